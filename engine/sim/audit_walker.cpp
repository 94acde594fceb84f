#include "audit_walker.h"

#include <algorithm>
#include <cmath>

#include "slipface/sim/reach.h"

namespace slipface {
namespace {

// A direction without sine or cosine, whose last bits differ between libraries.
Vec2 random_direction(WalkerRandom& random) {
    for (;;) {
        const Vec2 point(2.0 * random.unit() - 1.0, 2.0 * random.unit() - 1.0);
        const double squared = point.squaredNorm();
        if (squared > 1e-3 && squared <= 1.0) return point / std::sqrt(squared);
    }
}

}  // namespace

std::uint64_t WalkerRandom::bits() {
    state_ += 0x9e3779b97f4a7c15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
}

Walker::Walker(std::uint64_t seed, std::uint32_t number, std::uint32_t life, double dt,
               const MovementSettings& settings)
    : random_(WalkerRandom(seed ^ WalkerRandom((std::uint64_t{number} << 32) | life).bits()).bits()),
      ticks_a_second_(std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::lround(1.0 / dt)))),
      longest_pause_(jumps_in_air(settings) ? ticks_a_second_ : 4 * ticks_a_second_) {
    press_in_ = random_.below(longest_pause_);
    others_ = buttons_read(settings);
    others_.set(Button::jump, false);
}

PlayerInput Walker::next() {
    if (turn_in_ == 0) {
        const double strength = random_.below(8) == 0 ? 0.5 : 1.0;
        input_.wish = strength * random_direction(random_);
        turn_in_ = ticks_a_second_ / 2 + random_.below(ticks_a_second_ + 1);
    }
    --turn_in_;
    if (held_for_ > 0) --held_for_;
    if (press_in_ == 0) {
        held_for_ = 1 + random_.below(ticks_a_second_ / 2 + 1);
        press_in_ = held_for_ + 1 + random_.below(longest_pause_);
    }
    --press_in_;
    input_.buttons.set(Button::jump, held_for_ > 0);
    for (const ButtonInfo& info : button_table())
        if (others_.has(info.button) && random_.below(ticks_a_second_ / 2 + 1) == 0)
            input_.buttons.set(info.button, random_.below(2) == 0);
    return input_;
}

}  // namespace slipface
