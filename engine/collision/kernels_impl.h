// The kernels' code, included by one file for each instruction set. It has internal linkage and calls no
// function that another file could share: see lanes.h.
#pragma once

#include "kernels.h"
#include "lanes.h"

namespace slipface::detail {
namespace {

struct StackEntry {
    float key;
    std::uint32_t child;
};

inline unsigned first_lane(std::uint32_t mask) {
    return static_cast<unsigned>(__builtin_ctz(mask));
}

// Asks for the memory of a child that will be looked at soon.
inline void fetch(const TreeView& tree, std::uint32_t child) {
    const auto* at = (child & leaf_bit) != 0
                         ? tree.leaves + std::size_t{child & leaf_place_mask} * leaf_alignment
                         : reinterpret_cast<const std::byte*>(tree.nodes + child);
    __builtin_prefetch(at);
    __builtin_prefetch(at + 64);
    __builtin_prefetch(at + 128);
}

// Visits leaves in the order of their boxes' keys. `test(node, limit, keys)` gives the mask of children to
// visit; `visit(leaf, limit)` returns the limit from then on, below 0 to stop.
template <class Test, class Visit>
inline void walk(const TreeView& tree, float limit, Test&& test, Visit&& visit) {
    StackEntry stack[traversal_stack];
    std::size_t size = 0;
    std::uint32_t current = 0;
    alignas(32) float keys[8];
    while (true) {
        if ((current & leaf_bit) != 0) {
            const auto* leaf = reinterpret_cast<const Leaf*>(
                tree.leaves + std::size_t{current & leaf_place_mask} * leaf_alignment);
            limit = visit(*leaf, limit);
            if (limit < 0.0F) return;
        } else {
            const BvhNode& node = tree.nodes[current];
            std::uint32_t mask = test(node, limit, keys);
            if (mask != 0) {
                const std::uint32_t others = mask & (mask - 1);
                if (others == 0) {
                    current = node.child[first_lane(mask)];
                    continue;
                }
                const std::size_t bottom = size;
                for (; mask != 0; mask &= mask - 1) {
                    const unsigned k = first_lane(mask);
                    const StackEntry entry{keys[k], node.child[k]};
                    std::size_t place = size++;
                    for (; place > bottom && stack[place - 1].key < entry.key; --place)
                        stack[place] = stack[place - 1];
                    stack[place] = entry;
                }
                fetch(tree, stack[size - 2].child);
            }
        }
        do {
            if (size == 0) return;
            --size;
        } while (!(stack[size].key <= limit));
        current = stack[size].child;
    }
}

struct NodeRows {
    const BvhNode& node;
    Lanes operator()(int row) const { return Lanes::load(node.bound[row]); }
};
// The own boxes of a leaf's triangles.
struct LeafRows {
    const Lanes (&v)[9];
    Lanes operator()(int row) const {
        return row < 3 ? lanes_min(lanes_min(v[row], v[row + 3]), v[row + 6])
                       : lanes_max(lanes_max(v[row - 3], v[row]), v[row + 3]);
    }
};

struct LaneBoxPath {
    static constexpr float late = 1.0F + 4.0F * time_slack;

    Lanes near_offset[3];
    Lanes far_offset[3];
    Lanes inverse[3];
    Lanes far_inverse[3];
    int near_row[3];
    int far_row[3];

