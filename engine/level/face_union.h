// Whether several faces together are an old face of which only the key is known.
#pragma once

#include <span>

#include "face_index.h"

namespace slipface {

// Distances from the old mean of corners, in the root of the old area. A tool puts a point into the middle of
// a bent face where it likes.
inline constexpr double mean_slack = 1e-3, bent_mean_slack = 0.03;

// Cutting a face at its corners or halving its edges does not change the mean of its corners.
bool has_corner_mean(const Mesh& mesh, const FaceKey& key, std::span<const FaceId> parts, double slack);

// Nor does it change the vector of its area, even if the face is bent.
bool has_area_vector(const FaceIndex& index, const FaceKey& key, std::span<const FaceId> parts);

// Parts that are all of the old face, not parts of its neighbours: they have its mean of corners or its
// centre of area.
bool has_middle(const Mesh& mesh, const FaceKey& key, std::span<const FaceId> parts);

// Whether a part is at the old face's middle, where cuts often meet: halves of the neighbours of a deleted
// tile have its middle, too, but leave it free. `normal`: of the key, unit.
bool cover_middle(const FaceIndex& index, const FaceKey& key, const Vec3& normal,
                  std::span<const FaceId> parts);

}  // namespace slipface
