// Many instances of few meshes: each mesh has one tree, and an instance is a placement of it.
#pragma once

#include <memory>

#include "slipface/base/placement.h"
#include "slipface/collision/collision_world.h"

namespace slipface {

// A mesh that instances share. Immutable.
class CollisionMesh {
  public:
    // `soup.faces` are 0, 1, 2, ... in ascending order; `soup.bodies` is not used. Errors: as
    // CollisionWorld::build(); other faces.
    static Result<std::shared_ptr<const CollisionMesh>> build(const TriangleSoup& soup);
    ~CollisionMesh();
    std::size_t triangle_count() const;
    std::size_t face_count() const;
    std::size_t bytes() const;

    struct Impl;
    const Impl& impl() const { return *impl_; }

  private:
    CollisionMesh();
    std::unique_ptr<Impl> impl_;
};

// Its triangles are those of the mesh with each corner placed by placement.apply(); if the placement mirrors,
// with the second and the third corner exchanged. Their numbers follow those of the soup and of the instances
// before.
struct Instance {
    std::shared_ptr<const CollisionMesh> mesh;
    Placement placement;
    FaceId first_face =
        0;  // that of the mesh's face 0; larger than all faces of the soup and the instance before
    // [face of the mesh] its type; null: default_surface. Instances may share a list.
    std::shared_ptr<const std::vector<SurfaceId>> surfaces{};
};

}  // namespace slipface
