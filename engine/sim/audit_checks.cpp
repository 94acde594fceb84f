#include "audit_checks.h"

#include <array>
#include <cmath>

namespace slipface {
namespace {

bool blocks(const CollisionWorld& world, FaceId face) {
    const SurfaceRule rule = world.surface_rule(world.face_surface(face));
    return rule.solid && !rule.one_sided;
}

// The first blocking face between two points, or no_id.
FaceId face_between(const CollisionWorld& world, const Vec3& from, const Vec3& to) {
    if (from == to) return no_id;
    const std::optional<RayHit> hit = cast_ray(world, from, to - from, 1.0);
    return hit && blocks(world, hit->face) ? hit->face : no_id;
}

bool polyline_is_free(const CollisionWorld& world, std::initializer_list<Vec3> points) {
    const Vec3* previous = nullptr;
    for (const Vec3& point : points) {
        if (previous && face_between(world, *previous, point) != no_id) return false;
        previous = &point;
    }
    return true;
}

bool traced_way_is_free(const CollisionWorld& world, const std::vector<TraceRecord>& records,
                        const Vec3& before, const Vec3& after) {
    Vec3 at = before;
    for (const TraceRecord& record : records) {
        const auto* sweep = std::get_if<SweepRecord>(&record);
        if (!sweep) continue;
        if (face_between(world, at, sweep->from) != no_id) return false;
        if (face_between(world, sweep->from, sweep->reached) != no_id) return false;
        at = sweep->reached;
    }
    return face_between(world, at, after) == no_id;
}

}  // namespace

std::optional<CheckFailure> passed_through(const MovementScene& scene, const MovementSettings& settings,
                                           const PlayerState& before, const PlayerInput& input, double dt,
                                           const Vec3& after) {
    const CollisionWorld& world = scene.collision;
    const FaceId face = face_between(world, before.position, after);
    if (face == no_id) return std::nullopt;

    TraceRecorder trace;
    step(scene, settings, before, input, dt, &trace);
    if (traced_way_is_free(world, trace.records, before.position, after)) return std::nullopt;

    const Vec3 lift = Vec3::UnitY() * settings.radii.y();
    const Vec3 over_start(before.position.x(), after.y(), before.position.z());
    const Vec3 over_end(after.x(), before.position.y(), after.z());
    if (polyline_is_free(world, {before.position, over_start, after}) ||
        polyline_is_free(world, {before.position, over_end, after}) ||
        polyline_is_free(world, {before.position, before.position + lift, after + lift, after})) {
        return std::nullopt;
    }
    return CheckFailure{(after - before.position).norm(), face};
}

std::optional<CheckFailure> overlaps_deeply(const MovementScene& scene, const MovementSettings& settings,
                                            const Vec3& position) {
    const Vec3 radii = (settings.radii.array() - settings.skin).max(0.5 * settings.radii.array());
    if (!overlaps_any(scene.collision, radii, position)) return std::nullopt;
    std::array<Overlap, 64> overlaps;
    const std::size_t count =
        std::min(overlaps.size(), find_overlaps(scene.collision, radii, position, overlaps));
    std::optional<CheckFailure> deepest;
    for (std::size_t i = 0; i < count; ++i) {
        const Overlap& overlap = overlaps[i];
        if (!blocks(scene.collision, overlap.face)) continue;
        if (!deepest || overlap.depth_sphere_space > deepest->amount) {
            deepest = CheckFailure{overlap.depth_sphere_space, overlap.face};
        }
    }
    return deepest;
}

bool way_is_free(const MovementScene& scene, const MovementSettings& settings, const Vec3& position,
                 const Vec2& heading) {
    constexpr double reach = 0.05;
    const double length = heading.norm();
    if (!(length > 0.0)) return false;
    const double steepest = std::tan(std::min(settings.max_slope, 1.4));
    for (const double rise : {0.0, 0.5 * steepest, steepest}) {
        const Vec3 direction(heading.x() / length, rise, heading.y() / length);
        const Vec3 move = direction * (reach / direction.norm());
        if (!sweep_ellipsoid(scene.collision, settings.radii, position, move)) return true;
    }
    return false;
}

bool level_is_closed(const CollisionWorld& world, const Vec3& from) {
    // Directions on a cube's surface: whole numbers, no sines.
    constexpr int half = 6;
    for (int x = -half; x <= half; ++x) {
        for (int y = -half; y <= half; ++y) {
            for (int z = -half; z <= half; ++z) {
                if (std::max({std::abs(x), std::abs(y), std::abs(z)}) != half) continue;
                // Off the lattice, so that no ray runs along a wall's edge.
                const Vec3 direction(x + 0.013, y + 0.029, z + 0.017);
                if (!cast_ray(world, from, direction)) return false;
            }
        }
    }
    return true;
}

}  // namespace slipface
