// Checks whether the size of a level is plausible for a walking person.
#pragma once

#include <optional>
#include <string>

#include "slipface/mesh/import.h"

namespace slipface {

struct SizeDoubt {
    bool too_large = false;      // else it is too small
    double extent = 0.0;         // metres: the longest side of the bounds
    double better_scale = 1.0;   // metres per unit of the file that would give a plausible size
    double better_extent = 0.0;  // metres: the longest side with better_scale
    std::string text() const;    // "1856 m across: too large for a player; a scale of 0.03125 makes it 58 m"
};

// Returns a doubt if the mesh is less than 2 m across (a person of 1.8 m cannot walk in it), more than 4 km
// (minutes of running), higher than 400 m (no tower that people built to walk in is twice as high;
// OpenArena's maps are at most a quarter of that), or more than 100 m while nine tenths of its edges are
// longer than 8 m (nothing in it is as small as a door, a stair or a crate). The better scale is the one of
// the usual units that brings the longest side nearest to 60 m, a small arena (OpenArena's maps are 46 to 775
// m long). Returns nothing if the user gave the scale.
std::optional<SizeDoubt> size_doubt(const Mesh& mesh, const ImportSummary& summary);

}  // namespace slipface
