// The handles of the chosen prop in the view, and what dragging them does.
#include <algorithm>
#include <cmath>

#include "panels/viewport_panel.h"
#include "tools/props/props.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

constexpr double handle_length = 84.0;  // design pixels
constexpr double prop_handle_reach = 9.0;
constexpr std::size_t max_ghost_edges = 3000;
constexpr Color handle_colors[3] = {
    {0.93f, 0.36f, 0.36f, 1.0f}, {0.45f, 0.80f, 0.38f, 1.0f}, {0.40f, 0.60f, 0.95f, 1.0f}};
constexpr Color held_handle{1.0f, 0.86f, 0.42f, 1.0f};
constexpr Color ghost{0.945f, 0.690f, 0.330f, 0.9f};

double arm(const Camera& camera, const Vec3& point, double height) {
    return handle_length * static_cast<double>(ui::scale()) * metres_per_pixel(camera, point, height);
}

// Scaling is along the prop's own axes, the rest along the world's.
Vec3 axis_of(const Prop& prop, PropHandles handles, int axis) {
    if (handles != PropHandles::scale) return Vec3::Unit(axis);
    return placement(Vec3::Zero(), prop.rotation, Vec3::Ones()).columns[static_cast<std::size_t>(axis)];
}

// Two directions across an axis: angles count from the first to the second.
std::pair<Vec3, Vec3> across(int axis) {
    return {Vec3::Unit((axis + 1) % 3), Vec3::Unit((axis + 2) % 3)};
}

// Where the mouse's ray is along an axis, in metres; nothing if they are nearly parallel.
std::optional<double> along_axis(const Ray& ray, const Vec3& origin, const Vec3& axis) {
    const double cosine = axis.dot(ray.direction);
    const double square = 1.0 - cosine * cosine;
    if (square < 1e-3) return std::nullopt;
    const Vec3 between = origin - ray.origin;
    return (cosine * between.dot(ray.direction) - between.dot(axis)) / square;
}

// The angle of the mouse about an axis.
std::optional<double> about_axis(const Ray& ray, const Vec3& origin, int axis) {
    const double along = ray.direction[axis];
    if (std::abs(along) < 0.05) return std::nullopt;
    const Vec3 hit = ray.origin + ray.direction * ((origin - ray.origin)[axis] / along) - origin;
    const auto [u, v] = across(axis);
    return std::atan2(hit.dot(v), hit.dot(u));
}

std::optional<double> parameter(const Editor& editor, const Prop& prop, const Ray& ray, int axis) {
    if (editor.props.handles == PropHandles::rotate) return about_axis(ray, prop.position, axis);
    return along_axis(ray, prop.position, axis_of(prop, editor.props.handles, axis));
}

// Pixels from a point to a segment.
double distance_to(const Vec2& point, const Vec2& a, const Vec2& b) {
    const Vec2 way = b - a;
    const double square = way.squaredNorm();
    const double s = square > 0.0 ? std::clamp((point - a).dot(way) / square, 0.0, 1.0) : 0.0;
    return (a + s * way - point).norm();
}

// The handle as a chain of points: an axis, or a ring around it.
std::vector<Vec3> handle_points(const Prop& prop, PropHandles handles, int axis, double length) {
    if (handles != PropHandles::rotate)
        return {prop.position, prop.position + length * axis_of(prop, handles, axis)};
    constexpr int sides = 48;
    const auto [u, v] = across(axis);
    std::vector<Vec3> ring;
    for (int i = 0; i <= sides; ++i) {
        const double angle = 6.283185307179586 * i / sides;
        ring.push_back(prop.position + length * (std::cos(angle) * u + std::sin(angle) * v));
    }
    return ring;
}

// The edges of the prop where it would be put.
void add_ghost(Overlay& overlay, const Level& level, const Prop& prop) {
    const PropMesh* const mesh = find_prop_mesh(level, prop.mesh);
    if (mesh == nullptr || !mesh->mesh) return;
    const Mesh& shape = *mesh->mesh;
    const Placement at = prop.placement();
    std::size_t edges = 0;
    for (FaceId face = 0; face < shape.face_count() && edges < max_ghost_edges; ++face) {
        const std::uint32_t first = shape.face_first_corner[face], end = shape.face_first_corner[face + 1];
        for (std::uint32_t corner = first; corner < end; ++corner, ++edges) {
            const std::uint32_t next = corner + 1 == end ? first : corner + 1;
            overlay.line(at.apply(shape.corner_position(corner)).cast<double>(),
                         at.apply(shape.corner_position(next)).cast<double>(), ghost, 1.5f, true);
        }
    }
}

}  // namespace

