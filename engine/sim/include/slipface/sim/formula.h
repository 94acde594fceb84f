// The numbers of a hack's formula in one tick: what the cards of the hacks show.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "slipface/sim/story.h"

namespace slipface {

// A symbol of a formula, "N.V", and what it is in a tick, "-3.21 m/s".
struct FormulaNumber {
    std::string symbol, text;
};

// V and its dash, before and after the response, in m/s where the velocity changed, else the displacement in
// m; N, the normal of the contact that decided, or that there was none, and N.V; then the other symbols of
// the formula: E, the position, and settings. The formula of a setting that is no hack is about the last
// response of the tick. Empty: the hack did not act in the tick, or nothing responded.
std::vector<FormulaNumber> formula_numbers(const FormulaInfo& formula, const TickTrace& trace,
                                           const StoryNames& names);

// The tick that shows a hack best: of those in which it acted (for a setting that is no hack, in which
// something responded) the one whose end is furthest from what it would be under `off` with `off_step`, of
// equal ones the first. Nothing: there is none.
std::optional<TickTrace> telling_tick(const TapeRun& run, const TickScene& scene, std::string_view hack,
                                      const MovementSettings& off, StepFunction off_step = step);

}  // namespace slipface
