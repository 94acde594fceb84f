#include <gmock/gmock.h>

#include <map>
#include <set>

#include "level_fixture.h"
#include "slipface/level/find_start.h"
#include "slipface/level/preset.h"
#include "tools/commands/commands.h"
#include "tools/commands/docs.h"
#include "tools/commands/icons.h"
#include "tools/playtest/spawns.h"
#include "tools/selection/face_summary.h"
#include "tools/selection/selecting.h"
#include "tools/selection/surface_types.h"

namespace slipface {
namespace {

using testing::AnyOf;
using testing::ElementsAre;
using testing::HasSubstr;

class EditorTest : public LevelFixture {
  protected:
    void SetUp() override {
        LevelFixture::SetUp();
        open_level(editor, obj);
        ASSERT_TRUE(editor.document) << (editor.message ? editor.message->text : "");
    }
    // The face under a ray straight down.
    void point_at(double x, double z) { hover(editor, Ray{Vec3(x, 10, z), Vec3(0, -1, 0)}); }
    const Document& document() const { return *editor.document; }

    Editor editor;
};

TEST(CommandTable, EveryRowIsComplete) {
    std::set<std::string> ids;
    for (const Command& command : commands()) {
        SCOPED_TRACE(command.id);
        EXPECT_TRUE(ids.insert(command.id).second) << "twice";
        EXPECT_THAT(std::string(command.id), HasSubstr("."));
        EXPECT_STRNE(command.label, "");
        const std::string menu = command.menu;
        EXPECT_THAT(menu.substr(0, menu.find('/')),
                    AnyOf("File", "Edit", "Select", "View", "Tools", "Playtest", "Lab", "Help", ""));
        EXPECT_STRNE(command.description, "");
        EXPECT_STRNE(command.search, "");
        ASSERT_NE(command.enabled, nullptr);
        ASSERT_NE(command.run, nullptr);
        EXPECT_EQ(find_command(command.id), &command);
    }
    EXPECT_EQ(find_command("no.such"), nullptr);
    EXPECT_EQ(find_command(""), nullptr);
}

TEST(CommandTable, NoTwoCommandsShareAShortcut) {
    std::map<std::string, std::string> taken;
    for (const Command& command : commands()) {
        if (command.shortcut.key.empty()) continue;
        const auto [found, fresh] = taken.emplace(command.shortcut.text(), command.id);
        EXPECT_TRUE(fresh) << command.shortcut.text() << ": " << found->second << " and " << command.id;
        EXPECT_EQ(command_for(command.shortcut), &command);
    }
    EXPECT_GT(taken.size(), 30u);
    EXPECT_EQ(command_for({}), nullptr);
    EXPECT_EQ(command_for({"F12", true, true, true}), nullptr);
}

TEST(CommandTable, IconsAreFontAwesomeGlyphsOrOurOwn) {
    for (const Command& command : commands()) {
        const std::string icon = command.icon;
        if (icon.empty()) continue;
        ASSERT_EQ(icon.size(), 3u) << command.id;
        const auto byte = [&](std::size_t i) {
            return static_cast<unsigned>(static_cast<unsigned char>(icon[i]));
        };
        const unsigned code = (byte(0) & 0x0fu) << 12 | (byte(1) & 0x3fu) << 6 | (byte(2) & 0x3fu);
        EXPECT_EQ(byte(0) & 0xf0u, 0xe0u) << command.id;
        const bool own = icon == icons::lasso;
        EXPECT_TRUE(own || (code >= 0xf000 && code <= 0xf2e0)) << command.id;  // the range of version 4.7
    }
}

TEST(CommandTable, ShortcutsReadAsMenusShowThem) {
    EXPECT_EQ((Shortcut{"S", true, true, false}.text()), "Ctrl+Shift+S");
    EXPECT_EQ((Shortcut{"F5", false, false, true}.text()), "Alt+F5");
    EXPECT_EQ(Shortcut{}.text(), "");
    EXPECT_STREQ(command_for({"Z", true, false, false})->id, "edit.undo");
    EXPECT_STREQ(command_for({"Z", true, true, false})->id, "edit.redo");
    EXPECT_STREQ(command_for({"Y", true, false, false})->id, "edit.redo_alternative");
}

TEST(CommandTable, EverySwitchOfMovementHasACommand) {
    std::size_t switches = 0;
    for (const SettingInfo& info : settings_table()) {
        const bool is_switch = std::holds_alternative<bool MovementSettings::*>(info.member);
        EXPECT_EQ(find_command(std::string("movement.") + info.name) != nullptr, is_switch) << info.name;
        switches += is_switch ? 1 : 0;
    }
    EXPECT_GE(switches, 5u);
}

TEST(CommandTable, NothingBreaksWithoutALevel) {
    for (const Command& command : commands()) {
        Editor editor;
        run_command(editor, command.id);
        EXPECT_EQ(editor.document != nullptr, std::string_view(command.id).starts_with("lab.demo."))
            << command.id << ": a demo brings its own";
    }
}

TEST_F(EditorTest, EveryCommandRunsOnALevel) {
    const std::filesystem::path started_in = std::filesystem::current_path();
    std::filesystem::current_path(folder);  // where no review is
    for (const std::string state : {"plain", "selected", "hovered", "playing", "probing", "stroke"}) {
        for (const Command& command : commands()) {
            SCOPED_TRACE(state + " " + command.id);
            while (document().in_transaction())
                editor.document->commit();
            editor.playtest.reset();
            editor.hovered = no_id;
            editor.probe = {};
            editor.document->select({});
            if (state == "selected") editor.document->select({1, 2});
            if (state == "hovered") point_at(1.5, 1.5);
            if (state == "playing") start_playtest(editor);
            if (state == "probing") editor.probe.placed = true;
            if (state == "stroke") editor.document->begin("Stroke");
            const bool enabled = command.enabled(editor);
            EXPECT_EQ(run_command(editor, command.id), enabled);
            if (command.checked) command.checked(editor);
            // There is no report to review here, and the command says so.
            if (std::string_view(command.id) == "review.open") editor.message.reset();
            EXPECT_FALSE(editor.message.has_value());
            ASSERT_TRUE(editor.document);
        }
    }
    std::filesystem::current_path(started_in);
}

TEST_F(EditorTest, HackCommandsToggleUndoably) {
    ASSERT_TRUE(run_command(editor, "movement.keep_energy"));
    EXPECT_FALSE(document().level().movement.keep_energy);
    EXPECT_FALSE(find_command("movement.keep_energy")->checked(editor));
    EXPECT_EQ(document().history().back().name, "Switch off keep energy");
    ASSERT_TRUE(run_command(editor, "edit.undo"));
    EXPECT_TRUE(document().level().movement.keep_energy);
    EXPECT_FALSE(run_command(editor, "movement.reset"));  // nothing to reset
    run_command(editor, "edit.redo");
    ASSERT_TRUE(run_command(editor, "movement.reset"));
    EXPECT_EQ(document().level().movement, MovementSettings{});
}

TEST_F(EditorTest, DigitsChooseTheBrush) {
    ASSERT_TRUE(run_command(editor, "brush.3"));
    EXPECT_EQ(editor.brush, ladder);
    EXPECT_EQ(editor.tool, Tool::select) << "only commands of tools change the tool";
    EXPECT_TRUE(find_command("brush.3")->checked(editor));
    EXPECT_FALSE(run_command(editor, "brush.9"));  // the presets have no ninth type
    ASSERT_TRUE(run_command(editor, "brush.unset"));
    EXPECT_EQ(editor.brush, std::nullopt);
}

TEST_F(EditorTest, HoversFacesAndNothing) {
    point_at(2.5, 3.5);
    EXPECT_EQ(editor.hovered, 2u * n + 3u);
    EXPECT_LT((editor.hovered_point - Vec3(2.5, 0, 3.5)).norm(), 1e-9);
    EXPECT_LT((editor.hovered_normal - Vec3::UnitY()).norm(), 1e-9);
    point_at(-5, -5);
    EXPECT_EQ(editor.hovered, no_id);
}

TEST_F(EditorTest, PaintsFillsAndPicks) {
    editor.brush = ice;
    point_at(2.5, 3.5);
    paint_hovered(editor);
    EXPECT_EQ(document().face_count_of(ice), 1u);
    EXPECT_EQ(editor.status, "Painted ice on 1 face");
    editor.brush_radius = 0.6;
    paint_hovered(editor);
    EXPECT_EQ(document().face_count_of(ice), 5u);
    fill_hovered(editor);
    EXPECT_EQ(document().face_count_of(ice), 64u);
    hover(editor, Ray{Vec3(0, 0.5, 3.5), Vec3(1, 0, 0)});
    EXPECT_EQ(editor.hovered, wall + 3);
    pick_surface(editor);
    EXPECT_EQ(editor.brush, ladder);
}

TEST_F(EditorTest, ClicksSelectAddAndClear) {
    point_at(0.5, 0.5);
    click_select(editor, SelectBy::replace);
    point_at(1.5, 0.5);
    click_select(editor, SelectBy::toggle);
    EXPECT_THAT(document().selection(), ElementsAre(0, 8));
    click_select(editor, SelectBy::toggle);
    EXPECT_THAT(document().selection(), ElementsAre(0));
    point_at(-5, 0);
    click_select(editor, SelectBy::toggle);
    EXPECT_THAT(document().selection(), ElementsAre(0));
    click_select(editor, SelectBy::replace);
    EXPECT_TRUE(document().selection().empty());
}

TEST_F(EditorTest, SelectionCommands) {
    run_command(editor, "select.all");
    EXPECT_EQ(document().selection().size(), face_count);
    run_command(editor, "select.invert");
    EXPECT_TRUE(document().selection().empty());
    EXPECT_FALSE(run_command(editor, "select.none"));
    editor.brush = ladder;
    run_command(editor, "select.brush_type");
    EXPECT_THAT(document().selection(), ElementsAre(64, 65, 66, 67, 68, 69, 70, 71));
    editor.brush = ice;
    run_command(editor, "edit.fill_selection");
    EXPECT_EQ(document().face_count_of(ice), 8u);
    run_command(editor, "edit.unset_selection");
    EXPECT_EQ(document().face_count_of(ladder), 8u);
    run_command(editor, "select.none");
    EXPECT_TRUE(document().selection().empty());
}

TEST_F(EditorTest, HighlightsWhatTheToolWouldTouch) {
    point_at(2.5, 3.5);
    editor.document->select({1});
    const auto count = [&](std::uint8_t bit) {
        std::size_t lit = 0;
        for (const std::uint8_t face : face_highlights(editor, editor.document->face_count()).own)
            lit += (face & bit) != 0 ? 1 : 0;
        return lit;
    };
    EXPECT_EQ(count(1), 1u);
    EXPECT_EQ(count(2), 1u);
    editor.tool = Tool::paint;
    editor.brush_radius = 0.6;
    EXPECT_EQ(count(1), 5u);
    editor.brush_radius = 0.8;
    EXPECT_EQ(count(1), 9u);
    editor.tool = Tool::fill;
    EXPECT_EQ(count(1), 64u);
    editor.tool = Tool::probe;
    EXPECT_EQ(count(1), 0u);
}

TEST_F(EditorTest, BrushSizeCommandsGoUpAndDown) {
    EXPECT_FALSE(run_command(editor, "tools.smaller_brush"));
    run_command(editor, "tools.larger_brush");
    run_command(editor, "tools.larger_brush");
    EXPECT_GT(editor.brush_radius, 0.4);
    for (int i = 0; i < 30; ++i)
        run_command(editor, "tools.larger_brush");
    EXPECT_LT(editor.brush_radius, 1000.0);
    while (run_command(editor, "tools.smaller_brush")) {
    }
    EXPECT_EQ(editor.brush_radius, 0.0);
}

TEST_F(EditorTest, OverlayCommandRemembersItsStrength) {
    editor.style.overlay = 0.3f;
    run_command(editor, "view.overlay");
    EXPECT_EQ(editor.style.overlay, 0.0f);
    run_command(editor, "view.overlay");
    EXPECT_EQ(editor.style.overlay, 0.3f);
}

TEST_F(EditorTest, SpawnsAreAddedChosenRenamedAndDeletedUndoably) {
    const auto names = [&] {
        std::vector<std::string> list;
        for (const Spawn& spawn : all_spawns(document().level()))
            list.push_back(spawn.name);
        return list;
    };
    EXPECT_TRUE(names().empty());  // an OBJ alone has none
    for (const double x : {1.5, 3.5, 5.5}) {
        point_at(x, 2.5);
        ASSERT_TRUE(run_command(editor, "edit.add_spawn"));
    }
    EXPECT_EQ(names(), (std::vector<std::string>{"start", "Spawn 2", "Spawn 3"}));
    make_main_spawn(editor, 2);
    EXPECT_EQ(names(), (std::vector<std::string>{"Spawn 3", "start", "Spawn 2"}));
    EXPECT_LT((document().level().spawn - Vec3(5.5, 0.902, 2.5)).norm(), 1e-9);
    ASSERT_TRUE(run_command(editor, "playtest.start"));
    EXPECT_EQ(editor.playtest->state().position, document().level().spawn);
    ASSERT_TRUE(run_command(editor, "playtest.stop"));
    rename_spawn(editor, 1, "Spawn 2");  // taken
    EXPECT_NE(spawn_name_problem(document(), 1, "Spawn 2"), "");
    EXPECT_NE(spawn_name_problem(document(), 1, ""), "");
    rename_spawn(editor, 1, "door");
    remove_spawn(editor, 2);
    EXPECT_EQ(names(), (std::vector<std::string>{"Spawn 3", "door"}));
    const std::size_t steps = document().history_cursor();
    editor.document->set_spawns({{{0, 0, 0}, 0, "twin"}, {{0, 1, 0}, 0, "twin"}}, "Bad");
    editor.document->set_spawn({{std::numeric_limits<double>::quiet_NaN(), 0, 0}, 0});
    editor.document->set_spawn({{2e9, 0, 0}, 0});
    editor.document->set_fall_limit(std::numeric_limits<double>::infinity());
    EXPECT_EQ(document().history_cursor(), steps);
    for (int i = 0; i < 6; ++i)
        editor.document->undo();
    EXPECT_TRUE(names().empty());
    EXPECT_FALSE(document().dirty());
    for (int i = 0; i < 6; ++i)
        editor.document->redo();
    EXPECT_EQ(names(), (std::vector<std::string>{"Spawn 3", "door"}));
}

TEST_F(EditorTest, PlayFromHereBeginsUnderTheMouseAndRestartsThere) {
    point_at(6.5, 1.5);
    editor.view.yaw = 1.25;
    ASSERT_TRUE(run_command(editor, "playtest.from_here"));
    const Vec3 here(6.5, 0.902, 1.5);
    EXPECT_LT((editor.playtest->state().position - here).norm(), 1e-9);
    EXPECT_EQ(editor.playtest->yaw, 1.25);
    editor.playtest->advance(editor.lab.scene(document()), document().level().movement, {.stick = {1, 0}},
                             0.5);
    EXPECT_GT((editor.playtest->state().position - here).norm(), 0.1);
    ASSERT_TRUE(run_command(editor, "playtest.restart"));
    EXPECT_LT((editor.playtest->state().position - here).norm(), 1e-9);
    EXPECT_TRUE(document().history().empty());
}

TEST_F(EditorTest, PlayWithoutASpawnStandsOnTheFloorAndSaysSo) {
    ASSERT_TRUE(run_command(editor, "playtest.start"));
    EXPECT_THAT(editor.status, testing::HasSubstr("The level has no spawn"));
    editor.playtest->advance(editor.lab.scene(document()), document().level().movement, {}, 0.1);
    EXPECT_TRUE(editor.playtest->state().grounded);
}

TEST_F(EditorTest, EveryPresetIsACommandThatSaysWhetherItIsUsed) {
    for (const ShippedPreset& shipped : shipped_presets()) {
        const std::string id = std::string("movement.preset.") + shipped.id;
        ASSERT_TRUE(run_command(editor, id)) << id;
        EXPECT_EQ(document().level().movement, shipped.preset.settings);
        for (const ShippedPreset& other : shipped_presets())
            EXPECT_EQ(find_command(std::string("movement.preset.") + other.id)->checked(editor),
                      &other == &shipped);
    }
}

TEST_F(EditorTest, SpawnIsSetWhereThePlayerStands) {
    point_at(2.5, 3.5);
    editor.view.yaw = 0.4;
    ASSERT_TRUE(run_command(editor, "edit.set_spawn"));
    EXPECT_LT((document().level().spawn - Vec3(2.5, 0.902, 3.5)).norm(), 1e-9);
    EXPECT_EQ(document().level().spawn_yaw, 0.4);
    ASSERT_TRUE(run_command(editor, "playtest.start"));
    EXPECT_EQ(editor.playtest->state().position, document().level().spawn);
    EXPECT_EQ(editor.playtest->tape().level_name, "grid.obj");
    ASSERT_TRUE(run_command(editor, "playtest.toggle_person"));
    ASSERT_TRUE(run_command(editor, "playtest.restart"));
    EXPECT_TRUE(editor.playtest->first_person);
    ASSERT_TRUE(run_command(editor, "playtest.stop"));
    EXPECT_FALSE(editor.playtest);
    EXPECT_FALSE(run_command(editor, "playtest.toggle_person"));
}

TEST_F(EditorTest, FailedOpenLeavesTheLevelUntouched) {
    editor.document->paint(std::vector<FaceId>{1}, ice);
    const Document* before = editor.document.get();
    for (const std::filesystem::path& path : {folder / "missing.obj", folder, std::filesystem::path()}) {
        editor.message.reset();
        open_level(editor, path);
        ASSERT_TRUE(editor.message.has_value()) << path;
        EXPECT_THAT(editor.message->title, HasSubstr("Cannot open"));
        EXPECT_EQ(editor.document.get(), before);
    }
    EXPECT_TRUE(editor.document->dirty());
}

TEST_F(EditorTest, AsksBeforeLosingChanges) {
    request_quit(editor);
    EXPECT_TRUE(editor.quit);
    editor.quit = false;
    editor.document->paint(std::vector<FaceId>{1}, ice);
    request_quit(editor);
    EXPECT_FALSE(editor.quit);
    ASSERT_TRUE(editor.unsaved.has_value());
    answer_unsaved(editor, UnsavedChoice::cancel);
    EXPECT_FALSE(editor.unsaved || editor.quit);
    EXPECT_TRUE(editor.document->dirty());

    write_text(folder / "other.obj", floor_and_wall_obj(2));
    request_open(editor, folder / "other.obj");
    ASSERT_TRUE(editor.unsaved.has_value());
    answer_unsaved(editor, UnsavedChoice::save);
    EXPECT_EQ(document().face_count(), 6u);
    EXPECT_THAT(read_text(level_file), HasSubstr("ice"));

    editor.document->paint(std::vector<FaceId>{1}, ice);
    request_quit(editor);
    answer_unsaved(editor, UnsavedChoice::discard);
    EXPECT_TRUE(editor.quit);
    EXPECT_FALSE(std::filesystem::exists(folder / "other.slipface.json"));
}

TEST_F(EditorTest, StaysWhenSavingFails) {
    editor.document->paint(std::vector<FaceId>{1}, ice);
    std::filesystem::create_directories(level_file / "in the way");
    request_quit(editor);
    answer_unsaved(editor, UnsavedChoice::save);
    EXPECT_FALSE(editor.quit);
    EXPECT_TRUE(editor.message.has_value());
    EXPECT_TRUE(editor.document->dirty());
}

TEST_F(EditorTest, StrokeUnderWayCountsAsUnsaved) {
    editor.document->begin("Paint ice");
    editor.document->paint(std::vector<FaceId>{1}, ice);
    request_quit(editor);
    EXPECT_TRUE(editor.unsaved.has_value());
    EXPECT_FALSE(editor.document->in_transaction());
}

TEST_F(EditorTest, SaveAsAddsTheEnding) {
    save_level_as(editor, folder / "copy");
    EXPECT_TRUE(std::filesystem::exists(folder / "copy.slipface.json"));
    EXPECT_FALSE(editor.message.has_value());
    save_level_as(editor, obj);
    EXPECT_TRUE(editor.message.has_value());
}

TEST_F(EditorTest, TypesAreAddedAndRemoved) {
    const auto added = add_surface_type(editor);
    ASSERT_TRUE(added.has_value());
    EXPECT_EQ(editor.brush, added);
    EXPECT_EQ(document().level().surfaces.back().hotkey, 9);
    remove_brush_type(editor);
    EXPECT_EQ(document().level().surfaces.size(), 8u);
    EXPECT_EQ(editor.brush, default_surface);
    while (add_surface_type(editor)) {
    }
    EXPECT_EQ(document().level().surfaces.size(), max_surface_types);
    std::set<std::string> names;
    for (const SurfaceType& type : document().level().surfaces)
        names.insert(type.name);
    EXPECT_EQ(names.size(), max_surface_types);
}

TEST_F(EditorTest, UndoneTypeIsNoBrush) {
    ASSERT_TRUE(add_surface_type(editor).has_value());
    ASSERT_TRUE(run_command(editor, "edit.undo"));
    EXPECT_EQ(editor.brush, default_surface);
}

TEST_F(EditorTest, ATakenHotkeyChangesHands) {
    SurfaceType changed = document().level().surfaces[ice];
    changed.hotkey = 3;
    change_surface_type(*editor.document, ice, changed, "Change key");
    EXPECT_EQ(document().level().surfaces[ice].hotkey, 3);
    EXPECT_EQ(document().level().surfaces[ladder].hotkey, 0);
    run_command(editor, "brush.3");
    EXPECT_EQ(editor.brush, ice);
}

TEST_F(EditorTest, SummarySaysWhatFacesShare) {
    const FaceSummary floor = summarize_faces(document(), std::vector<FaceId>{0, 1, 2});
    EXPECT_EQ(floor.faces, 3u);
    EXPECT_EQ(floor.triangles, 6u);
    EXPECT_NEAR(floor.area, 3.0, 1e-9);
    EXPECT_EQ(floor.material, "floor");
    EXPECT_EQ(floor.surface, default_surface);
    EXPECT_NEAR(floor.slope_max, 0.0, 1e-9);
    editor.document->paint(std::vector<FaceId>{0}, ice);
    const FaceSummary mixed = summarize_faces(document(), std::vector<FaceId>{0, 1, wall, no_id});
    EXPECT_EQ(mixed.faces, 3u);
    EXPECT_EQ(mixed.painted, 1u);
    EXPECT_EQ(mixed.material, std::nullopt);
    EXPECT_EQ(mixed.surface, std::nullopt);
    EXPECT_EQ(mixed.source, std::nullopt);
    EXPECT_NEAR(mixed.slope_max, 1.5707963, 1e-6);
    EXPECT_EQ(summarize_faces(document(), {}).faces, 0u);
}

std::string in_code(const char* name) {
    return std::string("`").append(name).append("`");
}

TEST(Docs, ListEveryCommandSettingAndParameter) {
    const std::string page = commands_markdown();
    for (const Command& command : commands()) {
        EXPECT_THAT(page, HasSubstr(in_code(command.id)));
        EXPECT_THAT(page, HasSubstr(command.description));
    }
    const std::string settings = settings_markdown();
    for (const SettingInfo& info : settings_table())
        EXPECT_THAT(settings, HasSubstr(in_code(info.name)));
    for (const SurfaceField& field : surface_fields())
        EXPECT_THAT(settings, HasSubstr(in_code(field.name)));
    EXPECT_THAT(settings, HasSubstr("50 deg"));  // the default slope, not 0.8727
}

}  // namespace
}  // namespace slipface
