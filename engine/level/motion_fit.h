// Motions from points, boxes and faces that correspond.
#pragma once

#include <optional>
#include <vector>

#include "part_motion.h"

namespace slipface {

// The cube root of the change of volume.
double scale_of(const PartMotion& motion);

// True if it changes no distances.
bool is_rigid(const PartMotion& motion);

// How much a motion does: of two that explain the same, the lesser one is the likelier. `centre` and `size`
// (units) are those of what moves.
double effort(const PartMotion& motion, const Vec3& centre, double size);

// The least-squares affine motion of the columns. What is flat says nothing about the third direction: it
// becomes the new plane's normal, scaled as the plane was; `mirrored`: its opposite. None if the points do
// not say, or for `mirrored` if they are not flat.
std::optional<PartMotion> fit_affine(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to, bool mirrored);

// The least-squares turn, uniform scale and offset of the columns; `mirrored`: with a reflection.
std::optional<PartMotion> fit_similarity(Eigen::Matrix3Xd from, const Eigen::Matrix3Xd& to, bool mirrored);

// The motions that turn and mirror a box along the axes and make it another box; at most 48.
std::vector<PartMotion> box_motions(const Aabb& from, const Aabb& to);

}  // namespace slipface
