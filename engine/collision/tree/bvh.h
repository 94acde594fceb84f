// An eight-wide tree of boxes over the triangles, in world space. One tree serves every ellipsoid: a query
// widens the boxes by its own radii.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "queries/leaf_triangle.h"
#include "simd/four.h"
#include "slipface/base/types.h"
#include "tree/leaf.h"
#include "tree/triangle_leaves.h"

namespace slipface::detail {

inline LeafTriangle leaf_triangle(const Leaf& leaf, std::size_t lane) {
    LeafTriangle triangle;
    const float* values = leaf_values(leaf);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::uint32_t corners = leaf_corners(leaf, axis)[lane];
        // One store, as wide as the later load: a load that spans several stores makes the processor wait.
        Four::of(values[corner_of(corners, 0)], values[corner_of(corners, 1)], values[corner_of(corners, 2)])
            .store(triangle.at[axis]);
        values += leaf.values[axis];
    }
    triangle.id = leaf_id(leaf, lane);
    return triangle;
}
// Stands for none until one is found. Its corners stay as they are, because to set them costs a short query
// several per cent of its time.
inline LeafTriangle no_triangle() {
    LeafTriangle triangle;
    triangle.id = no_id;
    return triangle;
}
inline std::size_t lane_of(const Leaf& leaf, TriangleId id) {
    std::size_t lane = 0;
    while (leaf_id(leaf, lane) != id)
        ++lane;
    return lane;
}

// How a leaf may store its corners.
enum class LeafForm : std::uint8_t {
    any,
    vertices  // not by axis: vertices stay vertices wherever the leaf is placed
};

// Of a child: its box is empty.
inline bool is_missing(const BvhNode& node, std::size_t k) {
    return node.bound[0][k] > node.bound[3][k];
}

struct Bvh {
    std::vector<BvhNode> nodes;  // the root first, parents before children; empty without triangles
    std::vector<std::byte> leaves;
    TriangleLeaves leaf_of;  // [triangle]
    int depth = 0;           // levels of nodes
    std::array<float, 3> low{};
    std::array<float, 3> high{};
    // Once triangles have moved: what is above each node, and above each leaf, ascending.
    std::vector<std::uint32_t> parents;  // [node]; the root is its own parent
    struct LeafParent {
        std::uint32_t leaf;
        std::uint32_t parent;
    };
    std::vector<LeafParent> leaf_parents;

    const Leaf& leaf_at(std::uint32_t index) const {
        return *reinterpret_cast<const Leaf*>(&leaves[std::size_t{index} * leaf_alignment]);
    }
    Leaf& leaf_at(std::uint32_t index) {
        return *reinterpret_cast<Leaf*>(&leaves[std::size_t{index} * leaf_alignment]);
    }
    LeafTriangle triangle(TriangleId id) const {
        const Leaf& leaf = leaf_at(leaf_of[id]);
        return leaf_triangle(leaf, lane_of(leaf, id));
    }
    // What queries read.
    std::size_t view_bytes() const { return nodes.size() * sizeof(BvhNode) + leaves.size(); }
    TreeView view() const { return {nodes.empty() ? nullptr : nodes.data(), leaves.data()}; }
};

// Builds the tree over at most max_triangles triangles with finite coordinates. `bodies`:
// TriangleSoup::bodies. The result does not depend on the number of threads.
Bvh build_bvh(std::span<const Vec3f> positions, std::span<const std::array<std::uint32_t, 3>> triangles,
              std::span<const std::uint32_t> bodies, LeafForm form);

// Moves triangles[i], all below leaf_of.size(), to corners[i], which must be finite, and refits the boxes
// above them.
void move_bvh_triangles(Bvh& bvh, std::span<const TriangleId> triangles,
                        std::span<const std::array<Vec3f, 3>> corners);

}  // namespace slipface::detail
