// The triangles around a body, and sweeps that stay among them. Part of the kernels: see lanes.h.
#pragma once

#include "leaf_filter.h"
#include "paths.h"

namespace slipface::detail {
namespace {

// Boxes against a point, in sphere space.
struct LaneBody {
    Lanes up[3];
    Lanes down[3];
    Lanes inverse[3];

    explicit LaneBody(const PointBoxes& body) {
        for (int axis = 0; axis < 3; ++axis) {
            up[axis] = Lanes::all(body.up[axis]);
            down[axis] = Lanes::all(body.down[axis]);
            inverse[axis] = Lanes::all(body.sphere.inverse[axis]);
        }
    }
    // A lower bound.
    template <class Rows>
    Lanes distance(const Rows& rows) const {
        Lanes square = Lanes::all(0.0F);
        for (int axis = 0; axis < 3; ++axis) {
            const Lanes along =
                lanes_max(lanes_max(rows(axis) - up[axis], down[axis] - rows(axis + 3)), Lanes::all(0.0F)) *
                inverse[axis];
            square = square + along * along;
        }
        // Seven roundings on the way; the slack is larger than their sum.
        return lanes_sqrt(square) * Lanes::all(1.0F - time_slack);
    }
};

bool near_kernel(const TreeView& tree, const PointBoxes& path, float reach, NearTriangles& out) {
    const LaneBody body(path);
    const Lanes limit = Lanes::all(1.0F + reach);
    std::uint32_t nodes[traversal_stack];
    std::uint32_t leaves[near_capacity + 8];
    std::uint32_t node_count = 1;
    std::uint32_t leaf_count = 0;
    nodes[0] = 0;
    while (node_count != 0) {
        const BvhNode& node = tree.nodes[nodes[--node_count]];
        const std::uint32_t near = lanes_not_above(body.distance(NodeRows{node}), limit);
        const std::uint32_t ends = leaf_children(node);
        leaf_count = append_children(node, near & ends, leaves, leaf_count);
        node_count = append_children(node, near & ~ends, nodes, node_count);
        if (leaf_count > near_capacity) return false;
    }
    out.count = 0;
    for (std::uint32_t i = 0; i < leaf_count; ++i) {
        const Leaf& leaf = leaf_at(tree, leaves[i] & leaf_place_mask);
        Lanes v[9];
        lanes_of_leaf(leaf, v);
        const Lanes away = body.distance(LeafRows(v));
        const std::uint32_t mask = lanes_not_above(away, limit) & present(leaf);
        const auto more = static_cast<std::uint32_t>(__builtin_popcount(mask));
        if (out.count + more > near_capacity) return false;
        const auto* ids = reinterpret_cast<const std::uint32_t*>(&leaf + 1) + std::size_t{3} * leaf.vertices;
        for (int row = 0; row < 9; ++row)
            append(v[row], mask, out.corner[row] + out.count);
        append(away - Lanes::all(1.0F), mask, out.clear + out.count);
        append(ids, mask, out.id + out.count);
        out.count += more;
    }
    for (auto& row : out.corner)
        Lanes::all(0.0F).store(row + out.count);
    Lanes::all(__builtin_inff()).store(out.clear + out.count);
    return true;
}

std::uint32_t near_sweep_kernel(const NearTriangles& near, float clear_limit, const EllipsoidQuery& query,
                                double reach, NearCandidate* out) {
    const LaneSpherePath sphere(sphere_path(query, reach));
    const Lanes until = Lanes::all(time_limit(1.0));
    std::uint32_t found = 0;
    for (std::uint32_t first = 0; first < near.count; first += 8) {
        std::uint32_t mask = lanes_not_above(Lanes::load(near.clear + first), Lanes::all(clear_limit));
        if (mask == 0) continue;
        Lanes v[9];
        for (int row = 0; row < 9; ++row)
            v[row] = Lanes::load(near.corner[row] + first);
        const LeafFilter filter(sphere, v);
        // Along the ground nothing gets past the planes.
        const Lanes plane = filter.apart_by_plane(until);
        mask &= ~lanes_above(plane, until);
        if (mask == 0) continue;
        const Lanes after = filter.apart_by_border(plane, until);
        mask &= ~filter.apart_beside(until) & ~lanes_above(after, until);
        alignas(32) float times[8];
        after.store(times);
        for (; mask != 0; mask &= mask - 1) {
            const unsigned lane = first_lane(mask);
            out[found++] = {first + lane, times[lane]};
        }
    }
    return found;
}

}  // namespace
}  // namespace slipface::detail
