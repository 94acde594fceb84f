// Moves triangles: writes new corners to their leaves, and refits the boxes above.
#include <algorithm>
#include <bit>
#include <utility>

#include "tree/bvh.h"
#include "tree/pack_leaf.h"

namespace slipface::detail {
namespace {

using Corners = std::array<Vec3f, 3>;

// Writes the corners. Returns false if corners share a value along an axis but need different ones. `known`:
// [axis] the values that are already final in this round.
bool write_corners(Leaf& leaf, std::size_t lane, const Corners& corners,
                   std::array<std::uint32_t, 3>& known) {
    auto* values = const_cast<float*>(leaf_values(leaf));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::uint32_t at = leaf_corners(leaf, axis)[lane];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t index = corner_of(at, k);
            const float now = corners[k][static_cast<Eigen::Index>(axis)];
            const bool same =
                std::bit_cast<std::uint32_t>(values[index]) == std::bit_cast<std::uint32_t>(now);
            values[index] = now;
            if ((known[axis] >> index & 1U) != 0 && !same) return false;
            known[axis] |= 1U << index;
        }
        values += leaf.values[axis];
    }
    return true;
}

struct Moved {
    std::uint32_t leaf;
    std::uint32_t lane;
    std::uint32_t index;  // into the caller's list
};

// The values used by triangles that are not among the moved lanes.
std::array<std::uint32_t, 3> values_at_rest(const Leaf& leaf, std::uint32_t moved_lanes) {
    std::array<std::uint32_t, 3> mask{};
    for (std::size_t lane = 0; lane < leaf_size(leaf); ++lane) {
        if ((moved_lanes >> lane & 1U) != 0) continue;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (std::size_t k = 0; k < 3; ++k)
                mask[axis] |= 1U << corner_of(leaf_corners(leaf, axis)[lane], k);
        }
    }
    return mask;
}

LeafTriangle placed(TriangleId id, const Corners& corners) {
    LeafTriangle triangle{{}, id};
    for (std::size_t k = 0; k < 9; ++k)
        triangle.at[k % 3][k / 3] = corners[k / 3][static_cast<Eigen::Index>(k % 3)];
    return triangle;
}

using LeafTriangles = std::array<LeafTriangle, leaf_capacity>;

// Writes the leaf again with other corners, at the end of all leaves: first because what it shares by axis
// has turned, without room for more than its vertices, as these mostly stay together; then because they do
// not, with room for any corners, where it stays. Returns its index, which `parent` then has, too.
std::uint32_t rewrite(Bvh& bvh, BvhNode& parent, std::uint32_t index, const LeafTriangles& triangles) {
    const std::uint8_t shape = bvh.leaf_at(index).shape;
    const PackedLeaf packed(std::span<const LeafTriangle>(triangles).first(leaf_size(bvh.leaf_at(index))),
                            false);
    const bool roomy = (shape & leaf_by_axis) == 0;
    std::uint32_t to = index;
    if ((shape & leaf_roomy) == 0) {
        const std::size_t begin = bvh.leaves.size() - leaf_overread;
        const std::size_t size = begin + (roomy ? largest_leaf : packed.bytes()) + leaf_overread;
        // Of a large world a little turns: it should not take twice the memory for that.
        if (size > bvh.leaves.capacity()) bvh.leaves.reserve(size + size / 8);
        bvh.leaves.resize(size);
        to = static_cast<std::uint32_t>(begin / leaf_alignment);
        bvh.leaf_of.grow(std::size_t{to} + 1);
        *std::find(parent.child, parent.child + 8, leaf_bit | index) = leaf_bit | to;
    }
    packed.write(&bvh.leaves[std::size_t{to} * leaf_alignment]);
    Leaf& leaf = bvh.leaf_at(to);
    if (roomy) leaf.shape |= leaf_roomy;
    for (std::size_t lane = 0; lane < leaf_size(leaf); ++lane)
        bvh.leaf_of.set(leaf_id(leaf, lane), to);
    return to;
}

// Moves triangles of one leaf. Returns the index of the leaf afterwards.
std::uint32_t move_in_leaf(Bvh& bvh, BvhNode& parent, std::span<const Moved> moved,
                           std::span<const Corners> corners) {
    const std::uint32_t index = moved[0].leaf;
    Leaf& leaf = bvh.leaf_at(index);
    LeafTriangles triangles;
    for (std::size_t lane = 0; lane < leaf_size(leaf); ++lane)
        triangles[lane] = leaf_triangle(leaf, lane);
    std::array<const Corners*, leaf_capacity> to{};
    std::uint32_t lanes = 0;
    for (const Moved& one : moved) {
        lanes |= 1U << one.lane;
        to[one.lane] = &corners[one.index];
        triangles[one.lane] = placed(triangles[one.lane].id, corners[one.index]);
    }
    std::array<std::uint32_t, 3> known = values_at_rest(leaf, lanes);
    for (std::size_t lane = 0; lane < leaf_size(leaf); ++lane) {
        if (to[lane] != nullptr && !write_corners(leaf, lane, *to[lane], known))
            return rewrite(bvh, parent, index, triangles);
    }
    return index;
}

struct Bounds {
    std::array<float, 6> b;
};

Bounds leaf_bounds(const Leaf& leaf) {
    const float* values = leaf_values(leaf);
    Bounds bounds;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto [low, high] = std::minmax_element(values, values + leaf.values[axis]);
        bounds.b[axis] = *low;
        bounds.b[axis + 3] = *high;
        values += leaf.values[axis];
    }
    return bounds;
}

Bounds node_bounds(const BvhNode& node) {
    Bounds bounds;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        bounds.b[axis] = *std::min_element(node.bound[axis], node.bound[axis] + 8);
        bounds.b[axis + 3] = *std::max_element(node.bound[axis + 3], node.bound[axis + 3] + 8);
    }
    return bounds;
}