int prop_handle_at(const Editor& editor, const Camera& camera, const Vec2& pixel, const Vec2& size) {
    const std::optional<std::size_t> chosen = chosen_prop(editor);
    if (!chosen || editor.tool != Tool::props) return -1;
    const Prop& prop = editor.document->level().props[*chosen];
    const double length = arm(camera, prop.position, size.y());
    double best = prop_handle_reach * static_cast<double>(ui::scale());
    int found = -1;
    for (int axis = 0; axis < 3; ++axis) {
        const std::vector<Vec3> points = handle_points(prop, editor.props.handles, axis, length);
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            const Vec3 a = project(camera, points[i], size), b = project(camera, points[i + 1], size);
            if (a.z() <= 0.0 || b.z() <= 0.0) continue;
            const double distance = distance_to(pixel, a.head<2>(), b.head<2>());
            if (distance >= best) continue;
            best = distance;
            found = axis;
        }
    }
    return found;
}

bool begin_prop_drag(const Editor& editor, const Camera& camera, const Vec2& pixel, const Vec2& size,
                     int axis, PropDrag& drag) {
    const std::optional<std::size_t> chosen = chosen_prop(editor);
    if (!chosen) return false;
    const Prop& prop = editor.document->level().props[*chosen];
    const std::optional<double> start = parameter(editor, prop, pixel_ray(camera, pixel, size), axis);
    if (!start) return false;
    drag = {*chosen, axis, prop, prop, *start};
    return true;
}

void drag_prop(const Editor& editor, const Camera& camera, const Vec2& pixel, const Vec2& size,
               bool other_snap, PropDrag& drag) {
    const std::optional<double> now =
        parameter(editor, drag.before, pixel_ray(camera, pixel, size), drag.axis);
    if (!now) return;
    const PropTool& tool = editor.props;
    const bool snap = tool.snap != other_snap;
    const double moved = *now - drag.start;
    switch (tool.handles) {
        case PropHandles::move:
            drag.now = moved_prop(drag.before, drag.axis, moved,
                                  snap ? std::optional(tool.move_step) : std::nullopt);
            break;
        case PropHandles::rotate:
            drag.now = turned_prop(drag.before, drag.axis, snap ? snapped(moved, tool.turn_step) : moved);
            break;
        case PropHandles::scale:
            if (drag.start > 1e-6)
                drag.now = scaled_prop(drag.before, drag.axis, std::max(1e-3, *now / drag.start),
                                       snap ? std::optional(tool.scale_step) : std::nullopt);
            break;
    }
}

void end_prop_drag(Editor& editor, const PropDrag& drag) {
    static constexpr const char* verbs[] = {"Move ", "Rotate ", "Scale "};
    if (drag.now != drag.before)
        change_prop(editor, drag.prop, drag.now,
                    verbs[static_cast<std::size_t>(editor.props.handles)] + drag.before.name);
}

void add_prop_handles(Overlay& overlay, const Editor& editor, const Camera& camera, double height) {
    const std::optional<std::size_t> chosen = chosen_prop(editor);
    if (!chosen || editor.tool != Tool::props) return;
    const ViewportState& state = viewport_state();
    const bool dragged = state.gesture == Gesture::drag_prop;
    const Level& level = editor.document->level();
    const Prop& prop = dragged ? state.prop_drag.now : level.props[*chosen];
    if (dragged) add_ghost(overlay, level, prop);
    const double length = arm(camera, prop.position, height);
    for (int axis = 0; axis < 3; ++axis) {
        const Color color = dragged && state.prop_drag.axis == axis ? held_handle : handle_colors[axis];
        const std::vector<Vec3> points = handle_points(prop, editor.props.handles, axis, length);
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            if (editor.props.handles == PropHandles::move)
                overlay.arrow(points[i], points[i + 1], color, 3.0f, true);
            else
                overlay.line(points[i], points[i + 1], color, 3.0f, true);
        }
        if (editor.props.handles == PropHandles::scale)
            overlay.ellipsoid(points.back(), Vec3::Constant(0.07 * length), color, color);
    }
}

}  // namespace slipface
