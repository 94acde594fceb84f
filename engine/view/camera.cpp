#include "slipface/view/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace slipface {

namespace {

struct Axes {
    Vec3 right, up, back;  // unit; back points from the target to the eye
};

// If the camera looks straight down (or up), -Z (or +Z) points up on the screen, as on a map.
Axes camera_axes(const Camera& camera) {
    Vec3 back = camera.eye - camera.target;
    const double length = back.norm();
    back = length > 0.0 && std::isfinite(length) ? Vec3(back / length) : Vec3(Vec3::UnitZ());
    Vec3 right = Vec3::UnitY().cross(back);
    const double sine = right.norm();
    right = sine > 1e-9 ? Vec3(right / sine) : Vec3(Vec3::UnitX());
    return {right, back.cross(right), back};
}

std::array<Vec3, 8> corners(const Aabb& box) {
    std::array<Vec3, 8> result;
    for (std::size_t i = 0; i < 8; ++i) {
        result[i] = {(i & 1U) != 0 ? box.max.x() : box.min.x(), (i & 2U) != 0 ? box.max.y() : box.min.y(),
                     (i & 4U) != 0 ? box.max.z() : box.min.z()};
    }
    return result;
}

// The box, with some extent, so that an empty or point-like level still gives a camera.
Aabb usable_bounds(const Aabb& bounds) {
    Aabb box = bounds;
    if (box.empty() || !box.min.allFinite() || !box.max.allFinite()) box = {-Vec3::Ones(), Vec3::Ones()};
    if (box.size().maxCoeff() <= 0.0) {
        const double half = std::max(0.5, 1e-3 * box.centre().cwiseAbs().maxCoeff());
        box = {box.centre() - Vec3::Constant(half), box.centre() + Vec3::Constant(half)};
    }
    return box;
}

constexpr double margin = 1.06;  // air around the framed bounds

}  // namespace

Mat4 view_from_world(const Camera& camera) {
    const Axes axes = camera_axes(camera);
    Mat4 view = Mat4::Identity();
    view.row(0).head<3>() = axes.right;
    view.row(1).head<3>() = axes.up;
    view.row(2).head<3>() = axes.back;
    view(0, 3) = -axes.right.dot(camera.eye);
    view(1, 3) = -axes.up.dot(camera.eye);
    view(2, 3) = -axes.back.dot(camera.eye);
    return view;
}

Mat4 clip_from_view(const Camera& camera, double aspect) {
    const double n = camera.near_plane;
    const double f = camera.far_plane;
    Mat4 clip = Mat4::Zero();
    if (camera.orthographic) {
        clip(0, 0) = 2.0 / (camera.ortho_height * aspect);
        clip(1, 1) = 2.0 / camera.ortho_height;
        clip(2, 2) = -2.0 / (f - n);
        clip(2, 3) = -(f + n) / (f - n);
        clip(3, 3) = 1.0;
    } else {
        const double cotangent = 1.0 / std::tan(0.5 * camera.fov_y);
        clip(0, 0) = cotangent / aspect;
        clip(1, 1) = cotangent;
        clip(2, 2) = -(f + n) / (f - n);
        clip(2, 3) = -2.0 * f * n / (f - n);
        clip(3, 2) = -1.0;
    }
    return clip;
}

Ray pixel_ray(const Camera& camera, const Vec2& pixel, const Vec2& viewport_size) {
    const Axes axes = camera_axes(camera);
    const double aspect = viewport_size.x() / viewport_size.y();
    const double x = 2.0 * pixel.x() / viewport_size.x() - 1.0;
    const double y = 1.0 - 2.0 * pixel.y() / viewport_size.y();
    if (camera.orthographic) {
        const double half = 0.5 * camera.ortho_height;
        const Vec3 on_plane = camera.eye + axes.right * (x * half * aspect) + axes.up * (y * half);
        return {on_plane - axes.back * camera.near_plane, -axes.back};
    }
    const double tangent = std::tan(0.5 * camera.fov_y);
    return {camera.eye,
            (axes.right * (x * tangent * aspect) + axes.up * (y * tangent) - axes.back).normalized()};
}

