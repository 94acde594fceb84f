// The viewport's camera: orbiting around a point or flying, and framing.
#pragma once

#include "slipface/view/camera.h"

namespace slipface {

class ViewCamera {
  public:
    // Direction from the pivot to the eye, radians: yaw about +Y, pitch above the horizon.
    double yaw = 0.7, pitch = 0.5;
    double distance = 12.0;  // metres from pivot to eye
    Vec3 pivot = Vec3::Zero();
    double fov_y = 1.0471975511965976;
    double fly_speed = 8.0;  // m/s
    // Orthographic: `distance` sets only the size, which is that of the perspective view at the pivot.
    bool orthographic = false;

    Camera camera() const;

    void orbit(const Vec2& pixels);  // mouse movement; rotates around the pivot
    void look(const Vec2& pixels);   // rotates around the eye
    // The point at the pivot's depth follows the mouse.
    void pan(const Vec2& pixels, const Vec2& viewport_size);
    void zoom(double wheel);  // towards the pivot; never through it
    // Keeps `point` under the mouse, as far as the wheel at any distance to it, and never gets through it.
    // The pivot comes to the point's depth.
    void zoom_towards(double wheel, const Vec3& point);
    void fly(const Vec3& right_up_forward, double seconds);  // each -1..1
    // Keeps the direction; an empty box and no points are ignored.
    void frame(const Aabb& bounds, double aspect);
    void frame(std::span<const Vec3> points, double aspect);
    void look_at(const Vec3& eye, const Vec3& target);
    // Views the pivot from this direction (any length except zero), also straight up and down.
    void look_from(const Vec3& direction);
    // "Top", "Front", ... along an axis, otherwise "Orthographic" or "Perspective".
    const char* name() const;

    bool operator==(const ViewCamera&) const = default;

  private:
    void adopt(const Camera& framed);
};

}  // namespace slipface
