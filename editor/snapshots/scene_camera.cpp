#include "snapshots/scene_camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "goldens/camera_names.h"

namespace slipface {

namespace {

constexpr double degrees = std::numbers::pi / 180.0;
constexpr double nearest_plane = 0.02;  // metres

// `wanted`, or if geometry is in between, a point nearer to `target` that sees it.
Vec3 free_eye(const StagedLevel& staged, const Vec3& target, const Vec3& wanted) {
    const auto hit = cast_ray(staged.visible(), target, wanted - target, 1.0);
    return hit ? Vec3(target + (wanted - target) * std::max(0.05, hit->t * 0.92)) : wanted;
}

Camera looking(const Vec3& eye, const Vec3& target) {
    Camera camera;
    camera.eye = eye;
    camera.target = target;
    camera.fov_y = 60.0 * degrees;
    return camera;
}

std::optional<Camera> tape_camera(const CameraName& name, const StagedLevel& staged,
                                  const SceneMovement& story) {
    if (story.states.empty()) return std::nullopt;
    const std::size_t last = story.states.size() - 1;
    const std::size_t tick =
        last * static_cast<std::size_t>(name.index) / static_cast<std::size_t>(name.count);
    const PlayerState& state = story.states[tick];
    Vec3 ahead(state.velocity.x(), 0, state.velocity.z());
    if (ahead.norm() < 0.2) ahead = {-std::sin(staged.level.spawn_yaw), 0, -std::cos(staged.level.spawn_yaw)};
    ahead.normalize();
    const Vec3 head = state.position + Vec3(0, 0.4, 0);
    return looking(free_eye(staged, head, head - 4.0 * ahead + Vec3(0, 1.8, 0)), head + 0.5 * ahead);
}

std::optional<Camera> contact_camera(const CameraName& name, const StagedLevel& staged,
                                     const SceneMovement& story) {
    const std::vector<MovementContact> contacts = movement_contacts(story);
    if (static_cast<std::size_t>(name.index) > contacts.size()) return std::nullopt;
    const MovementContact& contact = contacts[static_cast<std::size_t>(name.index - 1)];
    Vec3 side = Vec3::UnitY().cross(contact.normal);
    if (side.norm() < 0.1) side = Vec3::UnitX();
    side.normalize();
    const Vec3 off = contact.point + 0.1 * contact.normal;
    const Vec3 wanted = off + 2.6 * contact.normal + 1.6 * side + Vec3(0, 1.2, 0);
    return looking(free_eye(staged, off, wanted), contact.point);
}

std::optional<Camera> find_camera(const CameraName& name, const Scene& scene, const StagedLevel& staged,
                                  const SceneMovement& story) {
    const double aspect = static_cast<double>(scene.width) / scene.height;
    const Aabb& bounds = staged.level.mesh.bounds();
    const double turn = 2.0 * std::numbers::pi * (name.index - 1) / name.count;
    switch (name.kind) {
        case CameraKind::named_view:
        case CameraKind::map: return named_view(name.view, bounds, aspect);
        case CameraKind::iso_corner:
            return frame_bounds(bounds, 35.0 * degrees + turn, 33.0 * degrees, 45.0 * degrees, aspect);
        case CameraKind::turntable: return frame_bounds(bounds, turn, 24.0 * degrees, 45.0 * degrees, aspect);
        case CameraKind::tape: return tape_camera(name, staged, story);
        case CameraKind::contact: return contact_camera(name, staged, story);
        case CameraKind::bookmark:
            for (const CameraBookmark& bookmark : staged.level.cameras) {
                if (bookmark.name != name.view) continue;
                Camera camera = looking(bookmark.eye, bookmark.target);
                camera.fov_y = bookmark.fov_y;
                return camera;
            }
    }
    return std::nullopt;
}

double distance_to_segment(const Vec3& point, const Vec3& a, const Vec3& b) {
    const Vec3 along = b - a;
    const double length = along.squaredNorm();
    const double t = length > 0.0 ? std::clamp(along.dot(point - a) / length, 0.0, 1.0) : 0.0;
    return (a + t * along - point).norm();
}

}  // namespace

Result<Camera> scene_camera(const Scene& scene, const StagedLevel& staged, const SceneMovement& story) {
    if (const auto* camera = std::get_if<Camera>(&scene.camera)) return *camera;
    const auto& text = std::get<std::string>(scene.camera);
    const std::optional<CameraName> name = read_camera_name(text);
    if (const auto wrong = wrong_camera_name(text)) return Error{scene.location + "/camera", *wrong};
    if (const auto camera = find_camera(*name, scene, staged, story)) return *camera;
    const Error error{scene.location + "/camera", ""};
    if (name->kind == CameraKind::tape)
        return Error{error.location, fmt::format("\"{}\" needs a scene with a tape", text)};
    if (name->kind == CameraKind::contact)
        return Error{error.location, fmt::format("\"{}\": the scene's probe and tape make {} contacts", text,
                                                 movement_contacts(story).size())};
    std::string names;
    for (const CameraBookmark& bookmark : staged.level.cameras)
        names += (names.empty() ? "" : ", ") + bookmark.name;
    return Error{error.location, fmt::format("the level has no camera \"{}\"; it has: {}", text,
                                             names.empty() ? "none" : names)};
}

void fit_depth_range(Camera& camera, const StagedLevel& staged, const Overlay& overlay, double aspect) {
    if (camera.orthographic) return;
    const auto closest = closest_point(staged.visible(), camera.eye);
    double nearest = closest ? closest->distance : 1.0, farthest = 0.0;
    const auto include = [&](double distance, double radius) {
        nearest = std::min(nearest, distance - radius);
        farthest = std::max(farthest, distance + radius);
    };
    const Aabb& bounds = staged.level.mesh.bounds();
    for (unsigned corner = 0; corner < 8; ++corner) {
        const Vec3 location((corner & 1U) != 0 ? bounds.max.x() : bounds.min.x(),
                            (corner & 2U) != 0 ? bounds.max.y() : bounds.min.y(),
                            (corner & 4U) != 0 ? bounds.max.z() : bounds.min.z());
        farthest = std::max(farthest, (location - camera.eye).norm());
    }
    for (const Overlay::Line& line : overlay.lines) {
        include(distance_to_segment(camera.eye, line.a, line.b), 0.0);
        farthest = std::max({farthest, (line.a - camera.eye).norm(), (line.b - camera.eye).norm()});
    }
    for (const Overlay::Ellipsoid& ellipsoid : overlay.ellipsoids)
        include((ellipsoid.centre - camera.eye).norm(), ellipsoid.radii.maxCoeff());
    for (const Overlay::Triangle& triangle : overlay.triangles)
        for (const Vec3& corner : {triangle.a, triangle.b, triangle.c})
            include((corner - camera.eye).norm(), 0.05);
    // A point at distance d in the image's corner has the depth d / sqrt(1 + tx^2 + ty^2).
    const double tangent = std::tan(0.5 * camera.fov_y);
    const double corner = std::sqrt(1.0 + tangent * tangent * (1.0 + aspect * aspect));
    camera.near_plane = std::max(nearest_plane, 0.9 * nearest / corner);
    camera.far_plane = std::max(2.0 * camera.near_plane, 1.05 * farthest);
}

}  // namespace slipface
