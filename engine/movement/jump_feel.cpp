// Windows around the instant of a jump, and jumps cut short. Times are counted down in state, so they are
// exact to the tick at every rate: a window of w seconds holds for the w / dt steps after it opened.
#include <algorithm>

#include "mover.h"

namespace slipface {

namespace {

// What repeated subtraction of a step may leave of a window that has run out.
constexpr double rounding = 1e-6;

bool open(double window_s, double dt) {
    return window_s > rounding * dt;
}

}  // namespace

bool wants_jump(const Mover& mover, const PlayerState& state, bool pressed) {
    if (pressed) return true;
    if (!mover.settings.jump_buffer || !open(state.jump_buffer_s, mover.dt)) return false;
    const bool held = state.grounded || state.climbing || state.stuck;
    decide(mover, "jump_buffer", held, "left, s", state.jump_buffer_s, mover.settings.jump_buffer_time,
           held ? "jumps: pressed before landing" : "refused: still in the air, the press is remembered",
           state.ground_face);
    return held;
}

bool may_jump(const Mover& mover, const PlayerState& state) {
    if (state.grounded || state.climbing || state.stuck) return true;
    const bool late = mover.settings.coyote && open(state.coyote_s, mover.dt);
    decide(mover, "coyote", late, "left, s", state.coyote_s, mover.settings.coyote_time,
           late ? "jumps: the ground was left only just now" : "refused: nothing to jump from");
    return late;
}

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
    decide(mover, "variable_jump", acts, "up, m/s", mover.velocity.y(), mover.settings.jump_cut,
           acts ? "the button was let go: cuts the jump short" : "switched off: rises on");
    if (acts) mover.velocity.y() *= mover.settings.jump_cut;
}

double coyote_after(const Mover& mover, const PlayerState& state) {
    if (mover.jumped || mover.bounced) return 0.0;
    if (mover.grounded || mover.climbing || mover.stuck || state.grounded) return mover.settings.coyote_time;
    return std::max(0.0, state.coyote_s - mover.dt);
}

double jump_buffer_after(const Mover& mover, const PlayerState& state, bool pressed) {
    if (mover.jumped) return 0.0;
    if (pressed) return mover.settings.jump_buffer_time;
    return std::max(0.0, state.jump_buffer_s - mover.dt);
}

}  // namespace slipface
