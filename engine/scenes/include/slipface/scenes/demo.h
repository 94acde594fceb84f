// One small scene for each hack: its level, the run that shows it, and where to look. Editor demos, picture
// pairs, tests and benchmarks share them.
#pragma once

#include <filesystem>
#include <span>

#include "slipface/level/level.h"
#include "slipface/sim/tape.h"

namespace slipface {

struct Demo {
    Level level;          // in memory, without files; level.movement is `on`
    MovementSettings on;  // differs from `off` in the shown switch only
    MovementSettings off;
    Tape tape;              // says where it starts: at level.spawn
    CameraBookmark camera;  // also the level's only one
};

// One row a demo.
struct DemoInfo {
    const char* name;     // "step-up": of its files, pictures and commands
    const char* hack;     // the switch in settings_table() that it shows
    const char* title;    // "Step up"
    const char* look_at;  // what happens with the switch off, and on: one sentence
    Demo (*build)();      // everything but what make_demo adds
};
std::span<const DemoInfo> demo_table();
const DemoInfo* find_demo(std::string_view name);

// The same demo every time.
Demo make_demo(const DemoInfo& info);

// Writes NAME.obj, NAME.mtl, NAME.slipface.json, NAME.tape and, where there is terrain, NAME-terrain.png into
// `folder`, which must exist. Returns the path of the OBJ.
Result<std::filesystem::path> save_demo(const DemoInfo& info, const std::filesystem::path& folder);

}  // namespace slipface
