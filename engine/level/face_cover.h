// What a new face covers of old ones, of which only the keys are known.
#pragma once

#include <span>
#include <vector>

#include "slipface/level/level.h"

namespace slipface {

// Faces smaller than this fraction of an old one are not taken for the whole of it.
inline constexpr double small_fraction = 0.25;

// An old face that a new face may cover.
struct OldFace {
    const FaceKey* key = nullptr;
    bool centre_inside = false;  // its centroid lies on the new face
};

// [of `faces`] how much of `face`'s area lies on each of them; the rest lies on none. A key has no outline:
// where a face is much larger than the old ones, their areas count; else points of the face count for the old
// face whose centroid is nearest, measured in the root of its area, as if it were a square.
std::vector<double> covered_areas(const Mesh& mesh, FaceId face, std::span<const OldFace> faces);

}  // namespace slipface
