// Many sweeps through the tree side by side. A single sweep spends most of its time waiting: for memory, for
// the previous test, for branches that cannot be predicted. Here each stage processes all sweeps before the
// next stage begins, and no step waits for the one before it. Part of the kernels: see lanes.h.
#pragma once

#include "queries/leaf_filter.h"

namespace slipface::detail {
namespace {

// Pairs of a sweep and a child that it touches.
struct WaveList {
    static constexpr std::uint32_t capacity = 4096;
    std::uint32_t size = 0;
    std::uint32_t sweep[capacity + 8];
    std::uint32_t child[capacity + 8];

    bool full() const { return size > capacity; }
    // Must not be full. Writes the sweep's number to all eight entries that may be needed.
    void append(const BvhNode& node, std::uint32_t mask, std::uint32_t number) {
        for (std::uint32_t k = 0; k < 8; ++k)
            sweep[size + k] = number;
        size = append_children(node, mask, child, size);
    }
};

// Prefetch distance: far enough that memory has answered when the loop arrives.
constexpr std::uint32_t wave_look_ahead = 12;

// The leaves that the sweeps touch; false if there are too many.
inline bool wave_leaves(const TreeView& tree, const WaveSweep* sweeps, std::uint32_t count,
                        WaveList& leaves) {
    WaveList nodes;
    for (; nodes.size < count; ++nodes.size) {
        nodes.sweep[nodes.size] = nodes.size;
        nodes.child[nodes.size] = 0;
    }
    for (std::uint32_t i = 0; i < nodes.size; ++i) {
        if (i + wave_look_ahead < nodes.size) fetch(tree, nodes.child[i + wave_look_ahead]);
        const std::uint32_t number = nodes.sweep[i];
        const WaveSweep& sweep = sweeps[number];
        const BvhNode& node = tree.nodes[nodes.child[i]];
        Lanes enter;
        const std::uint32_t hit =
            LaneBoxPath(sweep.path.box).intersect(NodeRows{node}, sweep.from, sweep.to, enter);
        const std::uint32_t ends = leaf_children(node);
        leaves.append(node, hit & ends, number);
        nodes.append(node, hit & ~ends, number);
        if (leaves.full() || nodes.full()) return false;
    }
    return true;
}

// Triangles whose own boxes are touched, each with the path that touches it. In a leaf of eight there are
// three or four. Packed together with those of other leaves and sweeps they leave no lane of the next tests
// idle.
struct WavePairs {
    static constexpr std::uint32_t capacity = 128;
    std::uint32_t size = 0;
    alignas(32) float corner[9][capacity + 8];  // [3 * corner + axis]
    alignas(32) float path[12][capacity + 8];   // [axis] of centre, rest, inverse and d
    alignas(32) float until[capacity + 8];
    std::uint32_t sweep[capacity + 8];
    std::uint32_t leaf[capacity + 8];
    std::uint32_t lane[capacity + 8];

    bool full() const { return size > capacity - 8; }
    // Must not be full. Writes the sweep's values to all eight entries that may be needed.
    void append(const Lanes (&v)[9], std::uint32_t mask, const WaveSweep& its, std::uint32_t number,
                std::uint32_t index) {
        constexpr std::uint32_t lanes[8] = {0, 1, 2, 3, 4, 5, 6, 7};
        for (int row = 0; row < 9; ++row)
            detail::append(v[row], mask, corner[row] + size);
        detail::append(lanes, mask, lane + size);
        for (int axis = 0; axis < 3; ++axis) {
            Lanes::all(its.path.sphere.centre[axis]).store(path[axis] + size);
            Lanes::all(its.path.sphere.rest[axis]).store(path[3 + axis] + size);
            Lanes::all(its.path.sphere.inverse[axis]).store(path[6 + axis] + size);
            Lanes::all(its.path.sphere.d[axis]).store(path[9 + axis] + size);
        }
        Lanes::all(its.to).store(until + size);
        for (std::uint32_t k = 0; k < 8; ++k)
            sweep[size + k] = number;
        for (std::uint32_t k = 0; k < 8; ++k)
            leaf[size + k] = index;
        size += lane_count(mask);
    }
    LaneVec path_row(int row, std::uint32_t first) const {
        return {Lanes::load(path[row] + first), Lanes::load(path[row + 1] + first),
                Lanes::load(path[row + 2] + first)};
    }
};

// Appends the pairs that may touch to the first `found` entries of `out`. Returns the new number, or more
// than wave_candidates if they do not fit.
inline std::uint32_t wave_filter(const WavePairs& pairs, Candidate* out, std::uint32_t found) {
    for (std::uint32_t first = 0; first < pairs.size; first += 8) {
        const std::uint32_t left = pairs.size - first;
        std::uint32_t mask = left < 8 ? (1U << left) - 1 : 0xffU;
        Lanes v[9];
        for (int row = 0; row < 9; ++row)
            v[row] = Lanes::load(pairs.corner[row] + first);
        const LaneSpherePath path(pairs.path_row(0, first), pairs.path_row(3, first),
                                  pairs.path_row(6, first), pairs.path_row(9, first));
        const LeafFilter filter(path, v);
        const Lanes until = Lanes::load(pairs.until + first);
        const Lanes plane = filter.apart_by_plane(until);
        mask &= ~lanes_above(plane, until);
        if (mask == 0) continue;
        mask &= ~filter.apart_beside(until);
        if (mask == 0) continue;
        const Lanes after = filter.apart_by_border(plane, until);
        mask &= ~lanes_above(after, until);
        if (found + 8 > wave_candidates) return wave_candidates + 1;
        alignas(32) float times[8];
        after.store(times);
        for (; mask != 0; mask &= mask - 1) {
            const unsigned k = first_lane(mask);
            out[found++] = {pairs.sweep[first + k], pairs.leaf[first + k], pairs.lane[first + k], times[k]};
        }
    }
    return found;
}

std::uint32_t wave_kernel(const TreeView& tree, const WaveSweep* sweeps, std::uint32_t count,
                          Candidate* out) {
    WaveList leaves;
    if (!wave_leaves(tree, sweeps, count, leaves)) return wave_candidates + 1;
    WavePairs pairs;
    std::uint32_t found = 0;
    for (std::uint32_t i = 0; i < leaves.size; ++i) {
        if (i + wave_look_ahead < leaves.size) fetch(tree, leaves.child[i + wave_look_ahead]);
        const WaveSweep& sweep = sweeps[leaves.sweep[i]];
        const std::uint32_t index = leaves.child[i] & leaf_index_mask;
        const Leaf& leaf = leaf_at(tree, index);
        Lanes v[9];
        lanes_of_leaf(leaf, v);
        Lanes enter;
        const std::uint32_t mask =
            LaneBoxPath(sweep.path.box).intersect(LeafRows(v), sweep.from, sweep.to, enter) & present(leaf);
        if (mask != 0) pairs.append(v, mask, sweep, leaves.sweep[i], index);
        if (pairs.full() || i + 1 == leaves.size) {
            found = wave_filter(pairs, out, found);
            if (found > wave_candidates) return found;
            pairs.size = 0;
        }
    }
    return found;
}

}  // namespace
}  // namespace slipface::detail
