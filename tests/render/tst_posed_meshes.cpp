// Meshes with clips, drawn by the graphics card in random poses, look like the positions that the processor
// finds.
#include <glad/gl.h>

#include <random>

#include "drawing.h"
#include "slipface/mesh/import.h"
#include "slipface/render/level_renderer.h"

namespace slipface {
namespace {

class PosedMeshes : public test::DrawingTest {};

constexpr int wide = 240, high = 240;

// The mesh as it would be if the pose were its rest.
MeshPtr frozen(const Mesh& mesh, const RigPose& pose) {
    auto made = std::make_shared<Mesh>(mesh);
    made->rig = nullptr;
    made->positions.clear();
    for (std::uint32_t corner = 0; corner < mesh.corner_vertex.size(); ++corner) {
        made->positions.push_back(posed_position(*mesh.rig, pose, corner));
        made->corner_vertex[corner] = corner;
    }
    return made;
}

std::size_t changed_pixels(const Image& a, const Image& b) {
    std::size_t count = 0;
    for (int y = 0; y < high; ++y)
        for (int x = 0; x < wide; ++x)
            count += test::delta(a, b, x, y) > 16 ? 1U : 0U;
    return count;
}

TEST_F(PosedMeshes, LookLikeTheirPositions) {
    const auto figure = import_mesh(std::string(SLIPFACE_SOURCE_DIR) + "/assets/props/islander.gltf");
    ASSERT_TRUE(figure) << figure.error().text();
    const Mesh& mesh = *figure->mesh;
    ASSERT_TRUE(mesh.rig);
    LevelRenderer posed(gl()), plain(gl());
    EXPECT_TRUE(posed.set_instances(figure->mesh, "").empty());
    std::mt19937 random(3);
    const auto number = [&](double low, double up) {
        return low + (up - low) * static_cast<double>(random()) / 4294967296.0;
    };
    LevelStyle style;
    style.textured = true;
    Camera camera;
    camera.eye = Vec3(1.5, 2, -3);
    camera.target = Vec3(0, 0.9, 0);
    Framebuffer target(gl(), wide, high);
    const auto image = [&](LevelRenderer& renderer, const PosedMesh* placed) {
        target.bind();
        gl()->ClearColor(0, 0, 0, 1);
        gl()->Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        if (placed != nullptr) renderer.draw_placed(camera, wide, high, style, *placed, 10.0);
        return target.read();
    };
    const Image empty = image(posed, nullptr);
    for (int round = 0; round < 12; ++round) {
        SCOPED_TRACE(round);
        PosedMesh placed{.at = placement({number(-0.3, 0.3), 0, number(-0.3, 0.3)}, {0, number(-3, 3), 0},
                                         {1, number(0.8, 1.2), 1})};
        const Animation animation{.clip = round % 3 == 0 ? "idle" : round % 3 == 1 ? "walk" : ""};
        pose_at(mesh, animation, number(0, 5), placed.pose);
        (void)plain.set_instances(frozen(mesh, placed.pose), "");
        PosedMesh still = placed;
        still.pose = {};
        const Image a = image(posed, &placed), b = image(plain, &still);
        ASSERT_TRUE(posed.status()) << posed.status().error().text();
        EXPECT_GT(changed_pixels(a, empty), 1000U);
        EXPECT_LT(changed_pixels(a, b), changed_pixels(a, empty) / 25)
            << "edges, and the rounding of normals";
    }
}

}  // namespace
}  // namespace slipface
