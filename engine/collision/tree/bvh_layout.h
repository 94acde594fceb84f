// The tree in memory. Plain data, read by kernels that are compiled for several instruction sets. Nothing
// here has a function, because the linker could take one that was compiled for another instruction set.
#pragma once

#include <cstddef>
#include <cstdint>

namespace slipface::detail {

// Eight children side by side. A child is a leaf (top bit set, then the index of the leaf), a node, or
// missing (its box is empty, so no query reaches it).
struct alignas(32) BvhNode {
    float bound[6][8];  // min x, y, z, then max x, y, z
    std::uint32_t child[8];
};

inline constexpr std::uint32_t leaf_bit = 0x80000000U;
inline constexpr std::uint32_t leaf_index_mask = 0x7fffffffU;
inline constexpr std::size_t leaf_alignment = 4;  // unit of leaf indices, bytes
inline constexpr std::uint32_t leaf_capacity = 8;

// The head of a leaf, which stores what its triangles share once. There follow
// - eight numbers of two bytes, one for each lane: five bits for each corner, the lowest for the first, that
//   say which of the leaf's vertices it is; lanes beyond the last triangle repeat it;
// - the x of all vertices, their y, their z;
// - for each triangle its number minus the lowest, in one, two or four bytes.
// Along the axes of a level many vertices have the same coordinate. So a leaf may instead have each value of
// an axis once. Then the numbers above are for x, and those for y and z come before the head, in this order
// from there: what is read first is always at the same place.
struct Leaf {
    std::uint32_t first_id;  // the lowest number of a triangle
    std::uint8_t values[3];  // [axis] 1 to 3 * triangles
    std::uint8_t shape;      // triangles, 1 to leaf_capacity; and the bits below
};
static_assert(sizeof(Leaf) == 8);
inline constexpr std::uint8_t leaf_by_axis = 16;
inline constexpr std::uint8_t leaf_width_unit = 32;  // times 0, 1 or 2 for one, two or four bytes
inline constexpr std::uint8_t leaf_roomy = 128;      // has room for largest_leaf bytes
inline constexpr std::size_t leaf_row_bytes = 2 * leaf_capacity;
// With three corners of its own for each triangle.
inline constexpr std::size_t largest_leaf =
    sizeof(Leaf) + leaf_row_bytes + std::size_t{36} * leaf_capacity + std::size_t{4} * leaf_capacity;

// Kernels read whole registers: they may read this many bytes after the last leaf.
inline constexpr std::size_t leaf_overread = 128;

// Splits by cost stop at this depth of the binary tree; below it ranges are halved. So no input makes the
// tree deeper than this plus the halvings of the largest number of triangles, and those of bodies above it.
inline constexpr std::size_t max_triangles = std::size_t{1} << 25;
inline constexpr int cost_split_depth = 36;
inline constexpr int max_depth = cost_split_depth + 25 + 25;
// A traversal pops one entry and pushes at most eight on each level.
inline constexpr std::size_t traversal_stack = std::size_t{max_depth} * 7 + 8;

// The part of a tree that a kernel needs.
struct TreeView {
    const BvhNode* nodes;  // the root first; null: no triangles
    const std::byte* leaves;
};

// One placement of a mesh. `inverse` maps the world to the mesh, for boxes alone: the corners that count are
// placed = linear * rest + offset, rounded to float.
struct InstanceView {
    TreeView tree;         // of the mesh, in its own space
    double linear[3][3];   // [column][axis]
    double offset[3];      // [axis]
    double inverse[3][3];  // [axis of the mesh][axis of the world]
    double slack;          // metres: a placed corner is at most this far from the exact one
    double least_scale;    // no distance shrinks to less than this part when placed
    std::uint32_t first;   // number of the mesh's first triangle
    bool mirrors;          // the second and third corner of a triangle are exchanged
};

// The triangles of a world: a tree of its own, and instances under a tree over their boxes. In that tree each
// instance is a triangle with the corners min, max, max of its box, and numbered like the list.
struct WorldView {
    TreeView own;
    TreeView boxes;  // of instances; no nodes: there are none
    const InstanceView* instances;
    double reach;  // WorldExtent::reach
};

}  // namespace slipface::detail
