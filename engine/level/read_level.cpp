// Reads a level from its file's JSON.

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "json_movement.h"
#include "json_parts.h"
#include "json_reader.h"
#include "level_json.h"
#include "packed_faces.h"
#include "slipface/base/text.h"
#include "slipface/level/find_start.h"

namespace slipface {
namespace {

constexpr std::size_t max_rules = 100'000;
constexpr std::size_t max_cameras = 100'000;
constexpr std::size_t max_platforms = 10'000;
constexpr std::size_t max_warnings = 100;
constexpr double max_position = 1e9;
constexpr double pi = 3.141592653589793;

void read_transform(JsonReader& reader, const Json& root, ImportTransform& transform) {
    if (const Json* json = root.find("scale")) {
        double scale = 1.0;
        if (reader.number(*json, "/scale", smallest_import_scale, largest_import_scale, scale))
            transform.scale = scale;
    }
    std::string up;
    const Json* axis = root.find("up");
    if (axis == nullptr || !reader.text(*axis, "/up", up)) return;
    const auto* const found = std::find(std::begin(up_axis_names), std::end(up_axis_names), up);
    if (found == std::end(up_axis_names)) {
        reader.fail("/up", json_kind_text(*axis),
                    "the file's upward axis: \"y\", \"z\", \"x\" or one of them with \"-\"");
        return;
    }
    transform.up = static_cast<UpAxis>(found - std::begin(up_axis_names));
}

int read_version(JsonReader& reader, const Json& root) {
    const Json* version = reader.member(root, "/", "slipface");
    if (version == nullptr) return level_file_version;
    for (const int known : {plain_level_file_version, level_file_version})
        if (version->kind == Json::Kind::number && version->text == std::to_string(known)) return known;
    reader.fail("/slipface", json_kind_text(*version),
                fmt::format("version {} or {}, the only supported ones", plain_level_file_version,
                            level_file_version));
    return level_file_version;
}

class LevelReader {
  public:
    LevelReader(const std::string& location, MeshPtr mesh) : reader_(location) {
        loaded_.level.mesh = std::move(mesh);
        loaded_.level.file_path = location;
        loaded_.level.movement = basic_settings();
        loaded_.level.spawn_is_set = false;
    }

    Result<LoadedLevel> read(const Json& root) {
        if (reader_.object(root, "/")) {
            version_ = read_version(reader_, root);
            read_mesh_name(root);
            read_transform(reader_, root, loaded_.level.import_transform);
            read_spawns(root);
            read_member(root, "fall_limit", [this](const Json& json, const std::string& path) {
                reader_.number(json, path, -max_position, max_position, loaded_.level.fall_limit.emplace());
            });
            read_member(root, "surfaces",
                        [this](const Json& json, const std::string& path) { read_surfaces(json, path); });
            read_member(root, "rules",
                        [this](const Json& json, const std::string& path) { read_rules(json, path); });
            for (const char* key : {"overrides", "orphans"}) {
                read_member(root, key, [this](const Json& json, const std::string& path) {
                    read_faces(json, path, "faces", true, stored_);
                });
                if (key == std::string_view("overrides")) painted_ = stored_.size();
            }
            read_member(root, "parts",
                        [this](const Json& json, const std::string& path) { read_parts(json, path); });
            read_member(root, "hidden", [this](const Json& json, const std::string& path) {
                read_stored_faces(json, path, "hidden", kept_.front());
            });
            read_member(root, "selections",
                        [this](const Json& json, const std::string& path) { read_selections(json, path); });
            read_member(root, "cameras",
                        [this](const Json& json, const std::string& path) { read_cameras(json, path); });
            read_member(root, "goals",
                        [this](const Json& json, const std::string& path) { read_goals(json, path); });
            read_member(root, "movement",
                        [this](const Json& json, const std::string& path) { read_movement(json, path); });
            read_member(root, "platforms",
                        [this](const Json& json, const std::string& path) { read_platforms(json, path); });
            read_member(root, "heightfield", [this](const Json& json, const std::string& path) {
                loaded_.level.heightfield = read_heightfield(reader_, json, path);
                keep_unknown(json, path, path, heightfield_keys);
            });
            read_member(root, "sectors", [this](const Json& json, const std::string& path) {
                loaded_.level.sectors = slipface::read_sectors(reader_, json, path);
                keep_unknown(json, path, path, sectors_keys);
            });
            read_member(root, "light",
                        [this](const Json& json, const std::string& path) { read_light_of(json, path); });
            keep_unknown(
                root, "/", "/",
                {"slipface", "mesh",     "scale",     "up",          "spawn",   "spawns",     "fall_limit",
                 "surfaces", "rules",    "overrides", "orphans",     "hidden",  "selections", "cameras",
                 "goals",    "movement", "platforms", "heightfield", "sectors", "light",      "parts"});
        }
        if (!reader_.ok()) return reader_.error();
        if (warnings_ > max_warnings)
            loaded_.warnings.push_back(
                {reader_.location("/"), fmt::format("{} more warnings", warnings_ - max_warnings)});
        loaded_.level.unknown = unknown_.text();
        match();
        return std::move(loaded_);
    }

