// Commands of the movement lab.
#include "slipface/scenes/demo.h"
#include "tools/commands/command_actions.h"
#include "tools/commands/command_rows.h"
#include "tools/commands/icons.h"
#include "tools/lab/lab_actions.h"
#include "tools/lab/reach_job.h"

namespace slipface {

using namespace command_actions;
using namespace lab_actions;

namespace {

// One for each demo, in the lecture's order.
void add_demo_commands(std::vector<Command>& rows) {
    for (const DemoInfo& info : demo_table())
        rows.push_back({lasting(std::string("lab.demo.") + info.name), "", info.title, "Lab/Demos",
                        info.problem, "demo lecture course hack card scene exercise example", no_key(),
                        always, [&info](const Editor& e) { return shown_demo(e) == &info; },
                        [&info](Editor& e) { open_demo(e, info); }});
}

}  // namespace

std::vector<Command> lab_commands() {
    std::vector<Command> rows{
        {"tools.clear_probe", icons::trash, "Clear probe", "Tools", "Remove the sweep probe", "remove delete",
         key("Delete"), probe_is_placed, nullptr, clear_probe},
        {"tools.copy_probe_command", icons::copy, "Copy probe's command", "Tools",
         "Copy the command line that repeats the probe's first sweep", "sweep terminal", no_key(),
         probe_is_placed, nullptr, copy_probe_command},
        {"tools.copy_probe_test", icons::copy, "Copy probe as a test", "Tools",
         "Copy a test for slipface sweep LEVEL --test FILE", "regression sweep", no_key(), probe_is_placed,
         nullptr, copy_probe_test},

        {"lab.open_tape", icons::folder_open, "Open tape…", "Lab",
         "Open a recorded run, or a capsule with its level, and inspect every tick of it",
         "replay recording bug report load capsule", ctrl_shift("O"), always, nullptr, ask_open_tape},
        {"lab.open_recording", icons::history, "Open recording…", "Lab",
         "Open one of the last 32 recorded runs, which are stored automatically", "recent tape playtest lost",
         no_key(), has_recordings, nullptr, ask_open_recording},
        {"lab.add_tape", icons::ghost, "Add a tape…", "Lab",
         "Open another tape beside this one, as a ghost: two attempts, or a colleague's",
         "compare attempts best several", no_key(), can_pin, nullptr, ask_add_tape},
        {"lab.import_run", icons::ghost, "Import run…", "Lab",
         "Open positions that a controller of another engine recorded, beside Slipface's mover with the same "
         "inputs",
         "unity unreal godot three rapier csv recorded external controller", no_key(), has_document, nullptr,
         ask_import_run},
        {"lab.save_tape", icons::save, "Save tape…", "Lab",
         "Write the run as a small text file that repeats it bit for bit",
         "replay recording bug report write", no_key(), can_use_tape, nullptr, ask_save_tape},
        {"lab.save_capsule", icons::save, "Save capsule…", "Lab",
         "Write the run and its level as one file, which repeats it on any machine",
         "bug report send archive share everything", no_key(), can_use_tape, nullptr, ask_save_capsule},
        {"lab.export_csv", icons::table, "Export run as CSV…", "Lab",
         "Write the numbers of the selected run, one row per tick", "table spreadsheet numbers plot",
         no_key(), can_use_tape, nullptr, ask_save_csv},
        {"lab.copy_tape", icons::copy, "Copy tape", "Lab", "Copy the tape's text to the clipboard",
         "replay recording bug report", no_key(), can_use_tape, nullptr, copy_tape},
        {"lab.copy_story", icons::copy, "Copy story", "Lab",
         "Copy the story of the tick to the clipboard, one line per record", "why trace explain", no_key(),
         can_use_tape, nullptr, copy_story},
        {"lab.copy_link", icons::share, "Copy link", "Lab",
         "Copy the run, its tick and the level's changes as the end of an address for Slipface as a page",
         "url share capsule bug report send", no_key(), can_use_tape, nullptr, copy_link},
        {"lab.close_tape", icons::trash, "Close tape", "Lab", "Close the tape and its ghosts",
         "remove forget", no_key(), can_use_tape, nullptr, close_tape},

        {"lab.play", icons::play, "Play tape", "Lab", "Play the tape from the cursor, or pause it",
         "pause forward run", shift("Space"), can_use_tape, is_moving_forward, play},
        {"lab.reverse", icons::backward, "Play backwards", "Lab",
         "Play the tape backwards from the cursor, or pause it", "reverse rewind", ctrl("Space"),
         can_use_tape, is_moving_backward, reverse},
        {"lab.step_forward", icons::step_forward, "Next tick", "Lab", "Go one tick forward", "step frame",
         key("."), can_use_tape, nullptr, step_forward},
        {"lab.step_back", icons::step_back, "Previous tick", "Lab", "Go one tick back", "step frame",
         key(","), can_use_tape, nullptr, step_back},
        {"lab.next_event", icons::fast_forward, "Next event", "Lab",
         "Go to the next jump, landing, contact, surface change or push-out", "marker", alt("."),
         can_use_tape, nullptr, next_event},
        {"lab.previous_event", icons::fast_back, "Previous event", "Lab",
         "Go to the previous jump, landing, contact, surface change or push-out", "marker", alt(","),
         can_use_tape, nullptr, previous_event},
        {"lab.start", icons::to_start, "First tick", "Lab", "Go to the start of the tape", "begin", no_key(),
         can_use_tape, nullptr, to_start},
        {"lab.end", icons::to_end, "Last tick", "Lab", "Go to the end of the tape", "finish", no_key(),
         can_use_tape, nullptr, to_end},
        {"lab.loop", icons::redo, "Loop", "Lab", "Start again when playback reaches an end", "repeat",
         no_key(), can_use_tape, loops, toggle_loop},
        {"lab.look", icons::eye, "Look at the player", "Lab",
         "Move the camera to the player at the cursor's tick", "camera frame focus", alt("F"), can_use_tape,
         nullptr, look_at_cursor},
        {"lab.resume", icons::dot, "Walk on from here", "Lab",
         "Continue playing at the cursor's tick; the old run stays as a ghost", "rewind continue record",
         ctrl("F5"), can_use_tape, nullptr, resume_from_cursor},
        {"lab.pin", icons::pin, "Add settings as a ghost", "Lab",
         "Run the tape under the present settings as another ghost", "compare variant A/B", no_key(), can_pin,
         nullptr, pin_now},
        {"lab.reach", icons::flask, "Reach", "Lab",
         "Draw how far and how high a jump from here goes with the present settings",
         "jump arc distance gap height coyote", no_key(), has_document, shows_reach, toggle_reach},
        {"audit.run", icons::fire, "Run audit", "Lab",
         "Run random walkers through the level to find holes and traps", "test bots walkers heat map",
         no_key(), audit_can_start, nullptr, run_audit_job},
        {"audit.cancel", icons::stop, "Cancel audit", "Lab", "End the audit that is running", "stop",
         no_key(), audit_runs, nullptr, cancel_audit},
        {"audit.clear", icons::trash, "Clear audit", "Lab", "Clear the heat map and the findings", "remove",
         no_key(), has_audit, nullptr, clear_audit},
        {"reach.run", icons::map, "Search reach", "Lab",
         "Search for all that the player can reach from the spawn, and how",
         "reachable navigation where jump get to", no_key(), reach_can_start, nullptr, run_reach},
        {"reach.cancel", icons::stop, "Cancel search", "Lab",
         "End the search; what it found until then is shown", "stop reach", no_key(), reach_runs, nullptr,
         cancel_reach},
        {"reach.clear", icons::trash, "Clear reach", "Lab",
         "Take the colours and the lists of the search away", "remove", no_key(), has_reach, nullptr,
         clear_reach},
        {"reach.path", icons::ghost, "Show the path", "Lab",
         "Open the fastest path found to the selected face, or the attempt that came nearest, as a tape",
         "how get there ghost reach proof", no_key(), can_show_path, nullptr, show_path},
        {"reach.add_goal", icons::flag, "Add goal", "Lab",
         "Put a goal on the face in the middle of the view: a position to reach, checked by slipface reach "
         "--check",
         "reach never within test", no_key(), has_document, nullptr, add_goal},
    };
    add_demo_commands(rows);
    return rows;
}

}  // namespace slipface
