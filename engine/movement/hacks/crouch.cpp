// Problem: what the body does not fit under is closed for ever. Hack: while crouch is held the player has a
// lower body, and on the ground a lower speed. It stands up as soon as there is room.
//
// Each step runs under settings that have the player's body. On the ground the feet stay when it changes; in
// the air the head stays and the feet are drawn up, as far as there is room.
#include <algorithm>
#include <cmath>

#include "mover.h"

namespace slipface {

namespace {

bool clings(const PlayerState& state) {
    return is_held(state) && !state.grounded;
}

// In the air, with the head where it was: the feet are drawn up by `up`, or let down by -up. Nothing if there
// is no room for the new body.
std::optional<PlayerState> keep_head(const MovementScene& scene, const MovementSettings& low,
                                     const MovementSettings& after, const PlayerState& state, double up) {
    PlayerState start = state;
    start.position = position_in_scene(scene, state);
    const Surroundings around(scene, low, start.position, std::abs(up));
    Mover mover({.scene = scene, .settings = low, .state = start}, around);
    const Vec3 end = sweep_with_skin(mover, Pass::probe, 0, Vec3(0.0, up, 0.0)).reached;
    const Surroundings around_end(scene, after, end, 0.0);
    const Mover grown({.scene = scene, .settings = after, .state = start}, around_end);
    if (!end.allFinite() || overlaps_scene(grown, end)) return std::nullopt;
    PlayerState result = state;
    put_in_scene(scene, end, result);
    return result;
}

}  // namespace

Vec3 body_radii(const MovementSettings& settings, const PlayerState& state) {
    Vec3 radii = settings.radii;
    if (state.crouched) radii.y() = std::min(radii.y(), settings.crouch_radius_y);
    return radii;
}

MovementSettings settings_of_body(const MovementSettings& settings, const PlayerState& state) {
    MovementSettings of_body = settings;
    of_body.radii = body_radii(settings, state);
    if (state.crouched && state.grounded)
        of_body.walk_speed = std::min(settings.walk_speed, settings.crouch_speed);
    return of_body;
}

void choose_body(const MovementScene& scene, const MovementSettings& settings, PlayerState& state,
                 const PlayerInput& input, TraceSink* trace) {
    const auto say = [&](Decision kind, const Quantity& quantity) {
        if (trace != nullptr)
            trace->add(DecisionRecord{.kind = kind, .value = quantity.value, .limit = quantity.limit});
    };
    const bool held = input.buttons.has(Button::crouch);
    if (held && !settings.crouch) say(Decision::crouch_off, {});
    const bool may = state.crouched || is_held(state) || settings.crouch_in_air == CrouchInAir::feet_up;
    const bool asks = settings.crouch && held && may && !clings(state);
    state.wants_to_stand = false;
    if (asks && state.crouched && state.grounded)
        say(Decision::crawled,
            {.value = std::min(settings.crouch_speed, settings.walk_speed), .limit = settings.walk_speed});
    if (asks == state.crouched) return;

    PlayerState other = state;
    other.crouched = asks;
    const MovementSettings now = settings_of_body(settings, state), then = settings_of_body(settings, other);
    const MovementSettings& low = asks ? then : now;
    const double lost = settings.radii.y() - low.radii.y();
    std::optional<PlayerState> changed;
    const bool keeps_head = !is_held(state) && settings.crouch_in_air == CrouchInAir::feet_up;
    if (keeps_head) changed = keep_head(scene, low, then, state, asks ? lost : -lost);
    const bool drawn_up = changed.has_value();
    if (!changed) changed = change_body(scene, now, state, then.radii);
    if (!changed) {
        state.wants_to_stand = !asks;
        if (!asks) say(Decision::crouch_no_room, {.value = 2.0 * settings.radii.y()});
        return;
    }
    const double moved = position_in_scene(scene, *changed).y() - position_in_scene(scene, state).y();
    state = *changed;
    state.crouched = asks;
    if (asks)
        say(Decision::crouched, {.value = 2.0 * then.radii.y(), .limit = 2.0 * settings.radii.y()});
    else
        say(Decision::stood_up, {.value = 2.0 * settings.radii.y()});
    if (drawn_up && asks) say(Decision::feet_drawn_up, {.value = moved + lost});
}

}  // namespace slipface
