#include "audit_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "slipface/movement/first_contact.h"

namespace slipface {
namespace {

// The first face between two points that stops a player on this way, or no_id.
template <class World>
FaceId face_between(const World& world, const Vec3& from, const Vec3& to, const QueryFilter& met) {
    if (from == to) return no_id;
    const std::optional<RayHit> hit = cast_ray(world, from, to - from, 1.0, RayStops::as_movement, met);
    return hit ? hit->face : no_id;
}

// What a player meets in such a step: one who drops through one-sided faces meets none of them.
QueryFilter met_by(const MovementScene& scene, const MovementSettings& settings, const PlayerState& before,
                   const PlayerInput& input) {
    QueryFilter met;
    if (!settings.drop_through || !(before.dropping || input.buttons.has(Button::drop))) return met;
    for (std::size_t i = 0; i < scene.surfaces.size() && i < met.ignored.size(); ++i)
        met.ignored[i] = scene.surfaces[i].one_sided;
    return met;
}

// The corners of the way that a step took from `from`, as its sweeps tell it; the last is `after`. Hacks try
// moves and take them back, so each sweep goes on from the latest corner that lies where it begins.
std::vector<Vec3> traced_path(const MovementScene& scene, const MovementSettings& settings,
                              const PlayerState& before, const PlayerInput& input, double dt,
                              const Vec3& from, const Vec3& after) {
    TraceRecorder trace;
    step(scene, settings, before, input, dt, &trace);
    struct Corner {
        Vec3 position;
        std::size_t previous;
    };
    std::vector<Corner> corners{{from, 0}};
    const auto latest_at = [&](const Vec3& position) {
        for (std::size_t i = corners.size(); i-- > 0;)
            if (corners[i].position == position) return i;
        // Moved without a sweep, by a push-out or onto terrain: straight from where it was last.
        corners.push_back({position, corners.size() - 1});
        return corners.size() - 1;
    };
    for (const TraceRecord& record : trace.records) {
        const auto* sweep = std::get_if<SweepRecord>(&record);
        if (sweep == nullptr) continue;
        const std::size_t begin = latest_at(sweep->from);
        corners.push_back({sweep->reached, begin});
    }
    std::vector<Vec3> path;
    for (std::size_t i = latest_at(after); i != 0; i = corners[i].previous)
        path.push_back(corners[i].position);
    std::reverse(path.begin(), path.end());
    if (path.empty()) path.push_back(after);
    return path;
}

bool path_is_clear(const PosedWorld& world, Vec3 at, std::span<const Vec3> path, const QueryFilter& met) {
    for (const Vec3& point : path) {
        if (face_between(world, at, point, met) != no_id) return false;
        at = point;
    }
    return true;
}

// A platform is looked at only near the boxes of where it ever was. The margin outdoes all rounding.
bool is_near(const MovingPart& part, const Vec3& a, const Vec3& b, const Vec3& radii) {
    const Aabb reach = part.at_end().bounds();
    const Vec3 margin = radii.array() + 0.01;
    return ((a.cwiseMax(b) + margin).array() >= reach.min.array()).all() &&
           ((a.cwiseMin(b) - margin).array() <= reach.max.array()).all();
}

// The straight way of the centre through a part of the scene: what stands still, or a platform in its frame.
struct Passage {
    PosedWorld world;
    Vec3 from;
    FaceId face;  // met on the straight way
    bool moves;
};

bool is_excused(const Passage& passage, std::span<const Vec3> path, const QueryFilter& met) {
    const auto& [world, from, face, moves] = passage;
    if (path_is_clear(world, from, path, met)) return true;
    // Pushes come first in a trace and do not see the platform that pushes: in its frame all of them are one
    // way, from where it set out to where they end, which is some corner of the way.
    for (std::size_t pushed = 1; moves && pushed < path.size(); ++pushed) {
        if (path_is_clear(world, from, path.subspan(pushed), met)) return true;
    }
    return false;
}

}  // namespace

std::vector<Pose> rides_of(std::span<const MovingPart> platforms) {
    std::vector<Pose> rides;
    for (const MovingPart& part : platforms) {
        Pose& ride = rides.emplace_back();
        if (part.begin == part.end) continue;
        for (std::size_t axis = 0; axis < 3; ++axis)
            ride.columns[axis] = part.end.rotate(part.begin.rotate_back(ride.columns[axis]));
        ride.offset = part.end.apply(part.begin.undo(Vec3::Zero()));
    }
    return rides;
}

std::optional<CheckFailure> passed_through(const MovementScene& scene, std::span<const Pose> rides,
                                           const MovementSettings& settings, const PlayerState& before,
                                           const PlayerInput& input, double dt, const Vec3& after,
                                           Against against) {
    const Vec3 from = position_in_scene(scene, before);
    const QueryFilter met = met_by(scene, settings, before, input);
    std::vector<Vec3> path;
    const auto judge = [&](const Passage& passage) -> std::optional<CheckFailure> {
        if (passage.face == no_id) return std::nullopt;
        if (path.empty()) path = traced_path(scene, settings, before, input, dt, from, after);
        if (is_excused(passage, path, met)) return std::nullopt;
        return CheckFailure{(after - passage.from).norm(), passage.face};
    };
    if (const auto failure = judge(
            {PosedWorld(scene.collision), from, face_between(scene.collision, from, after, met), false}))
        return failure;
    if (against == Against::what_stands_still) return std::nullopt;
    for (std::size_t i = 0; i < scene.platforms.size(); ++i) {
        const MovingPart& part = scene.platforms[i];
        const Vec3 carried = rides[i].apply(from);
        if (!is_near(part, carried, after, Vec3::Zero())) continue;
        const PosedWorld world = part.at_end();
        if (const auto failure = judge({world, carried, face_between(world, carried, after, met), true}))
            return failure;
    }
    return std::nullopt;
}

std::optional<CheckFailure> overlaps_deeply(const MovementScene& scene, const MovementSettings& settings,
                                            const Vec3& position, Against against) {
    const Vec3 radii = (settings.radii.array() - settings.skin).max(0.5 * settings.radii.array());
    std::optional<CheckFailure> deepest;
    const auto look_in = [&](const auto& world) {
        if (!overlaps_any(world, radii, position)) return;
        std::array<Overlap, 64> overlaps;
        const std::size_t count = std::min(overlaps.size(), find_overlaps(world, radii, position, overlaps));
        for (const Overlap& overlap : std::span(overlaps).first(count)) {
            // One who comes through a one-sided face from behind overlaps it rightly.
            if (world.surface_rule(world.face_surface(overlap.face)).one_sided) continue;
            if (!deepest || overlap.depth_sphere_space > deepest->amount)
                deepest = CheckFailure{overlap.depth_sphere_space, overlap.face};
        }
    };
    look_in(scene.collision);
    if (against == Against::what_stands_still) return deepest;
    for (const MovingPart& part : scene.platforms) {
        if (is_near(part, position, position, radii)) look_in(part.at_end());
    }
    return deepest;
}

bool path_is_free(const MovementScene& scene, const MovementSettings& settings, const Vec3& position,
                  const Vec2& heading) {
    constexpr double reach = 0.05;
    const double length = heading.norm();
    if (!(length > 0.0)) return false;
    const double steepest = std::tan(std::min(settings.max_slope, 1.4));
    for (const double rise : {0.0, 0.5 * steepest, steepest}) {
        const Vec3 direction(heading.x() / length, rise, heading.y() / length);
        const Vec3 move = direction * (reach / direction.norm());
        if (!first_contact(scene, settings.radii, position, move)) return true;
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
