// Props drawn as instances look like the same faces in the level's own mesh.
#include <glad/gl.h>

#include <random>

#include "drawing.h"
#include "slipface/render/level_renderer.h"

namespace slipface {
namespace {

class LevelPropsTest : public test::DrawingTest {};

constexpr int props_wide = 320, props_high = 220;

int differing(const Image& a, const Image& b) {
    int count = 0;
    for (int y = 0; y < props_high; ++y)
        for (int x = 0; x < props_wide; ++x)
            count += test::delta(a, b, x, y) > 8;
    return count;
}

TEST_F(LevelPropsTest, LookLikeTheirFaces) {
    const test::Courtyard yard = test::make_courtyard();
    std::mt19937 random(5);
    const auto number = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
    };
    LevelRenderer whole(gl()), apart(gl());
    Camera camera;
    camera.eye = Vec3(9, 14, 18);
    for (int round = 0; round < 6; ++round) {
        SCOPED_TRACE(round);
        Level level;
        level.mesh = yard.mesh;
        level.placed.meshes = {{"yard.obj", yard.mesh, nullptr, ""}};
        for (int i = 0; i < 5; ++i) {
            Prop prop;
            prop.name = "yard " + std::to_string(i);
            prop.mesh = "yard.obj";
            prop.position = Vec3(number(-6, 6), number(1, 4), number(-6, 6));
            prop.rotation = Vec3(number(-3, 3), number(-3, 3), number(-3, 3));
            prop.scale = Vec3(number(0.1, 0.3), number(0.1, 0.3), -number(0.1, 0.3));
            if (i % 2 == 0) prop.scale.z() = 0.2;
            if (i % 3 == 0) prop.type = "ice";
            level.props.push_back(prop);
        }
        ASSERT_TRUE(place_props(level).empty());
        const std::size_t own = yard.mesh->face_count();
        level.overrides.resize(own + 3);
        level.overrides[own + 2] = SurfaceId{3};
        // The second is selected, one face of the third is hovered, the fourth is hidden.
        std::vector<std::uint8_t> highlights(level.mesh.face_count());
        std::map<std::uint32_t, std::vector<std::uint8_t>> of_props;
        for (const auto& [prop, flag] : {std::pair{1U, 2}, {2U, 1}, {3U, 4}}) {
            of_props[prop].resize(own);
            for (FaceId face = 0; face < own; ++face) {
                const auto bits = static_cast<std::uint8_t>(flag != 1 || face == 4 ? flag : 0);
                of_props[prop][face] = highlights[level.placed.first_face[prop] + face] = bits;
            }
        }
        for (LevelRenderer* renderer : {&whole, &apart})
            renderer->set_surface_types(level.surfaces);
        (void)whole.set_mesh(level.mesh, "");
        whole.set_face_surfaces(resolve_surfaces(level).surface);
        whole.set_face_highlights(highlights);
        if (round == 0) (void)apart.set_mesh(own_mesh(level), "");
        const SurfaceParts parts = resolve_parts(level);
        apart.set_face_surfaces(parts.own.surface);
        (void)apart.set_props(level, parts.props);
        LevelStyle style;
        style.wireframe = round % 2 == 1;
        const Image before = draw(apart, camera, props_wide, props_high, style);
        apart.set_prop_highlights(of_props);
        const Image a = draw(whole, camera, props_wide, props_high, style);
        const Image b = draw(apart, camera, props_wide, props_high, style);
        EXPECT_GT(differing(before, b), 100) << "the highlights";
        EXPECT_LT(differing(a, b), differing(before, b) / 10);
        // A prop that moves is elsewhere, and at rest again.
        apart.move_props({{0U, Pose{.offset = Vec3(0, 2, 0)}}});
        EXPECT_GT(differing(draw(apart, camera, props_wide, props_high, style), b), 20);
        apart.move_props({});
        EXPECT_EQ(draw(apart, camera, props_wide, props_high, style), b);
    }
}

}  // namespace
}  // namespace slipface
