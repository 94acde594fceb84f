// Every panel, dialog and window at four sizes: nothing is cut, overlaps or leaves the window.
#include <fmt/format.h>
#include <imgui_internal.h>

#include "app_fixture.h"
#include "layout_check.h"
#include "panels/viewport_panel.h"

namespace slipface {
namespace {

struct Size {
    int width, height;
    float scale;
};
std::ostream& operator<<(std::ostream& out, const Size& size) {
    return out << size.width << "x" << size.height << "@" << size.scale;
}

class LayoutTest : public AppFixture, public testing::WithParamInterface<Size> {
  protected:
    void SetUp() override {
        LevelFixture::SetUp();
        OffscreenOptions options;
        options.width = GetParam().width;
        options.height = GetParam().height;
        options.scale = GetParam().scale;
        start(options);
    }

    void expect_tidy(const std::string& what) {
        host->settle();
        for (const std::string& defect :
             layout_defects(static_cast<float>(GetParam().width), static_cast<float>(GetParam().height)))
            ADD_FAILURE() << what << ": " << defect;
    }
    void expect_tidy_after(const std::string& script) {
        ASSERT_EQ(run(script + "\npark_mouse"), "") << script;
        expect_tidy(script);
    }
    // A level with long names, something selected, and a run on the tape.
    void fill_the_level() {
        editor().document->rename_surface(ice, "frozen_waterfall_of_the_northern_gate");
        ASSERT_EQ(
            run("camera eye 4,7,13 target 4,0,4\nselect faces 3,5-9\nselect save \"the long way round to the "
                "upper gallery\"\ncamera save \"the view from above the entrance hall\"\ncommand "
                "playtest.start\nwait 20\nhold W 30\nhold W Space 20\nkey Escape\nfinish"),
            "");
    }
};

TEST_P(LayoutTest, EveryPanel) {
    fill_the_level();
    ASSERT_EQ(run("command tools.probe\nviewport drag @2.5,0,4.5 @7.5,0,4.5"), "");
    for (const PanelInfo& info : panel_table()) {
        editor().layout = {};
        editor().layout.show(info.id);
        ASSERT_EQ(run("park_mouse"), "");
        expect_tidy(info.name);
    }
}

TEST_P(LayoutTest, EveryPanelByItself) {
    fill_the_level();
    for (const PanelInfo& info : panel_table())
        expect_tidy_after(std::string("only ") + info.name);
    expect_tidy_after("only view");
}

TEST_P(LayoutTest, PanelsWithContents) {
    fill_the_level();
    expect_tidy_after("command panel.problems\nclick \"Problems/Examine\"");
    expect_tidy_after("command panel.audit\ncommand audit.run\nfinish");
    expect_tidy_after("review " + std::string(SLIPFACE_SOURCE_DIR) + "/assets/review/report.json");
    expect_tidy_after("command review.close");
    if (!editor().layout.visible(PanelId::palette)) expect_tidy_after("click \"Tabs/Types\"");
    expect_tidy_after("click \"Palette/ladder\"");
    expect_tidy_after("set ground_acceleration=12\nfinish\ncommand lab.pin\nclick \"Tabs/Ghosts\"");
}

// Warnings about paint that was guessed, spawns with long names, and the card of a level opened first.
TEST_P(LayoutTest, WhatALevelFromElsewhereBringsUp) {
    const FaceId painted = 0;
    editor().document->paint(std::span(&painted, 1), ice);
    std::vector<Spawn> spawns;
    for (int i = 0; i < 12; ++i)
        spawns.push_back({Vec3(0.6 * i, 0.95, 4.0), 0.0, "info_player_deathmatch " + std::to_string(i + 1)});
    editor().document->set_spawns(spawns, "Many");
    write_text(obj, obj_with_cut_face(n));
    reload_geometry(editor());
    expect_tidy("guessed paint");
    ASSERT_TRUE(ui::widgets().contains("Warnings/Accept"));
    expect_tidy_after("command panel.spawns");
    expect_tidy_after("hover \"Spawns/info_player_deathmatch 3/Row\"");
    editor().import_card.shown = true;
    expect_tidy("import card");
    editor().document->set_spawns({}, "None");
    ImportTransform too_large;
    too_large.scale = 1000.0;
    ASSERT_TRUE(editor().document->set_import_transform(too_large));
    geometry_changed(editor());
    expect_tidy("import card of a level that is too large");
}

// At any size and scale: the level has at least half of the width and, over a timeline, two fifths of the
// height; most types are in sight beside it.
TEST_P(LayoutTest, TheLevelAndTheTypesHaveRoomBesideATimeline) {
    fill_the_level();
    for (const PanelId used : {PanelId::movement, PanelId::palette}) {
        ASSERT_EQ(run("command panel.timeline"), "");
        editor().layout.show(PanelId::timeline);
        editor().layout.show(used);
        expect_tidy("timeline");
        EXPECT_GE(viewport_state().size.x, 0.49f * static_cast<float>(GetParam().width));
        EXPECT_GE(viewport_state().size.y, 0.3f * static_cast<float>(GetParam().height));
        EXPECT_TRUE(editor().layout.visible(used));
    }
    std::size_t types = 0;
    for (const SurfaceType& type : document().level().surfaces) {
        const auto found = ui::widgets().find("Palette/" + type.name);
        types += found != ui::widgets().end() && found->second.visible ? 1 : 0;
    }
    EXPECT_GE(types, 6u);
    for (const auto& [path, rect] : ui::widgets())
        EXPECT_FALSE(path.starts_with("Viewport/Legend/")) << "it repeats the Types panel";
}

// A side that became icons opens by a press, and the other closes; or the user closes it.
TEST_P(LayoutTest, ASideWithoutRoomIsARailOfIcons) {
    const bool crowded = GetParam().scale > 1.0f || GetParam().width < 1000;
    host->settle();
    EXPECT_EQ(editor().layout.visible(PanelId::movement), !crowded);
    ASSERT_EQ(run("click \"Tabs/Why\""), "");
    host->settle();
    EXPECT_TRUE(editor().layout.visible(PanelId::why));
    EXPECT_EQ(editor().layout.visible(PanelId::palette), !crowded);
    ASSERT_EQ(run("right_click \"Tabs/Why\"\nclick \"Tabs/Tab menu/Collapse\""), "");
    expect_tidy("collapsed");
    EXPECT_FALSE(editor().layout.visible(PanelId::why));
    ASSERT_EQ(run("click \"Tabs/Why\""), "");
    host->settle();
    EXPECT_TRUE(editor().layout.visible(PanelId::why));
}

// As many selected faces as nobody counts, in a narrow column.
TEST_P(LayoutTest, TextsAndButtonsOfANarrowColumnLieBesideEachOther) {
    fill_the_level();
    for (const char* panel : {"inspector", "movement", "palette", "why", "props", "spawns"})
        expect_tidy_after(std::string("only ") + panel + " 240");
}

// All panels in one dock: their tabs can all be pressed.
TEST_P(LayoutTest, EveryTabOfACrowdedDock) {
    for (const Dock dock : {Dock::right, Dock::left, Dock::bottom}) {
        for (const PanelInfo& info : panel_table())
            editor().layout.move(info.id, dock);
        expect_tidy("crowded dock");
        for (const PanelInfo& info : panel_table()) {
            ASSERT_EQ(run(fmt::format("click \"Tabs/{}\"", info.label)), "");
            EXPECT_TRUE(editor().layout.is_front(info.id)) << info.label;
        }
    }
}

TEST_P(LayoutTest, EveryToolsOptions) {
    editor().document->rename_surface(ice, "frozen_waterfall_of_the_northern_gate");
    for (const char* tool : {"tools.select", "tools.paint", "tools.fill", "tools.probe"})
        expect_tidy_after(std::string("command ") + tool);
    expect_tidy_after("command select.brush");
    for (const char* widget :
         {"Drag a box", "Drag a lasso", "Drag a brush", "Select through", "Only whole faces"})
        EXPECT_TRUE(ui::widgets().contains(std::string("Toolbar/Options/") + widget)) << widget;
    EXPECT_TRUE(ui::widgets().contains("Toolbar/Options/Brush"));
    expect_tidy_after("command playtest.start\nwait 5");
}

TEST_P(LayoutTest, EveryDialogAndWindow) {
    expect_tidy_after("command file.open");
    expect_tidy_after("key Escape\ncommand file.save_as");
    expect_tidy_after("key Escape\nopen missing.obj");
    expect_tidy_after("key Escape\nset gravity=11\ncommand file.quit");
    expect_tidy_after("key Escape\ncommand help.shortcuts");
    expect_tidy_after("click \"Shortcuts/tools.paint\"\nkey Ctrl+S");
    expect_tidy_after("key Escape\nkey Ctrl+P");
    expect_tidy_after("key Escape\ncommand help.overlay");
    expect_tidy_after("key Escape\ncommand view.four_panes");
    ASSERT_EQ(run("command view.one_pane\ncommand help.tour"), "");
    for (int step = 0; step < 8; ++step)
        expect_tidy_after(step == 0 ? "" : "key Enter");
    expect_tidy_after("key Escape\nautosave\ncrash");
    editor().document.reset();
    expect_tidy("welcome");
}

TEST_P(LayoutTest, EveryMenu) {
    std::set<std::string> menus;
    for (const Command& command : commands())
        if (*command.menu) menus.insert(std::string("Menu/") + command.menu);
    for (const std::string& menu : menus) {
        const std::size_t slash = menu.find('/', 5);
        ASSERT_EQ(run("click \"" + menu.substr(0, slash) + "\""), "");
        if (slash != std::string::npos) {
            ASSERT_EQ(run("hover \"" + menu + "\"\nwait 2"), "");
        }
        expect_tidy(menu);
        ImGui::ClosePopupToLevel(0, false);
        ASSERT_EQ(run("park_mouse\nwait 2"), "");
    }
}

// Whatever is under the mouse, its tooltip lies in the window.
TEST_P(LayoutTest, EveryTooltip) {
    fill_the_level();
    std::vector<std::string> paths;
    for (const auto& [path, rect] : ui::widgets())
        if (rect.visible) paths.push_back(path);
    std::size_t shown = 0;
    for (const std::string& path : paths) {
        ASSERT_EQ(run("hover \"" + path + "\""), "");
        host->settle();
        for (const auto& [name, rect] : ui::widgets()) {
            if (!name.ends_with("Tooltip")) continue;
            ++shown;
            EXPECT_GE(rect.min.x, 0.0f) << path;
            EXPECT_GE(rect.min.y, 0.0f) << path;
            EXPECT_LE(rect.max.x, static_cast<float>(GetParam().width)) << path;
            EXPECT_LE(rect.max.y, static_cast<float>(GetParam().height)) << path;
        }
    }
    EXPECT_GT(shown, 20u);
}

INSTANTIATE_TEST_SUITE_P(Sizes, LayoutTest,
                         testing::Values(Size{800, 500, 1}, Size{1280, 720, 1}, Size{1440, 900, 1},
                                         Size{1920, 1080, 2}),
                         [](const auto& test) {
                             return fmt::format("{}x{}at{}", test.param.width, test.param.height,
                                                static_cast<int>(test.param.scale));
                         });

}  // namespace
}  // namespace slipface
