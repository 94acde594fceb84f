// The drawn geometry of a level: its mesh, its terrain as further faces, and the poses of its platforms.
#pragma once

#include <map>
#include <span>
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
// [prop] of those that a platform moves, from these two.
std::map<std::uint32_t, Pose> prop_poses(const Level& level, std::span<const std::uint32_t> face_platforms,
                                         std::span<const Pose> platform_poses);
// Whether a prop is drawn otherwise than at rest.
bool has_animated_props(const Level& level);

}  // namespace slipface
