#include <glad/gl.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "drawing.h"
#include "slipface/render/level_renderer.h"

namespace slipface {
namespace {

using test::delta;
using test::MeshBuilder;

class LevelRendererTest : public test::DrawingTest {};

// Four tiles of 4 x 4 m about the origin, seen from above at 20 pixels a metre: tile i covers 80 x 80 pixels.
MeshPtr four_tiles(const std::string& texture = "") {
    MeshBuilder builder;
    builder.material("tile", {0.5f, 0.5f, 0.5f}, texture);
    for (int i = 0; i < 4; ++i) {
        const double x = i % 2 == 0 ? -4.0 : 0.0, z = i < 2 ? -4.0 : 0.0;
        builder.face({{x, 0, z + 4}, {x + 4, 0, z + 4}, {x + 4, 0, z}, {x, 0, z}});
    }
    return builder.build();
}

constexpr int side = 200;
const Camera tile_camera = test::map_camera(5.0);

// The pixel rectangle of tile i: 20 + 80 * column .. , grown by `margin`.
bool in_tile(int tile, int x, int y, int margin) {
    const int left = 20 + 80 * (tile % 2), top = 20 + 80 * (tile / 2);
    return x >= left - margin && x < left + 80 + margin && y >= top - margin && y < top + 80 + margin;
}

TEST_F(LevelRendererTest, SameBytesTwice) {
    const test::Courtyard yard = test::make_courtyard();
    Image images[2];
    for (Image& image : images) {
        LevelRenderer renderer(gl());
        ASSERT_TRUE(renderer.status().ok());
        renderer.set_mesh(yard.mesh, "");
        renderer.set_surface_types(preset_surface_types());
        renderer.set_face_surfaces(test::courtyard_surfaces(yard));
        LevelStyle style;
        style.wireframe = true;
        image = draw(renderer, *named_view("iso", yard.mesh->bounds, 1.5), 300, 200, style);
        EXPECT_EQ(draw(renderer, *named_view("iso", yard.mesh->bounds, 1.5), 300, 200, style), image);
    }
    EXPECT_EQ(images[0], images[1]);
}

TEST_F(LevelRendererTest, WithoutMeshOnlyTheGradient) {
    LevelRenderer renderer(gl());
    const Image image = draw(renderer, tile_camera, side, side, {});
    EXPECT_EQ(image.pixel(0, 0)[0], image.pixel(side - 1, 0)[0]);
    EXPECT_NEAR(image.pixel(50, 0)[2], 0.21 * 255, 2);
    EXPECT_NEAR(image.pixel(50, side - 1)[2], 0.12 * 255, 2);
}

// Painting face 2 changes every pixel well inside it and none outside of it.
TEST_F(LevelRendererTest, PaintChangesExactlyTheFace) {
    LevelRenderer renderer(gl());
    renderer.set_mesh(four_tiles(), "");
    renderer.set_surface_types(preset_surface_types());
    const Image before = draw(renderer, tile_camera, side, side, {});
    const std::vector<SurfaceId> surfaces{0, 0, 7, 0};
    renderer.set_face_surfaces(surfaces);
    const Image after = draw(renderer, tile_camera, side, side, {});
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            if (in_tile(2, x, y, -1)) {
                EXPECT_GT(delta(before, after, x, y), 8) << x << "," << y;
            } else if (!in_tile(2, x, y, 1)) {
                EXPECT_EQ(delta(before, after, x, y), 0) << x << "," << y;
            }
        }
    }
}

// Hovering and selecting reach as far as their outline, 2.2 pixels wide, plus a pixel of softness.
TEST_F(LevelRendererTest, HighlightChangesExactlyTheFace) {
    for (const auto highlight : {std::uint8_t{1}, std::uint8_t{2}, std::uint8_t{3}}) {
        LevelRenderer renderer(gl());
        renderer.set_mesh(four_tiles(), "");
        const Image before = draw(renderer, tile_camera, side, side, {});
        const std::vector<std::uint8_t> highlights{0, highlight, 0, 0};
        renderer.set_face_highlights(highlights);
        const Image after = draw(renderer, tile_camera, side, side, {});
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                if (in_tile(1, x, y, -1)) {
                    EXPECT_GT(delta(before, after, x, y), 4) << x << "," << y;
                } else if (!in_tile(1, x, y, 3)) {
                    EXPECT_EQ(delta(before, after, x, y), 0) << x << "," << y;
                }
            }
        }
        renderer.set_face_highlights(std::vector<std::uint8_t>(4, 0));
        EXPECT_EQ(draw(renderer, tile_camera, side, side, {}), before);
    }
}

