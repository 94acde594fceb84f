// Complete sets of movement settings.
#pragma once

#include <string>
#include <vector>

#include "slipface/movement/settings.h"

namespace slipface {

struct Preset {
    std::string name;   // as shown
    std::string about;  // one sentence
    MovementSettings settings;
    friend bool operator==(const Preset&, const Preset&) = default;
};

// The presets that ship with Slipface: platformer, lecture, precise-platformer, momentum, simulation. They
// are built into the program; assets/presets has the same ones as files.
struct ShippedPreset {
    const char* id;  // "precise-platformer"
    Preset preset;
};
const std::vector<ShippedPreset>& shipped_presets();
// Settings described as a shipped preset and the differences from it.
struct PresetMatch {
    const ShippedPreset* preset = nullptr;    // fewest differences, the first of equals; never null
    std::vector<const SettingInfo*> changed;  // rows of settings_table() that differ from it
};
PresetMatch nearest_preset(const MovementSettings& settings);

}  // namespace slipface