// Moves every triangle, given in ascending order, so that no search is needed.
void move_all(Bvh& bvh, std::span<const Corners> corners) {
    const auto move_leaf = [&](BvhNode& parent, std::uint32_t index) {
        Leaf& leaf = bvh.leaf_at(index);
        std::array<std::uint32_t, 3> known{};
        for (std::size_t lane = 0; lane < leaf_size(leaf); ++lane) {
            if (write_corners(leaf, lane, corners[leaf_id(leaf, lane)], known)) continue;
            LeafTriangles triangles;
            for (std::size_t i = 0; i < leaf_size(leaf); ++i)
                triangles[i] = placed(leaf_id(leaf, i), corners[leaf_id(leaf, i)]);
            return rewrite(bvh, parent, index, triangles);
        }
        return index;
    };
    // Parents come before their children.
    for (std::size_t n = bvh.nodes.size(); n-- > 0;) {
        for (std::size_t k = 0; k < 8; ++k) {
            BvhNode& node = bvh.nodes[n];
            const std::uint32_t child = node.child[k];
            if (is_missing(node, k)) continue;
            const Bounds bounds = (child & leaf_bit) != 0
                                      ? leaf_bounds(bvh.leaf_at(move_leaf(node, child & leaf_index_mask)))
                                      : node_bounds(bvh.nodes[child]);
            for (std::size_t row = 0; row < 6; ++row)
                node.bound[row][k] = bounds.b[row];
        }
    }
}

// Fits the box of a node's child; returns false if it fitted already.
bool fit(BvhNode& node, std::uint32_t link, const Bounds& bounds) {
    const auto k = static_cast<std::size_t>(std::find(node.child, node.child + 8, link) - node.child);
    bool same = true;
    for (std::size_t row = 0; row < 6; ++row) {
        same = same && node.bound[row][k] == bounds.b[row];
        node.bound[row][k] = bounds.b[row];
    }
    return !same;
}

void remove_duplicates(std::vector<std::uint32_t>& list) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
}

// What is above nodes and leaves. Most worlds never move, so it is not kept for them.
void find_parents(Bvh& bvh) {
    bvh.parents.resize(bvh.nodes.size());
    bvh.leaf_parents.clear();
    for (std::uint32_t n = 0; n < bvh.nodes.size(); ++n) {
        const BvhNode& node = bvh.nodes[n];
        for (std::size_t k = 0; k < 8; ++k) {
            if (is_missing(node, k)) continue;
            if ((node.child[k] & leaf_bit) != 0)
                bvh.leaf_parents.push_back({node.child[k] & leaf_index_mask, n});
            else
                bvh.parents[node.child[k]] = n;
        }
    }
    std::ranges::sort(bvh.leaf_parents, {}, &Bvh::LeafParent::leaf);
}

void move_some(Bvh& bvh, std::span<const TriangleId> triangles, std::span<const Corners> corners) {
    if (bvh.parents.empty()) find_parents(bvh);
    std::vector<Moved> moved(triangles.size());
    for (std::uint32_t i = 0; i < moved.size(); ++i) {
        const std::uint32_t leaf = bvh.leaf_of[triangles[i]];
        moved[i] = {leaf, static_cast<std::uint32_t>(lane_of(bvh.leaf_at(leaf), triangles[i])), i};
    }
    // If a triangle is given twice, the later one applies.
    std::ranges::sort(moved, {}, [](const Moved& one) { return std::pair(one.leaf, one.index); });
    std::vector<std::uint32_t> nodes;
    for (std::size_t first = 0; first < moved.size();) {
        const std::uint32_t before = moved[first].leaf;
        std::size_t end = first + 1;
        while (end < moved.size() && moved[end].leaf == before)
            ++end;
        const std::uint32_t parent =
            std::ranges::lower_bound(bvh.leaf_parents, before, {}, &Bvh::LeafParent::leaf)->parent;
        BvhNode& node = bvh.nodes[parent];
        const std::uint32_t index =
            move_in_leaf(bvh, node, std::span(moved).subspan(first, end - first), corners);
        // Later leaves have higher indices.
        if (index != before) bvh.leaf_parents.push_back({index, parent});
        if (fit(node, leaf_bit | index, leaf_bounds(bvh.leaf_at(index)))) nodes.push_back(parent);
        first = end;
    }
    // A node is refitted again after each round in which a child changed; the last refit is correct.
    while (!nodes.empty()) {
        remove_duplicates(nodes);
        std::vector<std::uint32_t> above;
        for (const std::uint32_t node : nodes) {
            if (node == 0) continue;
            const std::uint32_t parent = bvh.parents[node];
            if (fit(bvh.nodes[parent], node, node_bounds(bvh.nodes[node]))) above.push_back(parent);
        }
        nodes = std::move(above);
    }
}

}  // namespace

void move_bvh_triangles(Bvh& bvh, std::span<const TriangleId> triangles, std::span<const Corners> corners) {
    bool all = triangles.size() == bvh.leaf_of.size();
    for (std::size_t i = 0; all && i < triangles.size(); ++i)
        all = triangles[i] == i;
    if (all) {
        move_all(bvh, corners);
        bvh.parents.clear();  // leaves may have other places now
    } else {
        move_some(bvh, triangles, corners);
    }
    if (!bvh.nodes.empty()) {
        const Bounds bounds = node_bounds(bvh.nodes[0]);
        std::copy_n(bounds.b.begin(), 3, bvh.low.begin());
        std::copy_n(bounds.b.begin() + 3, 3, bvh.high.begin());
    }
}

}  // namespace slipface::detail
