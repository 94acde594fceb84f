// Reads a level from its file's JSON.

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "json_movement.h"
#include "json_paint.h"
#include "json_parts.h"
#include "json_reader.h"
#include "level_json.h"
#include "slipface/base/system.h"
#include "slipface/base/text.h"
#include "slipface/level/find_start.h"
#include "slipface/level/preset.h"

namespace slipface {
namespace {

constexpr std::size_t max_cameras = 100'000;
constexpr std::size_t max_platforms = 10'000;
constexpr std::size_t max_warnings = 100;
constexpr double pi = 3.141592653589793;

void read_transform(const JsonNode& root, ImportTransform& transform) {
    root["scale"].number(smallest_import_scale, largest_import_scale, transform.scale);
    root["flip"].boolean(transform.flip);
    std::string up;
    const JsonNode axis = root["up"];
    if (!axis.text(up)) return;
    const auto* const found = std::find(std::begin(up_axis_names), std::end(up_axis_names), up);
    if (found == std::end(up_axis_names))
        axis.fail("the file's upward axis: \"y\", \"z\", \"x\" or one of them with \"-\"");
    else
        transform.up = static_cast<UpAxis>(found - std::begin(up_axis_names));
}

int read_version(const JsonNode& root) {
    const JsonNode version = root.need("slipface");
    if (!version) return level_file_version;
    for (const int known : {plain_level_file_version, level_file_version})
        if (version.json().kind == Json::Kind::number && version.json().text == std::to_string(known))
            return known;
    version.fail(fmt::format("version {} or {}, the only supported ones", plain_level_file_version,
                             level_file_version));
    return level_file_version;
}

// A name that no other has.
void read_name(const JsonNode& node, std::set<std::string>& names, std::string& name) {
    node.text(name);
    if (!node) return;
    if (name.empty()) node.fail("an empty name", "a name");
    if (!names.insert(name).second)
        node.fail(fmt::format("\"{}\" a second time", json_excerpt(name)), "each name once");
}

class LevelReader {
  public:
    LevelReader(const std::string& location, MeshPtr mesh, PropSource props)
        : reader_(location), props_mesh_path_(std::move(props.mesh_path)) {
        level_.mesh = std::move(mesh);
        level_.placed.meshes = std::move(props.known);
        level_.file_path = path_of(location);
        level_.movement = basic_settings();
        level_.spawn_is_set = false;
    }

    Result<LoadedLevel> read(const Json& json) {
        const JsonNode root(reader_, &json);
        if (root.object()) read_members(root);
        if (!reader_.ok()) return reader_.error();
        if (warnings_ > max_warnings)
            loaded_.warnings.push_back(
                {root.location(), fmt::format("{} more warnings", warnings_ - max_warnings)});
        level_.unknown = unknown_.text();
        match();
        return std::move(loaded_);
    }

  private:
    void read_members(const JsonNode& root) {
        version_ = read_version(root);
        std::string mesh;
        if (root["mesh"].text(mesh)) level_.mesh_path = level_.file_path.parent_path() / path_of(mesh);
        read_transform(root, level_.import_transform);
        read_spawns(root);
        root["fall_limit"].number(-farthest_position, farthest_position, level_.fall_limit);
        read_surfaces(root["surfaces"]);
        root["rules"].each(max_material_rules, [this](const JsonNode& node) { read_rule(node); });
        read_faces(root["overrides"], "faces", true, stored_);
        painted_ = stored_.size();
        read_faces(root["orphans"], "faces", true, stored_);
        if (const JsonNode parts = root["parts"]) {
            if (auto read = read_paint_parts(parts, std::span(stored_).first(painted_)))
                parts_ = std::move(*read);
            store_unknown(parts, "/parts");
        }
        read_stored_faces(root["hidden"], "hidden", face_keys_.front());
        root["selections"].each(max_saved_selections, [this](const JsonNode& node) { read_selection(node); });
        root["cameras"].each(max_cameras, [this](const JsonNode& node) { read_camera(node); });
        std::set<std::string> goals;
        root["goals"].each(max_goals, [&](const JsonNode& node) { read_goal(node, goals); });
        read_movement(root["movement"]);
        std::set<std::string> props;
        root["props"].each(max_props, [&](const JsonNode& node) { add_prop(node, props); });
        if (reader_.ok()) place();
        root["platforms"].each(max_platforms, [this](const JsonNode& node) { add_platform(node); });
        if (const JsonNode heightfield = root["heightfield"]) {
            level_.heightfield = read_heightfield(heightfield);
            store_unknown(heightfield, "/heightfield");
        }
        if (const JsonNode sectors = root["sectors"]) {
            level_.sectors = read_sectors(sectors);
            store_unknown(sectors, "/sectors");
        }
        if (const JsonNode light = root["light"]) {
            read_light(light, level_.light.emplace());
            store_unknown(light, "/light");
        }
        store_unknown(root, "/");
    }

