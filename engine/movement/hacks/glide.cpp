// Problem: a long fall can neither be slowed nor steered far. Hack: with jump held a fall has a speed, seen
// from the ground that was left.
#include <algorithm>

#include "mover.h"

namespace slipface {

void glide(Mover& mover) {
    const double fastest = mover.settings.glide_speed, falls = mover.air_frame.y() - mover.velocity.y();
    if (!mover.jump_held || !(falls > fastest)) return;
    const bool acts = mover.settings.glide;
    // Off, it is news once in a fall.
    if (acts || mover.air_frame.y() - mover.velocity_before.y() <= fastest)
        decide(mover, acts ? Decision::glided : Decision::glide_off, {.value = falls, .limit = fastest});
    if (!acts) return;
    mover.velocity.y() = mover.air_frame.y() - fastest;
    mover.velocity_before.y() = std::max(mover.velocity_before.y(), mover.velocity.y());
}

}  // namespace slipface
