// Two runs of one tape side by side: where they part, by how much, and what a switch would have changed.
#pragma once

#include "slipface/sim/run.h"

namespace slipface {

struct Divergence {
    std::size_t first = 0;  // the first tick after which the states differ, in any bit
    double worst_m = 0.0;   // largest distance between the two centres at the same tick
    std::size_t worst_tick = 0;
    double end_m = 0.0;  // distance after the last tick that both have
};
// Over the ticks that both have; nothing: they are the same there, bit for bit.
std::optional<Divergence> compare_runs(const TapeRun& a, const TapeRun& b);

// The same inputs at the same times at another rate. A tick that covers several of the tape's takes the first
// one's direction, and jumps if any of them does.
Tape tape_at_rate(const Tape& tape, int hz);

inline constexpr std::array<int, 5> standard_rates{30, 60, 120, 240, 360};

struct RateRow {
    int hz = 0;
    TapeRun run;
    // Against the tape at its own rate, at the times at which both rates have a tick.
    double worst_m = 0.0;
    double worst_time_s = 0.0;
    double end_m = 0.0;
};
// `own` is the tape's run at its own rate, complete.
RateRow compare_rate(const TickScene& scene, const TapeRun& own, int hz);

// What one switch would have changed, had it been thrown at tick `tick` and left so.
struct SwitchEffect {
    std::string setting;  // "step_up=on"
    const SettingInfo* info = nullptr;
    double further_m = 0.0;     // in the direction asked for, more than without the change; less is negative
    double end_speed = 0.0;     // m/s after the last of the ticks
    double speed_gained = 0.0;  // against the same without the change
    int grounded_gained = 0;    // ticks
    double apart_m = 0.0;       // between the two ends
};
// Every hack turned the other way (a choice: each other choice), from the state before `tick` on, for as many
// ticks, with the tape's own inputs. Those that change less than a millimetre
// and a centimetre a second are left out; the largest gain comes first.
std::vector<SwitchEffect> switch_effects(const TickScene& scene, const TapeRun& run, std::size_t tick,
                                         std::size_t ticks);

}  // namespace slipface
