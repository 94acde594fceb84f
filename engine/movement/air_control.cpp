// Problem: a jump cannot be corrected, and one that starts against a wall never gets over it. Hack: the stick
// steers in the air, as fast as the air acceleration allows; with the stick let go the flight goes on.
#include "mover.h"

namespace slipface {

double steering_in_air(const Mover& mover) {
    const bool acts = mover.settings.air_control;
    decide(mover, "air_control", acts, "stick", mover.wish.norm(), 0.0,
           acts ? "the stick steers in the air" : "switched off: nothing steers in the air");
    return acts ? mover.settings.air_acceleration : 0.0;
}

}  // namespace slipface
