// What the doctor finds at a stop, repaired in a copy of the mesh: cures for find_cures() to try, so that
// only repairs that let the player pass are offered. Nothing here changes a level's files; the user makes the
// repair in the modelling tool.
#pragma once

#include "slipface/sim/cures.h"

namespace slipface {

// Of the findings that the stop's face or position is part of: gaps closed, flipped faces turned, low steps
// flattened. A T-junction stops nobody and makes none. Looks at the faces around the stop alone. The cures
// have a mesh and no results yet.
std::vector<Cure> repairs_at(const Level& level, const Stop& stop);

// find_cures() with these among what is tried.
std::vector<Cure> find_cures_and_repairs(
    const Level& level, const TapeRun& run, const Stop& stop,
    const std::function<bool()>& cancelled = [] { return false; });

}  // namespace slipface
