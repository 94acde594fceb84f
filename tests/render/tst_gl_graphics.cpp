// A World drawn through GlGraphics: the picture that LevelRenderer makes of the level, and the players in it.
#include <functional>

#include "drawing.h"
#include "slipface/level/shown_mesh.h"
#include "slipface/render/gl_graphics.h"
#include "slipface/world/geometric_manager.h"

namespace slipface {
namespace {

constexpr int width = 240, height = 160;
constexpr double aspect = 1.5;

class GlGraphicsTest : public test::DrawingTest {
  protected:
    // The courtyard, painted; its deck rides to and fro.
    static Level courtyard(const Vec3& offset = Vec3::Zero()) {
        const test::Courtyard yard = test::make_courtyard();
        auto mesh = std::make_shared<Mesh>(*yard.mesh);
        for (Vec3f& position : mesh->positions)
            position += offset.cast<float>();
        mesh->bounds.min += offset;
        mesh->bounds.max += offset;
        Level level;
        level.mesh = std::move(mesh);
        level.overrides.resize(yard.mesh->face_count());
        const std::vector<SurfaceId> surfaces = test::courtyard_surfaces(yard);
        for (const FaceId face : yard.painted)
            level.overrides[face] = surfaces[face];
        level.spawn = offset + Vec3(0, 1, 7);
        return level;
    }
    static Level riding_courtyard() {
        Level level = courtyard();
        auto mesh = std::make_shared<Mesh>(*level.mesh);
        mesh->groups.push_back("crate");
        for (std::size_t face = 60; face < mesh->face_count(); ++face)
            mesh->face_group[face] = 1;
        level.mesh = std::move(mesh);
        level.platforms = {{.name = "crate",
                            .group = "crate",
                            .path = {{Vec3::Zero(), 1.0, 0.0}, {Vec3(0, 2, 0), 1.0, 0.0}}}};
        return level;
    }

    // As a game would do it without a World.
    static Image direct(const Level& level, const Camera& camera, const LevelStyle& style,
                        const Overlay* overlay = nullptr, double time_s = 0.0) {
        LevelRenderer renderer(gl());
        EXPECT_TRUE(renderer.set_mesh(level.mesh, {}).empty());
        renderer.set_surface_types(level.surfaces);
        renderer.set_face_surfaces(resolve_surfaces(level).surface);
        renderer.move_faces(face_platforms(level), platform_poses(level, time_s));
        return draw(renderer, camera, width, height, style, overlay);
    }

    static GeometricManager* add(World& world, Level level) {
        auto manager = GeometricManager::make(std::move(level));
        EXPECT_TRUE(manager.ok());
        return static_cast<GeometricManager*>(&world.add_manager(std::move(*manager)));
    }

