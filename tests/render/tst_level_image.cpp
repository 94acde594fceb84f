#include "drawing.h"
#include "slipface/render/level_image.h"

namespace slipface {
namespace {

class LevelImageTest : public test::DrawingTest {
  protected:
    static Level courtyard() {
        const test::Courtyard yard = test::make_courtyard("gone.png");
        Level level;
        level.mesh = yard.mesh;
        level.mesh_path = "/nowhere/yard.obj";
        level.overrides.resize(yard.mesh->face_count());
        return level;
    }
};

TEST_F(LevelImageTest, DrawsLevelOverridesAndOverlay) {
    Level level = courtyard();
    const Camera camera = *named_view("iso", level.mesh->bounds, 1.5);
    Warnings warnings;
    const auto plain = render_level_image(*context_, level, camera, 150, 100, {}, nullptr, &warnings);
    ASSERT_TRUE(plain.ok()) << plain.error().text();
    EXPECT_EQ(plain->width, 150);
    EXPECT_EQ(plain->height, 100);
    EXPECT_EQ(warnings.size(), 1U);
    level.overrides.assign(level.overrides.size(), SurfaceId{1});
    const auto painted = render_level_image(*context_, level, camera, 150, 100, {});
    ASSERT_TRUE(painted.ok());
    EXPECT_GT(test::differing_pixels(*plain, *painted), 3000U);
    Overlay overlay;
    overlay.cross(level.mesh->bounds.centre(), 5.0, {1, 0, 0, 1}, 3.0f);
    const auto marked = render_level_image(*context_, level, camera, 150, 100, {}, &overlay);
    ASSERT_TRUE(marked.ok());
    EXPECT_GT(test::differing_pixels(*painted, *marked), 50U);
}

TEST_F(LevelImageTest, RefusesSizes) {
    const Level level = courtyard();
    for (const auto& [width, height] :
         {std::pair(0, 10), std::pair(10, -1), std::pair(max_framebuffer_side + 1, 10)}) {
        const auto image = render_level_image(*context_, level, {}, width, height, {});
        ASSERT_FALSE(image.ok());
        EXPECT_EQ(image.error().location, "picture size");
    }
}

TEST_F(LevelImageTest, LevelWithoutMeshIsBackground) {
    const auto image = render_level_image(*context_, Level{}, {}, 20, 10, {});
    ASSERT_TRUE(image.ok()) << image.error().text();
    EXPECT_EQ(image->pixel(0, 5)[0], image->pixel(19, 5)[0]);
}

}  // namespace
}  // namespace slipface
