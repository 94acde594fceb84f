// Source: glTF 2.0, section 3.10 (extras) and 4.4 (GLB: a header of 12 bytes, then the chunk of JSON).
#include "assimp/gltf_types.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "obj/obj_text.h"
#include "slipface/base/text.h"

namespace slipface {
namespace {

constexpr std::string_view type_key = "slipface_type";    // of a material
constexpr std::string_view table_key = "slipface_types";  // of the scene
constexpr std::size_t longest_type = 255;                 // bytes

std::size_t length_at(std::string_view bytes, std::size_t at) {
    std::size_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value |= std::size_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
    return value;
}

std::string_view json_of(std::string_view bytes) {
    if (!bytes.starts_with("glTF")) return bytes;
    if (bytes.size() < 20) return {};
    return bytes.substr(20, length_at(bytes, 12));
}

// The members that have to be in memory: not what is large elsewhere.
nlohmann::json members_of(std::string_view text) {
    const auto keep = [](int depth, nlohmann::json::parse_event_t event, nlohmann::json& parsed) {
        return depth != 1 || event != nlohmann::json::parse_event_t::key || parsed == "materials" ||
               parsed == "scene" || parsed == "scenes";
    };
    nlohmann::json root = nlohmann::json::parse(text, keep, false);
    return root.is_object() ? std::move(root) : nlohmann::json::object();
}

nlohmann::json materials_of(const nlohmann::json& root) {
    return root.contains("materials") && root["materials"].is_array() ? root["materials"]
                                                                      : nlohmann::json::array();
}

// The table of types in the extras of the scene that is shown; null if there is none.
nlohmann::json table_of(const nlohmann::json& root) {
    if (!root.contains("scenes") || !root["scenes"].is_array()) return {};
    const nlohmann::json& scenes = root["scenes"];
    const bool named = root.contains("scene") && root["scene"].is_number_unsigned();
    const std::size_t scene = named ? root["scene"].get<std::size_t>() : 0;
    if (scene >= scenes.size() || !scenes[scene].is_object()) return {};
    const auto extras = scenes[scene].find("extras");
    if (extras == scenes[scene].end() || !extras->is_object()) return {};
    const auto table = extras->find(table_key);
    return table == extras->end() ? nlohmann::json() : *table;
}

std::string plain(std::string_view text) {
    std::string result = to_lower(text);
    std::replace(result.begin(), result.end(), ' ', '_');
    return result;
}

}  // namespace

std::string add_gltf_types(std::string_view bytes, const std::string& location,
                           std::vector<Material>& materials, WarningList& warnings) {
    const std::string_view text = json_of(bytes);
    if (text.find(type_key) == std::string_view::npos) return {};
    const nlohmann::json root = members_of(text);
    std::map<std::string, std::string> type_of;  // [name of a material] empty: none, or several
    for (const nlohmann::json& material : materials_of(root)) {
        if (!material.is_object() || !material.contains("name") || !material["name"].is_string()) continue;
        const std::string name = material["name"].get<std::string>();
        std::string type;
        if (material.contains("extras") && material["extras"].is_object() &&
            material["extras"].contains(type_key)) {
            const nlohmann::json& found = material["extras"][std::string(type_key)];
            if (found.is_string() && found.get_ref<const std::string&>().size() <= longest_type &&
                find_binary(found.get_ref<const std::string&>()) == std::string_view::npos)
                type = found.get<std::string>();
            else
                warnings.add(location, fmt::format("ignored \"{}\" of the material {}: expected a name",
                                                   type_key, in_quotes(name)));
        }
        const auto [known, added] = type_of.emplace(name, type);
        if (!added && known->second != type) known->second.clear();
    }
    for (Material& material : materials) {
        const auto found = type_of.find(material.name);
        if (found == type_of.end() || found->second.empty()) continue;
        const std::string suffix = "__" + found->second;
        if (!plain(material.name).ends_with(plain(suffix))) material.name += suffix;
    }
    const nlohmann::json table = table_of(root);
    return table.is_null() ? std::string() : table.dump();
}

}  // namespace slipface
