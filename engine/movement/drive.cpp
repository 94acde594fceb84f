// What moves the player: a sticky surface holds it, a ladder is climbed, or its own velocity does, after
// jump, acceleration and gravity.
//
// The displacement is the mean of the velocities before and after the step's acceleration times dt. For
// constant acceleration that is exact, so jumps are as high at 30 Hz as at 360.
#include "mover.h"

namespace slipface {

namespace {

// Gravity; of a player who slides on a surface only what pulls along it. What presses onto it is no speed to
// be lost or kept at the contact.
void fall(Mover& mover, const Vec3& surface_normal, double seconds) {
    const Vec3 pull = slide_along(Vec3(0.0, -mover.settings.gravity, 0.0), surface_normal);
    mover.velocity += pull * seconds;
    const double fastest = mover.settings.terminal_speed;
    const double falls = -(mover.velocity.y() + mover.frame.y());  // in the level
    if (!(falls > fastest)) return;
    decide(mover, Decision::fell_at_terminal_speed, {.value = falls, .limit = fastest});
    mover.velocity.y() = -fastest - mover.frame.y();
}

Drive drive_freely(Mover& mover, bool jumps) {
    const PlayerState& state = mover.state;
    const MovementSettings& settings = mover.settings;
    const SurfaceType& support = support_of(mover);
    const bool touching = state.ground_face != no_id;
    const bool slippery = touching && support.keeps_energy;
    Drive drive{.kind = Drive::Kind::walk,
                .split = settings.static_friction && !slippery,
                .glides = touching && !jumps};

    mover.was_grounded = state.grounded && !jumps;
    if (!jumps) {
        mover.velocity = state.velocity;
        // The downward press is not a motion: what the player does have is the descent along the slope.
        if (state.grounded && drive.split)
            mover.velocity.y() =
                settings.ground_velocity ? -descent(state.ground_normal, mover.velocity) : 0.0;
        cut_jump(mover);
    }
    dash(mover, jumps);
    const bool dashes = mover.dashed > 0.0;
    const double dash_s = mover.dashed * mover.dt;
    mover.velocity_before = mover.velocity;
    if (mover.was_grounded || slippery) drive.friction = friction_of(support);
    const double spare = dashes ? 0.0 : accelerate(mover, drive.friction, slippery);
    drive.driven = mover.velocity;
    if (mover.was_grounded && drive.split && !dashes) pull_down_slope(mover, drive.friction, spare);
    if (dashes) end_dash(mover);
    const Vec3 free = mover.velocity;  // when the dash is over, if it ends
    fall(mover, !drive.split && drive.glides ? state.ground_normal : Vec3(Vec3::Zero()),
         dashes && !mover.was_grounded ? mover.dt - dash_s : mover.dt);
    if (!mover.was_grounded && !jumps) slide_down_wall(mover);
    if (!mover.was_grounded) glide(mover);
    drive.move =
        dashes ? Vec3(dash_s * mover.velocity_before + 0.5 * (mover.dt - dash_s) * (free + mover.velocity))
               : Vec3(0.5 * mover.dt * (mover.velocity_before + mover.velocity));
    if (std::optional<Drive> hangs = grab_ledge(mover, drive.move)) return *hangs;
    return drive;
}

}  // namespace

Drive choose_drive(Mover& mover) {
    const PlayerState& state = mover.state;
    const SurfaceType& support = support_of(mover);
    const bool held = state.stuck && sticks(mover, support);
    const bool on_ladder = state.climbing && support.climbable;
    bool jump = wants_jump(mover);
    mover.air_frame = state.air_frame;
    drop_through(mover);
    if (mover.dash_pressed && mover.settings.dash && is_held(state) && !state.grounded)
        decide(mover, Decision::dash_held_back, state.ground_face);
    // The surface that carries the player may have carried it into a sticky one.
    if (mover.stuck) {
        mover.velocity = Vec3::Zero();
        return {};
    }
    if (state.hanging)
        if (std::optional<Drive> hangs = hang_on(mover, jump)) return *hangs;
    if (held && !jump) {
        hold(mover);
        return {};
    }
    if (on_ladder && !jump) return {.kind = Drive::Kind::climb};
    return drive_freely(mover, jump && start_jump(mover));
}

}  // namespace slipface