  private:
    template <class Read>
    void read_member(const Json& object, const char* key, Read read) {
        const Json* value = object.find(key);
        if (value != nullptr && reader_.ok()) read(*value, std::string("/") + key);
    }

    void keep_unknown(const Json& object, const std::string& path, const std::string& location,
                      const std::set<std::string_view>& known) {
        if (!reader_.ok()) return;
        for (std::size_t i = 0; i < object.keys.size(); ++i) {
            if (known.contains(object.keys[i])) continue;
            unknown_.add(location, object.keys[i], object.items[i]);
            const std::string at = (path == "/" ? "" : path) + "/" + object.keys[i];
            warn(at, "unknown key; it is preserved");
        }
    }

    void warn(const std::string& path, const std::string& message) {
        if (++warnings_ <= max_warnings) loaded_.warnings.push_back({reader_.location(path), message});
    }

    void read_mesh_name(const Json& root) {
        const Json* mesh = root.find("mesh");
        std::string name;
        if (mesh == nullptr || !reader_.text(*mesh, "/mesh", name)) return;
        loaded_.level.mesh_path = loaded_.level.file_path.parent_path() / name;
    }

    Spawn read_spawn(const Json& json, const std::string& path) {
        Spawn spawn;
        if (!reader_.object(json, path)) return spawn;
        if (const Json* value = json.find("name")) reader_.text(*value, path + "/name", spawn.name);
        if (const Json* value = json.find("position"))
            reader_.vector(*value, path + "/position", -max_position, max_position, spawn.position);
        if (const Json* value = json.find("yaw")) reader_.number(*value, path + "/yaw", -1e6, 1e6, spawn.yaw);
        return spawn;
    }

    void read_spawns(const Json& root) {
        std::vector<Spawn> spawns;
        std::set<std::string> names;
        const auto add = [&](const Json& json, const std::string& path, bool main) {
            Spawn spawn = read_spawn(json, path);
            if (!reader_.ok()) return;
            if (spawn.name.empty()) reader_.fail(path + "/name", "an empty name", "a name");
            if (!names.insert(spawn.name).second)
                reader_.fail(path + "/name", fmt::format("\"{}\" a second time", json_excerpt(spawn.name)),
                             "each name once");
            keep_unknown(json, path, main ? path : unknown_.location("spawns", spawn.name),
                         {"name", "position", "yaw"});
            spawns.push_back(std::move(spawn));
        };
        read_member(root, "spawn", [&](const Json& json, const std::string& path) { add(json, path, true); });
        read_member(root, "spawns", [&](const Json& json, const std::string& path) {
            if (!reader_.array(json, path, max_spawns - spawns.size())) return;
            for (std::size_t i = 0; i < json.items.size() && reader_.ok(); ++i) {
                const std::string here = fmt::format("{}/{}", path, i);
                if (reader_.object(json.items[i], here) &&
                    reader_.member(json.items[i], here, "name") != nullptr)
                    add(json.items[i], here, false);
            }
        });
        set_spawns(loaded_.level, std::move(spawns));
    }

