// Vectors, boxes and ids that every module shares.
//
// World space: metres, +Y up, right-handed. Directions and points are column vectors of double. Data from OBJ
// files stay float (Vec3f), because that is all the precision they have.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <limits>

#include "slipface/base/sum_order.h"

namespace slipface {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Vec2f = Eigen::Vector2f;
using Vec3f = Eigen::Vector3f;

using FaceId = std::uint32_t;      // a polygon as written in the level file: index into Mesh
using TriangleId = std::uint32_t;  // a triangle of such a face: index into Mesh
using SurfaceId = std::uint8_t;    // index into the level's surface types; 0 is always `default`

inline constexpr std::uint32_t no_id = std::numeric_limits<std::uint32_t>::max();
inline constexpr SurfaceId default_surface = 0;
inline constexpr std::size_t max_surface_types = 255;

// Axis-aligned box; empty (min > max) until something is added.
struct Aabb {
    Vec3 min = Vec3::Constant(std::numeric_limits<double>::infinity());
    Vec3 max = Vec3::Constant(-std::numeric_limits<double>::infinity());

    bool empty() const { return !(min.x() <= max.x()); }
    Vec3 centre() const { return 0.5 * (min + max); }
    Vec3 size() const { return max - min; }
    void add(const Vec3& point) {
        min = min.cwiseMin(point);
        max = max.cwiseMax(point);
    }
};

}  // namespace slipface
