// A project: levels, presets and checks, as slipface nightly runs them all.
//
//   {
//     "slipface_nightly": 1,
//     "levels": ["levels/*.obj", "boss/boss.slipface.json"],   // from the file's folder; * and ? in names of
//     files "presets": ["level", "momentum", "presets/heavy.json"],   // "level": its own settings; the
//     default "checks": {                                               // a verb, and its options
//       "audit": "--walkers 200 --seconds 60",
//       "reach": "--rounds 400",
//       "doctor": "",
//       "snapshot": "--goldens screenshots"
//     }
//   }
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "slipface/base/result.h"

namespace slipface {

// A verb that a night runs.
struct NightCheck {
    const char* verb;
    bool per_level, per_preset;
    bool uses_all_cores;               // has processes of its own
    std::vector<std::string> command;  // after "slipface", before the level
    std::vector<std::string> refused;  // options that the night sets itself, or that would not repeat
};
const std::vector<NightCheck>& night_checks();

struct NightItem {
    const NightCheck* check = nullptr;
    std::string level, preset;  // from the project's folder; empty: none, or the level's own settings
    std::vector<std::string> options;
    std::uint64_t key = 0;  // of all that its result depends on

    std::string name() const;                  // "levels/easy.obj, momentum: audit"
    std::filesystem::path folder() const;      // of its files, below the report's
    std::vector<std::string> command() const;  // what repeats it, in the project's folder
};

struct Project {
    std::filesystem::path folder;
    std::uint64_t fingerprint = 0;  // of the file
    std::vector<NightItem> items;   // without their keys
};

// Errors name the file and the JSON path: unknown keys and checks, patterns that fit no file, refused
// options.
Result<Project> load_project(const std::filesystem::path& file);
// Of items with levels: fills in the keys. `program`: of the build.
void find_keys(Project& project, const std::string& program);

// Words as a shell reads them.
std::string shell_text(const std::vector<std::string>& words);

}  // namespace slipface
