// Inputs as a search draws, stores and writes them: one of 64 directions, one of three strengths, so many
// ticks.
#pragma once

#include <cstdint>

#include "slipface/sim/tape.h"

namespace slipface {

inline constexpr std::uint32_t press_directions = 64;

// The same input for `ticks` ticks. The stick is a strength (0 rest, 1 full, 2 half, 3 a quarter) times 64
// plus a direction: 0 is +X, 16 is +Z.
struct Press {
    std::uint16_t ticks = 0;
    std::uint8_t stick = 0;
    std::uint8_t buttons = 0;  // ButtonSet::bits: those of button_table()
    friend bool operator==(const Press&, const Press&) = default;
};

inline constexpr std::uint8_t stick_at_rest = 0;
inline std::uint8_t full_stick(std::uint32_t direction) {
    return static_cast<std::uint8_t>(press_directions + direction % press_directions);
}

// Unit vector of a direction, by square roots alone: the same bits everywhere.
Vec2 direction_vector(std::uint32_t direction);
// The full stick in the direction nearest to `way`.
std::uint8_t stick_towards(const Vec2& way);
PlayerInput input_of(const Press& press);

}  // namespace slipface
