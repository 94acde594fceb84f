// Where each face's light lies in the level's light map: one rectangle of texels a face, laid out from the
// faces alone, so that the geometry file needs no second texture coordinate.
#pragma once

#include <cstdint>
#include <vector>

#include "slipface/base/result.h"
#include "slipface/mesh/mesh.h"

namespace slipface {

// A rectangle of texels laid over a face's plane. The centre of texel (i, j), both counted from 0, lies at
// origin + i * step.x * u + j * step.y * v; the outermost texel centres lie on the borders of the face's
// rectangle. A reader that clamps its coordinate to the outermost centres never sees another face's light.
struct LightChart {
    std::uint16_t x = 0, y = 0;               // of texel (0, 0) in the map, rows from the top
    std::uint16_t width = 0, height = 0;      // texels, 1 at least; 0 for a face without area
    Vec3 origin = Vec3::Zero();               // world space
    Vec3 u = Vec3::Zero(), v = Vec3::Zero();  // unit, in the face's plane
    Vec2 step = Vec2::Zero();                 // metres from texel to texel; 0 along a side of one texel

    Vec3 texel_position(double i, double j) const { return origin + i * step.x() * u + j * step.y() * v; }
    // The texel coordinate of a point, counted as above and clamped to the rectangle.
    Vec2 coordinate(const Vec3& point) const;
};

struct LightCharts {
    int width = 0, height = 0;   // of the map, texels
    std::uint64_t geometry = 0;  // hash of all that the charts were laid out from: a map baked for another
                                 // one does not fit
    std::vector<LightChart> charts;  // [face]
};

inline constexpr int max_light_map_side = 4096;
inline constexpr int max_light_chart_side = 96;  // larger faces get coarser texels

// `texel_m`: metres from texel to texel, above 0; faces larger than max_light_chart_side texels get coarser
// ones. Rectangles are packed row by row, highest first. The same mesh gives the same charts with every
// compiler. Refuses a mesh that needs more than max_light_map_side texels a side.
Result<LightCharts> light_charts(const Mesh& mesh, double texel_m);

}  // namespace slipface
