#include "slipface/level/preset.h"

#include <fmt/format.h>

#include "json_movement.h"
#include "slipface/base/files.h"
#include "slipface/base/system.h"

namespace slipface {

namespace {

constexpr std::size_t max_preset_bytes = std::size_t{1} << 20;

}  // namespace

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
