// An eight-wide tree of boxes over the triangles, in world space. One tree serves every ellipsoid: a query
// widens the boxes by its own radii.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "queries/leaf_triangle.h"
#include "simd/four.h"
#include "slipface/base/types.h"
#include "tree/bvh_layout.h"

namespace slipface::detail {

inline const float* leaf_coordinates(const Leaf& leaf) {
    return reinterpret_cast<const float*>(&leaf + 1);
}
inline const std::uint32_t* leaf_ids(const Leaf& leaf) {
    return reinterpret_cast<const std::uint32_t*>(leaf_coordinates(leaf) + std::size_t{3} * leaf.vertices);
}
inline std::size_t leaf_bytes(std::size_t count, std::size_t vertices) {
    const std::size_t bytes = sizeof(Leaf) + 12 * vertices + 4 * count;
    return (bytes + leaf_alignment - 1) / leaf_alignment * leaf_alignment;
}
inline LeafTriangle leaf_triangle(const Leaf& leaf, std::size_t lane) {
    LeafTriangle triangle;
    const float* coordinates = leaf_coordinates(leaf);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const float* table = coordinates + axis * leaf.vertices;
        // One store, as wide as the later load: a load that spans several stores makes the processor wait.
        Four::of(table[leaf.corner[0][lane]], table[leaf.corner[1][lane]], table[leaf.corner[2][lane]])
            .store(triangle.at[axis]);
    }
    triangle.id = leaf_ids(leaf)[lane];
    return triangle;
}

struct Bvh {
    std::vector<BvhNode> nodes;          // the root first, parents before children; empty without triangles
    std::vector<std::uint32_t> parents;  // [node]; the root is its own parent
    std::vector<std::byte> leaves;
    // [triangle] index of its leaf times leaf_capacity, plus its lane.
    std::vector<std::uint32_t> slots;
    int depth = 0;  // levels of nodes
    std::array<float, 3> low{};
    std::array<float, 3> high{};

    const Leaf& leaf_at(std::uint32_t index) const {
        return *reinterpret_cast<const Leaf*>(&leaves[index * leaf_alignment]);
    }
    Leaf& leaf_at(std::uint32_t index) { return *reinterpret_cast<Leaf*>(&leaves[index * leaf_alignment]); }
    LeafTriangle triangle(TriangleId id) const {
        return leaf_triangle(leaf_at(slots[id] / leaf_capacity), slots[id] % leaf_capacity);
    }
    // What queries read.
    std::size_t view_bytes() const { return nodes.size() * sizeof(BvhNode) + leaves.size(); }
    TreeView view() const { return {nodes.empty() ? nullptr : nodes.data(), leaves.data()}; }
};

// Builds the tree over at most max_triangles triangles with finite coordinates. `bodies`:
// TriangleSoup::bodies. The result does not depend on the number of threads.
Bvh build_bvh(std::span<const Vec3f> positions, std::span<const std::array<std::uint32_t, 3>> triangles,
              std::span<const std::uint32_t> bodies);

// Moves triangles[i], all below slots.size(), to corners[i], which must be finite, and refits the boxes above
// them.
void move_bvh_triangles(Bvh& bvh, std::span<const TriangleId> triangles,
                        std::span<const std::array<Vec3f, 3>> corners);

}  // namespace slipface::detail
