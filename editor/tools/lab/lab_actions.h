// Actions of the movement lab's commands and panels on the Editor.
#pragma once

#include <filesystem>

#include "tools/editor.h"

namespace slipface {

struct DemoInfo;
struct Preset;

// Moves the tape of the ending playtest to the lab, with the cursor at the end.
void take_playtest_tape(Editor& editor);
// Called before another level is opened: stores an unsaved recorded run in editor.stored_tapes.
void store_tape(Editor& editor);
// Called after a level was opened: puts its newest stored run, if any, back into the lab.
void restore_tape(Editor& editor);
void show_lab(Editor& editor);       // its panels
void complete_runs(Editor& editor);  // now; tapes that end after a few minutes take milliseconds
// Each reports failure as a MessageDialog and leaves the lab as it was.
void open_tape(Editor& editor, const std::filesystem::path& path);
void add_tape(Editor& editor, const std::filesystem::path& path);  // as a ghost beside the open one
void save_tape(Editor& editor, const std::filesystem::path& path);
// Before the lab's tape is replaced: one that was edited and not saved goes to the recordings.
void keep_edited_tape(Editor& editor);
// Reads the open tape's file again if another program wrote it. True: it was.
bool look_at_tape_file(Editor& editor);
void save_run_csv(Editor& editor, const std::filesystem::path& path);
// Starts a playtest at the cursor's tick; the run that it leaves stays as a ghost.
void resume_from_cursor(Editor& editor);

// A viewpoint about `distance` metres from `position` with free sight of it. Prefers the direction from
// `position` to `from_now`, then others around it, on the side of `normal` (zero: any side). If all are
// blocked, the one with the longest free sight.
Vec3 viewpoint(const CollisionWorld& world, const Vec3& position, const Vec3& normal, const Vec3& from_now,
               double distance);
// Highlights a line of the selected tick's story and moves the camera there.
void look_at_story_line(Editor& editor, std::size_t line);
void look_at_cursor(Editor& editor);  // moves the camera to the player at the cursor

// Opens the run of an audit finding at the tick before the error and moves the camera there.
void open_finding(Editor& editor, std::size_t finding);

// Opens a hack's demo scene with its tape; a ghost shows the run with the hack off. Asks first if there are
// unsaved changes; a running playtest goes on until the answer.
void open_demo(Editor& editor, const DemoInfo& info);
void show_demo(Editor& editor, const DemoInfo& info);  // asks nothing
// The demo that the open level is; null: it is none.
const DemoInfo* shown_demo(const Editor& editor);

// A whole set of settings as one step of history.
void use_preset(Editor& editor, const Preset& preset);

// Changes a setting as one step of history; a refused one has no effect.
void apply_setting(Editor& editor, const std::string& assignment);

namespace lab_actions {
bool can_use_tape(const Editor& editor);  // there is a tape and no playtest
bool is_moving_forward(const Editor& editor);
bool is_moving_backward(const Editor& editor);
bool loops(const Editor& editor);
bool can_pin(const Editor& editor);

void ask_open_tape(Editor& editor);
bool has_recordings(const Editor& editor);
void ask_open_recording(Editor& editor);
void ask_add_tape(Editor& editor);
void ask_import_run(Editor& editor);
void ask_save_tape(Editor& editor);
void ask_save_capsule(Editor& editor);
void ask_save_csv(Editor& editor);
void close_tape(Editor& editor);
void play(Editor& editor);
void reverse(Editor& editor);
void step_forward(Editor& editor);
void step_back(Editor& editor);
void to_start(Editor& editor);
void to_end(Editor& editor);
void next_event(Editor& editor);
void previous_event(Editor& editor);
void toggle_loop(Editor& editor);
void pin_now(Editor& editor);
void copy_tape(Editor& editor);
void copy_story(Editor& editor);
void copy_link(Editor& editor);
void copy_probe_command(Editor& editor);
void copy_probe_test(Editor& editor);
void toggle_reach(Editor& editor);
bool shows_reach(const Editor& editor);
bool audit_can_start(const Editor& editor);
bool audit_runs(const Editor& editor);
bool has_audit(const Editor& editor);
void run_audit_job(Editor& editor);
void cancel_audit(Editor& editor);
void clear_audit(Editor& editor);
}  // namespace lab_actions

}  // namespace slipface