// The outline of two selected neighbours goes round both: the edge between them (column 100) looks like the
// inside.
TEST_F(LevelRendererTest, SelectedNeighboursShareOneOutline) {
    LevelRenderer renderer(gl());
    renderer.set_mesh(four_tiles(), "");
    renderer.set_face_highlights(std::vector<std::uint8_t>{2, 2, 0, 0});
    LevelStyle style;
    style.textured = false;
    const Image both = draw(renderer, tile_camera, side, side, style);
    EXPECT_LT(std::abs(both.pixel(100, 50)[0] - both.pixel(96, 50)[0]), 40);
    renderer.set_face_highlights(std::vector<std::uint8_t>{2, 0, 0, 0});
    const Image one = draw(renderer, tile_camera, side, side, style);
    EXPECT_NE(both.pixel(101, 50)[2], one.pixel(101, 50)[2]);
}

TEST_F(LevelRendererTest, DefaultFacesIgnoreTheOverlay) {
    LevelRenderer renderer(gl());
    renderer.set_mesh(four_tiles(), "");
    renderer.set_surface_types(preset_surface_types());
    LevelStyle with, without;
    with.overlay = 1.0f;
    without.overlay = 0.0f;
    const Image plain = draw(renderer, tile_camera, side, side, without);
    EXPECT_EQ(draw(renderer, tile_camera, side, side, with), plain);
    renderer.set_face_surfaces(std::vector<SurfaceId>{1, 1, 1, 1});
    EXPECT_EQ(draw(renderer, tile_camera, side, side, without), plain);
    EXPECT_NE(draw(renderer, tile_camera, side, side, with), plain);
}

// The hatches differ without colour: eight types of one colour on one face give different images.
TEST_F(LevelRendererTest, HatchesDifferWithoutColour) {
    std::vector<SurfaceType> types(9);
    for (std::size_t i = 1; i < types.size(); ++i) {
        types[i].color = {0.2f, 0.6f, 0.9f};
        types[i].hatch = static_cast<Hatch>(i - 1);
    }
    LevelRenderer renderer(gl());
    renderer.set_mesh(four_tiles(), "");
    renderer.set_surface_types(types);
    std::vector<Image> images;
    for (std::size_t i = 1; i < types.size(); ++i) {
        renderer.set_face_surfaces(std::vector<SurfaceId>(4, static_cast<SurfaceId>(i)));
        images.push_back(draw(renderer, tile_camera, side, side, {}));
        for (std::size_t j = 0; j + 1 < images.size(); ++j) {
            EXPECT_GT(test::differing_pixels(images[j], images.back()), 2000U) << i << " and " << j + 1;
        }
    }
}

// A painted face costs two bytes, an unchanged one none; two faces of one row cost the span between them.
TEST_F(LevelRendererTest, UploadsOnlyWhatChanged) {
    LevelRenderer renderer(gl());
    MeshBuilder builder;
    for (int i = 0; i < 100; ++i)
        builder.face({{1.0 * i, 0, 1}, {i + 1.0, 0, 1}, {i + 1.0, 0, 0}});
    renderer.set_mesh(builder.build(), "");
    std::vector<SurfaceId> surfaces(100, 0);
    const auto cost = [&] {
        const std::size_t before = renderer.face_state_bytes_uploaded();
        renderer.set_face_surfaces(surfaces);
        return renderer.face_state_bytes_uploaded() - before;
    };
    EXPECT_EQ(cost(), 0U);
    surfaces[70] = 3;
    EXPECT_EQ(cost(), 2U);
    EXPECT_EQ(cost(), 0U);
    surfaces[10] = surfaces[19] = 1;
    EXPECT_EQ(cost(), 20U);
}

