// A mesh's triangles as a collision world.
#pragma once

#include "slipface/collision/collision_world.h"
#include "slipface/mesh/mesh.h"

namespace slipface {

Result<CollisionWorld> build_mesh_collision(const Mesh& mesh);

}  // namespace slipface
