// What a stranger tripped over in the window: each of it with the sight or the press that showed it.
#include <imgui_internal.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "app_fixture.h"
#include "panels/lab_track.h"
#include "panels/viewport_panel.h"
#include "slipface/level/find_start.h"
#include "tools/selection/surface_types.h"
#include "widgets/theme.h"

namespace slipface {
namespace {

class WindowTest : public AppFixture {
  protected:
    const ui::WidgetRect& widget(const std::string& path) {
        const auto found = ui::widgets().find(path);
        EXPECT_NE(found, ui::widgets().end()) << path;
        static const ui::WidgetRect none;
        return found == ui::widgets().end() ? none : found->second;
    }
    // Pixels inside a widget whose colour is nearer to `color` than `reach`, of 255.
    int pixels_like(const ui::WidgetRect& rect, const ImVec4& color, int reach) {
        host->settle();
        const Image image = host->screenshot();
        int count = 0;
        for (int y = static_cast<int>(rect.min.y); y < static_cast<int>(rect.max.y); ++y)
            for (int x = static_cast<int>(rect.min.x); x < static_cast<int>(rect.max.x); ++x) {
                const std::size_t at =
                    4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                         static_cast<std::size_t>(x));
                const float wanted[] = {color.x, color.y, color.z};
                bool like = true;
                for (std::size_t c = 0; c < 3; ++c)
                    like &= std::abs(static_cast<float>(image.rgba[at + c]) - 255.0f * wanted[c]) <=
                            static_cast<float>(reach);
                count += like ? 1 : 0;
            }
        return count;
    }
};

// The press-down that keeps a player on the ground is no motion.
TEST_F(WindowTest, APlayerAtRestHasNoVelocityArrow) {
    editor().document->set_spawn({Vec3(4, 0.95, 6), 0.0});
    editor().show_trace = false;  // contacts have arrows, too
    const auto arrows = [&] {
        std::vector<Vec3> found;
        for (const Overlay::Line& line : viewport_overlay(editor(), shown_camera(editor()), 600).lines)
            if (line.arrow) found.push_back(line.b - line.a);
        return found;
    };
    ASSERT_EQ(run("command playtest.start\nwait 30\nexpect grounded yes"), "");
    EXPECT_TRUE(arrows().empty());
    ASSERT_EQ(run("hold W 20"), "");
    ASSERT_EQ(arrows().size(), 1u);
    EXPECT_NEAR(arrows()[0].y(), 0.0, 1e-9);
    EXPECT_GT(arrows()[0].norm(), 0.3);
}

TEST_F(WindowTest, TheTabsThatAreThereAtFirstTakeOneLine) {
    OffscreenOptions options;
    options.width = 1440;
    options.height = 900;
    start(options);
    std::map<Dock, float> line;
    for (const PanelInfo& info : panel_table()) {
        if (!info.shown) continue;
        const float top = widget(std::string("Tabs/") + info.label).min.y;
        EXPECT_EQ(line.emplace(info.dock, top).first->second, top) << info.label;
    }
    EXPECT_EQ(line.size(), 3u);
}

// A Quake map has dozens: what is written is readable, and the main one is.
TEST_F(WindowTest, NamesOfSpawnsDoNotLieOnEachOther) {
    std::vector<Spawn> spawns;
    for (int i = 0; i < 60; ++i)
        spawns.push_back({Vec3(0.1 * i, 0.95, 4.0), 0.0, "info_player_deathmatch " + std::to_string(i + 1)});
    editor().document->set_spawns(spawns, "Many");
    ASSERT_EQ(run("camera frame"), "");
    host->settle();
    std::vector<ui::WidgetRect> names;
    for (const auto& [path, rect] : ui::widgets())
        if (path.find("Spawn name/") != std::string::npos) names.push_back(rect);
    EXPECT_TRUE(ui::widgets().contains("Viewport/Spawn name/info_player_deathmatch 1"));
    EXPECT_GE(names.size(), 1u);
    EXPECT_LT(names.size(), spawns.size());
    for (std::size_t i = 0; i < names.size(); ++i)
        for (std::size_t j = i + 1; j < names.size(); ++j)
            EXPECT_TRUE(names[i].max.x <= names[j].min.x || names[j].max.x <= names[i].min.x ||
                        names[i].max.y <= names[j].min.y || names[j].max.y <= names[i].min.y);
}

TEST_F(WindowTest, ALevelThatCannotBeSavedWhereItLiesIsOfferedSaveAs) {
    std::filesystem::create_directory(level_file);  // nothing can be written under its name
    ASSERT_EQ(run("select faces 1\ncommand edit.fill_selection\nkey Ctrl+S\n"
                  "expect message \"Cannot save grid.slipface.json*\"\n"
                  "click \"Message/Save as\u2026\"\nwait 2\nexpect message \"\""),
              "");
    EXPECT_EQ(editor().file_dialog, FileDialogKind::save_as);
    const std::string elsewhere = (folder / "mine.slipface.json").string();
    ASSERT_EQ(run("key Ctrl+A\ntype \"" + elsewhere + "\"\nkey Enter\nwait 2\nexpect dirty no"), "");
    EXPECT_TRUE(std::filesystem::exists(elsewhere));
    // Other errors have nothing to offer.
    ASSERT_EQ(run("open missing.obj\nexpect no_widget \"Message/Save as\u2026\""), "");
}

TEST_F(WindowTest, TheImportCardPlacesTheSpawn) {
    editor().import_card.shown = true;
    const Level& level = document().level();
    ASSERT_FALSE(has_spawn(level));
    ASSERT_EQ(run("wait 1\nclick \"Viewport/Import/Open floor\""), "");
    ASSERT_TRUE(has_spawn(level));
    EXPECT_NEAR(level.spawn.y(), level.movement.radii.y() + level.movement.skin, 1e-3);
    EXPECT_NEAR(level.spawn.x(), 4.0, 2.0);
    EXPECT_NEAR(level.spawn.z(), 4.0, 2.0);
    ASSERT_EQ(run("camera eye 1.5,9,6.6 target 1.5,0,6.5\nclick \"Viewport/Import/In view\""), "");
    EXPECT_NEAR(level.spawn.x(), 1.5, 0.1);  // no view looks straight down
    EXPECT_NEAR(level.spawn.z(), 6.5, 0.1);
    EXPECT_EQ(all_spawns(level).size(), 1u);
    ASSERT_EQ(run("key Ctrl+Z\nkey Ctrl+Z"), "");
    EXPECT_FALSE(has_spawn(level));
    ASSERT_EQ(run("click \"Viewport/Import/In view\""), "");
    EXPECT_NEAR(level.spawn.x(), 1.5, 0.1);
    ASSERT_EQ(run("key Escape\nwait 1\nexpect no_widget \"Viewport/Import/In view\""), "");
}

TEST_F(WindowTest, TheImportCardTurnsALevelUpright) {
    const std::filesystem::path lying = folder / "lying.obj";  // its floor is across z
    std::ofstream(lying)
        << "v 0 0 0\nv 20 0 0\nv 20 30 0\nv 0 30 0\nv 0 0 3\nv 20 0 3\nf 1 2 3 4\nf 1 5 6 2\n";
    ASSERT_EQ(run("open " + lying.string() +
                  "\nwait 2\nclick \"Viewport/Import/Turn upright\"\nwait 2\n"
                  "expect no_widget \"Viewport/Import/Turn upright\""),
              "");
    EXPECT_NEAR(document().level().import_summary.size.y(), 3.0, 1e-6);
    ASSERT_EQ(run("key Ctrl+Z\nwait 2\nexpect widget \"Viewport/Import/Turn upright\""), "");
    EXPECT_NEAR(document().level().import_summary.size.y(), 30.0, 1e-6);
}

TEST_F(WindowTest, TheImportCardFlipsALevelThatIsInsideOut) {
    const std::filesystem::path inverted = folder / "inverted.obj";  // a slab, seen from within
    std::ofstream(inverted)
        << "v 0 0 0\nv 20 0 0\nv 20 0 30\nv 0 0 30\nv 0 1 0\nv 20 1 0\nv 20 1 30\nv 0 1 30\n"
           "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    ASSERT_EQ(run("open " + inverted.string() + "\nwait 2\nclick \"Viewport/Import/Flip\"\nwait 2"), "");
    EXPECT_TRUE(document().level().import_transform.flip);
    EXPECT_NEAR(face_normal(*document().level().mesh, 1).y(), 1.0, 1e-6);
    EXPECT_FALSE(editor().import_card.facing_doubt);
    ASSERT_EQ(run("click \"Viewport/Import/Flip back\"\nwait 2"), "");
    EXPECT_FALSE(document().level().import_transform.flip);
    EXPECT_TRUE(editor().import_card.facing_doubt);
}

