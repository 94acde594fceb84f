// What a new face covers of old ones, of which only the keys are known.
#pragma once

#include <optional>
#include <span>

#include "slipface/level/level.h"

namespace slipface {

// Faces smaller than this fraction of an old one are not taken for the whole of it.
inline constexpr double small_fraction = 0.25;

// An old face that a new face may cover.
struct OldFace {
    const FaceKey* key = nullptr;
    SurfaceId type = default_surface;
    bool centre_inside = false;  // its centroid lies on the new face
};

// The type of the old faces that make up more than half of `face`'s area; nothing if there is none. The rest may
// be covered by others of `faces` or by faces without paint. A key has no outline: where a face is much larger
// than the old ones, their areas count; else points of the face count for the old face whose centroid is nearest,
// measured in the root of its area.
std::optional<SurfaceId> covered_type(const Mesh& mesh, FaceId face, std::span<const OldFace> faces);

}  // namespace slipface
