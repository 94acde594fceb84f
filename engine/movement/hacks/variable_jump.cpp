// Problem: every jump is as high as the highest. Hack: letting the button go while rising keeps only a
// fraction of the upward speed; the height left is its square.
#include "mover.h"

namespace slipface {

void cut_jump(Mover& mover) {
    if (!mover.jumping) return;
    if (!(mover.velocity.y() > 0.0)) {
        mover.jumping = false;
        return;
    }
    const bool released = !mover.jump_held;
    if (!released) return;
    mover.jumping = false;
    const bool acts = mover.settings.variable_jump;
    decide(mover, acts ? Decision::jump_cut : Decision::jump_cut_off, {.value = mover.velocity.y()});
    if (acts) mover.velocity.y() *= mover.settings.jump_cut;
}

}  // namespace slipface
