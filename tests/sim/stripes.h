// A flat floor of four stripes, 20 m long in X and 10 m wide in Z:
//   z in (0, 10): default, (10, 20): ice, (20, 30): hazard, (30, 40): sticky. Spawn centres are given in each
//   test.
#pragma once

#include <gtest/gtest.h>

#include "slipface/sim/simulate.h"

namespace slipface::test {

struct Stripes {
    Stripes() {
        std::vector<Vec3f> positions;
        std::vector<std::array<std::uint32_t, 3>> triangles;
        std::vector<FaceId> faces;
        for (FaceId face = 0; face < 4; ++face) {
            const float z = 10.0f * static_cast<float>(face);
            const auto first = static_cast<std::uint32_t>(positions.size());
            for (const Vec3f& corner :
                 {Vec3f(-10, 0, z), Vec3f(-10, 0, z + 10), Vec3f(10, 0, z + 10), Vec3f(10, 0, z)}) {
                positions.push_back(corner);
            }
            triangles.push_back({first, first + 1, first + 2});
            triangles.push_back({first, first + 2, first + 3});
            faces.insert(faces.end(), {face, face});
        }
        Result<CollisionWorld> built = CollisionWorld::build({positions, triangles, faces});
        EXPECT_TRUE(built.ok());
        world = std::move(*built);
        apply_surface_rules(world, surfaces);
        const auto id = [&](const char* name) {
            for (std::size_t i = 0; i < surfaces.size(); ++i) {
                if (surfaces[i].name == name) return static_cast<SurfaceId>(i);
            }
            ADD_FAILURE() << name;
            return default_surface;
        };
        world.set_face_surface(1, id("ice"));
        world.set_face_surface(2, id("hazard"));
        world.set_face_surface(3, id("sticky"));
    }

    MovementScene scene() const { return {world, surfaces}; }

    std::vector<SurfaceType> surfaces = preset_surface_types();
    CollisionWorld world;
};

inline Tape tape_of(std::initializer_list<TapeSegment> segments) {
    Tape tape;
    tape.segments = segments;
    return tape;
}

}  // namespace slipface::test
