// Terrain given as a grid of heights instead of triangles.
#pragma once

#include <optional>
#include <vector>

#include "slipface/base/types.h"

namespace slipface {

// Samples stand at the corners of the grid's cells. Each cell is two triangles, cut from its corner with the
// smallest x and z to the opposite one; what is drawn and what is walked on is the same surface.
struct Heightfield {
    int columns = 0;              // samples along x, >= 2
    int rows = 0;                 // samples along z, >= 2
    std::vector<double> heights;  // [row * columns + column], metres, world space
    Vec3 origin = Vec3::Zero();   // x and z of the first sample; y is not used
    Vec2 size = Vec2::Zero();     // metres from the first to the last sample along x and z

    double height(int column, int row) const {
        return heights[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                       static_cast<std::size_t>(column)];
    }
    Vec3 corner(int column, int row) const;  // of the grid, world space
};

struct TerrainPoint {
    double height = 0.0;          // metres, world space
    Vec3 normal = Vec3::UnitY();  // unit, upwards
};

// The terrain above or below (x, z); nothing beside the grid, or where the grid has fewer than 2 x 2 samples.
std::optional<TerrainPoint> terrain_at(const Heightfield& field, double x, double z);

}  // namespace slipface
