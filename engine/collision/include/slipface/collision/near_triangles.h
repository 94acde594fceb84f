// How a Neighbourhood keeps its triangles. Plain data, read by kernels that are compiled for several
// instruction sets.
#pragma once

#include <cstdint>

namespace slipface {

inline constexpr std::uint32_t near_capacity = 128;

// A triangle is a column. Rows are read eight at a time, so they go on behind the last one.
struct NearTriangles {
    // The body whose neighbourhood it is; the fourth numbers mean nothing.
    double centre[4] = {};                 // [axis], world
    double radii[4] = {};                  // world
    double inverse[4] = {};                // 1 / radii
    double reach[4] = {-1.0, -1.0, -1.0};  // how far its centre may be from there, world; below 0: nowhere

    std::uint32_t count = 0;
    float corner[9][near_capacity + 8];  // [3 * corner + axis], world
    // In sphere space, as seen from `centre`.
    float seen[9][near_capacity + 8];  // corners, like `corner`
    float edge[9][near_capacity + 8];  // [3 * edge + axis], from corner k to corner k + 1
    // Their planes: normal . x = offset. A distance from one of them is off by no more than slack +
    // slack_per_way * (the sizes of where and how far the body moves).
    float normal[3][near_capacity + 8];  // [axis], unit; shorter for needles
    float offset[near_capacity + 8];
    float slack[near_capacity + 8];
    float slack_per_length[near_capacity + 8];
    std::uint32_t id[near_capacity + 8];
};

}  // namespace slipface