TEST_F(WindowTest, TheSelectionsTintIsNotSeenWhileWalking) {
    ASSERT_EQ(run("select faces 3-9\ncommand playtest.start"), "");
    for (const std::uint8_t flags : face_highlights(editor(), document().face_count()).own)
        EXPECT_EQ(flags & 2, 0);
    ASSERT_EQ(run("key Escape"), "");
    EXPECT_EQ(face_highlights(editor(), document().face_count()).own[3] & 2, 2);
}

TEST_F(WindowTest, AStrokeSaysOnHowManyFacesItPainted) {
    look_down();
    choose_brush(editor(), ice);
    editor().tool = Tool::paint;
    ASSERT_EQ(run("viewport drag @0.5,0,4.5 @7.5,0,4.5"), "");
    EXPECT_EQ(editor().status, "Painted ice on 8 faces");
    // The next one begins at nothing, and what is ice already does not count.
    ASSERT_EQ(run("viewport drag @2.5,0,4.5 @2.5,0,6.5"), "");
    EXPECT_EQ(editor().status, "Painted ice on 2 faces");
    ASSERT_EQ(run("select faces 0-4\nkey L"), "");
    EXPECT_EQ(editor().status, "Painted ice on 4 faces");
}

TEST_F(WindowTest, CommandsNameTheTypeInsteadOfItsKey) {
    const auto& surfaces = document().level().surfaces;
    for (const SurfaceType& type : surfaces) {
        if (type.hotkey == 0) continue;
        const std::string digit = std::to_string(type.hotkey);
        EXPECT_EQ(command_name(editor(), *find_command("brush." + digit)), "Brush: " + type.name);
        EXPECT_EQ(command_name(editor(), *find_command("select.type_" + digit)), "Type: " + type.name);
        EXPECT_EQ(command_name(editor(), *find_command("paint." + digit)),
                  "Paint the selection with key " + digit)
            << "nothing is selected, so it stands for nothing yet";
    }
    ASSERT_EQ(run("select faces 1\nselect save \"north wall\""), "");
    EXPECT_EQ(command_name(editor(), *find_command("paint.2")), "Make it " + surfaces[ice].name);
    EXPECT_EQ(command_name(editor(), *find_command("select.recall_1")), "Recall north wall");
    // A rename is seen at once, and found.
    editor().document->rename_surface(ice, "frost");
    ASSERT_EQ(run("key Ctrl+P\ntype \"frost\"\nexpect widget \"Commands/Brush of key 2\""), "");
}

