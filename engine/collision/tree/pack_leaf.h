// Writing a leaf (bvh_layout.h).
#pragma once

#include <array>
#include <span>

#include "queries/leaf_triangle.h"
#include "tree/bvh_layout.h"

namespace slipface::detail {

// The content of a leaf with one to eight triangles, in ascending order of their numbers.
class PackedLeaf {
  public:
    // Corners at the same position are stored once. `by_axis`: equal coordinates along an axis may be, too,
    // if that takes less memory.
    PackedLeaf(std::span<const LeafTriangle> triangles, bool by_axis);

    // Multiples of leaf_alignment: of all, and of what comes before the head.
    std::size_t bytes() const;
    std::size_t bytes_before() const { return by_axis_ ? 2 * leaf_row_bytes : 0; }
    // Writes bytes() from there on.
    void write(std::byte* to) const;

  private:
    std::span<const LeafTriangle> triangles_;
    std::array<std::array<std::uint16_t, leaf_capacity>, 3> corners_{};  // [axis][lane]
    std::array<std::array<std::uint32_t, std::size_t{3} * leaf_capacity>, 3>
        values_;                            // [axis] bits of floats
    std::array<std::uint8_t, 3> counts_{};  // [axis]
    bool by_axis_ = false;
};

}  // namespace slipface::detail
