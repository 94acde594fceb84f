// Collision in the extensions that engines read: OMI_physics_shape and OMI_physics_body (Godot 4.3 and newer)
// and KHR_physics_rigid_bodies. Sources: github.com/omigroup/gltf-extensions (stage 1 proposals) and
// github.com/eoineoineoin/glTF_Physics (draft), as of October 2025.
#pragma once

#include <map>
#include <vector>

#include "gltf/buffer.h"
#include "slipface/movement/surface_type.h"

namespace slipface {

class GltfPhysics {
  public:
    explicit GltfPhysics(SurfaceTable surfaces) : surfaces_(surfaces) {}

    // A node without a mesh that makes the mesh of node `mesh_node` a static body of the type. It is a child
    // of that node: engines make one object of each node. Call it for solid types only.
    GltfJson collider(const std::string& name, SurfaceId surface, std::size_t mesh, std::size_t mesh_node);

    // Adds the shapes and the physics materials, one per type used, to the file.
    void append_to(GltfJson& root) const;

  private:
    SurfaceTable surfaces_;
    std::map<std::size_t, std::size_t> shape_of_mesh_;
    std::map<SurfaceId, std::size_t> material_of_type_;
    GltfJson shapes_ = GltfJson::array(), materials_ = GltfJson::array();
};

}  // namespace slipface
