// Checks whether a level stands upright, judged by its shape.
#pragma once

#include <optional>
#include <string>

#include "slipface/mesh/import.h"

namespace slipface {

struct UpDoubt {
    UpAxis better_up = UpAxis::z;  // of the file; never a negative axis, because ceilings look like floors
    double flat = 0.0;         // fraction of the area that is floor or ceiling (within 45 degrees of level)
    double better_flat = 0.0;  // the same with better_up
    std::string text() const;  // "with z up 61 % of the surface is floor or ceiling, instead of 21 %"
};

// Returns a doubt if the file's upward axis was guessed, and another of its axes has at least 40 % of the
// surface across it and 1.25 times as much as the others, and the level is at most 0.8 times as large along
// it: levels are mostly low, and most of their surface is floor. Of 126 upright levels (OpenArena, Nexuiz,
// TORCS, MORSE and our own) one is doubted, a tower; of the same levels lying on their back 94 are.
std::optional<UpDoubt> up_doubt(const Mesh& mesh, const ImportSummary& summary);

}  // namespace slipface