// Faces are spread over rows of 4096 in the face-state texture: the last of 5000 is found again.
TEST_F(LevelRendererTest, ManyFacesKeepTheirState) {
    MeshBuilder builder;
    for (int i = 0; i < 4998; ++i)
        builder.face({{20, 0, 1}, {21, 0, 1}, {21, 0, 0}});
    builder.face({{-4, 0, 4}, {4, 0, 4}, {4, 0, 0}, {-4, 0, 0}});
    builder.face({{-4, 0, 0}, {4, 0, 0}, {4, 0, -4}, {-4, 0, -4}});
    LevelRenderer renderer(gl());
    renderer.set_mesh(builder.build(), "");
    renderer.set_surface_types(preset_surface_types());
    const Image before = draw(renderer, tile_camera, side, side, {});
    std::vector<SurfaceId> surfaces(5000, 0);
    surfaces[4999] = 2;
    renderer.set_face_surfaces(surfaces);
    const Image after = draw(renderer, tile_camera, side, side, {});
    EXPECT_GT(delta(before, after, 100, 60), 8);
    EXPECT_EQ(delta(before, after, 100, 140), 0);
}

TEST_F(LevelRendererTest, WrongCountsOfFacesAreHarmless) {
    LevelRenderer renderer(gl());
    renderer.set_face_surfaces(std::vector<SurfaceId>(10, 1));
    renderer.set_face_highlights(std::vector<std::uint8_t>(10, 1));
    renderer.set_mesh(four_tiles(), "");
    renderer.set_surface_types(preset_surface_types());
    const Image before = draw(renderer, tile_camera, side, side, {});
    renderer.set_face_surfaces({});
    EXPECT_EQ(draw(renderer, tile_camera, side, side, {}), before);
    renderer.set_face_surfaces(std::vector<SurfaceId>(10000, 1));
    renderer.set_face_highlights(std::vector<std::uint8_t>(10000, 2));
    EXPECT_NE(draw(renderer, tile_camera, side, side, {}), before);
    renderer.set_mesh(four_tiles(), "");
    EXPECT_EQ(draw(renderer, tile_camera, side, side, {}), before);
}

TEST_F(LevelRendererTest, BackFacesAreReddishOrGone) {
    MeshBuilder builder;
    builder.face({{-4, 0, -4}, {4, 0, -4}, {4, 0, 4}, {-4, 0, 4}});
    LevelRenderer renderer(gl());
    renderer.set_mesh(builder.build(), "");
    LevelStyle style;
    style.textured = false;
    const Image shown = draw(renderer, tile_camera, side, side, style);
    EXPECT_GT(shown.pixel(100, 100)[0], shown.pixel(100, 100)[1] + 15);
    style.back_faces = false;
    const Image culled = draw(renderer, tile_camera, side, side, style);
    LevelRenderer nothing(gl());
    EXPECT_EQ(culled, draw(nothing, tile_camera, side, side, style));
}

// Two faces back to back in one place: the one that faces the eye is seen, whichever comes first in the file.
TEST_F(LevelRendererTest, FrontWinsOverItsOwnBack) {
    const std::vector<Vec3> up{{-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4}};
    const std::vector<Vec3> down(up.rbegin(), up.rend());
    LevelStyle style;
    style.textured = false;
    for (const bool front_first : {true, false}) {
        MeshBuilder builder;
        builder.face(front_first ? up : down);
        builder.face(front_first ? down : up);
        LevelRenderer renderer(gl());
        renderer.set_mesh(builder.build(), "");
        for (const bool orthographic : {true, false}) {
            Camera camera = tile_camera;
            camera.orthographic = orthographic;
            camera.eye = {0, 8, 3};
            const Image image = draw(renderer, camera, side, side, style);
            EXPECT_LT(std::abs(image.pixel(100, 100)[0] - image.pixel(100, 100)[1]), 10);
        }
    }
}

TEST_F(LevelRendererTest, WireframeDrawsPolygonBordersOnly) {
    LevelRenderer renderer(gl());
    renderer.set_mesh(four_tiles(), "");
    LevelStyle style;
    const Image before = draw(renderer, tile_camera, side, side, style);
    style.wireframe = true;
    const Image after = draw(renderer, tile_camera, side, side, style);
    EXPECT_GT(delta(before, after, 60, 100), 20);  // between tiles 0 and 2
    EXPECT_EQ(delta(before, after, 60, 60), 0);    // on the diagonal of tile 0, between its two triangles
    EXPECT_EQ(delta(before, after, 50, 70), 0);
}

