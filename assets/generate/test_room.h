// Where things stand in the test room of `easy`.
#pragma once

namespace slipface::generate {

struct FloorPlan {
    double west, east, north, south;
    double top = 0;
    constexpr bool contains(double x, double z) const {
        return x > west && x < east && z > north && z < south;
    }
};

inline constexpr FloorPlan room{.west = -50, .east = -18, .north = -29, .south = 11, .top = 7};
inline constexpr FloorPlan pipe{.west = -38, .east = -24, .north = -19, .south = -13};
inline constexpr FloorPlan seam_field{.west = -36, .east = -26, .north = -9, .south = 1};

}  // namespace slipface::generate
