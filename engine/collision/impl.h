// The data of a CollisionWorld.
#pragma once

#include <array>
#include <vector>

#include "simd/eigen_vec.h"
#include "simd/kernels.h"
#include "slipface/collision/collision_world.h"
#include "tree/bvh.h"

namespace slipface {

struct CollisionWorld::Impl {
    detail::Bvh bvh;
    std::vector<FaceId> faces;              // of the soup, ascending, each once; empty if they are 0, 1, 2...
    std::vector<std::uint32_t> face_index;  // [triangle] index into faces
    std::vector<SurfaceId> surfaces;        // [index into faces]
    std::array<SurfaceRule, 256> rules;     // [SurfaceId]
    bool plain = true;                      // every rule is solid and two-sided
    Aabb bounds;                            // of all positions that the triangles have had
    detail::WorldExtent extent{};

    std::size_t triangle_count() const { return face_index.size(); }
    FaceId face_of(TriangleId triangle) const {
        return faces.empty() ? face_index[triangle] : faces[face_index[triangle]];
    }
    SurfaceId surface_of(TriangleId triangle) const { return surfaces[face_index[triangle]]; }
    const SurfaceRule& rule_of(TriangleId triangle) const { return rules[surface_of(triangle)]; }
};

}  // namespace slipface
