#include "slipface/mesh/animation.h"

#include <algorithm>
#include <cmath>

namespace slipface {
namespace {

// The part of a whole that is left, 0 to 1.
double part_of_one(double value) {
    return std::isfinite(value) ? value - std::floor(value) : 0.0;
}

}  // namespace

void pose_at(const Mesh& mesh, const Animation& animation, double time_s, RigPose& pose) {
    if (!mesh.rig) return;
    const std::uint32_t clip = animation.clip.empty() ? no_id : find_clip(*mesh.rig, animation.clip);
    pose_rig(*mesh.rig, clip, animation.speed * time_s + animation.phase_s, pose);
}

UvChange uv_at(const Animation& animation, double time_s) {
    const int columns = std::max(animation.columns, 1), rows = std::max(animation.rows, 1);
    const double count = static_cast<double>(columns) * rows;
    const double round = part_of_one((animation.phase_s + time_s) * animation.pictures_per_s / count);
    const int picture = std::min(static_cast<int>(round * count), columns * rows - 1);
    const double u = picture % columns + part_of_one(animation.scroll.x() * time_s);
    const double v = rows - 1 - picture / columns + part_of_one(animation.scroll.y() * time_s);
    return Eigen::Vector4d(1.0 / columns, 1.0 / rows, u / columns, v / rows).cast<float>();
}

}  // namespace slipface