TEST_F(WindowTest, NoTwoIconsOfTheToolbarAreTheSame) {
    ASSERT_EQ(run("command tools.select"), "");
    host->settle();
    std::map<std::string_view, std::string> seen;
    for (const Command& command : commands()) {
        const std::string label(command.label);
        if (!ui::widgets().contains("Toolbar/" + label) &&
            !ui::widgets().contains("Toolbar/Options/" + label))
            continue;
        const auto [other, fresh] = seen.emplace(command.icon, label);
        EXPECT_TRUE(fresh || other->second == label) << label << " has the icon of " << other->second;
    }
    EXPECT_GT(seen.size(), 15u);
}

TEST_F(WindowTest, TheViewCubeHasLetters) {
    editor().view.look_from({0, 0, 1});
    host->settle();
    const ui::WidgetRect front = widget("Viewport/Cube/Front");
    ui::WidgetRect side = front;
    side.min = {front.min.x - 14, front.min.y - 4};
    side.max = {front.max.x + 14, front.max.y + 4};
    EXPECT_GT(pixels_like(side, ui::palette().text, 60), 12);
}

TEST_F(WindowTest, TheWhiteSwatchHasABorderInTheLightTheme) {
    ASSERT_EQ(run("command interface.light\nclick \"Palette/ice\"\npark_mouse"), "");
    const auto colors = safe_surface_colors();
    for (std::size_t i = 0; i < colors.size(); ++i) {
        const ui::WidgetRect swatch = widget("Palette/Swatch " + std::to_string(i + 1));
        if (!swatch.visible) continue;
        EXPECT_GT(pixels_like(swatch, ui::palette().muted, 40), 8) << i;
    }
}

TEST_F(WindowTest, ReviewNamesAMenuThatThereIs) {
    const std::string named = menu_location(*find_command("review.open"));
    EXPECT_EQ(named, "View > Snapshots > Review snapshots");
    ASSERT_EQ(run("menu \"View/Snapshots/Review snapshots\""), "");
}

