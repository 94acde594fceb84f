// Props drawn as instances look like the same faces in the level's own mesh.
#include <glad/gl.h>

#include <random>
#include <set>

#include "drawing.h"
#include "scratch_folder.h"
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

// What a prop's materials and its texture name is read by one rule, whether props are drawn alone or as faces
// of the level, and nothing outside the level's folder is.
TEST_F(LevelPropsTest, NameTheSameTexturesAsTheirFaces) {
    const std::filesystem::path root = test::make_scratch_folder(), folder = root / "level";
    std::filesystem::create_directories(folder / "parts" / "deep");
    for (const char* file : {"secret.png", "level/a.png", "level/parts/b.png", "level/parts/deep/c.png"})
        ASSERT_TRUE(save_png(root / file, make_image(2, 2, 90, 90, 90)));
    std::mt19937 random(3);
    const std::string names[] = {"",
                                 "a.png",
                                 "b.png",
                                 "parts/b.png",
                                 "deep/c.png",
                                 "../a.png",
                                 "../../secret.png",
                                 "../secret.png",
                                 "no.png",
                                 "C:\\art\\b.png",
                                 "/tmp/art/a.png",
                                 (root / "secret.png").string(),
                                 "c.png",
                                 "art/../b.png"};
    int refused = 0;
    for (int round = 0; round < 120; ++round) {
        Mesh mesh = *test::make_courtyard().mesh;
        for (Material& material : mesh.materials)
            material.texture = names[random() % std::size(names)];
        Level level;
        level.mesh_path = folder / "yard.obj";
        level.file_path = folder / "yard.slipface.json";
        level.mesh = test::make_courtyard().mesh;
        Prop prop;
        prop.name = "part";
        prop.mesh = round % 2 == 0 ? "parts/part.obj" : "part.obj";
        prop.texture = random() % 2 == 0 ? names[random() % std::size(names)] : "";
        level.placed.meshes = {{prop.mesh, std::make_shared<const Mesh>(std::move(mesh)), nullptr, ""}};
        level.props = {prop};
        ASSERT_TRUE(place_props(level).empty());
        const auto messages = [](const Warnings& warnings) {
            std::set<std::string> all;
            for (const Diagnostic& warning : warnings)
                all.insert(warning.message);
            return all;
        };
        LevelRenderer whole(gl()), apart(gl());
        const auto as_faces = messages(whole.set_mesh(level.mesh.whole(), folder));
        ASSERT_TRUE(apart.set_mesh(own_mesh(level), folder).empty());
        const auto alone = messages(apart.set_props(level, resolve_props(level)));
        EXPECT_EQ(as_faces, alone) << prop.mesh << " " << prop.texture;
        for (const std::string& message : alone)
            refused += message.find("lies outside the level's folder: not read; drawn") != std::string::npos;
    }
    EXPECT_GT(refused, 10);
    std::filesystem::remove_all(root);
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
