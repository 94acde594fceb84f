// What of a level is drawn: its mesh, its terrain as faces behind those of the mesh, and where its platforms
// are.
#pragma once

#include <vector>

#include "slipface/level/level.h"

namespace slipface {

// The level's mesh; where it has terrain, another mesh with the same faces first and the terrain's triangles
// after them, in the group "terrain".
MeshPtr shown_mesh(const Level& level);

// [face] which of level.platforms moves it, or no_id; empty if nothing moves.
std::vector<std::uint32_t> face_platforms(const Level& level);
// [platform] in the level's own coordinates.
std::vector<Pose> platform_poses(const Level& level, double time_s);

}  // namespace slipface