Vec3 project(const Camera& camera, const Vec3& point, const Vec2& viewport_size) {
    const Axes axes = camera_axes(camera);
    const Vec3 offset = point - camera.eye;
    const double depth = -axes.back.dot(offset);
    const double aspect = viewport_size.x() / viewport_size.y();
    const double half =
        camera.orthographic ? 0.5 * camera.ortho_height : depth * std::tan(0.5 * camera.fov_y);
    const double x = axes.right.dot(offset) / (half * aspect);
    const double y = axes.up.dot(offset) / half;
    return {0.5 * (x + 1.0) * viewport_size.x(), 0.5 * (1.0 - y) * viewport_size.y(), depth};
}

// The eye is shifted sideways as well as back: with perspective the middle of the points is not in the middle
// of their image. For each axis with half-angle tangent t, both |x - shift| <= (d - z) t must hold for every
// point, which gives d = (A + B) / 2t and shift = (A - B) / 2 with A = max(x + z t), B = max(-x + z t).
Camera frame_points(std::span<const Vec3> points, double yaw, double pitch, double fov_y, double aspect) {
    Aabb box;
    for (const Vec3& point : points)
        box.add(point);
    Camera camera;
    camera.fov_y = fov_y;
    camera.target = box.centre();
    const Vec3 direction(std::cos(pitch) * std::sin(yaw), std::sin(pitch), std::cos(pitch) * std::cos(yaw));
    camera.eye = camera.target + direction * std::max(1.0, box.size().norm());
    const Axes axes = camera_axes(camera);

    const double tangent_y = std::tan(0.5 * fov_y) / margin;
    const double tangent_x = tangent_y * aspect;
    constexpr double lowest = -std::numeric_limits<double>::infinity();
    double right = lowest, left = lowest, top = lowest, bottom = lowest, deepest = lowest;
    for (const Vec3& point : points) {
        const Vec3 offset = point - box.centre();
        const double x = axes.right.dot(offset), y = axes.up.dot(offset), z = axes.back.dot(offset);
        right = std::max(right, x + z * tangent_x);
        left = std::max(left, -x + z * tangent_x);
        top = std::max(top, y + z * tangent_y);
        bottom = std::max(bottom, -y + z * tangent_y);
        deepest = std::max(deepest, -z);
    }
    const double distance = std::max((right + left) / (2.0 * tangent_x), (top + bottom) / (2.0 * tangent_y));
    camera.target = box.centre() + axes.right * (0.5 * (right - left)) + axes.up * (0.5 * (top - bottom));
    camera.eye = camera.target + axes.back * distance;
    camera.near_plane = 1e-3 * distance;
    camera.far_plane = 20.0 * (distance + deepest);
    return camera;
}

Camera frame_bounds(const Aabb& bounds, double yaw, double pitch, double fov_y, double aspect) {
    return frame_points(corners(usable_bounds(bounds)), yaw, pitch, fov_y, aspect);
}

std::optional<Camera> named_view(std::string_view name, const Aabb& bounds, double aspect) {
    constexpr double degrees = std::numbers::pi / 180.0;
    constexpr double fov = 45.0 * degrees;
    if (name == "iso") return frame_bounds(bounds, 35.0 * degrees, 33.0 * degrees, fov, aspect);
    if (name == "iso-back") return frame_bounds(bounds, 215.0 * degrees, 33.0 * degrees, fov, aspect);
    struct OrthoView {
        std::string_view name;
        Vec3 back;
    };
    const std::array<OrthoView, 6> views{{{"top", Vec3::UnitY()},
                                          {"bottom", -Vec3::UnitY()},
                                          {"front", Vec3::UnitZ()},
                                          {"back", -Vec3::UnitZ()},
                                          {"right", Vec3::UnitX()},
                                          {"left", -Vec3::UnitX()}}};
    const auto view =
        std::find_if(views.begin(), views.end(), [&](const OrthoView& v) { return v.name == name; });
    if (view == views.end()) return std::nullopt;

    const Aabb box = usable_bounds(bounds);
    const double reach = box.size().norm();
    Camera camera;
    camera.orthographic = true;
    camera.fov_y = fov;
    camera.target = box.centre();
    camera.eye = box.centre() + view->back * reach;
    camera.near_plane = 0.01 * reach;
    camera.far_plane = 2.0 * reach;
    const Axes axes = camera_axes(camera);
    double height = 0.0;
    for (const Vec3& corner : corners(box)) {
        const Vec3 offset = corner - box.centre();
        height = std::max(
            {height, 2.0 * std::abs(axes.up.dot(offset)), 2.0 * std::abs(axes.right.dot(offset)) / aspect});
    }
    camera.ortho_height = margin * (height > 0.0 ? height : reach);
    return camera;
}

}  // namespace slipface
