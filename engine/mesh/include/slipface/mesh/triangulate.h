// Cutting a polygon into triangles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "slipface/base/types.h"

namespace slipface {

// Polygons with more corners than this are cut as a fan from their first corner, which is right for convex
// ones only.
inline constexpr std::size_t max_clipped_corners = 2000;

// Appends corners.size() - 2 triangles, as indices into `corners`, in the polygon's winding; nothing for
// fewer than three corners. Convex polygons become a fan from corner 0. Ear clipping in the projection along
// the largest component of Newell's normal: exact for planar simple polygons, concave ones and repeated
// corners (bridges to holes) included. What is not simple or has no area is cut all the same, somehow. At
// most O(n^2). Only differences of coordinates matter.
void triangulate_polygon(std::span<const Vec3f> corners,
                         std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace slipface