    void read_surfaces(const Json& json, const std::string& path) {
        if (!reader_.array(json, path, max_surface_types)) return;
        std::vector<SurfaceType>& surfaces = loaded_.level.surfaces;
        surfaces.clear();
        for (std::size_t i = 0; i < json.items.size() && reader_.ok(); ++i) {
            const std::string here = fmt::format("{}/{}", path, i);
            SurfaceType surface = read_surface(json.items[i], here);
            const bool twin = std::any_of(surfaces.begin(), surfaces.end(), [&](const SurfaceType& other) {
                return other.name == surface.name;
            });
            if (twin)
                reader_.fail(here + "/name", fmt::format("\"{}\" a second time", surface.name),
                             "each name once");
            surfaces.push_back(std::move(surface));
        }
        if (reader_.ok() && (surfaces.empty() || surfaces.front().name != "default")) {
            reader_.fail(path,
                         surfaces.empty() ? "no type" : fmt::format("\"{}\" first", surfaces.front().name),
                         "the type \"default\" first");
        }
    }

    SurfaceType read_surface(const Json& json, const std::string& path) {
        SurfaceType surface;
        if (!reader_.object(json, path)) return surface;
        const Json* name = reader_.member(json, path, "name");
        if (name == nullptr || !reader_.text(*name, path + "/name", surface.name)) return surface;
        if (surface.name.empty()) reader_.fail(path + "/name", "an empty name", "a name");

        std::set<std::string_view> known{"name", "color", "hatch", "hotkey"};
        if (const Json* value = json.find("color")) read_color(*value, path + "/color", surface);
        if (const Json* value = json.find("hatch")) read_hatch(*value, path + "/hatch", surface);
        if (const Json* value = json.find("hotkey"))
            reader_.integer(*value, path + "/hotkey", 0, 9, surface.hotkey);
        for (const SurfaceField& field : surface_fields()) {
            known.insert(field.name);
            if (const Json* value = json.find(field.name))
                read_field(*value, path + "/" + field.name, field, surface);
        }
        if (version_ == plain_level_file_version) take_old_friction(path + "/friction", surface);
        keep_unknown(json, path, unknown_.location("surfaces", surface.name), known);
        return surface;
    }

    // From the fraction that a bounce kept, which meant nothing without a bounce.
    void take_old_friction(const std::string& path, SurfaceType& surface) {
        const double kept = surface.friction;
        if (!reader_.ok() || kept == 1.0) return;
        if (kept > 1.0) {
            reader_.fail(
                path, to_text(kept),
                fmt::format("a number from 0 to 1 in a file of version {} (up to {:g} in version {})",
                            plain_level_file_version, max_friction, level_file_version));
            return;
        }
        const bool bounces = surface.restitution > 0.0;
        surface.friction = bounces ? 1.0 / std::max(kept, 1.0 / max_friction) : 1.0;
        warn(path, bounces ? fmt::format("a bounce that keeps {} of the speed along the surface; "
                                         "read as the friction {:.4g}",
                                         to_text(kept), surface.friction)
                           : fmt::format("{} meant nothing without a restitution; read as the friction 1",
                                         to_text(kept)));
    }

    void read_color(const Json& json, const std::string& path, SurfaceType& surface) {
        Vec3 color = Vec3::Zero();
        if (!reader_.vector(json, path, 0.0, 1.0, color)) return;
        for (std::size_t i = 0; i < 3; ++i)
            surface.color[i] = static_cast<float>(color[static_cast<Eigen::Index>(i)]);
    }