// A floor under a ceiling that is culled from above: its border across the middle is culled with it, the
// floor's stays.
TEST_F(LevelRendererTest, CulledFacesTakeTheirBordersAlong) {
    MeshBuilder builder;
    builder.face({{-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4}});
    builder.face({{-4, 3, -2}, {4, 3, -2}, {4, 3, 2}, {-4, 3, 2}});
    LevelRenderer renderer(gl());
    renderer.set_mesh(builder.build(), "");
    LevelStyle style;
    style.back_faces = false;
    const Image without = draw(renderer, tile_camera, side, side, style);
    style.wireframe = true;
    const Image with = draw(renderer, tile_camera, side, side, style);
    EXPECT_EQ(delta(without, with, 100, 60), 0);
    EXPECT_GT(delta(without, with, 100, 20), 20);
    style.back_faces = true;
    const Image ceiling = draw(renderer, tile_camera, side, side, style);
    style.wireframe = false;
    EXPECT_GT(delta(draw(renderer, tile_camera, side, side, style), ceiling, 100, 60), 10);
}

class TextureTest : public LevelRendererTest {
  protected:
    void SetUp() override {
        folder_ = std::filesystem::path(testing::TempDir()) /
                  ("slipface_textures_" + std::to_string(::getpid()) + "_" +
                   testing::UnitTest::GetInstance()->current_test_info()->name());
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path folder_;
};

// The picture's left half is red, its upper right quarter green: U goes right and V goes up.
TEST_F(TextureTest, IsDrawnTheRightWayUp) {
    Image image = make_image(64, 64, 200, 0, 0);
    for (int y = 0; y < 64; ++y) {
        for (int x = 32; x < 64; ++x) {
            image.pixel(x, y)[0] = 0;
            image.pixel(x, y)[y < 32 ? 1 : 2] = 200;
        }
    }
    ASSERT_TRUE(save_png(folder_ / "flag.png", image).ok());
    auto mesh = std::make_shared<Mesh>(*four_tiles("flag.png"));
    mesh->corner_uv[0] = {0, 0};
    mesh->corner_uv[1] = {1, 0};
    mesh->corner_uv[2] = {1, 1};
    mesh->corner_uv[3] = {0, 1};
    LevelRenderer renderer(gl());
    EXPECT_TRUE(renderer.set_mesh(mesh, folder_).empty());
    const Image shown = draw(renderer, tile_camera, side, side, {});
    EXPECT_GT(shown.pixel(30, 60)[0], 120);
    EXPECT_GT(shown.pixel(80, 30)[1], 120);
    EXPECT_GT(shown.pixel(80, 90)[2], 120);
    EXPECT_LT(shown.pixel(80, 90)[0], 60);
}

// Two files may give their pictures one name. A picture that is no image is reported and drawn as a checker.
TEST_F(TextureTest, OnesInTheMeshAreDrawn) {
    auto mesh = std::make_shared<Mesh>(*four_tiles("paint.png"));
    std::vector<Material> others(3, mesh->materials[0]);
    others[0].picture = std::make_shared<std::string>(*encode_png(make_image(4, 4, 200, 0, 0)));
    others[1].picture = std::make_shared<std::string>(*encode_png(make_image(4, 4, 0, 0, 200)));
    others[2].picture = std::make_shared<std::string>("junk");
    mesh->materials = others;
    for (FaceId face = 0; face < 4; ++face)
        mesh->face_material[face] = std::min(face, FaceId{2});
    LevelRenderer renderer(gl());
    const Warnings warnings = renderer.set_mesh(mesh, folder_);
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_NE(warnings[0].message.find("picture paint.png"), std::string::npos) << warnings[0].message;
    const Image shown = draw(renderer, tile_camera, side, side, {});
    int red = 0, blue = 0;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const std::uint8_t* pixel = shown.pixel(x, y);
            red += pixel[0] > 120 && pixel[1] < 40 && pixel[2] < 40 ? 1 : 0;
            blue += pixel[2] > 120 && pixel[1] < 40 && pixel[0] < 40 ? 1 : 0;
        }
    }
    EXPECT_GT(red, 1000);
    EXPECT_GT(blue, 1000);
}