    // Settings, or a shipped preset's name, for programs that make level files without knowing every setting.
    void read_movement(const JsonNode& node) {
        std::string name;
        if (!node) return;
        if (node.json().kind != Json::Kind::string) {
            read_settings(node, level_.movement);
            store_unknown(node, "/movement");
            return;
        }
        node.text(name);
        const auto& presets = shipped_presets();
        const auto found = std::find_if(presets.begin(), presets.end(),
                                        [&](const ShippedPreset& one) { return one.id == name; });
        if (found == presets.end())
            node.fail(fmt::format("\"{}\"", json_excerpt(name)), "settings, or the id of a shipped preset");
        else
            level_.movement = found->preset.settings;
    }

    void store_unknown(const JsonNode& node, const std::string& location) {
        for (const std::size_t i : node.unknown()) {
            unknown_.add(location, node.json().keys[i], node.json().items[i]);
            warn(node[node.json().keys[i]], "unknown key; it is preserved");
        }
    }

    void warn(const JsonNode& node, const std::string& message) {
        if (++warnings_ <= max_warnings) loaded_.warnings.push_back({node.location(), message});
    }

    void read_spawns(const JsonNode& root) {
        std::vector<Spawn> spawns;
        std::set<std::string> names;
        const auto add = [&](const JsonNode& node, bool main) {
            Spawn spawn;
            if (!node.object()) return;
            const JsonNode name = main ? node["name"] : node.need("name");
            if (name)
                read_name(name, names, spawn.name);
            else
                names.insert(spawn.name);
            node["position"].vector(-farthest_position, farthest_position, spawn.position);
            node["yaw"].number(-1e6, 1e6, spawn.yaw);
            store_unknown(node, main ? "/spawn" : unknown_.location("spawns", spawn.name));
            spawns.push_back(std::move(spawn));
        };
        if (const JsonNode main = root["spawn"]) add(main, true);
        root["spawns"].each(max_spawns - spawns.size(), [&](const JsonNode& node) { add(node, false); });
        set_spawns(level_, std::move(spawns));
    }

    void read_surfaces(const JsonNode& node) {
        if (!node) return;
        std::vector<SurfaceType>& surfaces = level_.surfaces;
        surfaces.clear();
        std::set<std::string> names;
        node.each(max_surface_types,
                  [&](const JsonNode& surface) { surfaces.push_back(read_surface(surface, names)); });
        if (node && (surfaces.empty() || surfaces.front().name != "default"))
            node.fail(surfaces.empty() ? "no type" : fmt::format("\"{}\" first", surfaces.front().name),
                      "the type \"default\" first");
    }

    SurfaceType read_surface(const JsonNode& node, std::set<std::string>& names) {
        SurfaceType surface;
        if (!node.object()) return surface;
        read_name(node.need("name"), names, surface.name);
        Vec3 color = Vec3::Zero();
        if (node["color"].vector(0.0, 1.0, color))
            for (std::size_t i = 0; i < 3; ++i)
                surface.color[i] = static_cast<float>(color[static_cast<Eigen::Index>(i)]);
        node["hatch"].one_of(hatch_names, surface.hatch);
        node["hotkey"].integer(0, 9, surface.hotkey);
        for (const SurfaceField& field : surface_fields())
            read_field(node[field.name], field, surface);
        if (version_ == plain_level_file_version && node) take_old_friction(node["friction"], surface);
        store_unknown(node, unknown_.location("surfaces", surface.name));
        return surface;
    }

    // From the fraction that a bounce kept, which meant nothing without a bounce.
    void take_old_friction(const JsonNode& node, SurfaceType& surface) {
        const double kept = surface.friction;
        if (kept == 1.0) return;
        if (kept > 1.0) {
            node.fail(to_text(kept),
                      fmt::format("a number from 0 to 1 in a file of version {} (up to {:g} in version {})",
                                  plain_level_file_version, max_friction, level_file_version));
            return;
        }
        const bool bounces = surface.restitution > 0.0;
        surface.friction = bounces ? 1.0 / std::max(kept, 1.0 / max_friction) : 1.0;
        warn(node, bounces ? fmt::format("a bounce that keeps {} of the speed along the surface; "
                                         "read as the friction {:.4g}",
                                         to_text(kept), surface.friction)
                           : fmt::format("{} meant nothing without a restitution; read as the friction 1",
                                         to_text(kept)));
    }