    void read_hatch(const Json& json, const std::string& path, SurfaceType& surface) {
        std::string name;
        if (!reader_.text(json, path, name)) return;
        const auto found = std::find(hatch_names.begin(), hatch_names.end(), name);
        if (found == hatch_names.end()) {
            reader_.fail(path, json_kind_text(json), fmt::format("one of {}", fmt::join(hatch_names, ", ")));
            return;
        }
        surface.hatch = static_cast<Hatch>(found - hatch_names.begin());
    }

    void read_field(const Json& json, const std::string& path, const SurfaceField& field,
                    SurfaceType& surface) {
        if (const auto* flag = std::get_if<bool SurfaceType::*>(&field.member)) {
            reader_.boolean(json, path, surface.**flag);
        } else if (const auto* number = std::get_if<double SurfaceType::*>(&field.member)) {
            reader_.number(json, path, field.minimum, field.maximum, surface.**number);
        } else if (const auto* vector = std::get_if<Vec3 SurfaceType::*>(&field.member)) {
            reader_.vector(json, path, field.minimum, field.maximum, surface.**vector);
        } else if (const auto* maybe = std::get_if<std::optional<double> SurfaceType::*>(&field.member)) {
            double value = 0.0;
            if (json.kind != Json::Kind::null &&
                reader_.number(json, path, field.minimum, field.maximum, value)) {
                surface.** maybe = value;
            }
        }
    }

    void read_rules(const Json& json, const std::string& path) {
        if (!reader_.array(json, path, max_rules)) return;
        for (std::size_t i = 0; i < json.items.size() && reader_.ok(); ++i) {
            const std::string here = fmt::format("{}/{}", path, i);
            MaterialRule rule;
            if (!reader_.object(json.items[i], here)) return;
            const Json* pattern = reader_.member(json.items[i], here, "pattern");
            const Json* type = reader_.member(json.items[i], here, "type");
            if (pattern == nullptr || type == nullptr ||
                !reader_.text(*pattern, here + "/pattern", rule.pattern) ||
                !reader_.text(*type, here + "/type", rule.type)) {
                return;
            }
            if (!find_surface(loaded_.level, rule.type)) {
                warn(here + "/type", fmt::format("found no surface type \"{}\"; the rule has no effect",
                                                 json_excerpt(rule.type)));
            }
            keep_unknown(json.items[i], here, unknown_.location("rules", rule.pattern), {"pattern", "type"});
            loaded_.level.rules.push_back(std::move(rule));
        }
    }

    // Reads groups of faces. `kind` names the location of a group's unknown members.
    void read_faces(const Json& json, const std::string& path, const std::string& kind, bool typed,
                    std::vector<StoredOverride>& to) {
        if (!reader_.array(json, path, max_json_values)) return;
        for (std::size_t i = 0; i < json.items.size() && reader_.ok(); ++i) {
            read_face_group(json.items[i], fmt::format("{}/{}", path, i), kind, typed, to);
        }
    }

    void read_stored_faces(const Json& json, const std::string& path, const std::string& kind,
                           std::vector<FaceKey>& keys) {
        std::vector<StoredOverride> stored;
        read_faces(json, path, kind, false, stored);
        for (StoredOverride& one : stored)
            keys.push_back(std::move(one.key));
    }

    void read_selections(const Json& json, const std::string& path) {
        if (!reader_.array(json, path, max_saved_selections)) return;
        for (std::size_t i = 0; i < json.items.size() && reader_.ok(); ++i) {
            const std::string here = fmt::format("{}/{}", path, i);
            const Json& item = json.items[i];
            SavedSelection saved;
            if (!reader_.object(item, here)) return;
            const Json* name = reader_.member(item, here, "name");
            const Json* faces = reader_.member(item, here, "faces");
            if (name == nullptr || faces == nullptr || !reader_.text(*name, here + "/name", saved.name))
                return;
            read_stored_faces(*faces, here + "/faces", "selected/" + saved.name, kept_.emplace_back());
            keep_unknown(item, here, unknown_.location("selections", saved.name), {"name", "faces"});
            loaded_.level.selections.push_back(std::move(saved));
        }
    }

