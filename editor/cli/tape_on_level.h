// A tape with its level and settings: the input of simulate, why and compare.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "slipface/level/level_file.h"
#include "slipface/sim/run.h"

namespace slipface::cli {

struct TapeOptions {
    std::filesystem::path level;             // or a capsule, which has its tape
    std::filesystem::path tape;              // empty: the capsule's
    std::vector<std::string> settings = {};  // "name=value"; override the level's and the tape's
    std::optional<std::string> preset = {};  // name or file; replaces the level's and the tape's settings
    std::string spawn = {};                  // name of a spawn; replaces the tape's start
};

struct TapeOnLevel {
    std::unique_ptr<LoadedLevel> loaded;  // on the heap: `scene` refers to it
    Tape tape;
    MovementSettings settings;
    Vec3 start = Vec3::Zero();
    LevelScene scene;
    Warnings warnings;   // the tape was recorded on another level
    std::string source;  // of the tape, for messages: its file, or the capsule
};

// Whether the level is a capsule, which has its tape.
bool brings_tape(const std::filesystem::path& level);

Result<TapeOnLevel> load_tape_on_level(const TapeOptions& options);

}  // namespace slipface::cli
