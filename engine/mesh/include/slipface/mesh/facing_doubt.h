// Checks whether the faces of a level look the right way.
#pragma once

#include <optional>
#include <string>

#include "slipface/mesh/mesh.h"

namespace slipface {

struct FacingDoubt {
    double wrong = 0.0;        // fraction of the judged area whose faces seem to look the wrong way
    std::string text() const;  // "78 % of the surface seems to look the wrong way"
};

// Returns a doubt if more than half of the judged area seems to look the wrong way. Judged are shells, faces
// that are connected over their edges:
// - A closed shell that looks outward, as a solid does, looks the right way.
// - One that looks inward is right as a room, or as a cave within a solid. A room is higher than a player,
//   0.8 m wide in the mean (twice the volume per area), and around at least half of all
//   else: of several solids that are inside out none is around the others.
// - An open shell looks the wrong way if twice as much of its floor and ceiling looks down as up.
// One closed shell alone may be a room or a solid that is inside out; it is not doubted if it may be a room.
std::optional<FacingDoubt> facing_doubt(const Mesh& mesh);

}  // namespace slipface
