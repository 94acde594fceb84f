// Moves triangles: writes new corners to their leaves, and refits the boxes above.
#include <algorithm>
#include <cstring>

#include "tree/bvh.h"

namespace slipface::detail {
namespace {

using Corners = std::array<Vec3f, 3>;

float* coordinates_of(Leaf& leaf) {
    return const_cast<float*>(leaf_coordinates(leaf));
}

// Writes the corners. Returns false if triangles share a vertex but need it at different positions. `known`:
// the vertices whose positions are already final in this round.
bool write_corners(Leaf& leaf, std::size_t lane, const Corners& corners, std::uint32_t& known) {
    float* coordinates = coordinates_of(leaf);
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t vertex = leaf.corner[k][lane];
        bool same = true;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            float& old = coordinates[axis * leaf.vertices + vertex];
            const float now = corners[k][static_cast<Eigen::Index>(axis)];
            same = same && old == now;
            old = now;
        }
        if ((known >> vertex & 1U) != 0 && !same) return false;
        known |= 1U << vertex;
    }
    return true;
}

struct Moved {
    std::uint32_t slot;
    std::uint32_t index;  // into the caller's list
};

// The vertices used by triangles that are not among the moved lanes.
std::uint32_t vertices_at_rest(const Leaf& leaf, std::uint32_t moved_lanes) {
    std::uint32_t mask = 0;
    for (std::size_t lane = 0; lane < leaf.count; ++lane) {
        if ((moved_lanes >> lane & 1U) != 0) continue;
        for (const auto& corner : leaf.corner)
            mask |= 1U << corner[lane];
    }
    return mask;
}

LeafTriangle placed(TriangleId id, std::span<const Corners> corners) {
    LeafTriangle triangle{{}, id};
    for (std::size_t k = 0; k < 9; ++k)
        triangle.at[k % 3][k / 3] = corners[id][k / 3][static_cast<Eigen::Index>(k % 3)];
    return triangle;
}

// Copies the leaf to the end of all leaves, with separate corners for each triangle. Returns its index.
std::uint32_t unshare(Bvh& bvh, std::uint32_t index,
                      const std::array<LeafTriangle, leaf_capacity>& triangles) {
    const std::size_t count = bvh.leaf_at(index).count;
    const std::size_t begin = bvh.leaves.size() - leaf_overread;
    bvh.leaves.resize(begin + leaf_bytes(count, 3 * count) + leaf_overread);
    const auto to = static_cast<std::uint32_t>(begin / leaf_alignment);
    Leaf& leaf = bvh.leaf_at(to);
    leaf.count = static_cast<std::uint8_t>(count);
    leaf.vertices = static_cast<std::uint8_t>(3 * count);
    leaf.unused = 0;
    leaf.parent = bvh.leaf_at(index).parent;
    for (std::size_t lane = 0; lane < leaf_capacity; ++lane) {
        const std::size_t from = std::min(lane, count - 1);
        for (std::size_t k = 0; k < 3; ++k)
            leaf.corner[k][lane] = static_cast<std::uint8_t>(3 * from + k);
    }
    auto* ids = const_cast<std::uint32_t*>(leaf_ids(leaf));
    for (std::size_t lane = 0; lane < count; ++lane) {
        ids[lane] = triangles[lane].id;
        bvh.slots[ids[lane]] = static_cast<std::uint32_t>(to * leaf_capacity + lane);
        for (std::size_t k = 0; k < 9; ++k)
            coordinates_of(leaf)[(k % 3) * leaf.vertices + 3 * lane + k / 3] =
                triangles[lane].at[k % 3][k / 3];
    }
    BvhNode& parent = bvh.nodes[leaf.parent];
    *std::find(parent.child, parent.child + 8, leaf_bit | index) = leaf_bit | to;
    return to;
}

