// Compares two runs of one tape: the tick at which they diverge, the distance, and the effect of a switch.
#pragma once

#include "slipface/sim/run.h"

namespace slipface {

struct Divergence {
    std::size_t first = 0;  // the first tick after which the samples differ, in any bit
    double worst_m = 0.0;   // largest distance between the two centres at the same tick
    std::size_t worst_tick = 0;
    double end_m = 0.0;  // distance after the last tick that both have
};
// Compares position, velocity, ground face and flags of the samples, in the ticks that both runs have.
// Nothing: they are equal, bit for bit.
std::optional<Divergence> compare_runs(const TapeRun& a, const TapeRun& b);

// The same inputs at the same times at another tick rate. A tick that covers several of the tape's ticks has
// the direction of the first one, and jumps if any of them does.
Tape tape_at_rate(const Tape& tape, int hz);

inline constexpr std::array<int, 5> standard_rates{30, 60, 120, 240, 360};

struct RateRow {
    int hz = 0;
    TapeRun run;
    // Distances to the run at the tape's own rate, at the times at which both rates have a tick.
    double worst_m = 0.0;
    double worst_time_s = 0.0;
    double end_m = 0.0;
};
// `own` is the tape's run at its own rate, complete.
RateRow compare_rate(const TickScene& scene, const TapeRun& own, int hz);

// The effect of a switch that is changed at a tick and stays changed.
struct SwitchEffect {
    std::string setting;  // "step_up=on"
    const SettingInfo* info = nullptr;
    double further_m = 0.0;     // in the requested direction, against no change; negative: less far
    double end_speed = 0.0;     // m/s after the last of the ticks
    double speed_gained = 0.0;  // m/s, against no change
    int grounded_gained = 0;    // ticks
    double apart_m = 0.0;       // distance between the two ends
};
// The effects of switching each hack to its other value (a choice: to each other choice), from the state
// before `tick` on, for `ticks` ticks, with the tape's inputs. Effects below 1 mm and 1 cm/s that do not
// change the grounded ticks are left out. The largest gain comes first.
std::vector<SwitchEffect> switch_effects(const TickScene& scene, const TapeRun& run, std::size_t tick,
                                         std::size_t ticks);

}  // namespace slipface
