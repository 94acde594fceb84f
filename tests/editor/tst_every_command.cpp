// Every command of the table, run as a person would: by its key, and through its menu. What it does has to be
// seen, and must not have been there before.
#include <gmock/gmock.h>

#include <fstream>
#include <map>
#include <thread>

#include "app_fixture.h"
#include "slipface/base/text.h"
#include "tools/commands/commands.h"
#include "tools/lab/audit_job.h"
#include "tools/lab/reach_job.h"

namespace slipface {
namespace {

class EveryCommand : public AppFixture {
  protected:
    // Each line that expects something fails as such.
    void expect_unmet(std::string_view lines) {
        for (const std::string_view line : split(lines, '\n'))
            if (line.starts_with("expect ")) {
                EXPECT_NE(run(std::string(line)), "") << line << ": holds before";
            }
    }
};

struct Case {
    std::string_view setup;  // lines of a script, so that the command can run
    // Lines of a script: each `expect` fails before the command and holds after it. Empty: the command's
    // check mark changes, or the window looks different.
    std::string_view expect;
};

// A walk, recorded.
constexpr std::string_view walk = "key F5\nwait 30\nhold W 30\nkey Escape\nfinish";
constexpr std::string_view walk_from_start =
    "key F5\nwait 30\nhold W 30\nkey Escape\nfinish\ncommand lab.start";

// By id, or by a family "brush." of ids. A command that needs nothing of this has no row: the mouse rests on
// face 36, faces 3 and 4 are selected, and the window must look different afterwards.
const std::map<std::string_view, Case>& cases() {
    static const std::map<std::string_view, Case> rows{
        {"file.save", {"key 2\nkey L\nkey 1\nkey L", "expect dirty no"}},
        {"file.quit", {"key 2\nkey L", ""}},
        {"file.keep_mine", {"", "expect changed_on_disk no\nexpect status \"Kept your changes*\""}},
        {"file.take_theirs", {"", "expect changed_on_disk no\nexpect dirty no"}},
        {"file.merge_by_face", {"", "expect changed_on_disk no\nexpect status \"Merged*\""}},
        {"interface.zoom_reset", {"key Ctrl+=", ""}},
        {"interface.dark", {"command interface.light", ""}},
        {"edit.undo", {"", "expect history 0"}},
        {"edit.redo", {"key Ctrl+Z", "expect history 1"}},
        {"edit.redo_alternative", {"key Ctrl+Z", "expect history 1"}},
        {"edit.fill_selection", {"key 2", "expect count ice 2"}},
        {"edit.unset_selection", {"key 2\nkey L", "expect count ice 0"}},
        {"edit.add_rule",
         {"select faces 0\nkey 2", "expect status \"1 rule added: ice\"\nexpect count ice 62"}},
        {"edit.replace_type", {"select faces 0-5\nkey 2\nviewport hover @0.5,0,0.5", "expect count ice 6"}},
        {"edit.set_spawn", {"", "expect dirty yes"}},
        {"select.all", {"", "expect selected 72"}},
        {"select.none", {"", "expect selected 0"}},
        {"select.invert", {"", "expect selected 70"}},
        {"select.grow", {"", "expect selected 6"}},
        {"select.shrink", {"", "expect selected 0"}},
        {"select.middle", {"", "expect selected 1"}},
        {"select.behind", {"", "expect status \"*under the mouse\""}},
        {"select.hide", {"", "expect hidden 2\nexpect selected 0"}},
        {"select.isolate", {"", "expect hidden 70"}},
        {"select.show_all", {"key H", "expect hidden 0"}},
        {"select.flat", {"", "expect selected 64"}},
        {"select.smooth", {"", "expect selected 64"}},
        {"select.within_material", {"", "expect selected 64"}},
        {"select.within_type", {"", "expect selected 64"}},
        {"select.same_material", {"", "expect selected 64"}},
        {"select.same_type", {"", "expect selected 64"}},
        {"select.same_group", {"", "expect selected 72"}},
        {"select.same_direction", {"", "expect selected 64"}},
        {"select.same_area", {"", "expect selected 72"}},
        {"select.same_slope", {"", "expect selected 64"}},
        {"select.steep", {"", "expect selected 8"}},
        {"select.brush_type", {"key 3", "expect selected 8"}},
        {"select.painted", {"key 1\nkey L\nselect faces 9", "expect selected 2"}},
        {"select.type_", {"key 1", "expect status \"Select *: * selected\""}},
        {"select.save", {"", "expect saved 1"}},
        {"select.guessed", {"open cut.obj", "expect selected 2"}},
        {"select.next_guessed", {"open cut.obj", "expect status \"Guessed paint 1 of 2: ice\""}},
        {"select.previous_guessed", {"open cut.obj", "expect status \"Guessed paint 2 of 2: ice\""}},
        {"select.accept_guessed", {"open cut.obj", "expect status \"2 guesses accepted\""}},
        {"select.accept_guess",
         {"open cut.obj\ncommand select.next_guessed", "expect status \"1 guess accepted, 1 left\""}},
        {"select.drop_guess",
         {"open cut.obj\ncommand select.next_guessed",
          "expect status \"1 guess dropped, 1 left\"\nexpect count ice 1"}},
        {"select.accept_part",
         {"open cut.obj\ncommand select.next_guessed", "expect status \"2 guesses accepted, 0 left\""}},
        {"select.drop_guessed",
         {"open cut.obj", "expect status \"2 guesses dropped, 0 left\"\nexpect count ice 0"}},
        {"select.two_readings", {"open tiles.obj", "expect selected 2"}},
        {"select.take_reading", {"open tiles.obj", "expect status \"The other reading*\""}},
        {"select.keep_reading", {"open tiles.obj", "expect status \"The paint was kept*\""}},
        {"select.recall_",
         {"select save a\nselect save b\nselect save c\nselect save d\nselect save e\nselect save f\nselect "
          "save g\n"
          "select save h\nselect save i\nselect faces 70",
          "expect selected 2"}},
        {"select.box", {"key Shift+Q", "expect checked \"Toolbar/Options/Drag a box\" yes"}},
        {"paint.", {"", "expect dirty yes"}},
        {"paint.1", {"key 2\nkey L", "expect count ice 0"}},
        {"tools.select", {"key B", "expect tool select"}},
        {"tools.smaller_brush", {"key B\nkey ]\nkey ]", ""}},
        {"tools.pick_surface", {"key 2", "expect brush default"}},
        {"tools.larger_brush", {"key B", ""}},
        {"tools.clear_probe", {"key T\nviewport click @4.5,0,4.5", ""}},
        {"brush.1", {"key 2", "expect brush default"}},
        {"brush.2", {"key 1", "expect brush ice"}},
        {"movement.preset.platformer", {"set walk_speed=2", "expect setting walk_speed=6"}},
        {"movement.reset", {"set walk_speed=2", "expect history 3"}},
        {"view.back_faces_automatic", {"command view.back_faces_never", ""}},
        {"view.one_pane", {"key Ctrl+Alt+2", "expect panes 1"}},
        {"view.two_panes", {"", "expect panes 2"}},
        {"view.three_panes", {"", "expect panes 3"}},
        {"view.four_panes", {"", "expect panes 4"}},
        {"view.next_pane", {"key Ctrl+Alt+2\npark_mouse", ""}},
        {"view.maximise", {"key Ctrl+Alt+4\npark_mouse", ""}},
        {"view.top", {"", "expect view Top"}},
        {"view.bottom", {"", "expect view Bottom"}},
        {"view.front", {"", "expect view Front"}},
        {"view.back", {"", "expect view Back"}},
        {"view.right", {"", "expect view Right"}},
        {"view.left", {"", "expect view Left"}},
        {"view.orthographic", {"", "expect view Orthographic"}},
        {"view.reset_layout", {"key Ctrl+H", ""}},
        {"view.turn_up", {"key Shift+Down\nkey Shift+Down", ""}},
        {"view.frame_all", {"camera eye 1,1,1 target 1,0,0", ""}},
        {"camera.add", {"", "expect cameras 1"}},
        {"camera.replace", {"camera save a\ncamera eye 1,1,1 target 1,0,0", "expect history 3"}},
        {"camera.delete", {"camera save a", "expect cameras 0"}},
        {"camera.",
         {"camera save a\ncamera save b\ncamera save c\ncamera save d\ncamera save e\ncamera save f\n"
          "camera save g\ncamera save h\ncamera save i\ncamera eye 1,1,1 target 1,0,0",
          "expect status \"Camera: ?\""}},
        {"review.open", {"", ""}},
        {"review.", {"review report.json", ""}},
        {"review.previous", {"review report.json\nkey Alt+PageDown", ""}},
        {"review.reject", {"review report.json", "expect status \"first: rejected\""}},
        {"review.skip", {"review report.json", "expect status \"first: skipped\""}},
        // No program is there that could approve.
        {"review.approve", {"review report.json", "expect message \"*approve*\""}},
        {"review.camera", {"review report.json", "expect status \"Looking from where first was taken\""}},
        {"playtest.start", {"", "expect playing yes"}},
        {"playtest.stop", {"key F5", "expect playing no"}},
        {"playtest.restart",
         {"key F5\nhold W 30\nkey Escape\nfinish\nkey F5\nhold W 30", "key Escape\nfinish\nexpect tape ?"}},
        {"playtest.from_here", {"", "expect playing yes"}},
        {"playtest.from_view", {"", "expect playing yes"}},
        {"playtest.toggle_person", {"key F5", ""}},
        {"tools.copy_probe_command", {"key T\nviewport click @4.5,0,4.5", "expect status \"*copied*\""}},
        {"tools.copy_probe_test", {"key T\nviewport click @4.5,0,4.5", "expect status \"*copied*\""}},
        {"tools.props", {"", "expect tool props"}},
        {"props.move", {"command props.rotate", ""}},
        {"props.place", {"prop file grid.obj", "expect props 1"}},
        {"props.duplicate", {"prop place grid.obj 0,3,0", "expect props 2"}},
        {"props.delete", {"prop place grid.obj 0,3,0", "expect props 0"}},
        {"props.paint", {"key 2\nprop place grid.obj 0,3,0", "expect count ice 72"}},
        {"props.choose",
         {"prop place grid.obj 0,3,0\nselect faces 0\nviewport hover @4.5,3,4.5", "expect selected 72"}},
        {"lab.", {walk, ""}},
        {"lab.open_tape", {"", ""}},
        {"lab.open_recording",
         {"key 2\nkey L\nautosave\nkey F5\nwait 30\nhold W 30\nkey Escape\nfinish", ""}},
        {"lab.reach", {"", ""}},
        {"lab.copy_tape", {walk, "expect status \"Tape copied\""}},
        {"lab.copy_story", {walk, "expect status \"Story copied\""}},
        {"lab.close_tape", {walk, "expect tape 0"}},
        {"lab.play", {walk_from_start, ""}},
        {"lab.step_forward", {walk_from_start, "expect tick 1"}},
        {"lab.next_event", {walk_from_start, ""}},
        {"lab.end", {walk_from_start, ""}},
        {"lab.start", {walk, "expect tick 0"}},
        {"lab.loop", {walk, "expect checked \"Timeline/Transport/Loop\" yes"}},
        {"lab.resume", {walk, "expect playing yes"}},
        {"lab.pin", {walk, "expect ghosts 3"}},
        {"reach.clear", {"command reach.run\nfinish", "expect no_widget \"Reach/Clear\""}},
        {"reach.path", {"command reach.run\nfinish\nselect faces 36", "expect status \"Face 36 *\""}},
        {"reach.add_goal", {"", "expect status \"Added Goal 1\""}},
        {"audit.clear", {"command audit.run\nfinish", "expect no_widget \"Audit/Clear\""}},
    };
    return rows;
}

// The row for the id, or for the longest family that it belongs to.
Case case_of(std::string_view id) {
    Case found;
    std::size_t length = 0;
    for (const auto& [name, one] : cases()) {
        const bool family = (name.ends_with(".") || name.ends_with("_")) && id.starts_with(name);
        if ((id == name || family) && name.size() >= length) {
            found = one;
            length = name.size();
        }
    }
    return found;
}

// As the menus show it: Menu, submenu, label.
std::string menu_path(const Command& command) {
    return std::string(command.menu) + "/" + command.label;
}

TEST_F(EveryCommand, DoesSomethingThatCanBeSeenByItsKeyAndByItsMenu) {
    // A type for every digit, so that each key of a type has one.
    std::vector<SurfaceType> surfaces = document().level().surfaces;
    for (int digit = static_cast<int>(surfaces.size()); digit <= 9; ++digit) {
        SurfaceType type;
        type.name = "type " + std::to_string(digit);
        type.hotkey = digit;
        surfaces.push_back(type);
    }
    editor().document->set_surfaces(surfaces, "Types");
    ASSERT_TRUE(editor().document->save().ok());
    // A level whose painted face was cut in two since it was saved.
    const FaceId painted = 0;
    editor().document->paint(std::span(&painted, 1), SurfaceId{1});
    ASSERT_TRUE(editor().document->save_as(folder / "cut.slipface.json").ok());
    std::string cut = read_text(folder / "cut.slipface.json");
    write_text(folder / "cut.slipface.json", cut.replace(cut.find("grid.obj"), 8, "cut.obj"));
    write_text(folder / "cut.obj", obj_with_cut_face(n));
    write_text(folder / "tiles.obj", tiles(0, 12));
    open_level(editor(), folder / "tiles.obj");
    editor().document->paint(std::vector<FaceId>{5}, ice);
    ASSERT_TRUE(editor().document->save().ok());
    write_text(folder / "tiles.obj", tiles(1, 12));
    std::ofstream(folder / "report.json")
        << R"({"version": 1, "goldens": "goldens", "entries": [{"name": "first", "state": "different"},
              {"name": "second", "state": "missing"}]})";
    std::ofstream(folder / "first.actual.json")
        << R"({"version": 1, "camera": {"eye": [4, 6, 9], "target": [4, 0, 4], "fov_y": 1}})";
    struct Run {
        const Command* command;
        bool by_key;
    };
    // What a key does, its menu does, too: with the mouse over the menu instead of over a face.
    std::vector<Run> runs;
    for (const Command& command : commands()) {
        const bool has_key = !command.shortcut.key.empty();
        if (has_key) runs.push_back({&command, true});
        if (!has_key || *command.menu) runs.push_back({&command, false});
    }
    for (const auto& [row_of_table, by_key] : runs) {
        const Command& command = *row_of_table;
        SCOPED_TRACE(std::string(command.id) + (by_key ? " by key" : " by menu"));
        const std::string_view id = command.id;
        const bool cancels = id.ends_with(".cancel");
        const Case row = case_of(id);
        editor() = Editor{};
        ASSERT_EQ(run("open grid.obj\ncamera eye 4,14,9 target 4,0,4\nselect faces 3,4\nviewport hover "
                      "@4.5,0,4.5\n" +
                      std::string(row.setup)),
                  "");
        if (cancels) {
            editor().document->set_spawn({Vec3(4.5, 1.0, 4.5), 0.0});
            ASSERT_TRUE(editor().document->save().ok());
        }
        const bool answers = command.menu == std::string_view("File/Changed on disk");
        const std::string kept = answers ? read_text(level_file) : std::string();
        if (answers) {
            const std::unique_ptr<Document> other = Document::open(level_file).value();
            other->set_spawn({Vec3(4.5, 1.0, 4.5), 0.0});
            ASSERT_TRUE(other->save().ok());
            ASSERT_EQ(run("key 2\nkey L\nwait 200"), "");
        }
        // More than any machine is done with before the click comes.
        if (id == "audit.cancel") editor().audit = AuditJob::start(*editor().document, {2000, 600.0, 1});
        if (id == "reach.cancel")
            editor().reach = ReachJob::start(*editor().document, {.duration_s = 3600.0}, {}, nullptr);
        const auto history = editor().document->history_cursor();
        ASSERT_TRUE(command.enabled(editor())) << "its row in this table lacks a setup";
        expect_unmet(row.expect);
        const bool marked = command.checked != nullptr && command.checked(editor());
        const bool walking = editor().playtest.has_value();
        if (!by_key && !command.shortcut.key.empty()) {
            host->park_mouse();
            host->frame();
            host->frame();
            // The prop under the mouse has no other name.
            if (!command.enabled(editor()) && id == "props.choose") continue;
        }
        host->settle();
        const std::uint64_t before = host->app().frame_hash();
        const std::string how =
            by_key ? "key " + command.shortcut.text() : "menu \"" + menu_path(command) + "\"";
        // A message of a refused write ends the script, unless the next line expects it.
        const bool refused = row.expect.starts_with("expect message");
        const std::string expect = refused ? "\n" + std::string(row.expect) : "";
        std::string error = run(how + expect);
        // A menu longer than the window scrolls, and what is out of sight cannot be clicked.
        if (!by_key && error.find("no widget \"Menu/") != std::string::npos)
            error = run("key Escape\ncommand " + std::string(id) + expect);
        EXPECT_EQ(error, "") << how;
        EXPECT_EQ(run(std::string(row.expect)), "") << how;
        const bool changed_mark = command.checked != nullptr && command.checked(editor()) != marked;
        host->settle();
        if (row.expect.empty() && !changed_mark) {
            EXPECT_FALSE(walking) << "in a walk each frame looks different";
            EXPECT_NE(host->app().frame_hash(), before) << how;
        }
        if (answers) write_text(level_file, kept);
        if (!cancels) continue;
        if (id == "audit.cancel") {
            while (editor().audit->running())
                std::this_thread::yield();
            ASSERT_NE(editor().audit->report(), nullptr) << editor().audit->problem();
            EXPECT_TRUE(editor().audit->report()->cancelled);
            EXPECT_LT(editor().audit->progress(), 0.5);
        } else {
            while (editor().reach->running())
                std::this_thread::yield();
            EXPECT_LT(editor().reach->progress(), 0.5);
        }
        EXPECT_FALSE(editor().document->dirty());
        EXPECT_EQ(editor().document->history_cursor(), history);
        EXPECT_FALSE(command.enabled(editor()));
    }
}

}  // namespace
}  // namespace slipface
