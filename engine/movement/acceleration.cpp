// How the stick changes the horizontal velocity, and what a player loses when the stick is released.
#include <algorithm>
#include <cmath>

#include "mover.h"

namespace slipface {

double accelerate(Mover& mover, double friction, bool slippery) {
    const MovementSettings& settings = mover.settings;
    const bool idle = mover.wish.isZero(0.0);
    if (idle && (slippery || !mover.was_grounded)) return 0.0;
    if (!mover.was_grounded && stick_is_locked(mover)) return 0.0;
    const double acceleration = slippery             ? settings.slippery_acceleration * friction
                                : mover.was_grounded ? settings.ground_acceleration * friction
                                                     : steering_in_air(mover);
    const Vec3 stick(mover.wish.x(), 0.0, mover.wish.y()), frame = horizontal(mover.air_frame);
    const bool brakes = mover.was_grounded && !slippery;
    const Vec3 target = frame + (brakes ? Vec3(stick * settings.walk_speed)
                                        : speed_asked_for(mover, stick, horizontal(mover.velocity) - frame));
    const Vec3 missing = target - horizontal(mover.velocity);
    const double maximum = acceleration * mover.dt;
    const double length = missing.norm();
    if (brakes)
        mover.asked = {.velocity = target,
                       .change = maximum,
                       .changed = missing * (length > maximum ? maximum / length : 1.0)};
    if (length <= maximum) {
        mover.velocity.x() = target.x();
        mover.velocity.z() = target.z();
        return maximum - length;
    }
    mover.velocity += missing * (maximum / length);
    return 0.0;
}

// With the stick held the horizontal speed on the ground is the wished one, uphill and over crests too. With
// the stick released the player pays with speed for the height it gains and for the change into a descent;
// otherwise weak braking would lift it for nothing. On ground of little friction gravity along the slope
// slows a player that goes up; there the rise counts as motion, so that height is not paid for twice.
void coast(Mover& mover, const Vec3& from, const Drive& drive) {
    const Vec3 flat = horizontal(mover.velocity);
    const double down = mover.settings.ground_velocity ? descent(mover.support.normal, flat) : 0.0;
    double square = flat.squaredNorm() + down * down;
    double before = drive.driven.squaredNorm();
    if (drive.friction < 1.0) {
        const double rises = descent(mover.support.normal, -flat);
        const double rose = descent(mover.state.ground_normal, -drive.driven);
        square += (1.0 - drive.friction) * rises * rises;
        before += (1.0 - drive.friction) * rose * rose;
    }
    const double climbed = mover.position.y() - from.y();
    const double allowed = std::max(0.0, before - 2.0 * mover.settings.gravity * climbed);
    if (!(square > allowed)) return;
    const double fraction = std::sqrt(allowed / square);
    decide(mover, Decision::coasted, {.value = std::sqrt(square), .limit = std::sqrt(allowed)},
           mover.support.face);
    mover.velocity.x() *= fraction;
    mover.velocity.z() *= fraction;
}

}  // namespace slipface
