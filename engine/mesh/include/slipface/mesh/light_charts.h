// The layout of the light map: one rectangle of texels per face, computed from the faces alone, so that the
// geometry file needs no second texture coordinate.
#pragma once

#include <cstdint>
#include <vector>

#include "slipface/base/result.h"
#include "slipface/mesh/mesh.h"

namespace slipface {

// A rectangle of texels in the plane of a face. The centre of texel (i, j), counted from 0, lies at origin +
// i * step.x * u + j * step.y * v. The outermost texel centres lie on the borders of the face's rectangle, so
// a reader that clamps to them never reads the light of another face.
struct LightChart {
    std::uint16_t x = 0, y = 0;               // of texel (0, 0) in the map; rows from the top
    std::uint16_t width = 0, height = 0;      // texels, at least 1; 0 for a face without area
    Vec3 origin = Vec3::Zero();               // world space
    Vec3 u = Vec3::Zero(), v = Vec3::Zero();  // unit, in the plane of the face
    Vec2 step = Vec2::Zero();                 // metres between texels; 0 along a side of one texel

    Vec3 texel_position(double i, double j) const { return origin + i * step.x() * u + j * step.y() * v; }
    // The texel coordinate (i, j) of a point in world space, clamped to the rectangle.
    Vec2 coordinate(const Vec3& point) const;
};

struct LightCharts {
    int width = 0, height = 0;   // of the map, texels
    std::uint64_t geometry = 0;  // hash of all input of the layout; a map baked for another hash does not fit
    std::vector<LightChart> charts;  // [face]
};

inline constexpr int max_light_map_side = 4096;
inline constexpr int max_light_chart_side = 96;  // texels; larger faces get coarser texels

// Lays out the charts. `texel_m`: metres between texels, above 0; faces larger than max_light_chart_side
// texels get coarser ones. Rectangles are packed row by row, highest first. The same mesh gives the same
// charts with every compiler. Errors: an invalid `texel_m`, a map larger than max_light_map_side texels per
// side.
Result<LightCharts> light_charts(const Mesh& mesh, double texel_m);

}  // namespace slipface
