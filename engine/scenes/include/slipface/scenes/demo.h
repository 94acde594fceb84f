// One small scene per hack: its level, a run that shows the hack, and a camera. Editor demos, image pairs,
// tests and benchmarks share them.
#pragma once

#include <filesystem>
#include <span>

#include "slipface/level/level.h"
#include "slipface/sim/tape.h"

namespace slipface {

struct Demo {
    Level level;          // in memory, without files; level.movement equals `on`
    MovementSettings on;  // differs from `off` only in the switch that is shown
    MovementSettings off;
    Tape tape;              // starts at level.spawn
    CameraBookmark camera;  // also the only camera of the level
};

// One row per demo.
struct DemoInfo {
    const char* name;     // of its files, images and commands: "step-up"
    const char* hack;     // the switch in settings_table() that the demo shows
    const char* title;    // "Step up"
    const char* look_at;  // what happens with the switch off and on
    Demo (*build)();      // everything except what make_demo adds
};
std::span<const DemoInfo> demo_table();
// Null if there is none.
const DemoInfo* find_demo(std::string_view name);

// Builds a demo; the result is the same every time.
Demo make_demo(const DemoInfo& info);

// Writes NAME.obj, NAME.mtl, NAME.slipface.json, NAME.tape and, if there is terrain, NAME-terrain.png into
// `folder`, which is created if it does not exist. Returns the path of the OBJ. Errors: a folder or file that
// cannot be written.
Result<std::filesystem::path> save_demo(const DemoInfo& info, const std::filesystem::path& folder);

}  // namespace slipface
