// What light meets: the faces with their colours, charts and glow.
#pragma once

#include <vector>

#include "slipface/collision/collision_world.h"
#include "slipface/level/level.h"
#include "slipface/mesh/light_charts.h"

namespace slipface {

// One glowing face, as light falls from it.
struct Emitter {
    Vec3 position = Vec3::Zero();  // a little in front of it
    Vec3 normal = Vec3::Zero();
    Vec3 color = Vec3::Zero();
    double area = 0.0;  // square metres
    FaceId face = no_id;
};

struct LightScene {
    MeshPtr mesh;
    LevelLight light;
    Vec3 sun = Vec3::Zero();  // unit; zero without a sun
    bool open = true;         // a black sky is none: the sun comes through windows alone
    CollisionWorld world;
    LightCharts charts;
    std::vector<Vec3> albedo;    // [material] linear
    std::vector<Vec3> emission;  // [material] linear; zero for most
    std::vector<bool> window;    // [material] the sun shines through
    std::vector<Vec3> normal;    // [face] unit; zero without area
    std::vector<Emitter> emitters;

    bool glows(FaceId face) const { return emission[mesh->face_material[face]].maxCoeff() > 0.0; }
    Vec3 sky(const Vec3& direction) const;
};

Result<LightScene> make_light_scene(const Level& level);

// The point of a face, a little in front of it and inside its border, nearest to `place`: from there no ray
// starts behind a neighbour.
Vec3 point_on_face(const LightScene& scene, FaceId face, const Vec3& position);

}  // namespace slipface
