// The changes that a search for cures tries.
#pragma once

#include <span>
#include <string_view>

#include "slipface/sim/cures.h"

namespace slipface {

// A number is tried at `extreme` first. If that helps, bisection finds the smallest change that still helps,
// which is then rounded to the next multiple of `step`.
struct CureCandidate {
    Cure cure;  // without results; number_cure() fills in a number's texts and settings
    std::vector<const SettingInfo*> numbers;  // settings that get the value; radius X and Z get the same one
    std::vector<std::string> with;            // further settings: the switch that a number belongs to
    bool fits = false;                        // true: a designer would try this number first
    bool asked = false;                       // the player asked for what this number allows
    double now = 0.0, extreme = 0.0, step = 0.0;  // in the units of MovementSettings
};

// The candidates for a stop with this loss; `settings` are those at the stop, and `asked` the settings that
// refused what a button asked for.
std::vector<CureCandidate> cure_candidates(const Level& level, const MovementSettings& settings,
                                           const Stop& stop, std::span<const std::string_view> asked);
// The cure that sets the candidate's numbers to `value`.
Cure number_cure(const CureCandidate& candidate, double value);

}  // namespace slipface
