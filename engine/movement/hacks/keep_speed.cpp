// Problem: the stick asks for the walking speed. So in the air and on ice it brakes a player that is faster,
// even where it points ahead, and letting it go is faster than pushing it.
// Hack (Quake, Celeste): the speed that the player has in the direction of the stick stays. What it has
// across that direction is still steered away, so turning gains no speed.
#include "mover.h"

namespace slipface {

Vec3 speed_asked_for(const Mover& mover, const Vec3& stick, const Vec3& has) {
    const double asked = stick.norm() * mover.settings.walk_speed;
    const Vec3 ahead = direction_of(stick);
    const double speed = has.dot(ahead);
    if (!(speed > asked)) return ahead * asked;
    const bool acts = mover.settings.keep_speed;
    decide(mover, acts ? Decision::speed_kept : Decision::speed_braked, {.value = speed, .limit = asked});
    return ahead * (acts ? speed : asked);
}

}  // namespace slipface