// A check knows levels, an editor that was started for its report has none open.
TEST_F(WindowTest, AReviewNeedsNoLevel) {
    host.reset();  // one Dear ImGui at a time
    host = std::move(OffscreenHost::make({})).value();
    ASSERT_EQ(run("review " SLIPFACE_SOURCE_DIR "/assets/review/report.json\nwait 2\nexpect widget "
                  "\"Review/Approve\"\nclick \"Review/Skip\"\nexpect status \"*skipped\""),
              "");
    ASSERT_EQ(run("command review.close\nwait 1\nexpect no_widget \"Review/Approve\""), "");
}

TEST_F(WindowTest, EscapeClosesTheWindowOfKeysAfterADialogToo) {
    ASSERT_EQ(
        run("key F1\nexpect widget \"Shortcuts/Reset all\"\nkey Escape\nexpect no_widget \"Shortcuts/Reset "
            "all\"\nkey F1\nopen missing.obj\nkey Escape\nexpect message \"\"\nexpect widget "
            "\"Shortcuts/Reset all\"\nkey Escape\nexpect no_widget \"Shortcuts/Reset all\""),
        "");
}

TEST_F(WindowTest, AConflictOfKeysNamesTheOtherCommand) {
    ASSERT_EQ(run("key F1\nclick \"Shortcuts/tools.paint\"\nkey Ctrl+S"), "");
    EXPECT_EQ(editor().status, "Paint has Ctrl+S now, and so has Save");
    host->settle();
    EXPECT_TRUE(ui::widgets().contains("Shortcuts/tools.paint/Conflict"));
    EXPECT_TRUE(ui::widgets().contains("Shortcuts/file.save/Conflict"));
    EXPECT_FALSE(ui::widgets().contains("Shortcuts/tools.fill/Conflict"));
}

TEST_F(WindowTest, FillSaysHowFarItGoesBeforeTheClick) {
    look_down();
    ASSERT_EQ(run("command tools.fill"), "");
    editor().brush = ice;
    ASSERT_EQ(run("viewport hover @3.5,0,3.5"), "");
    EXPECT_EQ(tool_preview(editor()), "Fill 64 faces with ice");
    EXPECT_TRUE(ui::widgets().contains("Viewport/Tool preview"));
    ASSERT_EQ(run("viewport click @3.5,0,3.5"), "");
    EXPECT_EQ(editor().status, "Painted ice on 64 faces");
    editor().brush.reset();
    EXPECT_EQ(tool_preview(editor()), "Unset 64 faces");
    ASSERT_EQ(run("park_mouse"), "");
    EXPECT_FALSE(ui::widgets().contains("Viewport/Tool preview"));
}

// With more ticks than pixels a marker covers many of them; a press anywhere on it means its event.
TEST_F(WindowTest, APressOnAnEventsMarkerTakesItsTick) {
    editor().document->set_spawn({Vec3(4, 0.95, 6), 0.0});
    ASSERT_EQ(run("command playtest.start\nwait 30\nhold W 40\nhold W Space 5\nwait 900\nkey Escape\nfinish"),
              "");
    host->settle();
    const Lab& lab = editor().lab;
    ASSERT_GT(lab.ticks(), 900u);
    const ui::WidgetRect track = widget("Timeline/Track");
    const LabTrack strip = lab_track(lab, track.min, track.max);
    std::set<std::size_t> ticks;
    for (const SimulationEvent& event : lab.runs()[lab.explained()].run.events())
        if (std::string_view(event.kind) == "jump") ticks.insert(event.tick);
    ASSERT_FALSE(ticks.empty());
    for (const std::size_t tick : ticks) {
        editor().lab.seek(0);
        host->move_mouse({strip.x(static_cast<double>(tick)) + 1.0f, track.min.y + 8.0f});
        host->frame();
        host->mouse_button(0, true);
        host->frame();
        host->mouse_button(0, false);
        host->frame();
        EXPECT_EQ(lab.cursor(), tick);
    }
}

TEST_F(WindowTest, ASlidersMarkLiesBelowItsNumber) {
    ASSERT_EQ(run("set gravity=20\npark_mouse"), "");
    ui::WidgetRect digits = widget("Movement/Gravity");
    // The line of text alone: the mark is as bright as the accent, the digits are not.
    const float middle = digits.centre().y, half = 0.35f * ImGui::GetFontSize();
    digits.min.y = middle - half;
    digits.max.y = middle + half;
    EXPECT_EQ(pixels_like(digits, ui::palette().accent, 50), 0);
    ui::WidgetRect below = widget("Movement/Gravity");
    below.min.y = below.max.y - 5.0f;
    EXPECT_GT(pixels_like(below, ui::palette().accent, 90), 4);
}

}  // namespace
}  // namespace slipface
