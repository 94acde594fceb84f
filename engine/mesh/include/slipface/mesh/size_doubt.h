// Whether a level's size is one that a person could walk in.
#pragma once

#include <optional>
#include <string>

#include "slipface/mesh/import.h"

namespace slipface {

struct SizeDoubt {
    bool too_large = false;      // else too small
    double extent = 0.0;         // metres: the longest side of the bounds
    double better_scale = 1.0;   // metres per unit of the file, with which the size would be plausible
    double better_extent = 0.0;  // metres: the longest side with it
    std::string text() const;    // "1856 m across: too large for a player; a scale of 0.03125 makes it 58 m"
};

// Doubts a mesh that is less than 2 m across (nobody of 1.8 m can walk in it), more than 4 km (minutes of
// running; single precision then resolves less than a millimetre), or more than 100 m while nine tenths of
// its edges are longer than 8 m (nothing in it is as small as a door, a stair or a crate). Of the usual
// units, the better scale is the one that brings the longest side nearest to 60 m, a small arena (OpenArena's
// maps are 46 to 775 m long). Nothing where the scale was given: the user knows.
std::optional<SizeDoubt> size_doubt(const Mesh& mesh, const ImportSummary& summary);

}  // namespace slipface