TEST_F(TextureTest, MissingOneIsReportedAndAChecker) {
    MeshBuilder builder;
    builder.material("a", {0.5f, 0.5f, 0.5f}, "gone.png");
    builder.material("b", {0.5f, 0.5f, 0.5f}, "gone.png");
    builder.face({{-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4}});
    LevelRenderer renderer(gl());
    const Warnings warnings = renderer.set_mesh(builder.build(), folder_);
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_EQ(warnings[0].location, "material \"a\"");
    EXPECT_NE(warnings[0].message.find("gone.png"), std::string::npos);
    const Image image = draw(renderer, tile_camera, side, side, {});
    int pink = 0, dark = 0;
    for (int y = 30; y < 170; ++y) {
        for (int x = 30; x < 170; ++x) {
            pink += image.pixel(x, y)[0] > image.pixel(x, y)[1] + 60 ? 1 : 0;
            dark += image.pixel(x, y)[0] < 70 ? 1 : 0;
        }
    }
    EXPECT_GT(pink, 5000);
    EXPECT_GT(dark, 5000);
}

TEST_F(TextureTest, HostileOnesAreReported) {
    std::ofstream(folder_ / "junk.png") << "\x89PNG\r\n\x1a\n and then nothing of use";
    std::filesystem::create_directories(folder_ / "folder.png");
    MeshBuilder builder;
    for (const std::string& name :
         {std::string("junk.png"), std::string("folder.png"), std::string("..\\..\\x.png"),
          std::string("nul\0.png", 8), std::string(100000, 'x')}) {
        const auto material = builder.material("m", {0.5f, 0.5f, 0.5f}, name);
        builder.face({{-4, 0, 4}, {4, 0, 4}, {4, 0, -4}}, material);
    }
    LevelRenderer renderer(gl());
    EXPECT_EQ(renderer.set_mesh(builder.build(), folder_).size(), 5U);
}

TEST_F(TextureTest, WindowsPathsFindTheFileBesideTheLevel) {
    ASSERT_TRUE(save_png(folder_ / "wood.png", make_image(4, 4, 180, 120, 60)).ok());
    LevelRenderer renderer(gl());
    EXPECT_TRUE(renderer.set_mesh(four_tiles("C:\\Users\\me\\wood.png"), folder_).empty());
}

// Thousands of missing textures give a bounded list and one line that counts the rest.
TEST_F(TextureTest, WarningsAreBounded) {
    MeshBuilder builder;
    for (int i = 0; i < 250; ++i)
        builder.material("m", {0.5f, 0.5f, 0.5f}, "gone" + std::to_string(i) + ".png");
    builder.face({{-4, 0, 4}, {4, 0, 4}, {4, 0, -4}});
    LevelRenderer renderer(gl());
    const Warnings warnings = renderer.set_mesh(builder.build(), folder_);
    ASSERT_EQ(warnings.size(), 101U);
    EXPECT_NE(warnings.back().message.find("150 more"), std::string::npos);
}

// 2^20 m out, where single precision steps by 1/8 m, the same level (whose corners are on that raster) is the
// same picture: positions reach the GPU relative to the level, and patterns repeat every 64 m.
TEST_F(LevelRendererTest, FarFromTheOriginLooksTheSame) {
    Image images[2];
    for (int i = 0; i < 2; ++i) {
        const double x = i == 0 ? 0.0 : 1048576.0;
        MeshBuilder builder;
        builder.box({x - 2, 0, -2}, {x + 2, 2, 2});
        LevelRenderer renderer(gl());
        const MeshPtr mesh = builder.build();
        renderer.set_mesh(mesh, "");
        renderer.set_surface_types(preset_surface_types());
        renderer.set_face_surfaces(std::vector<SurfaceId>{1, 2, 3, 4, 5, 6});
        LevelStyle style;
        style.wireframe = true;
        Camera camera;
        camera.eye = {x + 4, 5, 6};
        camera.target = {x, 1, 0};
        images[i] = draw(renderer, camera, side, side, style);
    }
    const Comparison comparison = compare_images(images[0], images[1], scene_tolerance);
    EXPECT_TRUE(comparison.same) << comparison.verdict;
}

TEST_F(LevelRendererTest, LeavesNoGlError) {
    LevelRenderer renderer(gl());
    renderer.set_mesh(four_tiles(), "");
    renderer.set_mesh(nullptr, "");
    draw(renderer, tile_camera, 1, 1, {});
    renderer.draw(tile_camera, 0, 0, {});
    EXPECT_EQ(gl()->GetError(), static_cast<GLenum>(GL_NO_ERROR));
}

}  // namespace
}  // namespace slipface
