// Problem: a press of jump one tick before landing is lost. Hack: the press is remembered for a short time,
// and the jump starts on landing.
#include <algorithm>

#include "mover.h"

namespace slipface {

bool wants_jump(const Mover& mover) {
    const PlayerState& state = mover.state;
    if (mover.jump_pressed) return true;
    if (!mover.settings.jump_buffer || !is_open(state.jump_buffer_s, mover.dt)) return false;
    const bool held = is_held(state) || (mover.settings.wall_jump && touches_wall(state));
    decide(mover, held ? Decision::jump_buffered : Decision::jump_remembered, {.value = state.jump_buffer_s},
           state.ground_face);
    return held;
}

double jump_buffer_after(const Mover& mover) {
    if (mover.jumped) return 0.0;
    if (!mover.settings.jump_buffer) {
        if (mover.jump_pressed) decide(mover, Decision::jump_buffer_off);
        return 0.0;
    }
    if (mover.jump_pressed) return mover.settings.jump_buffer_time;
    return std::max(0.0, mover.state.jump_buffer_s - mover.dt);
}

}  // namespace slipface
