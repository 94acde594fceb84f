// What moves about an instance of a mesh that stands still: its clip, and the picture of its texture.
#pragma once

#include <string>

#include "slipface/mesh/mesh.h"
#include "slipface/mesh/rig.h"

namespace slipface {

// Of one prop or entity; the mesh is shared. Collision does not see it.
struct Animation {
    std::string clip;            // of the mesh's file; empty: at rest
    double speed = 1.0;          // times the clip's own; below 0: backwards
    double phase_s = 0.0;        // by how many seconds it is ahead of others
    Vec2 scroll = Vec2::Zero();  // the texture moves over the faces: widths and heights per second, V up
    int columns = 1, rows = 1;   // pictures in the texture, shown one after the other from the upper left on
    double pictures_per_s = 0.0;
    bool operator==(const Animation&) const = default;
    // Whether something is to be drawn otherwise than at rest.
    bool moves() const { return *this != Animation{}; }
};
inline constexpr double fastest_animation = 1000.0;  // of speed, scroll and pictures_per_s
inline constexpr int max_pictures_a_side = 64;

// `time_s` of the level. Fills `pose`; that of a mesh without clips stays empty.
void pose_at(const Mesh& mesh, const Animation& animation, double time_s, RigPose& pose);

// How texture positions are changed: u * x + z, v * y + w.
using UvChange = Eigen::Vector4f;
UvChange uv_at(const Animation& animation, double time_s);

}  // namespace slipface
