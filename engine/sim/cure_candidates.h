// The changes that a search for cures tries, before it knows which of them help.
#pragma once

#include "slipface/sim/cures.h"

namespace slipface {

// A number is tried at `extreme` first. If that helps, the smallest change that still does is looked for by
// bisection, and put to the next multiple of `step`.
struct CureCandidate {
    Cure cure;  // without results; a number's texts and settings are made by number_cure()
    std::vector<const SettingInfo*> numbers;  // the settings that get the value: radius X and Z get the same
    std::vector<std::string> with;            // settings that go along: the switch that a number belongs to
    bool fits = false;                        // what a designer would look at first
    double now = 0.0, extreme = 0.0, step = 0.0;  // as stored
};

std::vector<CureCandidate> cure_candidates(const Level& level, const MovementSettings& settings,
                                           const Loss& loss);
Cure number_cure(const CureCandidate& candidate, double value);

}  // namespace slipface
