// Walks of the tree. Box tests are float and err on the side of visiting: docs/sweep.md, "Boxes", bounds
// their errors.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "bvh.h"
#include "lanes.h"

namespace slipface::detail {

// Coordinates, radii and moves within this range leave the float box tests free of overflow and underflow.
// Queries outside it look at every triangle instead.
inline constexpr double float_range = 1e15;
inline bool in_float_range(double radius) {
    return radius >= 1.0 / float_range && radius <= float_range;
}

// Relative slack of a float time against rounding: each is a subtraction, a reciprocal and a product away
// from exact input, under 8 ulp in all.
inline constexpr float time_slack = 1e-6F;
inline constexpr float least_time = 1e-37F;

// A float above (below) any that rounds to `value`: a step of one unit in the last place or two, without
// asking which way the conversion went.
inline float round_up(double value) {
    if (value > double{std::numeric_limits<float>::max()}) return std::numeric_limits<float>::infinity();
    if (value < -double{std::numeric_limits<float>::max()}) return -std::numeric_limits<float>::max();
    const auto nearest = static_cast<float>(value);
    return nearest + std::fabs(nearest) * 0x1.8p-23F + std::numeric_limits<float>::min();
}
inline float round_down(double value) {
    return -round_up(-value);
}

// The latest float time at which something may still improve on `best`.
inline float time_limit(double best) {
    return round_up(best) * (1.0F + 2.0F * time_slack) + least_time;
}

// Up to eight triangles of a leaf side by side.
struct LeafLanes {
    Lanes v[9];             // x, y, z of the three corners
    std::uint32_t present;  // mask of lanes in use

    LeafLanes(const LeafTriangle* first, std::uint32_t count) : present((1U << count) - 1) {
        const float* from[8];
        // Lanes beyond the leaf repeat its last triangle: nothing behind the array is read.
        for (std::uint32_t k = 0; k < 8; ++k)
            from[k] = first[std::min(k, count - 1)].v.data();
        lanes_gather9(from, v);
    }
    // The triangles' own boxes, in the order of BvhNode::bound.
    Lanes operator()(int row) const {
        return row < 3 ? lanes_min(lanes_min(v[row], v[row + 3]), v[row + 6])
                       : lanes_max(lanes_max(v[row - 3], v[row]), v[row + 3]);
    }
};

// The path of an axis-aligned box (or a point) against the tree's boxes: near and far plane of each axis are
// widened by the path's own half extents, then tested as slabs.
struct BoxPath {
    float centre[3];       // the nearest float to the start
    float near_offset[3];  // what the start lies off it, plus the widening of the nearer plane
    float far_offset[3];
    float inverse[3];  // 1 / move, +inf for none
    int near_row[3];   // row of BvhNode::bound that is met first
    int far_row[3];

    BoxPath(const V3& from, const V3& move, const V3& half) {
        const double f[3] = {from.x, from.y, from.z};
        const double m[3] = {move.x, move.y, move.z};
        const double r[3] = {half.x, half.y, half.z};
        for (int axis = 0; axis < 3; ++axis) {
            centre[axis] = static_cast<float>(f[axis]);
            const double rest = f[axis] - double{centre[axis]};
            const auto step = static_cast<float>(m[axis]);
            inverse[axis] = step == 0.0F ? std::numeric_limits<float>::infinity() : 1.0F / step;
            const bool forward = inverse[axis] > 0.0F;
            near_row[axis] = forward ? axis : axis + 3;
            far_row[axis] = forward ? axis + 3 : axis;
            near_offset[axis] = forward ? round_up(rest + r[axis]) : round_down(rest - r[axis]);
            far_offset[axis] = forward ? round_down(rest - r[axis]) : round_up(rest + r[axis]);
        }
    }

    // Which of eight boxes are met no later than `limit`, and when they are entered. `row(k)` gives the
    // boxes' bounds as BvhNode::bound orders them.
    template <class Row>
    std::uint32_t meet(Row&& row, float limit, Lanes& enter) const {
        enter = Lanes::all(0.0F);
        Lanes leave = Lanes::all(limit);
        for (int axis = 0; axis < 3; ++axis) {
            const Lanes origin = Lanes::all(centre[axis]);
            const Lanes scale = Lanes::all(inverse[axis]);
            const Lanes near = row(near_row[axis]) - origin;
            const Lanes far = row(far_row[axis]) - origin;
            enter = lanes_max((near - Lanes::all(near_offset[axis])) * scale, enter);
            leave = lanes_min((far - Lanes::all(far_offset[axis])) * scale, leave);
        }
        return lanes_not_above(enter, leave * Lanes::all(1.0F + 4.0F * time_slack) + Lanes::all(least_time));
    }
    std::uint32_t meet(const BvhNode& node, float limit, float* entry) const {
        Lanes enter;
        const std::uint32_t mask = meet([&](int k) { return Lanes::load(node.bound[k]); }, limit, enter);
        enter.store(entry);
        return mask;
    }
};

// Half extents of an ellipsoid's box, widened to cover what the float tests and the narrow phase round off: a
// millionth of the radius, the rounding of float differences as long as the move, and that of double
// coordinates.
inline V3 box_half_extents(const V3& radii, const V3& move, double reach) {
    const auto widen = [reach](double radius, double step) {
        return radius * (1.0 + 1e-6) + 3e-7 * std::fabs(step) + 1e-14 * reach;
    };
    return {widen(radii.x, move.x), widen(radii.y, move.y), widen(radii.z, move.z)};
}

struct StackEntry {
    float key;
    std::uint32_t child;
};

// Visits leaves in the order in which their boxes are met. `test(node, keys)` gives the mask of children to
// visit and their keys; `limit()` is the largest key still of interest; `leaf(first, count)` returns false to
// stop.
template <class Test, class Limit, class Leaf>
void walk_ordered(const Bvh& bvh, Test&& test, Limit&& limit, Leaf&& leaf) {
    if (bvh.nodes.empty()) return;
    StackEntry stack[traversal_stack];
    std::size_t size = 0;
    std::uint32_t current = 0;
    alignas(32) float keys[8];
    while (true) {
        if ((current & leaf_bit) != 0) {
            if (!leaf(leaf_first(current), leaf_count(current))) return;
        } else {
            const BvhNode& node = bvh.nodes[current];
            const std::size_t bottom = size;
            for (std::uint32_t mask = test(node, keys); mask != 0; mask &= mask - 1) {
                const auto k = static_cast<std::size_t>(std::countr_zero(mask));
                const StackEntry entry{keys[k], node.child[k]};
                std::size_t place = size++;
                for (; place > bottom && stack[place - 1].key < entry.key; --place)
                    stack[place] = stack[place - 1];
                stack[place] = entry;
            }
        }
        do {
            if (size == 0) return;
            --size;
        } while (!(stack[size].key <= limit()));
        current = stack[size].child;
    }
}

}  // namespace slipface::detail
