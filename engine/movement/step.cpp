#include "slipface/movement/step.h"

#include <cmath>

#include "mover.h"

namespace slipface {

namespace {

bool usable(const MovementSettings& s) {
    const double sum = s.gravity + s.walk_speed + s.ground_acceleration + s.slippery_acceleration +
                       s.air_acceleration + s.terminal_speed + s.jump_speed + s.max_slope + s.ground_speed +
                       s.keep_energy_limit;
    return s.radii.allFinite() && s.radii.minCoeff() > 0.0 && s.skin > 0.0 && std::isfinite(s.skin + sum);
}

bool usable(const PlayerState& state, const PlayerInput& input, double dt) {
    return dt >= 1e-4 && dt <= 0.25 && state.position.allFinite() && state.velocity.allFinite() &&
           state.ground_normal.allFinite() && input.wish.allFinite();
}

Vec2 at_most_one(const Vec2& wish) {
    const Vec3 lifted(wish.x(), wish.y(), 0.0);
    if (!(wish.cwiseAbs().maxCoeff() > 1.0) && wish.norm() <= 1.0) return wish;
    const Vec3 unit = direction_of(lifted);
    return {unit.x(), unit.y()};
}

PlayerState state_after(const Mover& mover, const PlayerInput& input) {
    PlayerState after;
    after.position = mover.position;
    after.velocity = mover.velocity;
    after.grounded = mover.grounded;
    after.climbing = mover.climbing;
    after.stuck = mover.stuck;
    after.jump_held = input.jump;
    after.hazard = mover.hazard;
    if (mover.support_face != no_id && !mover.bounced) {
        after.ground_normal = mover.support_normal;
        after.ground_face = mover.support_face;
        after.ground_surface = mover.support_surface;
    }
    return after;
}

}  // namespace

StepResult step(const MovementScene& scene, const MovementSettings& settings, const PlayerState& state,
                const PlayerInput& input, double dt, TraceSink* trace) {
    if (!usable(settings) || !usable(state, input, dt)) return {.state = state};

    Mover mover{.scene = scene, .settings = settings, .trace = trace, .dt = dt};
    mover.walkable_cosine = slope_cosine(settings.max_slope);
    mover.wish = at_most_one(input.wish);
    mover.position = state.position;
    push_out(mover);

    const SurfaceType& support = surface_of_face(mover, state.ground_face);
    const bool held = state.stuck && support.sticky;
    const bool on_ladder = state.climbing && support.climbable;
    const bool jump_pressed = input.jump && !state.jump_held;

    if (state.grounded || held) carry(mover, support);
    if (mover.stuck) {
        mover.velocity = Vec3::Zero();
    } else if (held && !jump_pressed) {
        hold(mover, state);
    } else if (on_ladder && !jump_pressed) {
        climb(mover, state);
    } else {
        walk(mover, state, jump_pressed);
    }

    StepResult result{.state = state_after(mover, input), .sweeps = mover.sweeps, .contacts = mover.contacts};
    const bool finite = mover.position.allFinite() && mover.velocity.allFinite();
    if (!finite || ends_inside(mover, state.position)) {
        decide(mover, "never_inside", true, "moved, m",
               finite ? (mover.position - state.position).norm() : 0.0, 0.0,
               "the step would end inside geometry: stays where it was", mover.support_face);
        result.state = state;
        result.state.velocity = Vec3::Zero();
        result.state.jump_held = input.jump;
        result.state.hazard = mover.hazard;
    }
    return result;
}

}  // namespace slipface
