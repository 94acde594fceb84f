// How the tree lies in memory. Plain data, read by kernels that are compiled for several instruction sets, so
// nothing here has a function that the linker could take from one of them for another.
#pragma once

#include <cstddef>
#include <cstdint>

namespace slipface::detail {

// Eight children side by side. A child is a leaf (top bit set, then its place), a node, or missing (its box
// is empty and no query meets it).
struct alignas(32) BvhNode {
    float bound[6][8];  // min x, y, z, then max x, y, z
    std::uint32_t child[8];
};

inline constexpr std::uint32_t leaf_bit = 0x80000000U;
inline constexpr std::uint32_t leaf_index_mask = 0x7fffffffU;
inline constexpr std::size_t leaf_alignment = 8;  // places count in these
inline constexpr std::uint32_t leaf_capacity = 8;

// The head of a leaf. Behind it lie the x of all its vertices, then the y, the z, and the numbers of its
// triangles. Triangles of a leaf share vertices, which is what makes it small.
struct Leaf {
    std::uint8_t corner[3][leaf_capacity];  // [corner][lane] a vertex; lanes beyond count repeat the last
    std::uint8_t count;                     // triangles, 1 to leaf_capacity
    std::uint8_t vertices;                  // 1 to 3 * count
    std::uint16_t unused;
    std::uint32_t parent;  // node
};
static_assert(sizeof(Leaf) == 32);

// Kernels read whole registers: so much may be read behind the last leaf.
inline constexpr std::size_t leaf_overread = 128;

// Splits by cost stop at this depth of the binary tree; from there on ranges are halved, so no input makes it
// deeper than this plus the halvings of the largest number of triangles, and of bodies above it.
inline constexpr std::size_t max_triangles = std::size_t{1} << 25;
inline constexpr int cost_split_depth = 36;
inline constexpr int max_depth = cost_split_depth + 25 + 25;
// A traversal pops one entry and pushes at most eight on each level.
inline constexpr std::size_t traversal_stack = std::size_t{max_depth} * 7 + 8;

// What a kernel sees of a tree.
struct TreeView {
    const BvhNode* nodes;  // the root first
    const std::byte* leaves;
};

}  // namespace slipface::detail
