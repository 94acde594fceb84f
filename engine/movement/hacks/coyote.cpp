// Problem: a press of jump one tick after running off a ledge falls, and players swear that they pressed in
// time. Hack: for a short time after the ground was left a jump still starts.
#include <algorithm>

#include "mover.h"

namespace slipface {

bool may_jump(const Mover& mover) {
    const PlayerState& state = mover.state;
    if (state.grounded || state.climbing || state.stuck) return true;
    const bool on = mover.settings.coyote;
    const bool late = on && is_open(state.coyote_s, mover.dt);
    decide(mover,
           late ? Decision::coyote_jump
           : on ? Decision::coyote_over
                : Decision::coyote_off,
           {.value = late ? state.coyote_s : 0.0});
    return late;
}

double coyote_after(const Mover& mover) {
    const PlayerState& state = mover.state;
    if (!mover.settings.coyote || mover.jumped || mover.bounced) return 0.0;
    if (mover.grounded || mover.climbing || mover.stuck || state.grounded) return mover.settings.coyote_time;
    return std::max(0.0, state.coyote_s - mover.dt);
}

}  // namespace slipface