    static void read_field(const JsonNode& node, const SurfaceField& field, SurfaceType& surface) {
        if (const auto* flag = std::get_if<bool SurfaceType::*>(&field.member)) {
            node.boolean(surface.**flag);
        } else if (const auto* number = std::get_if<double SurfaceType::*>(&field.member)) {
            node.number(field.minimum, field.maximum, surface.**number);
        } else if (const auto* vector = std::get_if<Vec3 SurfaceType::*>(&field.member)) {
            node.vector(field.minimum, field.maximum, surface.**vector);
        } else if (const auto* maybe = std::get_if<std::optional<double> SurfaceType::*>(&field.member)) {
            if (node && node.json().kind != Json::Kind::null)
                node.number(field.minimum, field.maximum, surface.**maybe);
        }
    }

    void read_rule(const JsonNode& node) {
        MaterialRule rule;
        if (!node.object()) return;
        const JsonNode pattern = node.need("pattern"), type = node.need("type");
        pattern.text(rule.pattern);
        if (type.text(rule.type) && !find_surface(level_, rule.type))
            warn(type, fmt::format("found no surface type \"{}\"; the rule has no effect",
                                   json_excerpt(rule.type)));
        store_unknown(node, unknown_.location("rules", rule.pattern));
        level_.rules.push_back(std::move(rule));
    }

    // Reads groups of faces. `kind` names the location of a group's unknown members.
    void read_faces(const JsonNode& node, const std::string& kind, bool typed,
                    std::vector<StoredOverride>& to) {
        node.each(max_json_values, [&](const JsonNode& group) { read_face_group(group, kind, typed, to); });
    }

    void read_stored_faces(const JsonNode& node, const std::string& kind, std::vector<FaceKey>& keys) {
        std::vector<StoredOverride> stored;
        read_faces(node, kind, false, stored);
        for (StoredOverride& one : stored)
            keys.push_back(std::move(one.key));
    }

    void read_selection(const JsonNode& node) {
        SavedSelection saved;
        if (!node.object()) return;
        const JsonNode name = node.need("name"), faces = node.need("faces");
        name.text(saved.name);
        read_stored_faces(faces, "selected/" + saved.name, face_keys_.emplace_back());
        store_unknown(node, unknown_.location("selections", saved.name));
        level_.selections.push_back(std::move(saved));
    }

    void read_face_group(const JsonNode& node, const std::string& kind, bool typed,
                         std::vector<StoredOverride>& to) {
        StoredOverride stored;
        if (!node.object()) return;
        if (typed) node.need("type").text(stored.type);
        node["material"].text(stored.key.material);
        const std::string material = stored.key.material, type = stored.type;
        read_face_rows(node, std::move(stored), to);
        store_unknown(node, unknown_.location(kind, typed ? type + "/" + material : material));
    }

    void read_camera(const JsonNode& node) {
        CameraBookmark camera;
        if (!node.object()) return;
        const JsonNode name = node.need("name"), eye = node.need("eye"), target = node.need("target");
        name.text(camera.name);
        eye.vector(-farthest_position, farthest_position, camera.eye);
        target.vector(-farthest_position, farthest_position, camera.target);
        node["fov_y"].number(0.01, pi - 0.01, camera.fov_y);
        store_unknown(node, unknown_.location("cameras", camera.name));
        level_.cameras.push_back(std::move(camera));
    }

    void read_goal(const JsonNode& node, std::set<std::string>& names) {
        Goal goal;
        if (!node.object()) return;
        const JsonNode name = node.need("name"), position = node.need("position"), within = node["within_s"];
        read_name(name, names, goal.name);
        position.vector(-farthest_position, farthest_position, goal.position);
        node["kind"].one_of(goal_kind_names, goal.kind);
        node["radius"].number(smallest_goal_radius, largest_goal_radius, goal.radius);
        if (within && goal.kind == GoalKind::never)
            within.fail("a time", "none for a goal of the kind \"never\"");
        within.number(0.0, 1e6, goal.within_s);
        node["from"].text(goal.from);
        node["settings"].each(max_goal_settings, [&](const JsonNode& setting) {
            MovementSettings movement;
            std::string& text = goal.settings.emplace_back();
            if (!setting.text(text)) return;
            if (const Status status = set_setting(movement, text); !status) setting.fail(status.error());
        });
        store_unknown(node, unknown_.location("goals", goal.name));
        level_.goals.push_back(std::move(goal));
    }