// Moves triangles of one leaf. Returns the index of the leaf afterwards.
std::uint32_t move_in_leaf(Bvh& bvh, std::span<const Moved> moved, std::span<const Corners> corners) {
    const std::uint32_t index = moved[0].slot / leaf_capacity;
    Leaf& leaf = bvh.leaf_at(index);
    std::array<LeafTriangle, leaf_capacity> triangles;
    for (std::size_t lane = 0; lane < leaf.count; ++lane)
        triangles[lane] = leaf_triangle(leaf, lane);
    std::uint32_t lanes = 0;
    for (const Moved& one : moved) {
        const std::size_t lane = one.slot % leaf_capacity;
        lanes |= 1U << lane;
        for (std::size_t k = 0; k < 9; ++k)
            triangles[lane].at[k % 3][k / 3] = corners[one.index][k / 3][static_cast<Eigen::Index>(k % 3)];
    }
    std::uint32_t known = vertices_at_rest(leaf, lanes);
    for (std::size_t lane = 0; lane < leaf.count; ++lane) {
        if ((lanes >> lane & 1U) == 0) continue;
        Corners to;
        for (std::size_t k = 0; k < 9; ++k)
            to[k / 3][static_cast<Eigen::Index>(k % 3)] = triangles[lane].at[k % 3][k / 3];
        if (!write_corners(leaf, lane, to, known)) return unshare(bvh, index, triangles);
    }
    return index;
}

struct Bounds {
    std::array<float, 6> b;
};

Bounds leaf_bounds(const Leaf& leaf) {
    const float* coordinates = leaf_coordinates(leaf);
    Bounds bounds;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto [low, high] =
            std::minmax_element(coordinates + axis * leaf.vertices, coordinates + (axis + 1) * leaf.vertices);
        bounds.b[axis] = *low;
        bounds.b[axis + 3] = *high;
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
    const auto move_leaf = [&](std::uint32_t index) {
        Leaf& leaf = bvh.leaf_at(index);
        std::uint32_t known = 0;
        for (std::size_t lane = 0; lane < leaf.count; ++lane) {
            if (write_corners(leaf, lane, corners[leaf_ids(leaf)[lane]], known)) continue;
            std::array<LeafTriangle, leaf_capacity> triangles;
            for (std::size_t i = 0; i < leaf.count; ++i)
                triangles[i] = placed(leaf_ids(leaf)[i], corners);
            return unshare(bvh, index, triangles);
        }
        return index;
    };
    // Parents come before their children.
    for (std::size_t n = bvh.nodes.size(); n-- > 0;) {
        for (std::size_t k = 0; k < 8; ++k) {
            const std::uint32_t child = bvh.nodes[n].child[k];
            if (bvh.nodes[n].bound[0][k] > bvh.nodes[n].bound[3][k]) continue;  // missing
            const Bounds bounds = (child & leaf_bit) != 0
                                      ? leaf_bounds(bvh.leaf_at(move_leaf(child & leaf_index_mask)))
                                      : node_bounds(bvh.nodes[child]);
            for (std::size_t row = 0; row < 6; ++row)
                bvh.nodes[n].bound[row][k] = bounds.b[row];
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

void move_some(Bvh& bvh, std::span<const TriangleId> triangles, std::span<const Corners> corners) {
    std::vector<Moved> moved(triangles.size());
    for (std::uint32_t i = 0; i < moved.size(); ++i)
        moved[i] = {bvh.slots[triangles[i]], i};
    // If a triangle is given twice, the later one applies.
    std::sort(moved.begin(), moved.end(), [](const Moved& a, const Moved& b) {
        return a.slot < b.slot || (a.slot == b.slot && a.index < b.index);
    });
    std::vector<std::uint32_t> nodes;
    for (std::size_t first = 0; first < moved.size();) {
        std::size_t end = first + 1;
        while (end < moved.size() && moved[end].slot / leaf_capacity == moved[first].slot / leaf_capacity)
            ++end;
        const std::uint32_t index = move_in_leaf(bvh, std::span(moved).subspan(first, end - first), corners);
        const Leaf& leaf = bvh.leaf_at(index);
        if (fit(bvh.nodes[leaf.parent], leaf_bit | index, leaf_bounds(leaf))) nodes.push_back(leaf.parent);
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
    bool all = triangles.size() == bvh.slots.size();
    for (std::size_t i = 0; all && i < triangles.size(); ++i)
        all = triangles[i] == i;
    if (all) {
        move_all(bvh, corners);
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
