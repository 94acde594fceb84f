// The triangles of a leaf against a sphere that moves or rests, and which of them it certainly does not
// touch. Part of the kernels: see lanes.h.
#pragma once

#include "lane_paths.h"

namespace slipface::detail {
namespace {

// The planes of eight triangles, kept for many paths of one sphere that start near each other.
struct LanePlane {
    LaneVec normal;  // unit, or shorter
    Lanes offset;
    Lanes slack;
    Lanes slack_per_length;

    // As LeafFilter::apart_by_plane for the path from `at` by `along`; `ways`: their sizes.
    Lanes apart_until(const LaneVec& at, const LaneVec& along, Lanes motions) const {
        const Lanes zero = Lanes::all(0.0F);
        const Lanes h = offset - dot(normal, at);
        const Lanes speed = dot(normal, along);
        const Lanes clear =
            lanes_abs(h) - (slack + slack_per_length * motions) - Lanes::all(1.0F + determinant_rounding);
        const Lanes t =
            clear / lanes_max(lanes_pick(lanes_less(h, zero), zero - speed, speed), Lanes::all(least_time));
        return lanes_max(t * Lanes::all(1.0F - time_slack), zero);
    }
};

// Eight triangles against a moving sphere. Every test keeps a triangle away for one reason only: a plane has
// all of it on one side and the sphere on the other. The plane's direction u may come from anywhere; what is
// rounded is the distances along it.
class LeafFilter {
  public:
    LeafFilter(const LaneSpherePath& path, const Lanes (&v)[9])
        : path_(path),
          a_{relative({v[0], v[1], v[2]}), relative({v[3], v[4], v[5]}), relative({v[6], v[7], v[8]})},
          e_{edge_between({v[0], v[1], v[2]}, {v[3], v[4], v[5]}),
             edge_between({v[3], v[4], v[5]}, {v[6], v[7], v[8]}),
             edge_between({v[6], v[7], v[8]}, {v[0], v[1], v[2]})},
          n_(cross(e_[0], e_[1])),
          edges_(size_of(e_[0]) + size_of(e_[1])) {}
    // Of corners and edges that were seen from elsewhere: from where the path starts at `at`.
    LeafFilter(const LaneSpherePath& path, const LaneVec& at, const LaneVec (&seen)[3],
               const LaneVec (&edges)[3])
        : path_(path),
          a_{seen[0] - at, seen[1] - at, seen[2] - at},
          e_{edges[0], edges[1], edges[2]},
          n_(cross(e_[0], e_[1])),
          edges_(size_of(e_[0]) + size_of(e_[1]) + size_of(at)) {}

    const LaneVec& corner(int k) const { return a_[k]; }
    const LaneVec& edge(int k) const { return e_[k]; }

    // The planes that contain an edge's direction and the move's: the sphere's whole way stays beside them.
    std::uint32_t apart_beside(Lanes limit) const {
        const Lanes zero = Lanes::all(0.0F);
        const Lanes slack = rounding(limit) * path_.d_size;
        std::uint32_t mask = 0;
        for (int k = 0; k < 3; ++k) {
            // On the axis e x d the edge is the point s, and the sphere's path stays at 0.
            const LaneVec axis = cross(e_[k], path_.d);
            const Lanes s = dot(a_[k], axis);
            const Lanes opposite = dot(a_[k == 0 ? 2 : k - 1], axis);
            mask |= beyond(lanes_max(lanes_min(s, opposite), zero - lanes_max(s, opposite)), dot(axis, axis),
                           slack * size_of(e_[k]));
        }
        return mask;
    }

    // A time before which each triangle is not touched, by its own plane: more than `limit` where nothing is
    // touched up to it.
    Lanes apart_by_plane(Lanes limit) const {
        const Lanes zero = Lanes::all(0.0F);
        const Lanes h = dot(n_, a_[0]);
        const Lanes speed = dot(n_, path_.d);
        return apart_until(lanes_abs(h), lanes_pick(lanes_less(h, zero), zero - speed, speed), dot(n_, n_),
                           rounding(limit) * size_of(e_[0]) * size_of(e_[1]));
    }
    // By the plane across the way from where the sphere is at `t`, when it touches nothing yet, to the
    // nearest point of the border, a step of Newton's method for the touch; at least `t`. A second step would
    // spare few a look in double.
    Lanes apart_by_border(Lanes t, Lanes limit) const {
        const LaneVec u = border_distance(lanes_min(t, limit) * path_.d);
        return lanes_max(
            apart_until(least_along(u), dot(u, path_.d), dot(u, u), rounding(limit) * size_of(u)), t);
    }

