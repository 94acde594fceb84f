// The sweep probe in the view: its two handles, and where the mouse drags them.
#include <algorithm>
#include <cmath>

#include "panels/viewport_panel.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

constexpr double handle_reach = 11.0;  // design pixels

// The point where the ray hits the plane through `point` with `normal`; nothing if it is behind the eye.
std::optional<Vec3> intersect_plane(const Ray& ray, const Vec3& point, const Vec3& normal) {
    const double along = normal.dot(ray.direction);
    if (std::abs(along) < 1e-6) return std::nullopt;
    const double t = normal.dot(point - ray.origin) / along;
    if (!(t > 0.0) || t > 1e6) return std::nullopt;
    return ray.origin + t * ray.direction;
}

// The ellipsoid's centre when the mouse points at a surface: standing on floors, but inside walls, because a
// probe is usually pushed into them. Slopes in between blend both.
Vec3 centre_over(const Vec3& point, const Vec3& normal, const MovementSettings& settings) {
    Probe standing;
    standing.place_on(point, normal, settings);
    return point + (standing.from - point) * std::max(0.0, normal.y());
}

}  // namespace

int probe_handle_at(const Editor& editor, const Camera& camera, const Vec2& pixel, const Vec2& size) {
    if (!editor.probe.placed) return 0;
    const double reach = handle_reach * static_cast<double>(ui::scale());
    const auto near = [&](const Vec3& point) {
        const Vec3 at = project(camera, point, size);
        return at.z() > 0.0 && (at.head<2>() - pixel).norm() <= reach;
    };
    if (near(editor.probe.from + editor.probe.move)) return 2;
    return near(editor.probe.from) ? 1 : 0;
}

void drag_probe(Editor& editor, const Camera& camera, const Vec2& pixel, const Vec2& size, Gesture gesture,
                bool vertical) {
    Probe& probe = editor.probe;
    const MovementSettings& settings = editor.document->level().movement;
    const Ray ray = pixel_ray(camera, pixel, size);
    const Vec3 looking = (camera.target - camera.eye).normalized();
    const bool start = gesture == Gesture::drag_probe_start;
    const Vec3 current = start ? probe.from : Vec3(probe.from + probe.move);

    std::optional<Vec3> wanted;
    if (vertical) {
        Vec3 facing = looking;
        facing.y() = 0.0;
        if (facing.norm() < 1e-6) return;
        const std::optional<Vec3> hit = intersect_plane(ray, current, facing.normalized());
        if (hit) wanted = Vec3(current.x(), hit->y(), current.z());
    } else {
        hover(editor, ray);
        if (editor.hovered != no_id && start) {
            const Vec3 move = probe.move;
            probe.place_on(editor.hovered_point, editor.hovered_normal, settings);
            probe.move = move;
            return;
        }
        wanted = editor.hovered != no_id
                     ? std::optional(centre_over(editor.hovered_point, editor.hovered_normal, settings))
                     : intersect_plane(ray, current, looking);
    }
    if (!wanted || !wanted->allFinite()) return;
    if (start)
        probe.from = *wanted;
    else
        probe.move = *wanted - probe.from;
}

}  // namespace slipface
