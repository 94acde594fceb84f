// A mesh's triangles as a collision world.
#pragma once

#include "slipface/collision/instances.h"
#include "slipface/mesh/mesh.h"

namespace slipface {

Result<CollisionWorld> build_mesh_collision(const Mesh& mesh, std::span<const Instance> props = {});
Result<std::shared_ptr<const CollisionMesh>> build_shared_collision(const Mesh& mesh);

}  // namespace slipface
