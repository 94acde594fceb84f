#include "slipface/level/preset.h"

#include <fmt/format.h>

#include "json_movement.h"
#include "slipface/base/files.h"
#include "slipface/base/system.h"

namespace slipface {

namespace {

constexpr std::size_t max_preset_bytes = std::size_t{1} << 20;

MovementSettings everything() {
    MovementSettings s;
    s.nudge = true;
    s.step_height = s.snap_distance = 0.35;
    return s;
}

// The demo of the lecture: its hacks and no others.
MovementSettings lecture() {
    MovementSettings s = basic_settings();
    s.push_out = PushOut::analytic;
    return s;
}

MovementSettings precise_platformer() {
    MovementSettings s = everything();
    s.walk_speed = 7.0;
    s.ground_acceleration = 140.0;
    s.air_acceleration = 90.0;
    s.gravity = 32.0;
    s.jump_speed = 11.5;
    s.variable_jump = true;
    s.sub_step = 1.0 / 120.0;
    return s;
}

MovementSettings momentum() {
    MovementSettings s = everything();
    s.walk_speed = 9.0;
    s.ground_acceleration = 14.0;
    s.air_acceleration = 8.0;
    s.slippery_acceleration = 5.0;
    s.terminal_speed = 90.0;
    s.jump_speed = 9.0;
    s.keep_energy_limit = -0.7;
    s.snap_down = false;
    return s;
}

// Every hack off: what remains is sweep and slide.
MovementSettings simulation() {
    MovementSettings s = basic_settings();
    set_switches(s, false);
    s.gravity = 9.81;
    return s;
}

}  // namespace

const std::vector<ShippedPreset>& shipped_presets() {
    static const std::vector<ShippedPreset> presets{
        {"platformer",
         {"Platformer", "What players of 3D platformers expect; the default of a level without a level file.",
          MovementSettings{}}},
        {"lecture", {"Lecture", "The hacks of the lecture, as its demo has them.", lecture()}},
        {"precise-platformer",
         {"Precise platformer", "Starts and stops at once, forgives late jumps, climbs stairs.",
          precise_platformer()}},
        {"momentum",
         {"Momentum", "Slopes give speed and ice preserves it; the stick steers little.", momentum()}},
        {"simulation",
         {"Simulation",
          "Every switch off: only sweeps and slides. The player falls through terrain without triangles.",
          simulation()}}};
    return presets;
}

Result<Preset> preset_from_json(std::string_view json, const std::string& location) {
    const Result<Json> root = parse_json(json, location);
    if (!root) return root.error();
    JsonReader reader(location);
    Preset preset;
    preset.settings = basic_settings();
    const JsonNode node(reader, &*root);
    if (!node.object()) return reader.error();
    int version = 0;
    node.need("slipface_preset").integer(1, 1, version);
    node.need("name").text(preset.name);
    node["about"].text(preset.about);
    const JsonNode movement = node.need("movement");
    read_settings(movement, preset.settings);
    for (const std::size_t i : movement.unknown())
        movement[movement.json().keys[i]].fail("an unknown setting", "a name of docs/settings.md");
    if (!reader.ok()) return reader.error();
    return preset;
}

std::string preset_to_json(const Preset& preset) {
    return json_pretty(json_object({{"slipface_preset", json_number(std::int64_t{1})},
                                    {"name", json_string(preset.name)},
                                    {"about", json_string(preset.about)},
                                    {"movement", settings_json(preset.settings)}}),
                       0) +
           "\n";
}

Result<Preset> load_preset(const std::filesystem::path& path) {
    const Result<std::string> text = read_file(path, max_preset_bytes);
    if (!text) return text.error();
    return preset_from_json(*text, path.string());
}

Status save_preset(const std::filesystem::path& path, const Preset& preset) {
    return write_file_atomic(path, preset_to_json(preset));
}

PresetMatch nearest_preset(const MovementSettings& settings) {
    PresetMatch nearest;
    for (const ShippedPreset& shipped : shipped_presets()) {
        PresetMatch match{&shipped, {}};
        for (const SettingInfo& info : settings_table())
            if (get_setting(settings, info) != get_setting(shipped.preset.settings, info))
                match.changed.push_back(&info);
        if (nearest.preset == nullptr || match.changed.size() < nearest.changed.size())
            nearest = std::move(match);
    }
    return nearest;
}

Result<Preset> find_preset(const std::string& name) {
    std::string ids;
    for (const ShippedPreset& shipped : shipped_presets()) {
        if (name == shipped.id) return shipped.preset;
        ids += std::string(ids.empty() ? "" : ", ") + shipped.id;
    }
    std::error_code error;
    if (std::filesystem::exists(path_of(name), error)) return load_preset(path_of(name));
    return Error{"preset",
                 fmt::format("found no preset and no file \"{}\", expected one of {}, or a file", name, ids)};
}

}  // namespace slipface
