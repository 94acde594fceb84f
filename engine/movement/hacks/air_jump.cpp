// Problem: a jump that falls short cannot be saved, and its height is the same everywhere. Hack: a press in
// the air jumps again, so many times until ground, or what else the settings name, gives the jumps back.
#include <algorithm>

#include "mover.h"

namespace slipface {

JumpStart jump_in_air(Mover& mover) {
    const MovementSettings& s = mover.settings;
    if (!s.air_jump) return Refusal{Decision::air_jump_off};
    if (mover.state.air_jumps >= s.air_jumps) return Refusal{Decision::air_jumps_used};
    mover.air_jumped = true;
    decide(mover, Decision::air_jumped, {.value = s.air_jump_speed});
    // Upwards it starts anew, seen from the ground that was left.
    return Vec3(horizontal(mover.state.velocity) + Vec3(0.0, s.air_jump_speed + mover.air_frame.y(), 0.0));
}

std::uint8_t air_jumps_after(const Mover& mover) {
    const AirJumpReset reset = mover.settings.air_jump_reset;
    const bool by_hold = reset != AirJumpReset::ground && is_held(mover);
    const bool by_wall = reset == AirJumpReset::walls && mover.on_wall;
    if (mover.grounded || mover.state.grounded || mover.bounced || by_hold || by_wall) return 0;
    constexpr std::uint8_t most = 255;
    const std::uint8_t made = mover.state.air_jumps;
    return mover.air_jumped && made < most ? static_cast<std::uint8_t>(made + 1) : made;
}

}  // namespace slipface
