// Problem: a jump cannot be corrected, and one that starts against a wall never gets over it. Hack: the stick
// steers in the air, as fast as the air acceleration allows; with the stick let go the flight goes on.
#include "mover.h"

namespace slipface {

double steering_in_air(const Mover& mover) {
    const bool acts = mover.settings.air_control;
    decide(mover, acts ? Decision::steered_in_air : Decision::air_control_off, {.value = mover.wish.norm()});
    return acts ? mover.settings.air_acceleration : 0.0;
}

}  // namespace slipface
