#include <random>

#include "app/parts.h"
#include "app_fixture.h"
#include "panels/viewport_panel.h"
#include "slipface/level/level_file.h"

namespace slipface {
namespace {

using AppTest = AppFixture;

std::size_t count_of(const Document& document, SurfaceId type) {
    const auto& surfaces = document.resolved().surface;
    return static_cast<std::size_t>(std::count(surfaces.begin(), surfaces.end(), type));
}

TEST_F(AppTest, OpensALevelAndDrawsItDifferentlyFromNothing) {
    host->settle();
    const Image opened = host->screenshot();
    EXPECT_EQ(opened.width, 1280);
    EXPECT_EQ(opened.height, 720);
    editor().document.reset();
    host->settle();
    const Image welcome = host->screenshot();
    EXPECT_FALSE(opened == welcome);
    EXPECT_TRUE(ui::widgets().contains("Welcome/Open"));
    EXPECT_FALSE(ui::widgets().contains("Viewport/View"));
}

TEST_F(AppTest, AToggleByPathChangesTheSettingAndUndoRestoresIt) {
    const bool before = document().level().movement.keep_energy;
    ASSERT_EQ(run("click \"Movement/Keep energy\""), "");
    EXPECT_NE(document().level().movement.keep_energy, before);
    EXPECT_TRUE(document().dirty());
    ASSERT_EQ(run("key Ctrl+Z"), "");
    EXPECT_EQ(document().level().movement.keep_energy, before);
    EXPECT_FALSE(document().dirty());
}

TEST_F(AppTest, AStrokeInTheViewPaintsEveryFaceOnItsWayAsOneStep) {
    look_down();
    choose_brush(editor(), ice);
    editor().tool = Tool::paint;
    // From the first to the last face of a row: 8 faces, though the mouse moves in only 12 jumps.
    ASSERT_EQ(run("viewport drag @0.5,0,4.5 @7.5,0,4.5"), "");
    for (FaceId i = 0; i < 8; ++i)
        EXPECT_EQ(document().resolved().surface[i * 8 + 4], ice) << i;
    EXPECT_EQ(count_of(document(), ice), 8u);
    EXPECT_EQ(document().history_cursor(), 1u);
    EXPECT_EQ(document().history()[0].name, "Paint ice");
    ASSERT_EQ(run("key Ctrl+Z"), "");
    EXPECT_EQ(count_of(document(), ice), 0u);
}

TEST_F(AppTest, OneJumpOfTheMouseLeavesNoGapInAStroke) {
    look_down();
    choose_brush(editor(), ice);
    editor().tool = Tool::paint;
    const Camera camera = shown_camera(editor());
    const ViewportState& view = viewport_state();
    const auto pixel = [&](const Vec3& point) {
        const Vec3 at =
            project(camera, point, {static_cast<double>(view.size.x), static_cast<double>(view.size.y)});
        return ImVec2{view.min.x + static_cast<float>(at.x()), view.min.y + static_cast<float>(at.y())};
    };
    host->move_mouse(pixel({0.5, 0, 2.5}));
    host->frame();
    host->mouse_button(0, true);
    host->frame();
    host->move_mouse(pixel({7.5, 0, 2.5}));
    host->frame();
    host->mouse_button(0, false);
    host->frame();
    EXPECT_EQ(count_of(document(), ice), 8u);
}

TEST_F(AppTest, EscapeTakesAStrokeBackAndTheHeldButtonPaintsNoMore) {
    look_down();
    choose_brush(editor(), ice);
    editor().tool = Tool::paint;
    ASSERT_EQ(run("viewport hover @1.5,0,1.5"), "");
    host->mouse_button(0, true);
    host->frame();
    EXPECT_EQ(count_of(document(), ice), 1u);
    host->press_key({.key = "Escape"});
    EXPECT_EQ(count_of(document(), ice), 0u);
    EXPECT_FALSE(document().in_transaction());
    const ImVec2 at = host->mouse();
    host->move_mouse({at.x + 80, at.y});
    host->frame();
    EXPECT_EQ(count_of(document(), ice), 0u);
    host->mouse_button(0, false);
    host->frame();
    EXPECT_EQ(document().history_cursor(), 0u);
}

TEST_F(AppTest, ClickSelectsCtrlClickAddsAndEmptySpaceClears) {
    look_down();
    ASSERT_EQ(run("viewport click @0.5,0,0.5\nexpect selected 1\nviewport click @2.5,0,0.5 ctrl\nexpect "
                  "selected 2\n"
                  "viewport click @2.5,0,0.5 shift\nexpect selected 1"),
              "");
    EXPECT_EQ(document().selection()[0], 0u);
    ASSERT_EQ(run("viewport click 5 5\nexpect selected 0"), "");
}

TEST_F(AppTest, AltClickPicksTheTypeAndFillStopsAtTheWall) {
    look_down();
    editor().tool = Tool::fill;
    editor().brush = ice;
    // The wall stands at a right angle, so 15 degrees fill the floor's 64 faces only.
    ASSERT_EQ(run("viewport click @3.5,0,3.5\nexpect count ice 64\nexpect count ladder 8"), "");
    editor().tool = Tool::paint;
    editor().brush = ladder;
    ASSERT_EQ(run("viewport click @3.5,0,3.5 alt\nexpect brush ice\nexpect count ice 64"), "");
}

TEST_F(AppTest, TheProbeIsPlacedDraggedAndPutBackByEscape) {
    look_down();
    ASSERT_EQ(run("command tools.probe\nviewport drag @2.5,0,4.5 @5.5,0,4.5"), "");
    ASSERT_TRUE(editor().probe.placed);
    // Pressed over the floor: the centre stands radius + skin above it. Dragged over the floor: three metres
    // level.
    const MovementSettings& movement = document().level().movement;
    EXPECT_NEAR(editor().probe.from.y(), movement.radii.y() + movement.skin, 1e-9);
    EXPECT_NEAR(editor().probe.move.x(), 3.0, 0.05);
    EXPECT_NEAR(editor().probe.move.y(), 0.0, 1e-6);
    EXPECT_TRUE(ui::widgets().contains("Probe/Clear"));

    const Vec3 move = editor().probe.move;
    const Vec3 end = editor().probe.from + move;
    ASSERT_EQ(run("viewport hover @" + std::to_string(end.x()) + "," + std::to_string(end.y()) + "," +
                  std::to_string(end.z())),
              "");
    host->mouse_button(0, true);
    host->frame();
    host->move_mouse({host->mouse().x - 60, host->mouse().y});
    host->frame();
    EXPECT_LT(editor().probe.move.x(), move.x() - 0.3);
    host->press_key({.key = "Escape"});
    EXPECT_EQ(editor().probe.move, move);
    host->mouse_button(0, false);
    host->frame();
}

TEST_F(AppTest, CameraGesturesMoveTheCameraAndNothingElse) {
    ASSERT_EQ(run("camera eye 4,6,14 target 4,0,4"), "");
    const Vec3 eye = editor().view.camera().eye;
    ASSERT_EQ(run("viewport drag 300 200 340 240 middle"), "");
    const Vec3 orbited = editor().view.camera().eye;
    EXPECT_GT((orbited - eye).norm(), 0.1);
    EXPECT_NEAR((orbited - editor().view.pivot).norm(), editor().view.distance, 1e-9);
    ASSERT_EQ(run("viewport drag 300 200 340 240 middle shift"), "");
    EXPECT_GT((editor().view.camera().eye - orbited).norm(), 0.1);
    const double distance = editor().view.distance;
    ASSERT_EQ(run("viewport hover 300 200\nwheel 2"), "");
    EXPECT_LT(editor().view.distance, distance);
    EXPECT_EQ(document().history_cursor(), 0u);
    EXPECT_TRUE(document().selection().empty());
}

TEST_F(AppTest, FlyingNeedsTheRightButtonAndIsNoShortcut) {
    look_down();
    const Vec3 eye = editor().view.camera().eye;
    host->app().context().held.forward = true;
    host->frame();
    EXPECT_EQ(editor().view.camera().eye, eye);
    ASSERT_EQ(run("viewport hover 300 200"), "");
    host->mouse_button(1, true);
    host->frame();
    host->frame();
    EXPECT_GT((editor().view.camera().eye - eye).norm(), 0.05);
    const Tool tool = editor().tool;
    host->app().key_pressed({{.key = "Q"}});
    host->app().key_pressed({{.key = "W"}});
    EXPECT_EQ(editor().tool, tool);
    host->mouse_button(1, false);
    host->app().context().held = {};
    host->frame();
}

TEST_F(AppTest, ABadFileShowsADialogAndLeavesTheDocument) {
    write_text(folder / "bad.obj", "v 0 0 zero\n");
    const Document* const before = editor().document.get();
    ASSERT_EQ(run("open bad.obj\nexpect message \"*bad.obj*\"\nexpect widget \"Message/OK\""), "");
    EXPECT_EQ(editor().document.get(), before);
    // The window below takes neither keys nor clicks meanwhile.
    ASSERT_EQ(run("key 1\nviewport click 300 200\nexpect selected 0"), "");
    ASSERT_EQ(run("click \"Message/OK\"\nexpect message \"\"\nexpect no_widget \"Message/OK\""), "");
}

TEST_F(AppTest, UnsavedChangesAreAskedAboutBeforeLeaving) {
    ASSERT_EQ(run("set gravity=10\ncommand file.quit\nexpect widget \"Unsaved/Save\"\nkey Escape"), "");
    EXPECT_FALSE(editor().quit);
    EXPECT_FALSE(editor().unsaved);
    ASSERT_EQ(run("command file.quit\nclick \"Unsaved/Save\""), "");
    EXPECT_TRUE(editor().quit);
    EXPECT_TRUE(std::filesystem::exists(level_file));
}

TEST_F(AppTest, TheFileBrowserOpensWhatIsClickedAndAsksBeforeReplacing) {
    write_text(folder / "other.obj", floor_and_wall_obj(2));
    write_text(folder / "notes.txt", "no level");
    ASSERT_EQ(run("command file.open\nexpect widget \"File dialog/List/other.obj\"\nexpect no_widget \"File "
                  "dialog/List/notes.txt\"\n"
                  "click \"File dialog/List/other.obj\"\nclick \"File dialog/Open\""),
              "");
    EXPECT_EQ(document().level().mesh_path.filename(), "other.obj");

    write_text(folder / "taken.slipface.json", "{}");
    ASSERT_EQ(run("command file.save_as\nclick \"File dialog/Path\"\nkey Ctrl+A\ntype \"" +
                  (folder / "taken.slipface.json").string() +
                  "\"\nclick \"File dialog/Save\"\n"
                  "expect widget \"File dialog/Replace\"\nclick \"File dialog/Keep it\""),
              "");
    EXPECT_EQ(read_text(folder / "taken.slipface.json"), "{}");
    ASSERT_EQ(run("click \"File dialog/Save\"\nclick \"File dialog/Replace\""), "");
    EXPECT_NE(read_text(folder / "taken.slipface.json"), "{}");
    EXPECT_EQ(editor().file_dialog, FileDialogKind::none);
}

TEST_F(AppTest, PlaytestWalksWithHeldKeysAndEscapeReturns) {
    ASSERT_EQ(run("viewport click 300 200"), "");
    ASSERT_EQ(run("click \"Toolbar/Play\"\nexpect playing yes\nwait 90"), "");
    const Vec3 rested = editor().playtest->state().position;
    EXPECT_TRUE(host->app().context().wants_cursor_capture);
    // A second at the walking speed of a few metres a second is more than a metre, if nothing is in the way
    // for that long.
    ASSERT_EQ(run("hold W 30"), "");
    EXPECT_GT((editor().playtest->state().position - rested).norm(), 0.5);
    ASSERT_EQ(run("key Escape\nexpect playing no\nwait 2"), "");
    EXPECT_FALSE(host->app().context().wants_cursor_capture);
}

TEST_F(AppTest, LosingTheFocusReleasesHeldKeys) {
    host->app().context().held.forward = true;
    host->app().context().held.buttons = Button::jump;
    host->app().focus_lost();
    EXPECT_FALSE(host->app().context().held.forward);
    EXPECT_FALSE(host->app().context().held.buttons.has(Button::jump));
}

TEST_F(AppTest, TheTitleShowsTheFileAndWhetherItIsSaved) {
    EXPECT_EQ(window_title(editor()), "grid.obj \u2014 Slipface");
    ASSERT_EQ(run("set gravity=10"), "");
    EXPECT_EQ(window_title(editor()), "grid.obj \u2022 \u2014 Slipface");
    editor().document.reset();
    EXPECT_EQ(window_title(editor()), "Slipface");
}

TEST_F(AppTest, EveryMenuOfTheTableOpensAndShowsItsCommands) {
    for (const Command& command : commands()) {
        // Submenus are opened by the test that runs every command.
        if (!*command.menu || std::string_view(command.menu).find('/') != std::string_view::npos) continue;
        const std::string menu = std::string("Menu/") + command.menu;
        ASSERT_EQ(run("click \"" + menu + "\""), "") << menu;
        EXPECT_TRUE(ui::widgets().contains(menu + "/" + command.label)) << command.id;
        ASSERT_EQ(run("key Escape"), "");
    }
}

// Sizes and scales at which every region must keep a positive size and no assertion of Dear ImGui may fire.
TEST_F(AppTest, SmallAndLargeWindowsWork) {
    struct Case {
        int width, height;
        float scale;
    };
    for (const Case& c :
         {Case{1920, 1080, 1}, Case{1280, 720, 2}, Case{480, 320, 1}, Case{64, 64, 1}, Case{480, 320, 2}}) {
        OffscreenOptions options;
        options.width = c.width;
        options.height = c.height;
        options.scale = c.scale;
        start(options);
        for (const PanelInfo& panel : panel_table())
            editor().layout.show(panel.id);
        editor().show_shortcuts = true;
        host->settle();
        const ViewportState& view = viewport_state();
        EXPECT_GE(view.size.x, 1.0f);
        if (c.width < 400) continue;
        EXPECT_GE(view.size.x, 0.3f * static_cast<float>(c.width)) << c.width;
        EXPECT_EQ(host->screenshot().width, c.width);
    }
}

// The window's shape is not known when a level is opened from the command line.
TEST_F(AppTest, ALevelOpensWholeInWindowsOfAnyShape) {
    std::mt19937 random(41);
    std::uniform_int_distribution<int> size(500, 1800);
    for (int i = 0; i < 5; ++i) {
        OffscreenOptions options;
        options.width = size(random);
        options.height = size(random);
        start(options);
        ASSERT_EQ(run(i % 2 == 1 ? "command view.four_panes" : "command view.one_pane"), "");
        host->frame();
        const Camera camera = editor().view.camera();
        const Aabb& box = document().bounds();
        for (const double x : {box.min.x(), box.max.x()})
            for (const double y : {box.min.y(), box.max.y()})
                for (const double z : {box.min.z(), box.max.z()}) {
                    const Vec3 at = project(camera, {x, y, z}, {editor().view_aspect, 1.0});
                    EXPECT_TRUE(at.x() > 0.0 && at.x() < editor().view_aspect) << options.width;
                    EXPECT_TRUE(at.y() > 0.0 && at.y() < 1.0) << options.height;
                }
        editor().view.orbit({20, 0});
        const ViewCamera moved = editor().view;
        ASSERT_EQ(run(i % 2 == 1 ? "command view.one_pane" : "command view.two_panes"), "");
        host->frame();
        EXPECT_EQ(editor().view.distance, moved.distance) << "a view that was moved stays";
    }
}

}  // namespace
}  // namespace slipface
