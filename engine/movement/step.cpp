#include "slipface/movement/step.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <tuple>

#include "mover.h"
#include "slipface/movement/rest.h"

namespace slipface {

namespace {

bool usable(const MovementSettings& s) {
    return is_finite(s) && s.radii.minCoeff() > 0.0 && s.skin > 0.0;
}

bool usable(const PlayerState& state, const PlayerInput& input, double dt) {
    const auto finite = [&](auto... number) { return (std::isfinite(state.*number) && ...); };
    const auto all_finite = [&](auto... vector) { return ((state.*vector).allFinite() && ...); };
    return dt >= 1e-4 && std::isfinite(dt) && input.wish.allFinite() &&
           std::apply(all_finite, PlayerState::vectors) && std::apply(finite, PlayerState::numbers);
}

Vec2 at_most_one(const Vec2& wish) {
    if (!(wish.cwiseAbs().maxCoeff() > 1.0) && wish.norm() <= 1.0) return wish;
    const Vec3 unit = direction_of(Vec3(wish.x(), wish.y(), 0.0));
    return {unit.x(), unit.y()};
}

// Bounded, so that no number that a game passes holds it for long.
constexpr double longest_hitch_s = 60.0;

int parts_of(const MovementSettings& settings, double dt) {
    constexpr double longest_part_s = 0.25;
    constexpr double max_parts = 1000.0;
    const double wanted = settings.sub_step > 0.0 ? std::ceil(dt / settings.sub_step - 1e-6) : 1.0;
    return static_cast<int>(std::clamp(wanted, std::ceil(dt / longest_part_s), max_parts));
}

void trace_sector(const MovementScene& scene, const PlayerState& before, const PlayerState& after,
                  TraceSink* trace) {
    if (trace == nullptr || !(scene.sectors.size > 0.0)) return;
    const bool stays = after.sector == before.sector;
    trace->add(DecisionRecord{.kind = stays ? Decision::sector_kept : Decision::sector_entered,
                              .value = after.position.cwiseAbs().maxCoeff(),
                              .limit = 0.5 * scene.sectors.size});
}

// With the body that the settings have. `looked`: the box of all places where a platform would be found; may
// be null.
StepResult step_with_body(const MovementScene& scene, const MovementSettings& settings,
                          const PlayerState& state, const PlayerInput& input, double dt, TraceSink* trace,
                          StepContacts* contacts, Aabb* looked = nullptr) {
    const Vec2 wish = at_most_one(input.wish);
    dt = std::min(dt, longest_hitch_s);
    const double walkable_cosine = slope_cosine(settings.max_slope);
    const int parts = parts_of(settings, dt);

    StepResult result{.state = state};
    result.state.position = position_in_scene(scene, state);
    bool hazard = false, crushed = false;
    bool free = false;  // where the next part begins; false: unknown
    const double part_s = dt / parts;
    const double ground =  // how fast it carries the player, m/s
        state.carrier == Carrier::level || state.carrier == Carrier::unknown
            ? 0.0
            : (velocity_in_level(scene, settings, state) - motion_velocity(state)).norm();
    // How far the player can get in the next parts, m. From rest it takes time to reach walking speed.
    const auto longest_move = [&](int count) {
        const double speed = result.state.velocity.norm(), time_s = count * part_s;
        return time_s * (ground + std::min(std::max(speed, settings.walk_speed),
                                           speed + settings.ground_acceleration * time_s));
    };
    // Short parts share what is around the player.
    constexpr double longest_shared_s = 1.0 / 30.0;
    const int shared = std::max(1, static_cast<int>(longest_shared_s / part_s));
    // Not in an optional, which would fill its 19 KB with zeros in every step.
    Surroundings around(scene, settings, result.state.position, longest_move(std::min(shared, parts)));
    for (int part = 0; part < parts; ++part) {
        PlayerState before = result.state;
        const Vec3 begin = before.position;
        if (part > 0 && !around.cover(settings, before.position, longest_move(1)))
            std::construct_at(&around, scene, settings, before.position,
                              longest_move(std::min(shared, parts - part)));
        Mover mover({.scene = scene,
                     .settings = settings,
                     .state = before,
                     .trace = trace,
                     .dt = part_s,
                     .wish = wish,
                     .jump_held = input.buttons.has(Button::jump),
                     .jump_pressed = input.buttons.has(Button::jump) && !before.jump_held,
                     .walkable_cosine = walkable_cosine,
                     .since = part / static_cast<double>(parts),
                     .until = part + 1 == parts ? 1.0 : (part + 1) / static_cast<double>(parts),
                     .step_s = dt,
                     .buttons = input.buttons,
                     .dash_pressed = input.buttons.has(Button::dash) && !before.dash_held,
                     .report = contacts},
                    around);
        mover.began_free = free;
        mover.looked = looked;
        if (looked != nullptr) {
            looked->add(around.platforms.room.min);
            looked->add(around.platforms.room.max);
        }
        move_with_platforms(mover, before);
        if (part == 0 || mover.pressed) leave_geometry(mover);
        const Vec3 safe = mover.position;
        move_with_surface(mover, before);
        const Drive drive = choose_drive(mover);
        move_player(mover, drive);
        const bool room = clamp_to_terrain(mover, safe);
        result.state = accept(mover, safe, room);

        keep_contacts(mover);
        result.sweeps += mover.sweeps;
        result.contacts += mover.contacts;
        result.end_is_free = mover.end_is_free;
        result.crowded = result.crowded || around.near.triangles().reach[0] < 0.0;
        free = mover.ends_free || (mover.began_free && result.state.position == begin);
        hazard = hazard || result.state.hazard;
        crushed = crushed || result.state.crushed;
    }
    result.state.hazard = hazard;
    result.state.crushed = crushed;
    put_in_scene(scene, result.state.position, result.state);
    trace_sector(scene, state, result.state, trace);
    return result;
}

}  // namespace

StepResult step(const MovementScene& scene, const MovementSettings& settings, const PlayerState& state,
                const PlayerInput& input, double dt, TraceSink* trace, StepContacts* contacts) {
    begin_contacts(contacts);
    if (!usable(settings) || !usable(state, input, dt)) return {.state = state};
    if (!settings.crouch && !state.crouched && trace == nullptr)
        return step_with_body(scene, settings, state, input, dt, trace, contacts);
    PlayerState begin = state;
    choose_body(scene, settings, begin, input, trace);
    if (!begin.crouched) return step_with_body(scene, settings, begin, input, dt, trace, contacts);
    const MovementSettings low = settings_of_body(settings, begin);
    StepResult result = step_with_body(scene, low, begin, input, dt, trace, contacts);
    result.state.crouched = true;
    result.state.wants_to_stand = begin.wants_to_stand;
    return result;
}

StepResult step(const MovementScene& scene, const MovementSettings& settings, const PlayerState& state,
                const PlayerInput& input, double dt, Rest& rest) {
    // Whether there is room to stand up is looked for elsewhere.
    if (settings.crouch || state.crouched) return step(scene, settings, state, input, dt);
    if (const StepResult* const known = rest.find(scene, settings, state, input, dt)) return *known;
    if (!usable(settings) || !usable(state, input, dt)) return {.state = state};
    Aabb looked;
    StepResult result = step_with_body(scene, settings, state, input, dt, nullptr, nullptr, &looked);
    rest.note(scene, settings, state, input, dt, looked, result);
    return result;
}

}  // namespace slipface
