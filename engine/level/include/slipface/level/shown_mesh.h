// The drawn geometry of a level: its mesh, its terrain as further faces, and the poses of its platforms.
#pragma once

#include <vector>

#include "slipface/level/level.h"

namespace slipface {

// The level's mesh, or that without its props. If the level has terrain: another mesh, with the same faces
// first and the terrain's triangles after them, in the group "terrain".
MeshPtr shown_mesh(const Level& level, bool with_props = true);

// [face] index of its platform in level.platforms, or no_id; empty if no face moves.
std::vector<std::uint32_t> face_platforms(const Level& level);
// [platform] pose at `time_s`, in the level's own coordinates.
std::vector<Pose> platform_poses(const Level& level, double time_s);

}  // namespace slipface
