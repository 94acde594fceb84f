// The window under a person's hands: the mouse rests, clicks are slow and shake, menus are far from the face
// that is meant, letters are typed before a window is drawn.
#include <gmock/gmock.h>

#include <random>

#include "app_fixture.h"
#include "panels/viewport_panel.h"
#include "slipface/level/find_start.h"
#include "tools/target.h"

namespace slipface {
namespace {

class Hands : public AppFixture {
  protected:
    static constexpr double delay_s = 0.45;

    // The frames that the window draws after an event, whatever it was.
    void event() {
        for (int i = 0; i < 3; ++i)
            host->frame();
    }
    void point_at(ImVec2 at) {
        host->move_mouse(at);
        event();
    }
    void press(int button) {
        host->mouse_button(button, true);
        event();
    }
    void release(int button) {
        host->mouse_button(button, false);
        event();
    }
    ImVec2 pixel_of(const Vec3& point) {
        const ViewportState& view = viewport_state();
        const Vec3 at = project(shown_camera(editor()), point,
                                {static_cast<double>(view.size.x), static_cast<double>(view.size.y)});
        return {view.min.x + static_cast<float>(at.x()), view.min.y + static_cast<float>(at.y())};
    }
    ImVec2 centre_of(const std::string& path) {
        const auto found = ui::widgets().find(path);
        EXPECT_NE(found, ui::widgets().end()) << path;
        return found == ui::widgets().end() ? ImVec2{} : found->second.centre();
    }
    static bool shown(std::string_view path) { return ui::widgets().contains(path); }
    static bool tooltip_is_shown() {
        return std::any_of(ui::widgets().begin(), ui::widgets().end(),
                           [](const auto& entry) { return entry.first.ends_with("Tooltip"); });
    }
};

TEST_F(Hands, EveryTooltipShowsWhileTheMouseRests) {
    host->settle();
    ui::set_tooltip_delay(delay_s);
    std::vector<std::pair<std::string, ImVec2>> places;
    for (const auto& [path, rect] : ui::widgets())
        if (rect.has_tooltip && rect.visible) places.emplace_back(path, rect.centre());
    // A setting's name is at the left of its control.
    for (const SettingInfo& info : settings_table())
        if (const auto found = ui::widgets().find(std::string("Movement/") + info.label);
            found != ui::widgets().end() && found->second.visible)
            places.emplace_back(std::string(info.label) + "'s name",
                                ImVec2{found->second.clip_min.x + 40.0f, found->second.centre().y});
    EXPECT_GT(places.size(), 50u);
    for (const auto& [what, at] : places) {
        host->park_mouse();
        event();
        point_at(at);
        host->rest(0.5 * delay_s);
        EXPECT_FALSE(tooltip_is_shown()) << what << ": too early";
        host->rest(2.0 * delay_s);
        EXPECT_TRUE(tooltip_is_shown()) << what;
        host->rest(60.0);
        EXPECT_TRUE(tooltip_is_shown()) << what << ": gone again";
    }
}

TEST_F(Hands, AWindowThatNobodyTouchesAsksForNoFrame) {
    host->settle();
    EXPECT_GT(host->app().next_frame_s(), 1e6);
    ui::set_tooltip_delay(delay_s);
    point_at(centre_of("Toolbar/Paint"));
    EXPECT_LT(host->app().next_frame_s(), delay_s);
    EXPECT_GT(host->app().next_frame_s(), 0.0) << "frames while nothing changes";
    host->rest(2.0);
    EXPECT_GT(host->app().next_frame_s(), 1e6);
}

TEST_F(Hands, TwoSlowClicksAreNoDoubleClick) {
    look_down();
    point_at(pixel_of({2.5, 0, 2.5}));
    for (int i = 0; i < 2; ++i) {
        press(0);
        host->rest(0.2);
        release(0);
        host->rest(3.0);
    }
    EXPECT_THAT(document().selection(), testing::ElementsAre(2 * 8 + 2));
    for (int i = 0; i < 2; ++i) {
        press(0);
        release(0);
    }
    EXPECT_EQ(document().selection().size(), 64u) << "two quick ones are";
}

TEST_F(Hands, ARightClickOpensTheMenuOfTheFaceUnderIt) {
    look_down();
    const ViewCamera before = editor().view;
    const ImVec2 at = pixel_of({5.5, 0, 2.5});
    point_at(at);
    press(1);
    host->rest(0.15);
    point_at({at.x + 2, at.y - 1});  // a hand is not still
    release(1);
    EXPECT_TRUE(editor().view == before);
    ASSERT_TRUE(shown("View menu/Set spawn point"));
    EXPECT_THAT(document().selection(), testing::ElementsAre(5 * 8 + 2));
    ASSERT_EQ(run("click \"View menu/Set spawn point\""), "");
    EXPECT_NEAR(document().level().spawn.x(), 5.5, 0.2);
    EXPECT_NEAR(document().level().spawn.z(), 2.5, 0.2);
    EXPECT_FALSE(shown("View menu/Set spawn point"));
    event();
    EXPECT_FALSE(editor().pointed);
}

TEST_F(Hands, ARightDragFliesAndAClickOfAnyLengthOpensTheMenu) {
    look_down();
    const ViewCamera before = editor().view;
    const ImVec2 at = pixel_of({4, 0, 4});
    point_at(at);
    press(1);
    point_at({at.x + 30, at.y});
    release(1);
    EXPECT_FALSE(editor().view == before);
    EXPECT_FALSE(shown("View menu/Set spawn point"));
    point_at(at);
    press(1);
    host->rest(3.0);
    release(1);
    EXPECT_TRUE(shown("View menu/Set spawn point"));
}

// Whatever the mouse is over.
TEST_F(Hands, CommandsAboutAFaceHaveATargetFromMenuPaletteAndKey) {
    look_down();
    const Vec3 middle{4, 0, 4};
    const auto near = [&](const Vec3& point) {
        return (editor().document->level().spawn - point).head<1>().norm() < 0.6;
    };
    ASSERT_EQ(run("menu \"Edit/Set spawn point\""), "");
    EXPECT_TRUE(near(middle)) << "nothing is selected: the middle of the view";
    ASSERT_EQ(run("select faces 58\nmenu \"Edit/Set spawn point\""), "");
    EXPECT_TRUE(near({7.5, 0, 2.5})) << "the selected face";
    ASSERT_EQ(run("viewport hover @1.5,0,1.5\nkey Ctrl+P\ntype \"set spawn\"\nkey Enter"), "");
    EXPECT_TRUE(near({1.5, 0, 1.5})) << "where the mouse was when the palette opened";
    ASSERT_EQ(run("park_mouse\nkey Ctrl+P\ntype \"set spawn\"\nkey Enter"), "");
    EXPECT_TRUE(near({7.5, 0, 2.5}));
    ASSERT_EQ(run("viewport hover @3.5,0,6.5\nkey P"), "");
    EXPECT_TRUE(near({3.5, 0, 6.5}));
    ASSERT_EQ(run("key Ctrl+Shift+A\nmenu \"Playtest/Play from here\"\nexpect playing yes"), "");
}

TEST_F(Hands, WithoutAFaceInSightTheStatusLineSaysSo) {
    ASSERT_EQ(run("camera eye 4,4,4 target 4,9,4\npark_mouse"), "");
    for (const char* id : {"edit.set_spawn", "edit.add_spawn", "playtest.from_here", "playtest.from_view",
                           "tools.pick_surface", "select.middle"}) {
        editor().status.clear();
        EXPECT_TRUE(run_command(editor(), id)) << id;
        EXPECT_FALSE(editor().status.empty()) << id;
        EXPECT_FALSE(editor().playtest);
    }
    EXPECT_EQ(document().history_cursor(), 0u);
}

// Keys and letters arrive before a window that they opened was drawn.
TEST_F(Hands, WhatIsTypedAheadGoesToTheWindowThatOpens) {
    struct Case {
        Shortcut opens;
        std::string_view found, hidden;
    };
    for (const Case& c : {Case{{.key = "F1"}, "Shortcuts/lab.reach", "Shortcuts/file.open"},
                          Case{{.key = "P", .ctrl = true}, "Commands/Reach", "Commands/Open\u2026"}}) {
        host->settle();
        const Tool tool = editor().tool;
        const std::uint64_t revision = document().revision();
        host->app().key_pressed({c.opens});
        const std::string_view typed = "reachr";
        for (const char letter : typed.substr(0, 3)) {
            host->app().key_pressed({{.key = std::string(1, static_cast<char>(letter - 32))}});
            host->type(std::string(1, letter));
        }
        host->frame();
        for (const char letter : typed.substr(3, 2)) {
            host->app().key_pressed({{.key = std::string(1, static_cast<char>(letter - 32))}});
            host->type(std::string(1, letter));
            host->frame();
        }
        host->settle();
        EXPECT_TRUE(ImGui::GetIO().WantTextInput) << c.opens.text();
        EXPECT_TRUE(shown(c.found)) << c.opens.text();
        EXPECT_FALSE(shown(c.hidden)) << c.opens.text();
        EXPECT_EQ(editor().tool, tool);
        EXPECT_EQ(document().revision(), revision);
        host->app().key_pressed({c.opens});
        host->settle();
    }
    EXPECT_FALSE(editor().show_shortcuts);
}

TEST_F(Hands, MovementIsSearched) {
    ASSERT_EQ(run("click \"Movement/Search\"\ntype \"coyote\""), "");
    host->settle();
    EXPECT_TRUE(shown("Movement/Coyote time"));
    EXPECT_FALSE(shown("Movement/Gravity"));
    ASSERT_EQ(run("type \" xyz\""), "");
    EXPECT_FALSE(shown("Movement/Coyote time"));
}

TEST_F(Hands, ADigitChoosesTheBrushAndKeepsTheTool) {
    for (const char* tool : {"tools.select", "tools.paint", "tools.fill", "tools.probe"}) {
        ASSERT_EQ(run(std::string("command ") + tool), "");
        const Tool before = editor().tool;
        ASSERT_EQ(run("key 1\nkey 2\nexpect brush ice"), "");
        EXPECT_EQ(editor().tool, before);
    }
}

// Into the wall or the floor, at any speed: the eye stays on its side and the near plane before the face.
TEST_F(Hands, TheWheelNeverPassesThroughWhatItComesTo) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> at(0.5, 7.5), height(0.2, 12.0);
    for (int i = 0; i < 8; ++i) {
        const Vec3 eye{at(random), height(random), at(random)}, target{at(random), 0.0, at(random)};
        editor().view.look_at(eye, target);
        editor().view.distance = height(random);  // the pivot is anywhere along the view
        editor().view.pivot = eye + (target - eye).normalized() * editor().view.distance;
        host->move_mouse(pixel_of(target));
        host->frame();
        host->frame();
        double before = 1e9;
        for (int notch = 0; notch < 40; ++notch) {
            host->wheel(1.0f + static_cast<float>(notch % 3));
            host->frame();
            const Camera camera = editor().view.camera();
            const double away = (camera.eye - target).norm();
            ASSERT_GT(camera.eye.y(), 0.0);
            ASSERT_GT(away, camera.near_plane);
            if (notch > 5) {
                ASSERT_LE(away, before + 1e-9);
            }
            before = away;
        }
        EXPECT_LT(before, 0.6);
    }
}

TEST_F(Hands, HomeShowsTheLevelFromInFront) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> yaw(-3.1, 3.1), pitch(-1.4, 1.4);
    for (int i = 0; i < 20; ++i) {
        editor().view.yaw = yaw(random);
        editor().view.pitch = pitch(random);
        ASSERT_EQ(run("command view.frame_all"), "");
        const Camera camera = editor().view.camera();
        EXPECT_GT(camera.eye.y(), 0.0) << "from below the floor is dark";
    }
}

