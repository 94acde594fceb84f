// A tape with the level and the settings that it runs under: what simulate, why and compare begin with.
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
    std::filesystem::path level;
    std::filesystem::path tape;
    std::vector<std::string> settings = {};  // "name=value"; after the level's and the tape's, so they win
    std::optional<std::string> preset = {};  // name or file; instead of the level's and the tape's settings
    std::string spawn = {};                  // its name; instead of where the tape begins
};

struct TapeOnLevel {
    std::unique_ptr<LoadedLevel> loaded;  // at a place of its own, which `scene` refers to
    Tape tape;
    MovementSettings settings;
    Vec3 start = Vec3::Zero();
    LevelScene scene;
    Warnings warnings;  // the tape was recorded on something else
};

Result<TapeOnLevel> load_tape_on_level(const TapeOptions& options);

}  // namespace slipface::cli
