// Problem: every jump is as high as the highest. Hack: letting the button go while rising keeps only a
// fraction of the upward speed; the height left is its square.
#include "mover.h"

namespace slipface {

void cut_jump(Mover& mover) {
    if (!mover.jumping) return;
    // Relative to the ground that was left.
    const double rises = mover.velocity.y() - mover.air_frame.y();
    if (!(rises > 0.0)) {
        mover.jumping = false;
        return;
    }
    const bool released = !mover.jump_held;
    if (!released) return;
    mover.jumping = false;
    const bool acts = mover.settings.variable_jump;
    decide(mover, acts ? Decision::jump_cut : Decision::jump_cut_off, {.value = rises});
    if (acts) mover.velocity.y() -= rises * (1.0 - mover.settings.jump_cut);
}

}  // namespace slipface