TEST_F(Hands, TheTourAndTheHelpNameThePanelWhy) {
    ASSERT_EQ(
        run("command help.overlay\nexpect widget \"Help/What stopped the player, and why\"\nkey Escape"), "");
    ASSERT_EQ(run("command help.tour"), "");
    bool named = false;
    for (int step = 0; step < 12 && editor().session.tour >= 0; ++step) {
        host->settle();
        named = named || (shown("Tour/Why") && editor().layout.visible(PanelId::why));
        host->press_key({.key = "Enter"});
    }
    EXPECT_TRUE(named);
}

TEST_F(Hands, PlayBeginsWhereOneLooksIfAskedTo) {
    look_down();
    editor().document->set_spawn({Vec3(0.5, 0.95, 0.5), 0.0});
    ASSERT_EQ(run("camera eye 6,3,9 target 6.5,0,6.5\nkey Shift+Alt+F5\nexpect playing yes"), "");
    EXPECT_NEAR(editor().playtest->state().position.x(), 6.5, 0.3);
    ASSERT_EQ(run("key Escape\nkey F5"), "");
    EXPECT_NEAR(editor().playtest->state().position.x(), 0.5, 0.3);
    host->frame();
    EXPECT_FALSE(editor().began_in_view) << "which is offered then";
    EXPECT_TRUE(shown("Viewport/Walking elsewhere"));
    ASSERT_EQ(run("key Escape\ncamera eye 4,9,9 target 2,0,2\nkey F5"), "");
    EXPECT_TRUE(editor().began_in_view);
}

}  // namespace
}  // namespace slipface