    void read_face_group(const Json& json, const std::string& path, const std::string& kind, bool typed,
                         std::vector<StoredOverride>& to) {
        StoredOverride stored;
        if (!reader_.object(json, path)) return;
        const Json* type = typed ? reader_.member(json, path, "type") : nullptr;
        const Json* faces = reader_.member(json, path, "faces");
        if (faces == nullptr || (typed && type == nullptr)) return;
        if (typed && !reader_.text(*type, path + "/type", stored.type)) return;
        if (const Json* material = json.find("material")) {
            if (!reader_.text(*material, path + "/material", stored.key.material)) return;
        }
        if (!reader_.array(*faces, path + "/faces", max_json_values)) return;
        for (std::size_t i = 0; i < faces->items.size(); ++i) {
            const Json& row = faces->items[i];
            const std::string here = fmt::format("{}/faces/{}", path, i);
            stored.key.copy = 0;
            if (row.kind != Json::Kind::string || !parse_face_row(row.text, stored.key)) {
                reader_.fail(here, json_kind_text(row),
                             "\"HASH X,Y,Z NX,NY,NZ AREA\" with 16 hexadecimal digits, a point, a unit "
                             "normal and an area");
                return;
            }
            stored.location = reader_.location(here);
            to.push_back(stored);
        }
        if (const Json* packed = json.find("packed")) read_packed(*packed, path + "/packed", stored, to);
        std::set<std::string_view> known{"material", "faces", "packed"};
        if (typed) known.insert("type");
        const std::string& material = stored.key.material;
        keep_unknown(json, path, unknown_.location(kind, typed ? stored.type + "/" + material : material),
                     known);
    }

    void read_packed(const Json& json, const std::string& path, const StoredOverride& group,
                     std::vector<StoredOverride>& to) {
        if (!reader_.array(json, path, max_json_values)) return;
        std::vector<FaceKey> keys;
        for (std::size_t i = 0; i < json.items.size(); ++i) {
            const Json& row = json.items[i];
            const std::string here = fmt::format("{}/{}", path, i);
            keys.clear();
            if (row.kind != Json::Kind::string || !unpack_faces(row.text, keys)) {
                reader_.fail(here, json_kind_text(row), "painted faces, 23 bytes each, as base64");
                return;
            }
            for (FaceKey& key : keys) {
                key.material = group.key.material;
                to.push_back({std::move(key), group.type, reader_.location(here)});
            }
        }
    }

    void read_parts(const Json& json, const std::string& path) {
        const Json* paint = reader_.member(json, path, "paint");
        const Json* box = reader_.member(json, path, "box");
        const Json* list = reader_.member(json, path, "list");
        std::string hash;
        if (paint == nullptr || box == nullptr || list == nullptr ||
            !reader_.text(*paint, path + "/paint", hash) || !reader_.array(*box, path + "/box", 2) ||
            !reader_.array(*list, path + "/list", max_paint_parts))
            return;
        PaintParts parts;
        if (box->items.size() != 2) {
            reader_.fail(path + "/box", json_kind_text(*box), "two corners");
            return;
        }
        reader_.vector(box->items[0], path + "/box/0", -max_position, max_position, parts.bounds.min);
        reader_.vector(box->items[1], path + "/box/1", -max_position, max_position, parts.bounds.max);
        for (const Json& item : list->items) {
            if (item.kind != Json::Kind::string || !unpack_part(item.text, parts.parts.emplace_back())) {
                reader_.fail(fmt::format("{}/list/{}", path, parts.parts.size() - 1), json_kind_text(item),
                             "a part of the geometry, as base64");
                return;
            }
        }
        parts.of.assign(painted_, 1);
        if (const Json* of = json.find("of")) {
            std::string bytes;
            if (of->kind != Json::Kind::string || !decode_base64(of->text, bytes)) {
                reader_.fail(path + "/of", json_kind_text(*of), "a part for each painted face, as base64");
                return;
            }
            if (bytes.size() != 2 * painted_) return;
            const char* at = bytes.data();
            for (std::uint16_t& part : parts.of)
                part = static_cast<std::uint16_t>(take_bytes(at, 2));
        }
        std::vector<const FaceKey*> keys;
        for (std::size_t i = 0; i < painted_; ++i)
            keys.push_back(&stored_[i].key);
        // Another program may have changed the painted faces and kept this member, which it does not know.
        if (hash == fmt::format("{:016x}", hash_of_keys(keys))) parts_ = std::move(parts);
        keep_unknown(json, path, path, {"paint", "box", "of", "list"});
    }