    explicit LaneBoxPath(const BoxPath& path) {
        for (int axis = 0; axis < 3; ++axis) {
            near_offset[axis] = Lanes::all(path.near_offset[axis]);
            far_offset[axis] = Lanes::all(path.far_offset[axis]);
            inverse[axis] = Lanes::all(path.inverse[axis]);
            // The slack of a time, on the way out, costs no product of its own.
            far_inverse[axis] = Lanes::all(path.inverse[axis] * late);
            near_row[axis] = axis + 3 * path.backward[axis];
            far_row[axis] = axis + 3 - 3 * path.backward[axis];
        }
    }
    // Which of eight boxes are met no later than `limit`, and when they are entered.
    template <class Rows>
    std::uint32_t meet(const Rows& rows, float limit, Lanes& enter) const {
        enter = Lanes::all(0.0F);
        Lanes leave = Lanes::all(limit * late);
        for (int axis = 0; axis < 3; ++axis) {
            enter = lanes_max((rows(near_row[axis]) - near_offset[axis]) * inverse[axis], enter);
            leave = lanes_min((rows(far_row[axis]) - far_offset[axis]) * far_inverse[axis], leave);
        }
        return lanes_not_above(enter, leave + Lanes::all(least_time));
    }
};

struct LaneVec {
    Lanes x, y, z;
};
inline LaneVec operator+(const LaneVec& a, const LaneVec& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline LaneVec operator-(const LaneVec& a, const LaneVec& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline LaneVec operator-(const LaneVec& a) {
    const Lanes zero = Lanes::all(0.0F);
    return {zero - a.x, zero - a.y, zero - a.z};
}
inline LaneVec operator*(const LaneVec& a, const LaneVec& b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
inline LaneVec operator*(Lanes s, const LaneVec& a) {
    return {s * a.x, s * a.y, s * a.z};
}
inline Lanes dot(const LaneVec& a, const LaneVec& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline LaneVec cross(const LaneVec& a, const LaneVec& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
// At least the length, at most sqrt(3) of it.
inline Lanes size_of(const LaneVec& a) {
    return lanes_abs(a.x) + lanes_abs(a.y) + lanes_abs(a.z);
}
inline LaneVec all(const float (&v)[4]) {
    return {Lanes::all(v[0]), Lanes::all(v[1]), Lanes::all(v[2])};
}
inline LaneVec pick(LaneMask where, const LaneVec& yes, const LaneVec& no) {
    return {lanes_pick(where, yes.x, no.x), lanes_pick(where, yes.y, no.y), lanes_pick(where, yes.z, no.z)};
}

struct LaneSpherePath {
    LaneVec centre, rest, inverse, d;
    Lanes d_size;
    Lanes inverse_dd;

    explicit LaneSpherePath(const SpherePath& path)
        : centre(all(path.centre)),
          rest(all(path.rest)),
          inverse(all(path.inverse)),
          d(all(path.d)),
          d_size(size_of(d)),
          inverse_dd(Lanes::all(path.inverse_dd)) {}
};

// Eight triangles against a moving sphere. Every test drops a triangle for one reason only: a plane keeps it
// further than the radius from both ends of the path. The plane's direction u may come from anywhere; what is
// rounded is the distances along it.
class LeafFilter {
  public:
    LeafFilter(const LaneSpherePath& path, const Lanes (&v)[9])
        : path_(path),
          a_{relative({v[0], v[1], v[2]}), relative({v[3], v[4], v[5]}), relative({v[6], v[7], v[8]})},
          e_{edge({v[0], v[1], v[2]}, {v[3], v[4], v[5]}), edge({v[3], v[4], v[5]}, {v[6], v[7], v[8]}),
             edge({v[6], v[7], v[8]}, {v[0], v[1], v[2]})},
          n_(cross(e_[0], e_[1])) {}

    // The triangle's own plane, and those that contain an edge's direction and the move's.
    std::uint32_t apart_on_axes(float limit) const {
        const Lanes zero = Lanes::all(0.0F);
        const Lanes one = Lanes::all(1.0F);
        const Lanes end = Lanes::all(limit);
        const Lanes error = Lanes::all(determinant_rounding);
        const Lanes edges = size_of(e_[0]) + size_of(e_[1]);
        const Lanes reach = size_of(a_[0]) + edges + end * path_.d_size + one;
        const Lanes dn = dot(path_.d, n_);
        const Lanes from = zero - dot(n_, a_[0]);
        const Lanes to = from + end * dn;
        std::uint32_t mask = beyond(lanes_max(lanes_min(from, to), zero - lanes_max(from, to)), dot(n_, n_),
                                    error * size_of(e_[0]) * size_of(e_[1]) * reach);
        for (int k = 0; k < 3; ++k) {
            // On the axis e x d the edge is the point s, and the sphere's path stays at 0.
            const LaneVec axis = cross(e_[k], path_.d);
            const Lanes s = dot(a_[k], axis);
            const Lanes opposite = dot(a_[k == 0 ? 2 : k - 1], axis);
            mask |= beyond(lanes_max(lanes_min(s, opposite), zero - lanes_max(s, opposite)), dot(axis, axis),
                           error * size_of(e_[k]) * path_.d_size * reach);
        }
        return mask;
    }

    // The planes across the way from the triangle's nearest point to the path: first to the path's end, then
    // to where that is nearest to the point found. `radius` in sphere space. Returns what is left of `mask`.
    std::uint32_t not_apart_nearest(std::uint32_t mask, float limit, float radius, int rounds) const {
        const Lanes zero = Lanes::all(0.0F);
        const Lanes end = Lanes::all(limit);
        Lanes t = end;
        for (int round = 0;; ++round) {
            const LaneVec at = t * path_.d;
            const LaneVec way = border_way(at);
            mask &= ~apart_along(-way, end, radius);
            if (mask == 0 || round + 1 >= rounds) return mask;
            t = lanes_min(lanes_max(dot(way + at, path_.d) * path_.inverse_dd, zero), end);
        }
    }

    // The triangle's own plane alone, for a sphere at rest.
    std::uint32_t apart_on_plane(float radius) const {
        const Lanes error = Lanes::all(determinant_rounding);
        const Lanes reach = size_of(a_[0]) + size_of(e_[0]) + size_of(e_[1]) + Lanes::all(radius);
        return beyond(lanes_abs(dot(n_, a_[0])), Lanes::all(radius * radius) * dot(n_, n_),
                      error * size_of(e_[0]) * size_of(e_[1]) * reach);
    }

    // About when each triangle is touched; only an order.
    Lanes order(float limit) const {
        const Lanes zero = Lanes::all(0.0F);
        const Lanes h = dot(n_, a_[0]);
        const Lanes gap = lanes_abs(h) - lanes_sqrt(dot(n_, n_));
        const Lanes speed = lanes_abs(dot(n_, path_.d));
        const Lanes t = lanes_min(lanes_max(gap / speed, zero), Lanes::all(limit));
        const LaneVec at = t * path_.d;
        const LaneVec p[3] = {a_[0] - at, a_[1] - at, a_[2] - at};
        Lanes least = dot(n_, cross(p[0], e_[0]));
        least = lanes_min(least, dot(n_, cross(p[1], e_[1])));
        least = lanes_min(least, dot(n_, cross(p[2], e_[2])));
        // Outside: when the border's nearest point would be touched; never, if the path passes it.
        const LaneVec point = border_way(at) + at;
        const Lanes foot = dot(point, path_.d) * path_.inverse_dd;
        const LaneVec off = point - foot * path_.d;
        const Lanes room = Lanes::all(1.0F) - dot(off, off);
        const Lanes touch = foot - lanes_sqrt(lanes_max(room, zero) * path_.inverse_dd);
        const Lanes outside = lanes_pick(lanes_less(room, zero), Lanes::all(1e30F), touch);
        return lanes_pick(lanes_less(least, zero), outside, t);
    }
    // Squared distance of the border from the path's start; only an order.
    Lanes border_distance() const {
        const LaneVec way = border_way({Lanes::all(0.0F), Lanes::all(0.0F), Lanes::all(0.0F)});
        return dot(way, way);
    }

  private:
    LaneVec relative(const LaneVec& world) const {
        return (world - path_.centre) * path_.inverse - path_.rest;
    }

    LaneVec edge(const LaneVec& from, const LaneVec& to) const { return (to - from) * path_.inverse; }

    // Bit k is set where distance - slack > sqrt(square).
    static std::uint32_t beyond(Lanes distance, Lanes square, Lanes slack) {
        const Lanes clear = lanes_max(distance - slack, Lanes::all(0.0F));
        return lanes_above(clear * clear,
                           square * Lanes::all(1.0F + determinant_rounding) + Lanes::all(least_square));
    }

    std::uint32_t apart_along(const LaneVec& u, Lanes end, float radius) const {
        const Lanes zero = Lanes::all(0.0F);
        const Lanes furthest = lanes_max(lanes_max(dot(u, a_[0]), dot(u, a_[1])), dot(u, a_[2]));
        const Lanes path = lanes_min(end * dot(u, path_.d), zero);
        const Lanes reach =
            size_of(a_[0]) + size_of(e_[0]) + size_of(e_[2]) + end * path_.d_size + Lanes::all(radius);
        return beyond(path - furthest, Lanes::all(radius * radius) * dot(u, u),
                      Lanes::all(determinant_rounding) * size_of(u) * reach);
    }

    // From `at` to about the nearest point of the triangle's border.
    LaneVec border_way(const LaneVec& at) const {
        const Lanes zero = Lanes::all(0.0F);
        const Lanes one = Lanes::all(1.0F);
        LaneVec best{zero, zero, zero};
        Lanes best_square = zero;
        for (int k = 0; k < 3; ++k) {
            const LaneVec p = a_[k] - at;
            const Lanes ee = lanes_max(dot(e_[k], e_[k]), Lanes::all(least_square));
            // A quotient that is no number becomes 0.
            const Lanes s = lanes_min(lanes_max((zero - dot(p, e_[k])) / ee, zero), one);
            const LaneVec way = p + s * e_[k];
            const Lanes square = dot(way, way);
            if (k == 0) {
                best = way;
                best_square = square;
                continue;
            }
            const LaneMask nearer = lanes_less(square, best_square);
            best = pick(nearer, way, best);
            best_square = lanes_min(square, best_square);
        }
        return best;
    }

    const LaneSpherePath& path_;
    LaneVec a_[3];
    LaneVec e_[3];
    LaneVec n_;
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

float sweep_leaf(const LaneBoxPath& box, const LaneSpherePath& sphere, bool usable, const Leaf& leaf,
                 float limit, Consider consider, void* context) {
    Lanes v[9];
    lanes_of_leaf(leaf, v);
    Lanes enter;
    std::uint32_t mask = box.meet(LeafRows{v}, limit, enter) & present(leaf);
    if (mask == 0) return limit;
    if (!usable) {
        for (; mask != 0 && limit >= 0.0F; mask &= mask - 1)
            limit = consider(context, leaf, first_lane(mask));
        return limit;
    }
    const LeafFilter filter(sphere, v);
    mask &= ~filter.apart_on_axes(limit);
    if (mask == 0) return limit;
    // A third round would drop few that these two kept.
    mask = filter.not_apart_nearest(mask, limit, 1.0F, 2);
    if (mask == 0) return limit;
    const bool several = (mask & (mask - 1)) != 0;
    const Lanes order = several ? filter.order(limit) : enter;
    while (true) {
        const unsigned lane = several ? least_lane(mask, order) : first_lane(mask);
        const float before = limit;
        limit = consider(context, leaf, lane);
        mask &= ~(1U << lane);
        if (mask == 0 || limit < 0.0F) return limit;
        if (limit < before) {
            mask = filter.not_apart_nearest(mask, limit, 1.0F, 1);
            if (mask == 0) return limit;
        }
    }
}

void sweep_kernel(const TreeView& tree, const SweepPath& path, float limit, Consider consider,
                  void* context) {
    const LaneBoxPath box(path.box);
    const LaneSpherePath sphere(path.sphere);
    walk(
        tree, limit,
        [&](const BvhNode& node, float now, float* keys) {
            Lanes enter;
            const std::uint32_t mask = box.meet(NodeRows{node}, now, enter);
            enter.store(keys);
            return mask;
        },
        [&](const Leaf& leaf, float now) {
            return sweep_leaf(box, sphere, path.sphere.usable, leaf, now, consider, context);
        });
}

// Whether the ray's line passes each triangle, in the ray's sheared coordinates (ray.cpp). An edge function
// is off by less than its slack.
inline std::uint32_t ray_misses(const RayPath& path, const Lanes (&v)[9]) {
    Lanes x[3];
    Lanes y[3];
    Lanes xs[3];
    Lanes ys[3];
    const Lanes sx = Lanes::all(path.sx);
    const Lanes sy = Lanes::all(path.sy);
    for (int k = 0; k < 3; ++k) {
        const auto along = [&](int axis) {
            return v[3 * k + axis] - Lanes::all(path.centre[axis]) - Lanes::all(path.rest[axis]);
        };
        const Lanes ax = along(path.kx);
        const Lanes ay = along(path.ky);
        const Lanes az = along(path.kz);
        x[k] = ax - sx * az;
        y[k] = ay - sy * az;
        // |sx|, |sy| <= 1.
        xs[k] = lanes_abs(ax) + lanes_abs(az);
        ys[k] = lanes_abs(ay) + lanes_abs(az);
    }
    Lanes low = Lanes::all(0.0F);
    Lanes high = low;
    Lanes slack = low;
    for (int k = 0; k < 3; ++k) {
        const int next = k == 2 ? 0 : k + 1;
        const Lanes edge = x[k] * y[next] - y[k] * x[next];
        low = k == 0 ? edge : lanes_min(low, edge);
        high = k == 0 ? edge : lanes_max(high, edge);
        slack = lanes_max(slack, xs[k] * ys[next] + ys[k] * xs[next]);
    }
    slack = slack * Lanes::all(determinant_rounding) + Lanes::all(1e-30F);
    return lanes_above(Lanes::all(0.0F) - low, slack) & lanes_above(high, slack);
}

void ray_kernel(const TreeView& tree, const RayPath& path, float limit, Consider consider, void* context) {
    const LaneBoxPath box(path.box);
    walk(
        tree, limit,
        [&](const BvhNode& node, float now, float* keys) {
            Lanes enter;
            const std::uint32_t mask = box.meet(NodeRows{node}, now, enter);
            enter.store(keys);
            return mask;
        },
        [&](const Leaf& leaf, float now) {
            Lanes v[9];
            lanes_of_leaf(leaf, v);
            std::uint32_t mask = present(leaf);
            if (path.usable) {
                mask &= ~ray_misses(path, v);
                if (mask == 0) return now;
            }
            Lanes enter;
            mask &= box.meet(LeafRows{v}, now, enter);
            for (; mask != 0 && now >= 0.0F; mask &= mask - 1)
                now = consider(context, leaf, first_lane(mask));
            return now;
        });
}

struct LanePoint {
    Lanes up[3];
    Lanes down[3];

    explicit LanePoint(const PointBoxes& point) {
        for (int axis = 0; axis < 3; ++axis) {
            up[axis] = Lanes::all(point.up[axis]);
            down[axis] = Lanes::all(point.down[axis]);
        }
    }
    // Which of eight boxes are within `limit`, a squared distance, and a lower bound of theirs.
    template <class Rows>
    std::uint32_t within(const Rows& rows, float limit, Lanes& square) const {
        square = Lanes::all(0.0F);
        for (int axis = 0; axis < 3; ++axis) {
            const Lanes distance =
                lanes_max(lanes_max(rows(axis) - up[axis], down[axis] - rows(axis + 3)), Lanes::all(0.0F));
            square = square + distance * distance;
        }
        // Four roundings on the way; the slack is larger than their sum.
        square = square * Lanes::all(1.0F - 2.0F * time_slack);
        return lanes_not_above(square, Lanes::all(limit));
    }
};

void closest_kernel(const TreeView& tree, const PointBoxes& point, float limit, Consider consider,
                    void* context) {
    const LanePoint boxes(point);
    const LaneSpherePath sphere(point.sphere);
    walk(
        tree, limit,
        [&](const BvhNode& node, float now, float* keys) {
            Lanes square;
            const std::uint32_t mask = boxes.within(NodeRows{node}, now, square);
            square.store(keys);
            return mask;
        },
        [&](const Leaf& leaf, float now) {
            Lanes v[9];
            lanes_of_leaf(leaf, v);
            Lanes square;
            std::uint32_t mask = boxes.within(LeafRows{v}, now, square) & present(leaf);
            if (mask == 0) return now;
            if (!point.sphere.usable) {
                for (; mask != 0 && now >= 0.0F; mask &= mask - 1)
                    now = consider(context, leaf, first_lane(mask));
                return now;
            }
            const LeafFilter filter(sphere, v);
            const Lanes order = filter.border_distance();
            for (float tested = -1.0F; mask != 0 && now >= 0.0F;) {
                if (now != tested && now < 1e12F) {
                    const float radius = __builtin_sqrtf(now) * (1.0F + time_slack) + least_time;
                    mask &= ~filter.apart_on_plane(radius);
                    if (mask != 0) mask = filter.not_apart_nearest(mask, 0.0F, radius, 1);
                    tested = now;
                    continue;
                }
                const unsigned lane = least_lane(mask, order);
                now = consider(context, leaf, lane);
                mask &= ~(1U << lane);
            }
            return now;
        });
}

}  // namespace
}  // namespace slipface::detail
