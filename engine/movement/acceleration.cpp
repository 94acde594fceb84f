// What the stick makes of the horizontal velocity, and what is lost when it is let go.
#include <algorithm>
#include <cmath>

#include "mover.h"

namespace slipface {

void accelerate(Mover& mover, bool slippery) {
    const MovementSettings& settings = mover.settings;
    const bool idle = mover.wish.isZero(0.0);
    if (idle && (slippery || !mover.was_grounded)) return;
    const double acceleration = slippery             ? settings.slippery_acceleration
                                : mover.was_grounded ? settings.ground_acceleration
                                                     : steering_in_air(mover);
    const Vec3 target = Vec3(mover.wish.x(), 0.0, mover.wish.y()) * settings.walk_speed;
    const Vec3 missing = target - horizontal(mover.velocity);
    const double maximum = acceleration * mover.dt;
    const double length = missing.norm();
    if (length <= maximum) {
        mover.velocity.x() = target.x();
        mover.velocity.z() = target.z();
    } else {
        mover.velocity += missing * (maximum / length);
    }
}

// On the ground the horizontal speed is what the stick asks for, uphill and over crests. With the stick let
// go nobody asks, and a coasting player pays for the height gained and for the turn into a descent; low
// braking would otherwise lift it for nothing.
void coast(Mover& mover, const Vec3& from, const Vec3& driven_velocity) {
    const Vec3 level = horizontal(mover.velocity);
    const double down = mover.settings.ground_velocity ? descent(mover.support_normal, level) : 0.0;
    const double square = level.squaredNorm() + down * down;
    const double climbed = mover.position.y() - from.y();
    const double allowed =
        std::max(0.0, driven_velocity.squaredNorm() - 2.0 * mover.settings.gravity * climbed);
    if (!(square > allowed)) return;
    const double fraction = std::sqrt(allowed / square);
    decide(mover, Decision::coasted, {.value = std::sqrt(square), .limit = std::sqrt(allowed)},
           mover.support_face);
    mover.velocity.x() *= fraction;
    mover.velocity.z() *= fraction;
}

}  // namespace slipface
