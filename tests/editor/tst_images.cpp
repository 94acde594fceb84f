// What a run without a display leaves: the editor, and the level as a game draws it.
#include "app/screens.h"
#include "level_fixture.h"
#include "slipface/level/level_file.h"
#include "slipface/render/level_image.h"

namespace slipface {
namespace {

using ImagesTest = LevelFixture;

TEST_F(ImagesTest, TheLevelIsDrawnAsAGameDrawsItWithThePlayerAtItsSpawn) {
    auto opened = open();
    opened->set_spawn({Vec3(4, 1, 4), 0.0});
    ASSERT_TRUE(opened->save_as(level_file).ok());
    const Status drawn = write_images(obj, folder / "editor.png", folder / "level.png");
    ASSERT_TRUE(drawn.ok()) << drawn.error().text();
    const Result<Image> editor = load_image(folder / "editor.png");
    const Result<Image> level = load_image(folder / "level.png");
    ASSERT_TRUE(editor.ok() && level.ok());
    EXPECT_EQ(editor->width, 1440);
    ASSERT_EQ(level->width, 1280);

    // The same by the renderer's own call: the editor frames a level without cameras as ViewCamera does.
    Editor expected;
    open_level(expected, obj);
    ASSERT_TRUE(expected.document);
    fit_framed_pane(expected, 0, 1280.0 / 720.0);
    const Camera camera = expected.view.camera();
    const Level& opened_level = expected.document->level();
    auto context = make_offscreen_context();
    ASSERT_TRUE(context.ok());
    const auto empty = render_level_image(**context, opened_level, camera, 1280, 720, expected.style);
    ASSERT_TRUE(empty.ok());
    const Vec3 player = project(camera, opened_level.spawn, Vec2(1280, 720));
    std::size_t different = 0, far_from_player = 0;
    for (int y = 0; y < 720; ++y) {
        for (int x = 0; x < 1280; ++x) {
            if (std::equal(level->pixel(x, y), level->pixel(x, y) + 4, empty->pixel(x, y))) continue;
            ++different;
            if ((Vec2(x, y) - player.head<2>()).norm() > 150.0) ++far_from_player;
        }
    }
    EXPECT_GT(different, 500u) << "the player shows";
    EXPECT_EQ(far_from_player, 0u) << "and nothing else is different";
}

}  // namespace
}  // namespace slipface
