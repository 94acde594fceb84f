// Walking, falling and jumping: everything but ladders and sticky surfaces.
//
// The displacement is the mean of the velocities before and after the step's acceleration times dt. For
// constant acceleration that is exact, so jumps are as high at 30 Hz as at 360.
#include <algorithm>
#include <cmath>

#include "mover.h"

namespace slipface {

namespace {

// With constant speed on slopes: what of a move that leads down the ground stood on is made across the map,
// so that the length along the slope is the move's. Uphill straight_ahead.cpp sees to it.
double fraction_on_slope(const Mover& mover, const PlayerState& state, const Vec3& level) {
    if (!mover.was_grounded || !(descent(state.ground_normal, level) > 0.0)) return 1.0;
    const bool acts = mover.settings.constant_slope_speed;
    const double down = descent(state.ground_normal, level);
    const double along = std::sqrt(level.squaredNorm() + down * down);
    if (acts) {
        decide(mover, Decision::slope_speed_kept, {.value = level.norm()}, state.ground_face);
    } else {
        decide(mover, Decision::slope_speed_off, {.value = along, .limit = level.norm()}, state.ground_face);
    }
    return acts ? level.norm() / along : 1.0;
}

// The horizontal part slides; the vertical part decides whether the player is grounded.
void move_split(Mover& mover, const PlayerState& state, const Vec3& move) {
    const Vec3 level = horizontal(move) * fraction_on_slope(mover, state, horizontal(move));
    const double rise = mover.was_grounded ? -press_down(mover, state.ground_normal, move) : move.y();
    const Motion before = mover;
    const MovementSettings& s = mover.settings;
    if (s.step_up && s.step_form == StepForm::every_move && mover.was_grounded && !level.isZero(0.0)) {
        if (step_every_move(mover, before, level)) return;
        if (!level.isZero(0.0)) collide_and_slide(mover, Pass::horizontal, level);
    } else {
        if (!level.isZero(0.0)) collide_and_slide(mover, Pass::horizontal, level);
        if (!mover.stuck && !mover.climbing && mover.wall_count > 0 && step_up(mover, before, level)) return;
    }
    if (mover.stuck || mover.climbing) return;

    const double height = mover.position.y();
    const int contacts = mover.contacts;
    collide_and_slide(mover, Pass::vertical, Vec3(0.0, rise, 0.0));
    if (mover.grounded || mover.stuck || mover.climbing || mover.bounced) return;
    if (mover.was_grounded) snap_down(mover, before);
    if (mover.grounded) return;
    // Two faces, each too steep to stand on, hold a player who is wedged between them; without this there
    // would be no jumping out of a ditch.
    const double dropped = height - mover.position.y();
    if (rise < 0.0 && mover.contacts - contacts >= 2 && dropped < -0.01 * rise) {
        mover.grounded = true;
        mover.support_normal = Vec3::UnitY();
        mover.velocity.y() = 0.0;
        decide(mover, Decision::wedged, {.value = dropped}, mover.support_face);
    }
}

// The whole move slides. Gravity alone may not bring a gliding player back to within reach of a sweep at
// every tick, so the surface slid along is looked for where it was.
void move_whole(Mover& mover, const PlayerState& state, const Vec3& move, bool touching) {
    const int contacts = mover.contacts;
    collide_and_slide(mover, Pass::slide, move);
    if (!touching || mover.contacts != contacts) return;
    const Swept swept = sweep_with_skin(mover, Pass::probe, 0, -state.ground_normal * mover.settings.skin);
    if (!swept.contact) return;
    // Moving off faster than gravity pulls back is leaving, not gliding.
    const double off = mover.velocity.dot(swept.contact->normal);
    const double rounding = 1e-9 * mover.velocity.norm();
    if (off > mover.settings.gravity * mover.dt + rounding) return;
    mover.position = swept.reached;
    ++mover.contacts;
    const SurfaceType& surface = surface_of(mover, swept.contact->surface);
    const Hit hit{.pass = Pass::slide,
                  .contact = *swept.contact,
                  .surface = surface,
                  .platform = swept.platform,
                  .walkable = is_walkable(mover, swept.contact->normal, surface),
                  .remainder = mover.velocity * mover.dt,
                  .done = 1.0};
    touch(mover, hit);
    if (off < -rounding) mover.velocity = respond(mover, hit).velocity;
}

// Gravity; of a player who slides on a surface only what pulls along it. What presses onto it is no speed to
// be lost or kept at the contact.
void fall(Mover& mover, const Vec3& surface_normal) {
    const Vec3 pull = slide_along(Vec3(0.0, -mover.settings.gravity, 0.0), surface_normal);
    mover.velocity += pull * mover.dt;
    const double fastest = mover.settings.terminal_speed;
    if (!(mover.velocity.y() < -fastest)) return;
    decide(mover, Decision::fell_at_terminal_speed, {.value = -mover.velocity.y(), .limit = fastest});
    mover.velocity.y() = -fastest;
}

Vec3 jump_velocity(const Mover& mover, const PlayerState& state) {
    const bool off_wall = state.climbing || state.stuck;
    decide(mover, off_wall ? Decision::jumped_off : Decision::jumped, {.value = mover.settings.jump_speed},
           state.ground_face);
    if (off_wall && !state.grounded) return state.ground_normal * mover.settings.jump_speed;
    // Who left the ground just now has its velocity already.
    const Vec3 carried = state.grounded ? carry_velocity(mover, state) : Vec3(Vec3::Zero());
    return horizontal(state.velocity) + Vec3(0.0, mover.settings.jump_speed, 0.0) + carried;
}

}  // namespace

void walk(Mover& mover, const PlayerState& state, bool wants_to_jump) {
    const MovementSettings& settings = mover.settings;
    const SurfaceType& support = support_of(mover, state);
    const bool touching = state.ground_face != no_id;
    const bool slippery = touching && support.keeps_energy;
    const bool split = settings.static_friction && !slippery;
    const bool jumps = wants_to_jump && may_jump(mover, state);
    const Vec3 from = mover.position;

    Vec3 velocity = state.velocity;
    if (jumps) {
        velocity = jump_velocity(mover, state);
        mover.jumped = true;
        mover.jumping = true;
    } else if (state.grounded && split) {
        // The downward press is not a motion: what the player does have is the descent along the slope.
        velocity.y() = settings.ground_velocity ? -descent(state.ground_normal, velocity) : 0.0;
    }
    mover.was_grounded = state.grounded && !jumps;
    mover.velocity = velocity;
    if (!jumps) cut_jump(mover);
    mover.velocity_before = mover.velocity;
    accelerate(mover, slippery);
    const Vec3 driven = mover.velocity;
    fall(mover, !split && touching && !jumps ? state.ground_normal : Vec3(Vec3::Zero()));
    const Vec3 move = 0.5 * mover.dt * (mover.velocity_before + mover.velocity);

    if (split) {
        move_split(mover, state, move);
    } else {
        decide(mover, settings.static_friction ? Decision::whole_move_on_ice : Decision::static_friction_off,
               state.ground_face);
        move_whole(mover, state, move, touching && !jumps);
    }

    if (mover.grounded && split && !surface_of(mover, mover.support_surface).keeps_energy) {
        if (mover.wish.isZero(0.0)) coast(mover, from, driven);
        set_ground_velocity(mover);
        // Rounding must not make an idle player creep.
        const bool rests = mover.was_grounded && mover.wish.isZero(0.0) &&
                           (mover.position - from).norm() <= 1e-3 * settings.skin;
        if (rests) mover.position = from;
    }
    // In the air nothing but speed pays for the height that a ramp gives.
    const bool flying = !mover.was_grounded && !mover.grounded && mover.contacts > 0;
    if (!split || flying || mover.kept_energy || mover.bounced) cap_energy(mover, from, driven);
    if (mover.was_grounded && !mover.grounded && !mover.stuck && !mover.climbing) {
        const Vec3 carried = carry_velocity(mover, state);
        if (!carried.isZero(0.0)) {
            const bool platform = state.ground_platform != no_id;
            decide(mover, platform ? Decision::platform_velocity_kept : Decision::surface_velocity_kept,
                   {.value = carried.norm()}, state.ground_face);
        }
        mover.velocity += carried;
    }
}

}  // namespace slipface
