// How a Neighbourhood keeps its triangles. Plain data, read by kernels that are compiled for several
// instruction sets.
#pragma once

#include <cstdint>

namespace slipface {

inline constexpr std::uint32_t near_capacity = 128;

// A triangle is a column. Rows are read eight at a time, so they go on behind the last one.
struct NearTriangles {
    std::uint32_t count = 0;
    float corner[9][near_capacity + 8];  // [3 * corner + axis], world
    float clear[near_capacity + 8];  // how far from the body at least, sphere space; infinite behind the last
    std::uint32_t id[near_capacity + 8];
};

}  // namespace slipface
