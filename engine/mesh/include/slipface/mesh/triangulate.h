// Cutting a polygon into triangles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "slipface/base/types.h"

namespace slipface {

// Polygons with more corners than this are cut as a fan from their first corner, which is correct only for
// convex ones.
inline constexpr std::size_t max_clipped_corners = 2000;

// Appends corners.size() - 2 triangles, as indices into `corners`, in the winding of the polygon; nothing for
// fewer than three corners. Convex polygons become a fan from corner 0. Method: ear clipping in the
// projection along the largest component of Newell's normal. It is exact for planar simple polygons,
// including concave ones and repeated corners (bridges to holes). Polygons that are not simple or have no
// area still get triangles, of no specified shape. At most O(n^2). Only differences of coordinates matter.
void triangulate_polygon(std::span<const Vec3f> corners,
                         std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace slipface