    // Its roundings are fewer than those of a determinant, and so are those of the normal's length, which is
    // at most 1 but for them.
    LanePlane plane() const {
        const Lanes inverse = Lanes::all(1.0F) / lanes_sqrt(dot(n_, n_) + Lanes::all(least_square));
        const LaneVec normal = inverse * n_;
        const Lanes slack_per_length =
            Lanes::all(determinant_rounding) * size_of(e_[0]) * size_of(e_[1]) * inverse;
        return {normal, dot(normal, a_[0]), slack_per_length * (size_of(a_[0]) + edges_ + Lanes::all(1.0F)),
                slack_per_length};
    }

    // Those that a sphere of that radius does not touch at rest.
    std::uint32_t apart_at_rest(std::uint32_t mask, float radius) const {
        const Lanes reach = Lanes::all(radius);
        const Lanes slack = Lanes::all(determinant_rounding) * (size_of(a_[0]) + edges_ + reach);
        const Lanes square = reach * reach;
        std::uint32_t apart =
            beyond(lanes_abs(dot(n_, a_[0])), square * dot(n_, n_), slack * size_of(e_[0]) * size_of(e_[1]));
        if ((mask & ~apart) == 0) return apart;
        const Lanes zero = Lanes::all(0.0F);
        const LaneVec u = border_distance({zero, zero, zero});
        return apart | beyond(least_along(u), square * dot(u, u), slack * size_of(u));
    }

    // Squared distance of the border from the path's start; only an order.
    Lanes border_distance() const {
        const LaneVec motion = border_distance({Lanes::all(0.0F), Lanes::all(0.0F), Lanes::all(0.0F)});
        return dot(motion, motion);
    }

  private:
    LaneVec relative(const LaneVec& world) const {
        return (world - path_.centre) * path_.inverse - path_.rest;
    }

    // Of the corners.
    Lanes least_along(const LaneVec& u) const {
        return lanes_min(lanes_min(dot(u, a_[0]), dot(u, a_[1])), dot(u, a_[2]));
    }

    LaneVec edge_between(const LaneVec& from, const LaneVec& to) const { return (to - from) * path_.inverse; }

    // Times |u|: how much the distances along u between the triangle and the path's ends may be off.
    Lanes rounding(Lanes limit) const {
        const Lanes reach = size_of(a_[0]) + edges_ + limit * path_.d_size + Lanes::all(1.0F);
        return Lanes::all(determinant_rounding) * reach;
    }

    // Bit k is set where distance - slack > sqrt(square).
    static std::uint32_t beyond(Lanes distance, Lanes square, Lanes slack) {
        const Lanes clear = lanes_max(distance - slack, Lanes::all(0.0F));
        return lanes_above(clear * clear,
                           square * Lanes::all(1.0F + determinant_rounding) + Lanes::all(least_square));
    }

    // When a sphere that comes nearer by `speed` has covered `distance` - sqrt(square), at least 0; very late
    // if it does not come nearer. What is no number becomes 0.
    static Lanes apart_until(Lanes distance, Lanes speed, Lanes square, Lanes slack) {
        const Lanes radius =
            lanes_sqrt(square * Lanes::all(1.0F + determinant_rounding) + Lanes::all(least_square));
        const Lanes clear = distance - slack - radius;
        const Lanes t = clear / lanes_max(speed, Lanes::all(least_time));
        return lanes_max(t * Lanes::all(1.0F - time_slack), Lanes::all(0.0F));
    }

    // From `at` to about the nearest point of the triangle's border.
    LaneVec border_distance(const LaneVec& at) const {
        const Lanes zero = Lanes::all(0.0F);
        const Lanes one = Lanes::all(1.0F);
        LaneVec best{zero, zero, zero};
        Lanes best_square = zero;
        for (int k = 0; k < 3; ++k) {
            const LaneVec p = a_[k] - at;
            const Lanes ee = lanes_max(dot(e_[k], e_[k]), Lanes::all(least_square));
            // A quotient that is no number becomes 0.
            const Lanes s = lanes_min(lanes_max((zero - dot(p, e_[k])) / ee, zero), one);
            const LaneVec motion = p + s * e_[k];
            const Lanes square = dot(motion, motion);
            if (k == 0) {
                best = motion;
                best_square = square;
                continue;
            }
            const LaneMask nearer = lanes_less(square, best_square);
            best = pick(nearer, motion, best);
            best_square = lanes_min(square, best_square);
        }
        return best;
    }

    const LaneSpherePath& path_;
    LaneVec a_[3];
    LaneVec e_[3];
    LaneVec n_;
    Lanes edges_;  // their sizes, and that of the way from where the corners were seen from
};

inline std::uint32_t present(const Leaf& leaf) {
    return (1U << leaf.count) - 1;
}

inline unsigned least_lane(std::uint32_t mask, Lanes keys) {
    alignas(32) float key[8];
    keys.store(key);
    unsigned best = first_lane(mask);
    for (mask &= mask - 1; mask != 0; mask &= mask - 1) {
        const unsigned lane = first_lane(mask);
        if (key[lane] < key[best]) best = lane;
    }
    return best;
}

}  // namespace
}  // namespace slipface::detail
