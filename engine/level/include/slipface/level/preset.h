// Whole sets of movement settings as files.
//
//   {
//     "slipface_preset": 1,
//     "name": "Momentum",
//     "about": "Speed is earned on slopes and kept.",
//     "movement": {"radius_x": 0.4, ...one key a settings_table() row}
//   }
//
// A setting that the file does not name has its value of basic_settings().
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "slipface/base/result.h"
#include "slipface/movement/settings.h"

namespace slipface {

struct Preset {
    std::string name;   // as shown
    std::string about;  // one sentence
    MovementSettings settings;
    friend bool operator==(const Preset&, const Preset&) = default;
};

// Errors name the file and the JSON path; unknown settings are errors, because a misspelled one would
// silently be the default.
Result<Preset> preset_from_json(std::string_view json, const std::string& location);
std::string preset_to_json(const Preset& preset);
Result<Preset> load_preset(const std::filesystem::path& path);
Status save_preset(const std::filesystem::path& path, const Preset& preset);

// The presets that ship with Slipface: platformer, lecture, precise-platformer, momentum, simulation. They
// are part of the program; assets/presets holds the same ones as files.
struct ShippedPreset {
    const char* id;  // "precise-platformer"
    Preset preset;
};
const std::vector<ShippedPreset>& shipped_presets();
// What settings are, as a preset and what differs from it.
struct PresetMatch {
    const ShippedPreset* preset = nullptr;    // the one that differs least, the first of equals; never null
    std::vector<const SettingInfo*> changed;  // rows of settings_table() that differ from it
};
PresetMatch nearest_preset(const MovementSettings& settings);
// `name` is the id of a shipped preset, or the path of a file.
Result<Preset> find_preset(const std::string& name);

}  // namespace slipface
