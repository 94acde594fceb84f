// Finds which triangles of a leaf a moving or resting sphere certainly does not touch. Part of the kernels:
// see lanes.h.
#pragma once

#include "simd/lane_paths.h"

namespace slipface::detail {
namespace {

// The planes of eight triangles, stored for many paths of one sphere that start near each other.
struct LanePlane {
    LaneVec normal;  // unit, or shorter
    Lanes offset;
    Lanes slack;
    Lanes slack_per_length;

    // Bit k is set where a sphere at rest does not touch the plane; `size`: that of `at`.
    std::uint32_t apart_at_rest(const LaneVec& at, Lanes size) const {
        return lanes_above(lanes_abs(offset - dot(normal, at)),
                           slack + slack_per_length * size + Lanes::all(1.0F + determinant_rounding));
    }
    // As LeafFilter::apart_by_plane for the path from `at` by `along`; `motions`: the sum of their sizes.
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

// Eight triangles against a moving sphere. Each test rejects a triangle by a separating plane: all of the
// triangle is on one side and the sphere on the other. The direction u of the plane may be any; only the
// distances along it are rounded.
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
    // From corners that are relative to another point; the path starts at `at`, seen from there.
    LeafFilter(const LaneSpherePath& path, const LaneVec& at, const LaneVec (&seen)[3],
               const LaneVec (&edges)[3])
        : path_(path),
          a_{seen[0] - at, seen[1] - at, seen[2] - at},
          e_{edges[0], edges[1], edges[2]},
          n_(cross(e_[0], e_[1])),
          edges_(size_of(e_[0]) + size_of(e_[1]) + size_of(at)) {}

    const LaneVec& corner(int k) const { return a_[k]; }
    const LaneVec& edge(int k) const { return e_[k]; }

    // Planes that contain the direction of an edge and of the move: the sphere's distance from them is
    // constant.
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

    // By the triangle's own plane: a time before which each triangle is not touched. It is above `limit` if
    // the triangle is not touched up to `limit`.
    Lanes apart_by_plane(Lanes limit) const {
        const Lanes zero = Lanes::all(0.0F);
        const Lanes h = dot(n_, a_[0]);
        const Lanes speed = dot(n_, path_.d);
        return apart_until(lanes_abs(h), lanes_pick(lanes_less(h, zero), zero - speed, speed), dot(n_, n_),
                           rounding(limit) * size_of(e_[0]) * size_of(e_[1]));
    }
    // By the plane at right angles to the line from the sphere's centre at `t`, before it touches anything,
    // to the nearest point of the border: one step of Newton's method towards the touch. The result is at
    // least `t`. A second step would reject few more triangles.
    Lanes apart_by_border(Lanes t, Lanes limit) const {
        const LaneVec u = border_distance(lanes_min(t, limit) * path_.d);
        return lanes_max(
            apart_until(least_along(u), dot(u, path_.d), dot(u, u), rounding(limit) * size_of(u)), t);
    }

    // The plane has fewer roundings than a determinant. So has the length of its normal, which is at most 1
    // apart from them.
    LanePlane plane() const {
        const Lanes inverse = Lanes::all(1.0F) / lanes_sqrt(dot(n_, n_) + Lanes::all(least_square));
        const LaneVec normal = inverse * n_;
        const Lanes slack_per_length =
            Lanes::all(determinant_rounding) * size_of(e_[0]) * size_of(e_[1]) * inverse;
        return {normal, dot(normal, a_[0]), slack_per_length * (size_of(a_[0]) + edges_ + Lanes::all(1.0F)),
                slack_per_length};
    }

    // Bit k is set where a sphere of this radius at rest does not touch triangle k.
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

    // The square of how far the centre of the sphere can certainly be from where the path starts before it
    // touches each triangle. NaN becomes 0.
    Lanes clearance(const LanePlane& plane) const {
        const Lanes zero = Lanes::all(0.0F);
        const LaneVec u = border_distance({zero, zero, zero});
        const Lanes of_border =
            (least_along(u) - rounding(zero) * size_of(u)) /
            lanes_sqrt(dot(u, u) * Lanes::all(1.0F + determinant_rounding) + Lanes::all(least_square));
        const Lanes distance = lanes_max(of_border, lanes_abs(plane.offset) - plane.slack);
        // Also for the roundings of the path that this is compared with.
        const Lanes least = distance * Lanes::all(1.0F - 4.0F * determinant_rounding) -
                            Lanes::all(1.0F + 4.0F * determinant_rounding);
        const Lanes clear = lanes_max(least, zero);
        return clear * clear;
    }

    // Squared distance of the border from the start of the path; accurate enough only for an order.
    Lanes border_distance() const {
        const LaneVec motion = border_distance({Lanes::all(0.0F), Lanes::all(0.0F), Lanes::all(0.0F)});
        return dot(motion, motion);
    }

  private:
    LaneVec relative(const LaneVec& world) const {
        return product_minus(world - path_.centre, path_.inverse, path_.rest);
    }

    // The least of the three corners along u.
    Lanes least_along(const LaneVec& u) const {
        return lanes_min(lanes_min(dot(u, a_[0]), dot(u, a_[1])), dot(u, a_[2]));
    }

    LaneVec edge_between(const LaneVec& from, const LaneVec& to) const { return (to - from) * path_.inverse; }

    // An error bound, relative to |u|, of the distances along u between the triangle and the ends of the
    // path.
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

    // The time at which a sphere that approaches by `speed` has covered `distance` - sqrt(square), at least
    // 0; very late if it does not approach. NaN becomes 0.
    static Lanes apart_until(Lanes distance, Lanes speed, Lanes square, Lanes slack) {
        const Lanes radius =
            lanes_sqrt(square * Lanes::all(1.0F + determinant_rounding) + Lanes::all(least_square));
        const Lanes clear = distance - slack - radius;
        const Lanes t = clear / lanes_max(speed, Lanes::all(least_time));
        return lanes_max(t * Lanes::all(1.0F - time_slack), Lanes::all(0.0F));
    }

    // From `at` to approximately the nearest point of the triangle's border.
    LaneVec border_distance(const LaneVec& at) const {
        const Lanes zero = Lanes::all(0.0F);
        const Lanes one = Lanes::all(1.0F);
        LaneVec best{zero, zero, zero};
        Lanes best_square = zero;
        for (int k = 0; k < 3; ++k) {
            const LaneVec p = a_[k] - at;
            const Lanes ee = lanes_max(dot(e_[k], e_[k]), Lanes::all(least_square));
            // A quotient that is NaN becomes 0.
            const Lanes s = lanes_min(lanes_max((zero - dot(p, e_[k])) / ee, zero), one);
            const LaneVec motion = product_plus(s, e_[k], p);
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
    Lanes edges_;  // sum of their sizes, and that of the start relative to the origin of the corners
};

inline std::uint32_t present(const Leaf& leaf) {
    return (1U << leaf_size(leaf)) - 1;
}

}  // namespace
}  // namespace slipface::detail
