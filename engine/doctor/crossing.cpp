#include "crossing.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "slipface/base/parallel.h"
#include "slipface/movement/step.h"

namespace slipface::doctor {
namespace {

constexpr double dt = 1.0 / 60.0;

// `count` headings around the circle, turned on from one to the next: no sine, whose last bits differ between
// libraries.
template <std::size_t count>
std::array<Vec2, count> headings(double cosine, double sine) {
    std::array<Vec2, count> all;
    Vec2 heading(1.0, 0.0);
    for (Vec2& each : all) {
        each = heading;
        heading = Vec2(cosine * heading.x() - sine * heading.y(), sine * heading.x() + cosine * heading.y());
    }
    return all;
}
const auto every_5_degrees = headings<72>(0.9961946980917455, 0.08715574274765817);
const auto every_30_degrees = headings<12>(0.8660254037844387, 0.5);

MovementSettings still_settings(const Patient& patient) {
    MovementSettings settings = patient.level.movement;
    settings.sectors = false;
    settings.platforms = false;
    settings.heightfield = false;
    return settings;
}

MovementScene scene_of(const Patient& patient) {
    return {.collision = patient.world(), .surfaces = patient.level.surfaces};
}

// After a step of a player at `position`.
void spend_step(const Patient& patient, const StepResult& result, const Vec3& position) {
    constexpr std::size_t queries = 8;
    ++patient.effort;
    if (!result.crowded) return;
    const MovementSettings& settings = patient.level.movement;
    const Vec3 reach = settings.radii.array() + settings.step_height + settings.walk_speed * dt;
    patient.spend(queries, {position - reach, position + reach});
}

// Before `count` walks begin or end within `reach` of a position on the ground.
void spend_ends(const Patient& patient, const Vec3& position, double reach, std::size_t count) {
    constexpr std::size_t queries = 4;
    const Vec3 around = 2.0 * patient.level.movement.radii + Vec3(reach, 0.0, reach);
    patient.spend(queries * count, {position - around, position + around});
}

bool is_free(const Patient& patient, const Vec3& from, const Vec3& move) {
    return !overlaps_any(patient.world(), patient.level.movement.radii, from) &&
           !sweep_ellipsoid(patient.world(), patient.level.movement.radii, from, move);
}

// A player who stands above or below `feet`, within half a radius up and down. A walkable floor that holds
// nobody back and takes nobody along.
std::optional<PlayerState> standing_at(const Patient& patient, const Vec3& feet) {
    const MovementSettings& settings = patient.level.movement;
    const double reach = 0.5 * settings.radii.y();
    const Vec3 above = feet + Vec3(0.0, settings.radii.y() + reach, 0.0);
    ++patient.effort;
    if (patient.is_spent() || overlaps_any(patient.world(), settings.radii, above)) return std::nullopt;
    const Vec3 down(0.0, -2.0 * reach, 0.0);
    const auto floor = sweep_ellipsoid(patient.world(), settings.radii, above, down);
    if (!floor) return std::nullopt;
    const SurfaceType& surface = patient.surface(floor->face);
    const double steepest = surface.max_slope.value_or(settings.max_slope);
    if (floor->normal.y() < std::cos(steepest) || surface.sticky || surface.hazardous ||
        surface.restitution > 0.0 || !surface.velocity.isZero() || surface.angular_velocity != 0.0)
        return std::nullopt;
    PlayerState state;
    state.position = above + floor->t * down + Vec3(0.0, settings.skin, 0.0);
    state.grounded = true;
    state.ground_normal = floor->normal;
    state.ground_face = floor->face;
    state.ground_surface = patient.resolved.surface[floor->face];
    return state;
}

// There is floor at about the height of `at` in every quarter of a circle around it, three bodies wide.
bool floor_all_round(const Patient& patient, const Vec3& at) {
    const double reach = 0.5 * patient.level.movement.radii.y();
    const double radius = 3.0 * std::max(patient.level.movement.radii.x(), patient.level.movement.radii.z());
    std::size_t missing = 0, longest = 0;
    patient.effort += every_30_degrees.size();
    for (std::size_t i = 0; i < 2 * every_30_degrees.size(); ++i) {
        const Vec2& heading = every_30_degrees[i % every_30_degrees.size()];
        const Vec3 from = at + Vec3(radius * heading.x(), reach, radius * heading.y());
        missing = cast_ray(patient.world(), from, Vec3(0.0, -1.0, 0.0), 2.0 * reach) ? 0 : missing + 1;
        longest = std::max(longest, missing);
    }
    return 4 * longest <= every_30_degrees.size();
}

Passage walk_between(const Patient& patient, const PlayerState& begin, const PlayerState& end) {
    const MovementSettings settings = still_settings(patient);
    const Vec3 motion(end.position.x() - begin.position.x(), 0.0, end.position.z() - begin.position.z());
    const double length = motion.norm();
    if (!(length > 0.0)) return Passage::unknown;
    const Vec3 along = motion / length;
    const Vec2 heading(along.x(), along.z());
    // Up, across and down again, a little above what lies at the feet.
    const double clearance = 0.05 * settings.radii.y();
    const double high = std::max(begin.position.y(), end.position.y()) + clearance;
    const Vec3 up_begin(begin.position.x(), high, begin.position.z());
    const Vec3 up_end(end.position.x(), high, end.position.z());
    if (!is_free(patient, begin.position + Vec3(0.0, settings.skin, 0.0), up_begin - begin.position) ||
        !is_free(patient, up_begin, up_end - up_begin))
        return Passage::unknown;
    const MovementScene scene = scene_of(patient);
    const double start_up = settings.walk_speed / std::max(settings.ground_acceleration, 1e-3);
    const auto ticks =
        static_cast<int>(std::min(2000.0, (2.0 * length / settings.walk_speed + start_up + 0.2) / dt));
    const double lost = std::min(begin.position.y(), end.position.y()) - settings.radii.y();
    PlayerState state = begin;
    for (int tick = 0; tick < ticks; ++tick) {
        const StepResult result = step(scene, settings, state, {.wish = heading}, dt);
        state = result.state;
        spend_step(patient, result, state.position);
        if (patient.is_spent()) return Passage::unknown;
        const Vec3 made = state.position - begin.position;
        if (made.x() * along.x() + made.z() * along.z() >= 0.98 * length) return Passage::passes;
        if (state.position.y() < lost)
            return floor_all_round(patient, Vec3(state.position.x(), lost, state.position.z()))
                       ? Passage::falls
                       : Passage::unknown;
    }
    return Passage::catches;
}

}  // namespace

Passage cross(const Patient& patient, const Vec3& position, const Vec2& heading, double before,
              double after) {
    const Vec3 along(heading.x(), 0.0, heading.y());
    return cross_between(patient, position - before * along, position + after * along);
}

Passage cross_between(const Patient& patient, const Vec3& from, const Vec3& to) {
    const auto begin = standing_at(patient, from);
    const auto end = standing_at(patient, to);
    return begin && end ? walk_between(patient, *begin, *end) : Passage::unknown;
}

Passage climb_between(const Patient& patient, const Vec3& low, const Vec3& high) {
    for (const Vec3& end : {low, high})
        spend_ends(patient, end, 0.0, 1);
    const auto begin = standing_at(patient, low);
    const auto end = standing_at(patient, high);
    if (!begin || !end || !(begin->position.y() < end->position.y())) return Passage::unknown;
    return walk_between(patient, *begin, *end);
}

Passage cross_all_directions(const Patient& patient, const Vec3& position) {
    const double reach = 1.5 * std::max(patient.level.movement.radii.x(), patient.level.movement.radii.z());
    spend_ends(patient, position, reach, 2 * every_5_degrees.size());
    Passage worst = Passage::unknown;
    for (const Vec2& heading : every_5_degrees) {
        worst = std::max(worst, cross(patient, position, heading, reach, reach));
        if (worst == Passage::falls) break;
    }
    return worst;
}

bool drops_through(const Patient& patient, const Vec3& position) {
    const Vec3& radii = patient.level.movement.radii;
    const Vec3 above = position + Vec3(0.0, 1.5 * radii.y(), 0.0);
    return is_free(patient, above, Vec3(0.0, -3.0 * radii.y(), 0.0)) && floor_all_round(patient, position);
}

bool wedges(const Patient& patient, const Vec3& centre) {
    const MovementSettings settings = still_settings(patient);
    const MovementScene scene = scene_of(patient);
    const double away = settings.radii.minCoeff();
    constexpr int second = 60;
    const auto step_on = [&](PlayerState& state, const PlayerInput& input) {
        if (patient.is_spent()) return;
        const StepResult result = step(scene, settings, state, input, dt);
        state = result.state;
        spend_step(patient, result, state.position);
    };
    for (const Vec2& in : every_30_degrees) {
        PlayerState caught;
        caught.position = centre;
        for (int tick = 0; tick < second; ++tick)
            step_on(caught, {.wish = in});
        // A jump on the way, as players try; where it ends counts, not how high it went.
        const bool leaves =
            std::any_of(every_30_degrees.begin(), every_30_degrees.end(), [&](const Vec2& out) {
                PlayerState state = caught;
                for (int tick = 0; tick < 2 * second; ++tick)
                    step_on(state, {.wish = out, .buttons = {Button::jump, tick > 5 && tick < second / 2}});
                return (state.position - caught.position).norm() > away;
            });
        if (patient.is_spent()) return false;
        if (!leaves) return true;
    }
    return false;
}

std::size_t try_in_turn(const Patient& patient, std::size_t count,
                        const std::function<bool(const Patient&, std::size_t)>& try_one) {
    constexpr std::size_t largest_batch = 32, highest_effort = 3'000'000;
    if (count > 0) patient.world();
    std::size_t effort = 0, next = 0, untried = 0;
    std::size_t dearest = highest_effort / 4;  // of those tried; at first a guess
    while (next < count && effort < highest_effort) {
        const std::size_t batch =
            std::min({count - next, largest_batch, (highest_effort - effort) / dearest + 1});
        std::array<std::size_t, largest_batch> efforts{};
        std::array<bool, largest_batch> found_out{};
        parallel_for(batch, 4, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const Patient here{patient.level,           patient.mesh, patient.topology, patient.resolved,
                                   patient.world_on_demand, efforts[i]};
                found_out[i] = try_one(here, next + i);
            }
        });
        dearest = next == 0 ? 1 : dearest;
        for (std::size_t i = 0; i < batch; ++i) {
            effort += efforts[i];
            dearest = std::max(dearest, efforts[i]);
            if (!found_out[i]) ++untried;
        }
        next += batch;
    }
    return untried + count - next;
}

}  // namespace slipface::doctor
