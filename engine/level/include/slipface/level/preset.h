// Complete sets of movement settings as files.
//
//   {
//     "slipface_preset": 1,
//     "name": "Momentum",
//     "about": "Speed is earned on slopes and kept.",
//     "movement": {"radius_x": 0.4, ...one key per settings_table() row}
//   }
//
// A setting that the file does not name has its value of basic_settings().
#pragma once

#include <filesystem>
#include <string>

#include "slipface/base/result.h"
#include "slipface/movement/preset.h"

namespace slipface {

// Errors name the file and the JSON path. Unknown settings are errors, because a misspelled one would
// silently have its default value.
Result<Preset> preset_from_json(std::string_view json, const std::string& location);
std::string preset_to_json(const Preset& preset);
Result<Preset> load_preset(const std::filesystem::path& path);
Status save_preset(const std::filesystem::path& path, const Preset& preset);

// The shipped preset with the id `name`, else the preset file at the path `name`.
Result<Preset> find_preset(const std::string& name);

}  // namespace slipface
