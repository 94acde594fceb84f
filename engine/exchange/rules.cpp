#include "slipface/exchange/rules.h"

#include <fmt/format.h>

#include <algorithm>

#include "quake.h"
#include "slipface/base/files.h"
#include "slipface/base/text.h"
#include "slipface/level/level_file.h"
#include "slipface/mesh/build.h"

namespace slipface {
namespace {

constexpr std::uint64_t max_bytes = std::uint64_t{256} << 20;
constexpr std::size_t max_lines = 100'000;

// The level file is applied to a mesh of one triangle, because only its rules are needed.
Result<ImportedRules> read_level_rules(std::string_view json, const std::string& location) {
    PolygonSoup soup;
    soup.corner_position = {Vec3f(0, 0, 0), Vec3f(0, 0, 1), Vec3f(1, 0, 0)};
    soup.face_first_corner = {0, 3};
    const Result<MeshPtr> mesh = build_mesh(std::move(soup));
    if (!mesh) return mesh.error();
    const Result<LoadedLevel> loaded = level_from_json(json, location, *mesh);
    if (!loaded) return loaded.error();
    ImportedRules out;
    out.rules = loaded->level.rules;
    for (const SurfaceType& type : loaded->level.surfaces) {
        if (std::any_of(out.rules.begin(), out.rules.end(),
                        [&](const MaterialRule& rule) { return rule.type == type.name; }))
            out.types.push_back(type);
    }
    return out;
}

Result<ImportedRules> read_rule_lines(std::string_view text, const std::string& location) {
    ImportedRules out;
    std::size_t number = 0;
    for (std::string_view line : split(text, '\n')) {
        ++number;
        line = trim(line.substr(0, line.find('#')));
        if (line.empty()) continue;
        const std::size_t space = line.find_last_of(" \t");
        if (space == std::string_view::npos)
            return Error{fmt::format("{}:{}", location, number),
                         fmt::format("found \"{:.40}\", expected PATTERN TYPE", line)};
        if (out.rules.size() == max_lines) return Error{location, "gives more than 100000 rules"};
        out.rules.push_back({std::string(trim(line.substr(0, space))), std::string(line.substr(space + 1))});
    }
    return out;
}

}  // namespace

Result<ImportedRules> read_rules(const std::filesystem::path& path) {
    const std::string location = path.string();
    const std::string ending = to_lower(path.extension().string());
    if (ending != ".shader" && ending != ".bsp" && ending != ".json" && ending != ".txt")
        return Error{location, "gives no rules; expected a file named *.shader, *.bsp, *.json or *.txt"};
    const Result<std::string> bytes = read_file(path, max_bytes);
    if (!bytes) return bytes.error();
    if (ending == ".shader") return read_shaders(*bytes, location);
    if (ending == ".bsp") return read_bsp_flags(*bytes, location);
    return ending == ".json" ? read_level_rules(*bytes, location) : read_rule_lines(*bytes, location);
}

Result<AddedRules> add_rules(Level& level, const ImportedRules& imported) {
    AddedRules added;
    std::vector<SurfaceType> surfaces = level.surfaces;
    for (SurfaceType type : imported.types) {
        const auto named = [&](const SurfaceType& other) { return other.name == type.name; };
        if (std::any_of(surfaces.begin(), surfaces.end(), named)) continue;
        const auto same_key = [&](const SurfaceType& other) { return other.hotkey == type.hotkey; };
        if (std::any_of(surfaces.begin(), surfaces.end(), same_key)) type.hotkey = 0;
        surfaces.push_back(std::move(type));
        ++added.types;
    }
    if (surfaces.size() > max_surface_types)
        return Error{level.file_path.string(),
                     fmt::format("would have {} surface types; at most {} are possible", surfaces.size(),
                                 max_surface_types)};
    for (const MaterialRule& rule : imported.rules) {
        const auto named = [&](const SurfaceType& type) { return type.name == rule.type; };
        if (std::none_of(surfaces.begin(), surfaces.end(), named))
            return Error{
                level.file_path.string(),
                fmt::format("has no surface type \"{}\" for the rule \"{}\"", rule.type, rule.pattern)};
    }
    level.surfaces = std::move(surfaces);
    for (const MaterialRule& rule : imported.rules) {
        if (std::find(level.rules.begin(), level.rules.end(), rule) != level.rules.end()) continue;
        level.rules.push_back(rule);
        ++added.rules;
    }
    return added;
}

}  // namespace slipface
