#include "slipface/movement/step.h"

#include <algorithm>
#include <cmath>

#include "mover.h"

namespace slipface {

namespace {

bool usable(const MovementSettings& s) {
    return is_finite(s) && s.radii.minCoeff() > 0.0 && s.skin > 0.0;
}

bool usable(const PlayerState& state, const PlayerInput& input, double dt) {
    return dt >= 1e-4 && dt <= 0.25 && state.position.allFinite() && state.velocity.allFinite() &&
           state.ground_normal.allFinite() && input.wish.allFinite() &&
           std::isfinite(state.ground_rise + state.coyote_s + state.jump_buffer_s);
}

Vec2 at_most_one(const Vec2& wish) {
    const Vec3 lifted(wish.x(), wish.y(), 0.0);
    if (!(wish.cwiseAbs().maxCoeff() > 1.0) && wish.norm() <= 1.0) return wish;
    const Vec3 unit = direction_of(lifted);
    return {unit.x(), unit.y()};
}

PlayerState state_after(const Mover& mover, const PlayerState& before, const PlayerInput& input) {
    const bool pressed = input.jump && !before.jump_held;
    PlayerState after;
    after.position = mover.position;
    after.velocity = mover.velocity;
    after.grounded = mover.grounded;
    after.climbing = mover.climbing;
    after.stuck = mover.stuck;
    after.jump_held = input.jump;
    after.hazard = mover.hazard;
    after.jumping = mover.jumping && !mover.grounded && !mover.climbing && !mover.stuck;
    after.trapped = mover.trapped;
    if ((mover.support_face != no_id && !mover.bounced) || mover.grounded) {
        after.ground_normal = mover.support_normal;
        after.ground_face = mover.support_face;
        after.ground_surface = mover.support_surface;
        after.ground_platform = mover.support_platform;
        after.ground_rise = mover.grounded ? mover.support_rise : 0.0;
    }
    after.coyote_s = coyote_after(mover, before);
    after.jump_buffer_s = jump_buffer_after(mover, before, pressed);
    return after;
}

// A player inside geometry is put outside before anything else.
void leave_geometry(Mover& mover) {
    const MovementSettings& settings = mover.settings;
    const bool pushes = settings.push_out != PushOut::off;
    if (!pushes && !settings.nudge) {
        // Asked only by who wants to know why.
        if (mover.trace == nullptr || !overlaps_scene(mover, mover.position)) return;
        decide(mover, Decision::push_out_off);
        decide(mover, Decision::nudge_off);
        return;
    }
    mover.began_free = is_free(mover, mover.position);
    if (mover.began_free || !overlaps_scene(mover, mover.position)) {
        decide(mover, settings.nudge ? Decision::nudge_needless : Decision::push_out_needless);
        return;
    }
    if (pushes) {
        push_out(mover);
    } else {
        decide(mover, Decision::push_out_off);
    }
    if (settings.nudge) {
        mover.trapped = !nudge(mover);
    } else if (mover.trace != nullptr && overlaps_scene(mover, mover.position)) {
        decide(mover, Decision::nudge_off);
    }
}

// What holds the player decides how the rest of the step goes.
void move(Mover& mover, const PlayerState& state, const PlayerInput& input) {
    const SurfaceType& support = support_of(mover, state);
    const bool held = state.stuck && sticks(mover, support);
    const bool on_ladder = state.climbing && support.climbable;
    const bool pressed = input.jump && !state.jump_held;
    const bool jump = wants_jump(mover, state, pressed);
    const bool stays = (held || on_ladder) && !jump;
    if (state.grounded || held) carry(mover, support, state.ground_face);
    if (mover.stuck) {
        mover.velocity = Vec3::Zero();
    } else if (held && stays) {
        hold(mover, state);
    } else if (stays) {
        climb(mover, state);
    } else {
        walk(mover, state, jump);
    }
}

// A part of a step: `state` and the result are in the scene's coordinates. Only the first part moves with the
// platforms, whose geometry stands where the whole step ends.
PlayerState part_of_step(Mover& mover, const PlayerState& state, const PlayerInput& input, bool first) {
    mover.walkable_cosine = slope_cosine(mover.settings.max_slope);
    mover.wish = at_most_one(input.wish);
    mover.jump_held = input.jump;
    mover.jumping = state.jumping;
    mover.trapped = state.trapped && !first;
    if (first) {
        leave_geometry(mover);
        const Vec3 began = mover.position;
        move_with_platforms(mover, state);
        mover.began_free = mover.began_free && mover.position == began;
    }
    mover.support_rise = state.grounded ? state.ground_rise : 0.0;
    const Motion safe = mover;
    move(mover, state, input);
    const bool room = clamp_to_terrain(mover, safe.position);

    const bool finite = mover.position.allFinite() && mover.velocity.allFinite();
    if (finite && room && !ends_inside(mover, safe.position)) return state_after(mover, state, input);
    decide(mover, Decision::never_inside, {.value = finite ? (mover.position - safe.position).norm() : 0.0},
           mover.support_face);
    PlayerState after = state;
    after.position = safe.position;
    after.velocity = Vec3::Zero();
    after.jump_held = input.jump;
    after.hazard = mover.hazard;
    after.trapped = mover.trapped;
    return after;
}

}  // namespace

StepResult step(const MovementScene& scene, const MovementSettings& settings, const PlayerState& state,
                const PlayerInput& input, double dt, TraceSink* trace) {
    if (!usable(settings) || !usable(state, input, dt)) return {.state = state};
    constexpr double max_parts = 1000.0;
    const double wanted = settings.sub_step > 0.0 ? std::ceil(dt / settings.sub_step - 1e-6) : 1.0;
    const int parts = static_cast<int>(std::clamp(wanted, 1.0, max_parts));

    StepResult result{.state = state};
    result.state.position = position_in_scene(scene, state);
    bool hazard = false;
    for (int i = 0; i < parts; ++i) {
        const double speed = std::max(result.state.velocity.norm(), settings.walk_speed);
        const Vec3 reach = reach_of_step(settings, speed * dt / parts);
        Mover mover(scene, settings, trace, dt / parts, result.state.position, reach);
        result.state = part_of_step(mover, result.state, input, i == 0);
        result.sweeps += mover.sweeps;
        result.contacts += mover.contacts;
        result.end_is_free = mover.end_is_free;
        hazard = hazard || result.state.hazard;
    }
    result.state.hazard = hazard;
    put_in_scene(scene, result.state.position, result.state);
    if (trace != nullptr && scene.sectors.size > 0.0) {
        const bool stays = result.state.sector == state.sector;
        trace->add(DecisionRecord{.kind = stays ? Decision::sector_kept : Decision::sector_entered,
                                  .value = result.state.position.cwiseAbs().maxCoeff(),
                                  .limit = 0.5 * scene.sectors.size});
    }
    return result;
}

}  // namespace slipface
