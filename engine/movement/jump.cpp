// What a press of jump does. When it may come late or early is in coyote.cpp and jump_buffer.cpp, what
// letting the button go does in variable_jump.cpp.
#include "mover.h"

namespace slipface {

namespace {

using Jump = JumpStart (*)(Mover&);

// In the order in which they are asked. A new jump is a file with one such function and one name here.
constexpr std::array<Jump, 3> jumps{jump_from_hold, jump_off_wall, jump_in_air};

}  // namespace

bool start_jump(Mover& mover) {
    std::array<std::optional<Refusal>, jumps.size()> refusals;
    for (std::size_t i = 0; i < jumps.size(); ++i) {
        const JumpStart start = jumps[i](mover);
        if (const Vec3* velocity = std::get_if<Vec3>(&start)) {
            mover.velocity = *velocity;
            return mover.jumped = mover.jumping = true;
        }
        if (const Refusal* refusal = std::get_if<Refusal>(&start)) refusals[i] = *refusal;
    }
    // Why none of them started is news only now.
    for (const std::optional<Refusal>& refusal : refusals)
        if (refusal) decide(mover, refusal->why, refusal->quantity);
    return false;
}

JumpStart jump_from_hold(Mover& mover) {
    if (const auto refusal = too_late_to_jump(mover)) return *refusal;
    const PlayerState& state = mover.state;
    const bool off_wall = state.climbing || state.stuck;
    decide(mover, off_wall ? Decision::jumped_off : Decision::jumped, {.value = mover.settings.jump_speed},
           state.ground_face);
    if (off_wall && !state.grounded) return Vec3(state.ground_normal * mover.settings.jump_speed);
    // During coyote time the ground that was left counts, on the ground this is 0.
    const double ground = mover.air_frame.y();
    return Vec3(horizontal(state.velocity) + Vec3(0.0, mover.settings.jump_speed + ground, 0.0));
}

}  // namespace slipface