    static Image frame(GlGraphics& graphics, World& world, const Camera& camera) {
        Framebuffer target(gl(), width, height);
        target.bind();
        graphics.begin_frame(camera, width, height);
        world.draw(graphics);
        const Status drawn = graphics.end_frame();
        EXPECT_TRUE(drawn.ok());
        return target.read();
    }
};

TEST_F(GlGraphicsTest, AWorldsLevelIsThePictureThatLevelRendererMakes) {
    World world;
    const Level& level = add(world, courtyard())->level();
    const Camera camera = *named_view("iso", level.mesh->bounds, aspect);
    GlGraphics graphics(gl());
    std::vector<Image> images;
    for (const float overlay : {0.0f, 0.55f}) {
        for (const bool wireframe : {false, true}) {
            graphics.style.overlay = overlay;
            graphics.style.wireframe = wireframe;
            images.push_back(frame(graphics, world, camera));
            EXPECT_EQ(images.back().rgba, direct(level, camera, graphics.style).rgba)
                << overlay << " " << wireframe;
        }
    }
    // The styles are seen at all: the pictures are not four times the same background.
    EXPECT_GT(test::differing_pixels(images[0], images[1]), 500U);
    EXPECT_GT(test::differing_pixels(images[0], images[2]), 500U);
    EXPECT_TRUE(graphics.take_warnings().empty());
}

TEST_F(GlGraphicsTest, ThePlayerShowsWhereItStandsAndLeavesTheRestAlone) {
    World world;
    GeometricManager& geometry = *add(world, courtyard());
    const Camera camera = *named_view("iso", geometry.level().mesh->bounds, aspect);
    GlGraphics graphics(gl());
    const Image without = frame(graphics, world, camera);

    auto& player = world.make_entity<Character>();
    player.state = geometry.player_at(geometry.level().spawn);
    const Image with = frame(graphics, world, camera);
    Overlay expected;
    expected.ellipsoid(player.position(), player.settings.radii, graphics.ellipsoid_fill,
                       graphics.ellipsoid_outline);
    EXPECT_EQ(with.rgba, direct(geometry.level(), camera, graphics.style, &expected).rgba);

    const Vec3 at = project(camera, player.position(), Vec2(width, height));
    const int x = static_cast<int>(at.x()), y = static_cast<int>(at.y());
    EXPECT_GT(test::delta(without, with, x, y), 20);
    EXPECT_GT(with.pixel(x, y)[2], with.pixel(x, y)[0]) << "the ellipsoid is blue";
    const std::size_t changed = test::differing_pixels(without, with);
    EXPECT_GT(changed, 40U);
    EXPECT_LT(changed, static_cast<std::size_t>(width * height / 20));

    player.input.wish = {-1, 0};
    for (int tick = 0; tick < 60; ++tick)
        world.tick(1.0 / 60);
    EXPECT_EQ(test::delta(without, frame(graphics, world, camera), x, y), 0) << "it has walked away";
}

TEST_F(GlGraphicsTest, PlatformsAreDrawnWhereTheyAreNow) {
    World world;
    const GeometricManager& geometry = *add(world, riding_courtyard());
    const Camera camera = *named_view("iso", geometry.level().mesh->bounds, aspect);
    GlGraphics graphics(gl());
    const Image before = frame(graphics, world, camera);
    for (int tick = 0; tick < 6; ++tick)
        world.tick(0.25);
    const Image after = frame(graphics, world, camera);
    EXPECT_GT(test::differing_pixels(before, after), 200U);
    EXPECT_EQ(after.rgba, direct(geometry.level(), camera, graphics.style, nullptr, 1.5).rgba);
}

TEST_F(GlGraphicsTest, TwoLevelsShareAFrameAndTheNearerOneCoversTheOther) {
    World both, first;
    add(both, courtyard());
    add(both, courtyard(Vec3(20, 0, 0)));
    add(first, courtyard());
    Aabb bounds = courtyard().mesh->bounds;
    bounds.add(bounds.max + Vec3(20, 0, 0));
    const Camera camera = *named_view("iso", bounds, aspect);
    GlGraphics graphics(gl());
    const Image alone = frame(graphics, first, camera);
    const Image pair = frame(graphics, both, camera);
    EXPECT_GT(test::differing_pixels(alone, pair), 2000U);

    // The same two the other way round give the same picture: depth decides, not order.
    World turned;
    add(turned, courtyard(Vec3(20, 0, 0)));
    add(turned, courtyard());
    EXPECT_LT(test::differing_pixels(pair, frame(graphics, turned, camera)), 60U);
}

TEST_F(GlGraphicsTest, ChangedTypesAreSentWhenTheGameSaysSo) {
    Level level = courtyard();
    const Camera camera = *named_view("iso", level.mesh->bounds, aspect);
    GlGraphics graphics(gl());
    const auto image = [&] {
        Framebuffer target(gl(), width, height);
        target.bind();
        graphics.begin_frame(camera, width, height);
        graphics.draw_level(level, 0.0);
        EXPECT_TRUE(graphics.end_frame().ok());
        return target.read();
    };
    const Image before = image();
    level.overrides.assign(level.overrides.size(), SurfaceId{1});
    graphics.surfaces_changed();
    const Image after = image();
    EXPECT_GT(test::differing_pixels(before, after), 3000U);
    EXPECT_EQ(after.rgba, direct(level, camera, graphics.style).rgba);
}

TEST_F(GlGraphicsTest, AWorldWithoutALevelIsBackgroundAndItsCharacters) {
    World world;
    world.make_entity<Character>();
    Camera camera;
    camera.target = Vec3::Zero();
    camera.eye = Vec3(0, 0, 5);
    GlGraphics graphics(gl());
    const Image image = frame(graphics, world, camera);
    LevelRenderer nothing(gl());
    const Image background = draw(nothing, camera, width, height, graphics.style);
    EXPECT_EQ(test::delta(image, background, 2, 2), 0);
    EXPECT_GT(test::delta(image, background, width / 2, height / 2), 20);
}

TEST_F(GlGraphicsTest, NothingIsDrawnOutsideAFrame) {
    GlGraphics graphics(gl());
    EXPECT_FALSE(graphics.end_frame().ok());
    const Level level = courtyard();
    graphics.draw_level(level, 0.0);
    graphics.draw_ellipsoid(Vec3::Zero(), Vec3::Ones());
    EXPECT_TRUE(graphics.overlay().ellipsoids.empty());
    graphics.begin_frame({}, width, height);
    Framebuffer target(gl(), width, height);
    target.bind();
    EXPECT_TRUE(graphics.end_frame().ok());
    EXPECT_FALSE(graphics.end_frame().ok()) << "one end a frame";
}

// As the same faces in the level's own mesh, also turned, scaled and mirrored.
TEST_F(GlGraphicsTest, AMeshIsDrawnWhereItIsPlaced) {
    Level level = courtyard();
    const MeshPtr mesh = level.mesh;
    LevelStyle style;
    style.overlay = 0.0f;
    style.wireframe = false;
    Camera camera;
    camera.eye = Vec3(9, 14, 18);
    Level merged = level;
    merged.placed.meshes = {{"yard.obj", mesh, nullptr, ""}};
    GlGraphics graphics(gl());
    graphics.style = style;
    Framebuffer target(gl(), width, height);
    const auto picture = [&](const std::function<void()>& draw_all) {
        target.bind();
        graphics.begin_frame(camera, width, height);
        draw_all();
        EXPECT_TRUE(graphics.end_frame().ok());
        return target.read();
    };
    for (const Vec3& scale : {Vec3(0.4, 0.5, 0.3), Vec3(-0.4, 0.5, 0.3)}) {
        Prop prop;
        prop.name = "yard";
        prop.mesh = "yard.obj";
        prop.position = Vec3(1, 3, 2);
        prop.rotation = Vec3(0.3, 0.8, -0.2);
        prop.scale = scale;
        merged.props = {prop};
        ASSERT_TRUE(place_props(merged).empty());
        const Image alone = picture([&] { graphics.draw_level(level, 0.0); });
        const Image placed = picture([&] {
            graphics.draw_level(level, 0.0);
            graphics.draw_mesh(mesh, prop.placement(), {});
        });
        const Image flat = picture([&] { graphics.draw_level(merged, 0.0); });
        int seen = 0, other = 0;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                seen += test::delta(alone, placed, x, y) > 8;
                other += test::delta(flat, placed, x, y) > 8;
            }
        }
        EXPECT_GT(seen, 1000);
        EXPECT_LT(other, seen / 50);
    }
}

TEST_F(GlGraphicsTest, TexturesThatAreNotThereAreReportedOnce) {
    const test::Courtyard yard = test::make_courtyard("gone.png");
    Level level;
    level.mesh = yard.mesh;
    level.mesh_path = "/nowhere/yard.obj";
    level.overrides.resize(yard.mesh->face_count());
    World world;
    add(world, std::move(level));
    GlGraphics graphics(gl());
    (void)frame(graphics, world, {});
    const Warnings warnings = graphics.take_warnings();
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_NE(warnings[0].text().find("gone.png"), std::string::npos);
    (void)frame(graphics, world, {});
    EXPECT_TRUE(graphics.take_warnings().empty());
}

}  // namespace
}  // namespace slipface
