// The data of a CollisionWorld.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "simd/eigen_vec.h"
#include "simd/kernels.h"
#include "slipface/collision/instances.h"
#include "tree/bvh.h"
#include "triangle_faces.h"

namespace slipface {

// As Placement::apply(), one triangle at a time.
detail::LeafTriangle place_triangle(const detail::InstanceView& in, const detail::LeafTriangle& rest);

// An instance, for what a query reports and for its types.
struct PlacedMesh {
    std::shared_ptr<const CollisionMesh> mesh;
    FaceId first_face;
    // [face of the mesh]; instances with the same types share, and one that is alone may change its list
    std::shared_ptr<const std::vector<SurfaceId>> surfaces;
    std::array<Vec3f, 2> box;  // of the placed corners
};

std::uint64_t next_revision();

struct CollisionWorld::Impl {
    std::uint64_t revision = next_revision();
    detail::Bvh bvh;                     // of the soup
    std::vector<FaceId> faces;           // of the soup, ascending, each once; empty if they are 0, 1, 2...
    detail::TriangleFaces face_index;    // [triangle] index into faces
    std::vector<SurfaceId> surfaces;     // [index into faces]
    std::array<SurfaceRule, 256> rules;  // [SurfaceId]
    std::vector<detail::InstanceView> views;  // [instance]
    std::vector<PlacedMesh> placed;           // [instance]
    detail::Bvh boxes;                        // of the instances; see detail::WorldView
    // Of a world of build_movable(): one instance, in a box that holds it however it is turned about its
    // middle.
    detail::Bvh ball;
    double radius = 0.0;        // of all triangles around the middle of `bounds`, metres
    std::size_t triangles = 0;  // of the soup and the instances
    bool plain = true;          // every rule is solid and two-sided
    Aabb bounds;                // of all positions that the triangles have had
    detail::WorldExtent extent{};

    detail::WorldView view() const { return {bvh.view(), boxes.view(), views.data(), extent.reach}; }
    bool movable() const { return !ball.nodes.empty(); }
    bool empty() const { return triangles == 0; }
    std::size_t own_triangles() const { return face_index.size(); }
    std::size_t triangle_count() const { return triangles; }
    detail::LeafTriangle triangle(TriangleId id) const;
    FaceId face_of(TriangleId triangle) const;
    SurfaceId surface_of(TriangleId triangle) const;
    // The instance that a triangle beyond own_triangles() belongs to.
    std::size_t instance_of(TriangleId triangle) const {
        return static_cast<std::size_t>(
            std::ranges::upper_bound(views, triangle, {}, &detail::InstanceView::first) - views.begin() - 1);
    }
    const SurfaceRule& rule_of(TriangleId triangle) const { return rules[surface_of(triangle)]; }
};

struct CollisionMesh::Impl {
    CollisionWorld world;
};

inline FaceId CollisionWorld::Impl::face_of(TriangleId triangle) const {
    if (triangle < own_triangles()) return faces.empty() ? face_index[triangle] : faces[face_index[triangle]];
    const std::size_t i = instance_of(triangle);
    return placed[i].first_face + placed[i].mesh->impl().world.impl().face_index[triangle - views[i].first];
}

inline SurfaceId CollisionWorld::Impl::surface_of(TriangleId triangle) const {
    if (triangle < own_triangles()) return surfaces[face_index[triangle]];
    const std::size_t i = instance_of(triangle);
    return (*placed[i].surfaces)[placed[i].mesh->impl().world.impl().face_index[triangle - views[i].first]];
}

inline detail::LeafTriangle CollisionWorld::Impl::triangle(TriangleId id) const {
    if (id < own_triangles()) return bvh.triangle(id);
    const std::size_t i = instance_of(id);
    return place_triangle(views[i], placed[i].mesh->impl().world.impl().bvh.triangle(id - views[i].first));
}

}  // namespace slipface
