// How a Neighbourhood stores its triangles. Plain data, read by kernels that are compiled for several
// instruction sets.
#pragma once

#include <cstdint>

namespace slipface {

inline constexpr std::uint32_t near_capacity = 128;

// Each triangle is a column. Rows are read eight at a time, so each has eight more floats at its end.
struct NearTriangles {
    // The body that the neighbourhood was built for. The fourth component of each array is unused.
    double centre[4] = {};                 // [axis], world
    double radii[4] = {};                  // world
    double inverse[4] = {};                // 1 / radii
    double reach[4] = {-1.0, -1.0, -1.0};  // largest offset of the body's centre, world; negative: none

    std::uint32_t count = 0;
    float clear = 0.0F;                  // the least clearance
    float corner[9][near_capacity + 8];  // [3 * corner + axis], world
    // In sphere space, relative to `centre`.
    float seen[9][near_capacity + 8];  // corners, like `corner`
    float edge[9][near_capacity + 8];  // [3 * edge + axis], from corner k to corner k + 1
    // The planes of the triangles: normal . x = offset. A distance from a plane has an error of at most slack
    // + slack_per_length * (the sizes of the body's position and of its motion).
    float normal[3][near_capacity + 8];  // [axis], unit; shorter for needles
    float offset[near_capacity + 8];
    float slack[near_capacity + 8];
    float slack_per_length[near_capacity + 8];
    // The square of how far the body can go in sphere space, at least, before it touches the triangle.
    float clearance[near_capacity + 8];
    std::uint32_t id[near_capacity + 8];
};

}  // namespace slipface
