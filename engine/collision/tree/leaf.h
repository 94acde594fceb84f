// Reading a leaf (bvh_layout.h).
#pragma once

#include <cstring>

#include "simd/isa.h"
#include "tree/bvh_layout.h"

namespace slipface::detail {
inline namespace SLIPFACE_ISA {

inline std::uint32_t leaf_size(const Leaf& leaf) {
    return leaf.shape & 15U;
}
// [lane] which of the values along the axis its corners have.
inline const std::uint16_t* leaf_corners(const Leaf& leaf, std::size_t axis) {
    const auto* head = reinterpret_cast<const std::uint16_t*>(&leaf);
    constexpr std::size_t row = leaf_row_bytes / sizeof *head;
    return axis == 0 || (leaf.shape & leaf_by_axis) == 0 ? head + sizeof(Leaf) / sizeof *head
                                                         : head - axis * row;
}
inline std::uint32_t corner_of(std::uint32_t corners, std::size_t k) {
    return corners >> (5 * k) & 31U;
}
// The x, then the y, then the z.
inline const float* leaf_values(const Leaf& leaf) {
    return reinterpret_cast<const float*>(reinterpret_cast<const std::byte*>(&leaf + 1) + leaf_row_bytes);
}
// How often one byte is doubled for the numbers of the triangles, and where these begin.
inline std::uint32_t leaf_width(const Leaf& leaf) {
    return leaf.shape / leaf_width_unit & 3U;
}
inline const std::byte* leaf_offsets(const Leaf& leaf) {
    const std::size_t values = std::size_t{leaf.values[0]} + leaf.values[1] + leaf.values[2];
    return reinterpret_cast<const std::byte*>(leaf_values(leaf) + values);
}
inline std::uint32_t leaf_id(const Leaf& leaf, std::size_t lane) {
    // No branch, which would be hard to predict.
    const std::uint32_t width = leaf_width(leaf);
    std::uint32_t offset;
    std::memcpy(&offset, leaf_offsets(leaf) + (lane << width), sizeof offset);
    return leaf.first_id + (offset & ~std::uint32_t{0} >> (32U - (8U << width)));
}

}  // namespace SLIPFACE_ISA
}  // namespace slipface::detail
