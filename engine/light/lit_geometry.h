// The level as the light rays need it: faces with their colours, charts and emission.
#pragma once

#include <vector>

#include "slipface/collision/collision_world.h"
#include "slipface/level/level.h"
#include "slipface/mesh/light_charts.h"

namespace slipface {

// One emitting face as a light source.
struct Emitter {
    Vec3 position = Vec3::Zero();  // a little in front of the face
    Vec3 normal = Vec3::Zero();
    Vec3 color = Vec3::Zero();
    double area = 0.0;  // square metres
    FaceId face = no_id;
};

struct LitGeometry {
    MeshPtr mesh;
    LevelLight light;
    Vec3 sun = Vec3::Zero();  // unit, towards the sun; zero without a sun
    bool open = true;         // false: the sky is black, and the sun shines only through windows
    CollisionWorld world;
    LightCharts charts;
    std::vector<Vec3> albedo;    // [material] linear
    std::vector<Vec3> emission;  // [material] linear; zero if it does not emit
    std::vector<bool> window;    // [material] the sun shines through it
    std::vector<Vec3> normal;    // [face] unit; zero for a face without area
    std::vector<Emitter> emitters;

    bool glows(FaceId face) const { return emission[mesh->face_material[face]].maxCoeff() > 0.0; }
    Vec3 sky(const Vec3& direction) const;
};

// Errors: those of LightBaker::make().
Result<LitGeometry> make_lit_geometry(const Level& level);

// The point nearest to `position` that is inside the border of the face and a little in front of it, so that
// no ray starts behind a neighbour.
Vec3 point_on_face(const LitGeometry& lit, FaceId face, const Vec3& position);

}  // namespace slipface
