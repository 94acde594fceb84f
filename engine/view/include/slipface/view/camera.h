// A camera, and the conversion between pixels and rays.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "slipface/base/types.h"

namespace slipface {

using Mat4 = Eigen::Matrix4d;

struct Camera {
    Vec3 eye{0, 2, 6};
    Vec3 target = Vec3::Zero();
    double fov_y = 1.0471975511965976;  // radians
    double near_plane = 0.05;           // metres
    double far_plane = 2000.0;          // metres
    bool orthographic = false;
    double ortho_height = 10.0;  // metres from the lower to the upper edge
};

struct Ray {
    Vec3 origin = Vec3::Zero();
    Vec3 direction = Vec3::UnitZ();  // unit
};

// View space: the origin is the eye, +X right, +Y up, -Z the direction of view.
Mat4 view_from_world(const Camera& camera);
// `aspect`: width by height of the viewport.
Mat4 clip_from_view(const Camera& camera, double aspect);

// The ray through a point of the viewport, in world space. Pixels count from the upper left corner.
Ray pixel_ray(const Camera& camera, const Vec2& pixel, const Vec2& viewport_size);

// The pixel at which `point` (world space) appears; z is the depth in metres along the view direction, <= 0
// behind the camera.
Vec3 project(const Camera& camera, const Vec3& point, const Vec2& viewport_size);

// A camera that sees all of `bounds` from the direction (yaw about +Y, pitch above the horizon; radians).
Camera frame_bounds(const Aabb& bounds, double yaw, double pitch, double fov_y, double aspect);
// The nearest one that sees all of `points`: two or more, finite, not all the same.
Camera frame_points(std::span<const Vec3> points, double yaw, double pitch, double fov_y, double aspect);

// A camera that sees all of `bounds`, by name: "iso" and "iso-back" (perspective, from above a corner), or
// "top", "bottom", "front", "back", "right", "left" (orthographic; "top" is a map with -Z upwards). Nothing
// for any other name.
std::optional<Camera> named_view(std::string_view name, const Aabb& bounds, double aspect);

}  // namespace slipface