    void read_cameras(const Json& json, const std::string& path) {
        if (!reader_.array(json, path, max_cameras)) return;
        for (std::size_t i = 0; i < json.items.size() && reader_.ok(); ++i) {
            const std::string here = fmt::format("{}/{}", path, i);
            const Json& item = json.items[i];
            CameraBookmark camera;
            if (!reader_.object(item, here)) return;
            const Json* name = reader_.member(item, here, "name");
            const Json* eye = reader_.member(item, here, "eye");
            const Json* target = reader_.member(item, here, "target");
            if (name == nullptr || eye == nullptr || target == nullptr) return;
            reader_.text(*name, here + "/name", camera.name);
            reader_.vector(*eye, here + "/eye", -max_position, max_position, camera.eye);
            reader_.vector(*target, here + "/target", -max_position, max_position, camera.target);
            if (const Json* fov = item.find("fov_y"))
                reader_.number(*fov, here + "/fov_y", 0.01, pi - 0.01, camera.fov_y);
            keep_unknown(item, here, unknown_.location("cameras", camera.name),
                         {"name", "eye", "target", "fov_y"});
            loaded_.level.cameras.push_back(std::move(camera));
        }
    }

    void read_goals(const Json& json, const std::string& path) {
        if (!reader_.array(json, path, max_goals)) return;
        std::set<std::string> names;
        for (std::size_t i = 0; i < json.items.size() && reader_.ok(); ++i) {
            const std::string here = fmt::format("{}/{}", path, i);
            Goal goal = read_goal(json.items[i], here);
            if (!reader_.ok()) return;
            if (!names.insert(goal.name).second)
                reader_.fail(here + "/name", fmt::format("\"{}\" a second time", json_excerpt(goal.name)),
                             "each name once");
            keep_unknown(json.items[i], here, unknown_.location("goals", goal.name),
                         {"name", "kind", "position", "radius", "within_s", "from"});
            loaded_.level.goals.push_back(std::move(goal));
        }
    }

    Goal read_goal(const Json& json, const std::string& path) {
        Goal goal;
        if (!reader_.object(json, path)) return goal;
        const Json* name = reader_.member(json, path, "name");
        const Json* position = reader_.member(json, path, "position");
        if (name == nullptr || position == nullptr) return goal;
        reader_.text(*name, path + "/name", goal.name);
        if (goal.name.empty()) reader_.fail(path + "/name", "an empty name", "a name");
        reader_.vector(*position, path + "/position", -max_position, max_position, goal.position);
        std::string kind = goal_kind_names[0];
        if (const Json* value = json.find("kind")) reader_.text(*value, path + "/kind", kind);
        const auto found = std::find(goal_kind_names.begin(), goal_kind_names.end(), kind);
        if (found == goal_kind_names.end())
            reader_.fail(path + "/kind", fmt::format("\"{}\"", json_excerpt(kind)),
                         fmt::format("one of {}", fmt::join(goal_kind_names, ", ")));
        else
            goal.kind = static_cast<GoalKind>(found - goal_kind_names.begin());
        if (const Json* value = json.find("radius"))
            reader_.number(*value, path + "/radius", smallest_goal_radius, largest_goal_radius, goal.radius);
        if (const Json* value = json.find("within_s")) {
            if (goal.kind == GoalKind::never)
                reader_.fail(path + "/within_s", "a time", "none for a goal of the kind \"never\"");
            reader_.number(*value, path + "/within_s", 0.0, 1e6, goal.within_s.emplace());
        }
        if (const Json* value = json.find("from")) reader_.text(*value, path + "/from", goal.from);
        return goal;
    }

