// The last check of every step: a position inside geometry is not accepted.
//
// Every centre lies on a swept path that stops a skin short, so this does not happen in exact arithmetic; it
// is for rounding and for the last hundredth of a skin in acute corners. By induction each accepted position
// is outside, and each path between two of them was swept.
#include "mover.h"

namespace slipface {

namespace {

bool ends_inside(Mover& mover, const Vec3& from) {
    if (mover.position == from) return false;
    mover.ends_free = is_free(mover, mover.position);
    mover.end_is_free = mover.ends_free || !overlaps_scene(mover, mover.position);
    // A player who began inside may be on the way out.
    return !mover.end_is_free && !overlaps_scene(mover, from);
}

PlayerState state_after(const Mover& mover) {
    PlayerState after;
    after.position = mover.position;
    after.velocity = mover.velocity;
    after.grounded = mover.grounded;
    after.climbing = mover.climbing;
    after.stuck = mover.stuck;
    after.jump_held = mover.jump_held;
    after.hazard = mover.hazard;
    after.jumping = mover.jumping && !is_held(mover);
    after.dash_held = mover.settings.dash && mover.buttons.has(Button::dash);
    after.hanging = mover.hanging;
    after.dropping = drops_on(mover);
    after.trapped = mover.trapped;
    after.crushed = mover.crushed;
    if (is_held(mover)) {
        after.carrier = carrier_of(mover, mover.support);
    } else {
        after.carrier = Carrier::level;
        after.air_frame = mover.air_frame;
    }
    if ((mover.support.face != no_id && !mover.bounced) || mover.grounded) {
        after.ground_normal = mover.support.normal;
        after.ground_face = mover.support.face;
        after.ground_surface = mover.support.surface;
        after.ground_platform = mover.support.platform;
        after.ground_rise = mover.grounded || mover.hanging ? mover.support_rise : 0.0;
    }
    for (const Clock& clock : clocks)
        after.*clock.member = clock.after(mover);
    for (const Count& count : counts)
        after.*count.member = count.after(mover);
    return after;
}

}  // namespace

PlayerState accept(Mover& mover, const Vec3& safe, bool room_above_terrain) {
    const bool finite = mover.position.allFinite() && mover.velocity.allFinite();
    if (finite && room_above_terrain && !ends_inside(mover, safe)) return state_after(mover);
    decide(mover, Decision::never_inside, {.value = finite ? (mover.position - safe).norm() : 0.0},
           mover.support.face);
    PlayerState after = mover.state;
    after.position = safe;
    after.velocity = Vec3::Zero();
    after.air_frame += mover.frame;
    after.jump_held = mover.jump_held;
    after.dash_held = mover.settings.dash && mover.buttons.has(Button::dash);
    after.hazard = mover.hazard;
    after.trapped = mover.trapped;
    after.crushed = mover.crushed;
    return after;
}

}  // namespace slipface
