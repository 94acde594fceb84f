#include "tools/view/view_camera.h"

#include <algorithm>
#include <cmath>

namespace slipface {
namespace {

constexpr double radians_per_pixel = 0.006;
constexpr double steepest = 1.5533430342749532;  // 89 degrees: straight up and down have no yaw
constexpr double nearest_m = 1e-3, farthest_m = 1e8;
constexpr double nearest_face_m = 0.1;  // several times the nearest near plane, or one would see through it
constexpr double zoom_per_notch = 0.85;

Vec3 eye_direction(const ViewCamera& view) {
    const double across = std::cos(view.pitch);
    return {across * std::sin(view.yaw), std::sin(view.pitch), across * std::cos(view.yaw)};
}

Vec3 right_direction(const ViewCamera& view) {
    return {std::cos(view.yaw), 0.0, -std::sin(view.yaw)};
}

void turn(ViewCamera& view, const Vec2& pixels) {
    if (!pixels.allFinite()) return;
    // The angle is wrapped, so that it stays precise however often the view rotates.
    view.yaw = std::remainder(view.yaw - pixels.x() * radians_per_pixel, 2.0 * 3.14159265358979323846);
    view.pitch = std::clamp(view.pitch + pixels.y() * radians_per_pixel, -steepest, steepest);
}

}  // namespace

Camera ViewCamera::camera() const {
    Camera camera;
    camera.eye = pivot + distance * eye_direction(*this);
    camera.target = pivot;
    camera.fov_y = fov_y;
    camera.near_plane = std::clamp(distance * 0.004, 0.02, 2.0);
    camera.far_plane = std::max(2000.0, distance * 50.0);
    if (orthographic) {
        camera.orthographic = true;
        camera.ortho_height = 2.0 * distance * std::tan(0.5 * fov_y);
        camera.near_plane = -camera.far_plane;  // nothing is clipped, however far the view zooms in
    }
    return camera;
}

void ViewCamera::orbit(const Vec2& pixels) {
    turn(*this, pixels);
}

void ViewCamera::look(const Vec2& pixels) {
    const Vec3 eye = pivot + distance * eye_direction(*this);
    turn(*this, pixels);
    pivot = eye - distance * eye_direction(*this);
}

void ViewCamera::pan(const Vec2& pixels, const Vec2& viewport_size) {
    if (!pixels.allFinite() || !(viewport_size.y() > 0.0)) return;
    const double metres_per_pixel = 2.0 * distance * std::tan(0.5 * fov_y) / viewport_size.y();
    const Vec3 right = right_direction(*this);
    const Vec3 up = eye_direction(*this).cross(right);
    pivot += metres_per_pixel * (up * pixels.y() - right * pixels.x());
}

void ViewCamera::zoom(double wheel) {
    zoom_towards(wheel, pivot);
}

void ViewCamera::zoom_towards(double wheel, const Vec3& point) {
    if (!std::isfinite(wheel) || !point.allFinite()) return;
    double nearest = nearest_m;
    if (!orthographic && point != pivot) {
        const Vec3 eye = pivot + distance * eye_direction(*this);
        const double depth = (eye - point).dot(eye_direction(*this));
        if (depth > nearest_m) {
            distance = depth;
            pivot = eye - depth * eye_direction(*this);
            nearest = std::min(depth, nearest_face_m);
        }
    }
    const double before = distance;
    distance = std::clamp(distance * std::pow(zoom_per_notch, wheel), nearest, farthest_m);
    // Scaling the offsets of eye and pivot from the point alike moves the eye along the line to the point.
    pivot = point + (pivot - point) * (distance / before);
}

void ViewCamera::fly(const Vec3& right_up_forward, double seconds) {
    if (!right_up_forward.allFinite() || !std::isfinite(seconds)) return;
    const Vec3 motion = right_up_forward.x() * right_direction(*this) + right_up_forward.y() * Vec3::UnitY() -
                        right_up_forward.z() * eye_direction(*this);
    pivot += motion * (fly_speed * seconds);
}

void ViewCamera::frame(const Aabb& bounds, double aspect) {
    if (bounds.empty() || !bounds.min.allFinite() || !bounds.max.allFinite() || !(aspect > 0.0)) return;
    adopt(frame_bounds(bounds, yaw, pitch, fov_y, aspect));
}

void ViewCamera::frame(std::span<const Vec3> points, double aspect) {
    if (!points.empty()) adopt(frame_points(points, yaw, pitch, fov_y, aspect));
}

void ViewCamera::adopt(const Camera& framed) {
    pivot = framed.target;
    distance = std::clamp((framed.eye - framed.target).norm(), nearest_m, farthest_m);
}

void ViewCamera::look_from(const Vec3& direction) {
    const double length = direction.norm();
    if (!(length > 0.0) || !std::isfinite(length)) return;
    const double up = direction.y() / length, across = std::hypot(direction.x(), direction.z()) / length;
    pitch = std::atan2(up, across);
    yaw = across > 1e-9 ? std::atan2(direction.x(), direction.z()) : 0.0;  // as on a map, -Z upwards
}

const char* ViewCamera::name() const {
    struct Named {
        Vec3 direction;
        const char* name;
    };
    const Named views[] = {{Vec3::UnitY(), "Top"},   {-Vec3::UnitY(), "Bottom"}, {Vec3::UnitZ(), "Front"},
                           {-Vec3::UnitZ(), "Back"}, {Vec3::UnitX(), "Right"},   {-Vec3::UnitX(), "Left"}};
    if (!orthographic) return "Perspective";
    for (const Named& view : views)
        if (eye_direction(*this).dot(view.direction) > 1.0 - 1e-9) return view.name;
    return "Orthographic";
}

void ViewCamera::look_at(const Vec3& eye, const Vec3& target) {
    const Vec3 offset = eye - target;
    const double length = offset.norm();
    if (!(length > 0.0) || !std::isfinite(length)) return;
    distance = std::clamp(length, nearest_m, farthest_m);
    pitch = std::clamp(std::asin(std::clamp(offset.y() / length, -1.0, 1.0)), -steepest, steepest);
    if (offset.x() != 0.0 || offset.z() != 0.0) yaw = std::atan2(offset.x(), offset.z());
    pivot = eye - distance * eye_direction(*this);
}

}  // namespace slipface
