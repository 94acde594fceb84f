// One small scene per hack: its level, a run that shows the hack, and a camera. Editor demos, image pairs,
// tests and benchmarks share them.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "slipface/level/level.h"
#include "slipface/sim/tape.h"

namespace slipface {

struct Demo {
    Level level;          // in memory, without files; level.movement equals `on`
    MovementSettings on;  // differs from `off` only in the setting that is shown, if in any
    MovementSettings off;
    Tape tape;              // starts at level.spawn
    Tape off_tape;          // the same inputs; differs only in its mover, if in anything
    CameraBookmark camera;  // also the only camera of the level
};

// One row per demo.
struct DemoInfo {
    const char* name;           // of its files, images and commands: "step-up"
    const char* hack;           // the setting that the demo shows, mostly a switch
    const char* title;          // "Step up"
    const char* problem;        // with the switch off; a sentence. At most 25 words together with
    const char* cure;           // what it does
    Demo (*build)();            // everything except what make_demo adds
    const char* off = "";       // "max_slides=1" or "mover NAME"; empty: the switch is off
    FormulaInfo formula = {};   // in place of the hack's
    const char* exercise = "";  // a question beside that of exercise_of()
};
std::span<const DemoInfo> demo_table();
// Null if there is none.
const DemoInfo* find_demo(std::string_view name);

// "Problem. Cure."
std::string sentences_of(const DemoInfo& info);
// "step_up=off", "mover lecture-no-epsilon": what differs in the run that shows the problem.
std::string off_of(const DemoInfo& info);
// What differs by name: "step_up", "mover".
std::string changed_by(const DemoInfo& info);
// Whether the demo is about the lecture's own mover, and no hack of Slipface's.
bool plays_lecture(const DemoInfo& info);
// How to hand in a solution.
std::string exercise_of(const DemoInfo& info);
// Null if the hack has none.
const FormulaInfo* formula_of(const DemoInfo& info);

// Builds a demo; the result is the same every time.
Demo make_demo(const DemoInfo& info);

// Writes NAME.obj, NAME.mtl, NAME.slipface.json, NAME.tape, NAME-off.tape with the problem and, if there is
// terrain, NAME-terrain.png into `folder`, which is created if it does not exist. The level has a goal that
// the one tape reaches and the other does not: `slipface grade` passes a tape that a student made of the
// latter. Returns the path of the OBJ. Errors: a folder or file that cannot be written.
Result<std::filesystem::path> save_demo(const DemoInfo& info, const std::filesystem::path& folder);

}  // namespace slipface
