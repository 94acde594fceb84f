// What the commands and panels of the movement lab do to the Editor.
#pragma once

#include <filesystem>

#include "tools/editor.h"

namespace slipface {

struct DemoInfo;
struct Preset;

// The tape of the playtest that ends goes to the lab, its cursor at the end.
void take_playtest_tape(Editor& editor);
// Before another level is opened: a recorded run that is in no file goes to editor.kept_tapes.
void keep_tape(Editor& editor);
// After it was opened: the newest run that was kept for it, if there is one, is in the lab again.
void bring_back_tape(Editor& editor);
void show_lab(Editor& editor);       // its panels
void complete_runs(Editor& editor);  // now; tapes that end after a few minutes take milliseconds
// Each reports failure as a MessageDialog and leaves the lab as it was.
void open_tape(Editor& editor, const std::filesystem::path& path);
void save_tape(Editor& editor, const std::filesystem::path& path);
void save_run_csv(Editor& editor, const std::filesystem::path& path);
// Walks on from the cursor's tick; what comes after it on the tape is recorded anew.
void resume_from_cursor(Editor& editor);

// Where to look at `place` from, about `distance` metres away and with nothing in between: from where the
// camera looks now if that is free, else from around it, on the side of `normal` (zero: any side).
Vec3 viewpoint(const CollisionWorld& world, const Vec3& position, const Vec3& normal, const Vec3& from_now,
               double distance);
// Lights up a line of the told tick's story and brings the camera there.
void look_at_story_line(Editor& editor, std::size_t line);
void look_at_cursor(Editor& editor);  // the camera to the player at the cursor

// Opens the run of an audit's finding at the tick before it went wrong, and looks there.
void open_finding(Editor& editor, std::size_t finding);

// Opens a hack's demo scene with its tape and, as a ghost, the run with its switch off. Asks first when there
// are unsaved changes; a walk that is going on goes on until that is answered.
void open_demo(Editor& editor, const DemoInfo& info);
void show_demo(Editor& editor, const DemoInfo& info);  // asks nothing

// A whole set of settings as one step of history.
void use_preset(Editor& editor, const Preset& preset);

// The setting as one step of history; refused ones are left out.
void apply_setting(Editor& editor, const std::string& assignment);

namespace lab_actions {
bool can_use_tape(const Editor& editor);  // there is one, and nobody walks
bool is_moving_forward(const Editor& editor);
bool is_moving_backward(const Editor& editor);
bool loops(const Editor& editor);
bool can_pin(const Editor& editor);

void ask_open_tape(Editor& editor);
bool has_recordings(const Editor& editor);
void ask_open_recording(Editor& editor);
void ask_save_tape(Editor& editor);
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
