// Problem: a press of jump one tick after running off a ledge falls, and players swear that they pressed in
// time. Hack: for a short time after the ground was left a jump still starts.
#include <algorithm>

#include "mover.h"

namespace slipface {

std::optional<Refusal> too_late_to_jump(const Mover& mover) {
    const PlayerState& state = mover.state;
    if (is_held(state)) return std::nullopt;
    if (!mover.settings.coyote) return Refusal{Decision::coyote_off};
    if (!is_open(state.coyote_s, mover.dt)) return Refusal{Decision::coyote_over};
    decide(mover, Decision::coyote_jump, {.value = state.coyote_s});
    return std::nullopt;
}

double coyote_after(const Mover& mover) {
    const PlayerState& state = mover.state;
    if (!mover.settings.coyote || mover.jumped || mover.bounced) return 0.0;
    if (is_held(mover) || state.grounded) return mover.settings.coyote_time;
    return std::max(0.0, state.coyote_s - mover.dt);
}

}  // namespace slipface
