// What a CollisionWorld keeps.
#pragma once

#include <array>
#include <vector>

#include "bvh.h"
#include "slipface/collision/collision_world.h"
#include "vec.h"

namespace slipface {

struct CollisionWorld::Impl {
    detail::Bvh bvh;
    std::vector<std::uint32_t> slot;        // [triangle] its place in bvh.triangles
    std::vector<FaceId> faces;              // the faces of the soup, ascending, each once
    std::vector<std::uint32_t> face_index;  // [triangle] index into faces
    std::vector<SurfaceId> surfaces;        // [index into faces]
    std::array<SurfaceRule, 256> rules;     // [SurfaceId]
    Aabb bounds;
    double reach = 0.0;  // largest coordinate

    SurfaceId surface_of(TriangleId triangle) const { return surfaces[face_index[triangle]]; }
    const SurfaceRule& rule_of(TriangleId triangle) const { return rules[surface_of(triangle)]; }
};

}  // namespace slipface