    void add_prop(const JsonNode& node, std::set<std::string>& names) {
        Prop prop = read_prop(node);
        if (!node) return;
        read_name(node["name"], names, prop.name);
        if (!prop.type.empty() && !find_surface(level_, prop.type))
            warn(node["type"],
                 fmt::format("found no surface type \"{}\"; it has no effect", json_excerpt(prop.type)));
        store_unknown(node, unknown_.location("props", prop.name));
        level_.props.push_back(std::move(prop));
    }

    // Before the painted faces are found, because those of props can be painted, too.
    void place() {
        if (level_.props.empty()) return;
        const std::filesystem::path named = level_.mesh_path;
        if (!props_mesh_path_.empty()) level_.mesh_path = props_mesh_path_;
        Warnings warnings = place_props(level_);
        level_.mesh_path = named;
        for (Diagnostic& warning : warnings)
            if (++warnings_ <= max_warnings) loaded_.warnings.push_back(std::move(warning));
    }

    void add_platform(const JsonNode& node) {
        std::vector<JsonNode> parts;
        Platform platform = read_platform(node, parts);
        if (!node) return;
        const std::string location = unknown_.location("platforms", platform.name);
        store_unknown(node, location);
        for (const JsonNode& part : parts)
            store_unknown(part, location + part.path().substr(node.path().size()));
        if (!has_group(level_, platform.group))
            warn(node["group"],
                 fmt::format("found no group or object \"{}\" in the mesh; the platform does not move",
                             json_excerpt(platform.group)));
        level_.platforms.push_back(std::move(platform));
    }

    void match() {
        MatchedOverrides matched = match_overrides(level_, stored_, parts_);
        level_.overrides = std::move(matched.overrides);
        level_.orphans = std::move(matched.orphans);
        loaded_.match = matched.summary;
        loaded_.second = std::move(matched.second);
        level_.guessed = std::move(matched.guessed);
        for (Diagnostic& warning : matched.warnings) {
            if (warning.location.empty()) warning.location = level_.file_path.string();
            loaded_.warnings.push_back(std::move(warning));
        }
        for (Diagnostic& warning : match_stored_faces(level_, face_keys_)) {
            const std::string file = level_.file_path.string();
            loaded_.warnings.push_back({file, std::move(warning.message)});
        }
    }

    JsonReader reader_;
    std::filesystem::path props_mesh_path_;
    int version_ = level_file_version;
    LoadedLevel loaded_;
    Level& level_ = loaded_.level;
    std::size_t warnings_ = 0;  // about the file's content; only the first ones are listed
    UnknownMembers unknown_;
    std::vector<StoredOverride> stored_;
    std::size_t painted_ = 0;  // of stored_; the others were orphans already
    PaintParts parts_;
    FaceKeySets face_keys_ = FaceKeySets(1);  // hidden faces, then selections
};

}  // namespace

Result<LoadedLevel> read_level(const Json& root, const std::string& location, MeshPtr mesh,
                               PropSource props) {
    if (!mesh) return Error{location, "the level file has no geometry"};
    return LevelReader(location, std::move(mesh), std::move(props)).read(root);
}

Status check_level_version(const Json& json, const std::string& location) {
    JsonReader reader(location);
    const JsonNode root(reader, &json);
    if (root.object()) read_version(root);
    return reader.ok() ? Status() : Status(reader.error());
}

Result<ImportTransform> read_import_transform(const Json& json, const std::string& location) {
    JsonReader reader(location);
    ImportTransform transform;
    const JsonNode root(reader, &json);
    if (root.object()) read_transform(root, transform);
    if (!reader.ok()) return reader.error();
    return transform;
}

Result<LoadedLevel> level_from_json(std::string_view json, const std::string& location, MeshPtr mesh) {
    const Result<Json> root = parse_json(json, location);
    if (!root) return root.error();
    return read_level(*root, location, std::move(mesh));
}

Result<LoadedLevel> level_from_json(std::string_view json, const std::string& location, const Level& base) {
    const Result<Json> root = parse_json(json, location);
    if (!root) return root.error();
    return read_level(*root, location, own_mesh(base), {base.mesh_path, base.placed.meshes});
}

}  // namespace slipface