    void read_platforms(const Json& json, const std::string& path) {
        if (!reader_.array(json, path, max_platforms)) return;
        const std::vector<std::string>& groups = loaded_.level.mesh->groups;
        for (std::size_t i = 0; i < json.items.size() && reader_.ok(); ++i) {
            const std::string here = fmt::format("{}/{}", path, i);
            const Json& item = json.items[i];
            Platform platform = read_platform(reader_, item, here);
            if (!reader_.ok()) return;
            const std::string location = unknown_.location("platforms", platform.name);
            keep_unknown(item, here, location, platform_keys);
            if (const Json* spin = item.find("spin"))
                keep_unknown(*spin, here + "/spin", location + "/spin", spin_keys);
            for (std::size_t k = 0; k < platform.path.size(); ++k) {
                const std::string point = fmt::format("/path/{}", k);
                keep_unknown(item.find("path")->items[k], here + point, location + point, path_keys);
            }
            if (std::find(groups.begin(), groups.end(), platform.group) == groups.end()) {
                warn(here + "/group",
                     fmt::format("found no group or object \"{}\" in the mesh; the platform does not move",
                                 json_excerpt(platform.group)));
            }
            loaded_.level.platforms.push_back(std::move(platform));
        }
    }

    void read_movement(const Json& json, const std::string& path) {
        read_settings(reader_, json, path, loaded_.level.movement);
        if (reader_.ok()) keep_unknown(json, path, path, setting_names());
    }

    void read_light_of(const Json& json, const std::string& path) {
        read_light(json, path, reader_, loaded_.level.light.emplace());
        keep_unknown(json, path, path, light_keys());
    }

    void match() {
        MatchedOverrides matched =
            match_overrides(*loaded_.level.mesh, loaded_.level.surfaces, stored_, parts_);
        loaded_.level.overrides = std::move(matched.overrides);
        loaded_.level.orphans = std::move(matched.orphans);
        loaded_.match = matched.summary;
        loaded_.guessed = std::move(matched.guessed);
        for (Diagnostic& warning : matched.warnings) {
            if (warning.location.empty()) warning.location = loaded_.level.file_path.string();
            loaded_.warnings.push_back(std::move(warning));
        }
        for (Diagnostic& warning : match_stored_faces(loaded_.level, kept_)) {
            const std::string file = loaded_.level.file_path.string();
            loaded_.warnings.push_back({file, std::move(warning.message)});
        }
    }

    JsonReader reader_;
    int version_ = level_file_version;
    LoadedLevel loaded_;
    std::size_t warnings_ = 0;  // about the file's content; only the first ones are listed
    UnknownMembers unknown_;
    std::vector<StoredOverride> stored_;
    std::size_t painted_ = 0;  // of stored_; the others were orphans already
    PaintParts parts_;
    FaceKeySets kept_ = FaceKeySets(1);  // hidden faces, then selections
};

}  // namespace

Result<LoadedLevel> read_level(const Json& root, const std::string& location, MeshPtr mesh) {
    if (!mesh) return Error{location, "the level file has no geometry"};
    return LevelReader(location, std::move(mesh)).read(root);
}

Status check_level_version(const Json& root, const std::string& location) {
    JsonReader reader(location);
    if (reader.object(root, "/")) read_version(reader, root);
    return reader.ok() ? Status() : Status(reader.error());
}

Result<ImportTransform> read_import_transform(const Json& root, const std::string& location) {
    JsonReader reader(location);
    ImportTransform transform;
    if (reader.object(root, "/")) read_transform(reader, root, transform);
    if (!reader.ok()) return reader.error();
    return transform;
}

Result<LoadedLevel> level_from_json(std::string_view json, const std::string& location, MeshPtr mesh) {
    const Result<Json> root = parse_json(json, location);
    if (!root) return root.error();
    return read_level(*root, location, std::move(mesh));
}

}  // namespace slipface
