// Motions that follow from points and where they went, by least squares; and how much a motion does.
#pragma once

#include <optional>

#include "part_motion.h"

namespace slipface {

// The edge of a cube after the motion, whose edge was 1.
double scale_of(const Motion& motion);

// How much a motion of something of this size at this centre does: of two that explain the same, the lesser
// one is the likelier. 0 to about 10; a scale, a turn and a reflection count, a way hardly.
double effort(const Motion& motion, const Vec3& centre, double size);

// The 48 ways to turn and mirror a box along the axes.
const std::vector<Eigen::Matrix3d>& axis_turns();

// Columns are points. Turned, scaled alike in all directions and shifted; `mirrored`: and reflected. None
// if the points do not say.
std::optional<Motion> similarity(Eigen::Matrix3Xd from, const Eigen::Matrix3Xd& to, bool mirrored);

// Also sheared and scaled unevenly. What is flat says nothing about the third direction: it becomes the new
// plane's normal, scaled as the plane was, on its other side if `mirrored`.
std::optional<Motion> affine(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to, bool mirrored);

}  // namespace slipface
