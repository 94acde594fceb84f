// The inputs of an audit's walker: a pure function of the seed, the walker, its life and the tick.
#pragma once

#include <cstdint>

#include "slipface/movement/step.h"

namespace slipface {

// Random numbers that are the same on every machine. Source: splitmix64 (Steele, Lea, Flood 2014).
class WalkerRandom {
  public:
    explicit WalkerRandom(std::uint64_t state) : state_(state) {}
    std::uint64_t bits();
    double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }  // [0, 1)
    std::uint64_t below(std::uint64_t count) { return bits() % count; }

  private:
    std::uint64_t state_;
};

// Changes its heading about once per second, jumps about every two seconds, four times as often where jumps
// start in the air, too, and sometimes walks slowly. What other buttons the settings read it holds now and
// then for up to a second.
class Walker {
  public:
    Walker(std::uint64_t seed, std::uint32_t number, std::uint32_t life, double dt,
           const MovementSettings& settings);
    PlayerInput next();

  private:
    WalkerRandom random_;
    std::uint64_t ticks_a_second_;
    std::uint64_t longest_pause_;  // ticks between two jumps
    std::uint64_t turn_in_ = 0;    // ticks to the next heading
    std::uint64_t press_in_ = 0;   // ticks to the next jump
    std::uint64_t held_for_ = 0;   // ticks that the jump stays pressed
    PlayerInput input_;
    ButtonSet others_;  // that the settings read, beside jump
};

}  // namespace slipface
