// The velocity that a jump starts with. When it may start is in coyote.cpp and jump_buffer.cpp, what letting
// the button go does in variable_jump.cpp.
#include "mover.h"

namespace slipface {

Vec3 jump_velocity(const Mover& mover) {
    const PlayerState& state = mover.state;
    const bool off_wall = state.climbing || state.stuck;
    decide(mover, off_wall ? Decision::jumped_off : Decision::jumped, {.value = mover.settings.jump_speed},
           state.ground_face);
    if (off_wall && !state.grounded) return state.ground_normal * mover.settings.jump_speed;
    // During coyote time the ground that was left counts, on the ground this is 0.
    const double ground = state.air_frame.y();
    return horizontal(state.velocity) + Vec3(0.0, mover.settings.jump_speed + ground, 0.0);
}

}  // namespace slipface
