// What a new face covers of old ones.
#pragma once

#include <span>
#include <vector>

#include "slipface/level/level.h"

namespace slipface {

// An octagon of the key's area, for an old face whose outline is not known.
std::vector<Vec3> likely_outline(const FaceKey& key);

// An old face that a new face may cover.
struct OldFace {
    std::span<const Vec3> outline;
    double distance = 0.0;  // from the new face's plane
};

// [of `faces`] how much of `face`'s area lies on each of them, seen along its normal; the rest lies on none.
// Where old faces lie on each other, and `face` is much more like one of them than like the others, that one
// counts; else the nearest do. Equally near ones (`slack`) share the area.
std::vector<double> covered_areas(const Mesh& mesh, FaceId face, std::span<const OldFace> faces,
                                  double slack);

}  // namespace slipface
