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

// The numbers of all symbols in the hack's formula (formula_table()) that the tick has: V and its dash,
// before and after the response, in m/s where the velocity changed, else the displacement in m; N, the normal
// of the contact that decided; E, the position; then the settings. Empty: there is no formula, or the hack
// did not act in the tick.
std::vector<FormulaNumber> formula_numbers(std::string_view hack, const TickTrace& trace,
                                           const StoryNames& names);

// The tick that shows a hack best: the one whose end is furthest from what it would be with the hack off, of
// equal ones the first. Nothing: it never acted.
std::optional<TickTrace> telling_tick(const TapeRun& run, const TickScene& scene, std::string_view hack);

}  // namespace slipface
