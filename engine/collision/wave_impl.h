// Many sweeps through the tree side by side. A single sweep mostly waits: for memory, for the test before,
// for a branch that nobody could guess. Here each stage runs over all that is there before the next one
// begins, and no step waits for the one before it. Part of the kernels: see lanes.h.
#pragma once

#include "leaf_filter.h"

namespace slipface::detail {
namespace {

// Which sweep meets what.
struct WaveList {
    static constexpr std::uint32_t capacity = 2048;
    std::uint32_t size = 0;
    std::uint32_t sweep[capacity + 8];
    std::uint32_t child[capacity + 8];

    bool full() const { return size > capacity; }
    // Not when full. Keeps the sweep's number in all eight places that could be its own.
    void append(const BvhNode& node, std::uint32_t mask, std::uint32_t number) {
        for (std::uint32_t k = 0; k < 8; ++k)
            sweep[size + k] = number;
        size = append_children(node, mask, child, size);
    }
};

// So far ahead that memory has answered when a list comes to it.
constexpr std::uint32_t wave_look_ahead = 12;

// The leaves that the sweeps meet; false if there are too many.
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
        const std::uint32_t met =
            LaneBoxPath(sweep.path.box).meet(NodeRows{node}, sweep.from, sweep.to, enter);
        const std::uint32_t ends = leaf_children(node);
        leaves.append(node, met & ends, number);
        nodes.append(node, met & ~ends, number);
        if (leaves.full() || nodes.full()) return false;
    }
    return true;
}

std::uint32_t wave_kernel(const TreeView& tree, const WaveSweep* sweeps, std::uint32_t count,
                          Candidate* out) {
    WaveList leaves;
    if (!wave_leaves(tree, sweeps, count, leaves)) return wave_candidates + 1;

    // Leaves of which some triangle's own box is met.
    std::uint32_t met[WaveList::capacity + 8];
    std::uint32_t met_lanes[WaveList::capacity + 8];
    std::uint32_t met_count = 0;
    for (std::uint32_t i = 0; i < leaves.size; ++i) {
        if (i + wave_look_ahead < leaves.size) fetch(tree, leaves.child[i + wave_look_ahead]);
        const WaveSweep& sweep = sweeps[leaves.sweep[i]];
        const Leaf& leaf = leaf_at(tree, leaves.child[i] & leaf_place_mask);
        Lanes v[9];
        lanes_of_leaf(leaf, v);
        Lanes enter;
        met[met_count] = i;
        met_lanes[met_count] =
            LaneBoxPath(sweep.path.box).meet(LeafRows(v), sweep.from, sweep.to, enter) & present(leaf);
        met_count += met_lanes[met_count] != 0 ? 1U : 0U;
    }

    std::uint32_t found = 0;
    for (std::uint32_t k = 0; k < met_count; ++k) {
        const std::uint32_t i = met[k];
        const WaveSweep& sweep = sweeps[leaves.sweep[i]];
        const std::uint32_t place = leaves.child[i] & leaf_place_mask;
        Lanes v[9];
        lanes_of_leaf(leaf_at(tree, place), v);
        const LaneSpherePath path(sweep.path.sphere);
        const LeafFilter filter(path, v);
        const Lanes after = filter.apart_until(sweep.to);
        std::uint32_t mask =
            met_lanes[k] & ~filter.apart_beside(sweep.to) & ~lanes_above(after, Lanes::all(sweep.to));
        alignas(32) float times[8];
        after.store(times);
        for (; mask != 0; mask &= mask - 1) {
            const unsigned lane = first_lane(mask);
            if (found == wave_candidates) return wave_candidates + 1;
            out[found++] = {leaves.sweep[i], place, lane, times[lane]};
        }
    }
    return found;
}

}  // namespace
}  // namespace slipface::detail
