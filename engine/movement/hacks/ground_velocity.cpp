// Problem: a player whose vertical velocity is 0 on the ground runs off every downward slope, falls back, and
// hops. Hack (lecture, "Bouncing down ramps"): on the ground the vertical velocity is a small downward value
// instead.
//
// How small: running at v down a slope of angle a needs v tan a, or the ground falls away faster than the
// player. So it is the larger of ground_speed and that. Gravity during the step is added.
#include <algorithm>

#include "mover.h"

namespace slipface {

double descent(const Vec3& ground_normal, const Vec3& along) {
    // Along the plane N.x x + N.y y + N.z z = 0 a horizontal step (x, z) changes y by -(N.x x + N.z z) / N.y.
    // Ground that is stood on has N.y > 0; the bound keeps any other normal from dividing by zero.
    const double up = std::max(ground_normal.y(), 0.01);
    return std::max(0.0, horizontal(along).dot(ground_normal) / up);
}

Vec3 motion_velocity(const PlayerState& state) {
    const Vec3& velocity = state.velocity;
    if (!state.grounded) return velocity;
    const double up = std::max(state.ground_normal.y(), 0.01);
    return {velocity.x(), -horizontal(velocity).dot(state.ground_normal) / up, velocity.z()};
}

double press_down(const Mover& mover, const Vec3& ground_normal, const Vec3& move) {
    const double dt = mover.dt;
    const double fall = 0.5 * mover.settings.gravity * dt * dt;
    if (!mover.settings.ground_velocity) return std::max(0.0, -move.y());
    return std::max({-move.y(), mover.settings.ground_speed * dt, descent(ground_normal, move) + fall});
}

void set_ground_velocity(Mover& mover) {
    const double needed = descent(mover.support.normal, mover.velocity);
    const double speed = std::max(mover.settings.ground_speed, needed);
    const bool acts = mover.settings.ground_velocity;
    mover.velocity.y() = acts ? -speed : 0.0;
    if (acts) {
        decide(mover, Decision::pressed_down, {.value = speed, .limit = mover.settings.ground_speed},
               mover.support.face);
    } else {
        decide(mover, Decision::pressed_down_off, mover.support.face);
    }
}

}  // namespace slipface
