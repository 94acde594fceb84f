// An eight-wide tree of boxes over the triangles, in world space. One tree serves every shape: a query widens
// the boxes by its own radii.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "slipface/base/types.h"
#include "vec.h"

namespace slipface::detail {

// A triangle as the leaves hold it: nine floats in a row, so that a leaf is one run of memory.
struct LeafTriangle {
    std::array<float, 9> v;  // x, y, z of the three corners
    TriangleId id;

    V3 corner(int i) const {
        const auto k = static_cast<std::size_t>(3 * i);
        return {double{v[k]}, double{v[k + 1]}, double{v[k + 2]}};
    }
};

// Eight children side by side. A child is a leaf (top bit set, then the number of its triangles less one in
// three bits, then its first triangle), a node, or missing (its box is empty and no query meets it).
struct alignas(32) BvhNode {
    float bound[6][8];  // min x, y, z, then max x, y, z
    std::uint32_t child[8];
};

inline constexpr std::uint32_t leaf_bit = 0x80000000U;
inline constexpr std::uint32_t leaf_first_mask = 0x0fffffffU;
inline constexpr std::size_t leaf_capacity = 8;
inline constexpr std::size_t max_triangles = std::size_t{leaf_first_mask} + 1;
inline constexpr std::uint32_t leaf_first(std::uint32_t child) {
    return child & leaf_first_mask;
}
inline constexpr std::uint32_t leaf_count(std::uint32_t child) {
    return ((child >> 28) & 7U) + 1;
}

// Splits by cost stop at this depth of the binary tree; from there on ranges are halved, so no input makes it
// deeper than this plus the 28 halvings of the largest number of triangles.
inline constexpr int cost_split_depth = 36;
inline constexpr int max_depth = cost_split_depth + 28;
// A traversal pops one entry and pushes at most eight on each level.
inline constexpr std::size_t traversal_stack = std::size_t{max_depth} * 7 + 8;

struct Bvh {
    std::vector<BvhNode> nodes;           // the root first; empty for no triangles
    std::vector<LeafTriangle> triangles;  // in leaf order
    int depth = 0;                        // levels of nodes
};

// `triangles` in order of id, with finite coordinates, at most max_triangles. The result depends on nothing
// else.
Bvh build_bvh(std::vector<LeafTriangle> triangles);

}  // namespace slipface::detail
