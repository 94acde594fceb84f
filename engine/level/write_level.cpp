// Writes the text of a level file.

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "json_movement.h"
#include "json_paint.h"
#include "json_parts.h"
#include "level_json.h"
#include "packed_faces.h"
#include "slipface/base/base64.h"
#include "slipface/level/find_start.h"

namespace slipface {
namespace {

Json surface_json(const SurfaceType& surface) {
    Json json =
        json_object({{"name", json_string(surface.name)},
                     {"color", json_array_of(surface.color, [](float part) { return json_number(part); })},
                     {"hatch", json_string(hatch_names[static_cast<std::size_t>(surface.hatch)])},
                     {"hotkey", json_number(std::int64_t{surface.hotkey})}});
    for (const SurfaceField& field : surface_fields()) {
        if (const auto* flag = std::get_if<bool SurfaceType::*>(&field.member)) {
            json_add(json, field.name, json_bool(surface.**flag));
        } else if (const auto* number = std::get_if<double SurfaceType::*>(&field.member)) {
            json_add(json, field.name, json_number(surface.**number));
        } else if (const auto* vector = std::get_if<Vec3 SurfaceType::*>(&field.member)) {
            json_add(json, field.name, vector_json(surface.**vector));
        } else if (const auto* maybe = std::get_if<std::optional<double> SurfaceType::*>(&field.member)) {
            if (const std::optional<double>& value = surface.**maybe)
                json_add(json, field.name, json_number(*value));
        }
    }
    return json;
}

// With more painted faces than this they are packed, because nobody reads so many rows.
constexpr std::size_t max_readable_faces = 10'000;

struct PaintedFaces {
    std::vector<FaceKey> keys;
    std::vector<const std::string*> types;  // [key]
    std::vector<std::size_t> type_ranks;    // [key] types of the level in their order, then other types
    PaintParts parts;
};

// [i] rank of the name among the distinct names in alphabetical order.
template <class NameOf>
std::vector<std::uint32_t> ranks(std::size_t count, const NameOf& name_of) {
    std::map<std::string_view, std::uint32_t> names;
    for (std::size_t i = 0; i < count; ++i)
        names.try_emplace(name_of(i), 0);
    std::uint32_t next = 0;
    for (auto& [name, rank] : names)
        rank = next++;
    std::vector<std::uint32_t> result(count);
    for (std::size_t i = 0; i < count; ++i)
        result[i] = names.find(name_of(i))->second;
    return result;
}

struct SortedFace {
    std::size_t type_rank;
    std::uint32_t type, material;
    bool is_row;  // in a packed group: a face that cannot be packed
    std::uint64_t hash;
    std::uint32_t copy;
    std::size_t face;
    friend auto operator<=>(const SortedFace&, const SortedFace&) = default;
};

// Sorts by key and not by index, so that reordering a mesh's faces does not change the text.
std::vector<SortedFace> sorted(const PaintedFaces& faces, bool packed) {
    const std::size_t count = faces.keys.size();
    const auto types = ranks(count, [&](std::size_t i) { return std::string_view(*faces.types[i]); });
    const auto materials =
        ranks(count, [&](std::size_t i) { return std::string_view(faces.keys[i].material); });
    std::vector<SortedFace> order(count);
    for (std::size_t i = 0; i < count; ++i) {
        const FaceKey& key = faces.keys[i];
        const std::uint64_t hash = packed ? packed_hash(key.loop_hash) : key.loop_hash;
        order[i] = {faces.type_ranks[i], types[i], materials[i], packed && key.copy > 0, hash, key.copy, i};
    }
    std::sort(order.begin(), order.end());
    return order;
}

// One object per type and material. Without `typed` the objects have no type. `kind` names the location of a
// group's unknown members. Appends the indices of the keys in the file's order to `written`, if given.
Json groups_json(const PaintedFaces& faces, bool packed, UnknownMembers& unknown, const std::string& kind,
                 bool typed, std::vector<std::size_t>* written = nullptr) {
    const std::vector<SortedFace> order = sorted(faces, packed);
    Json groups = json_array();
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
        const auto same = [&](const SortedFace& one) {
            return one.type == order[begin].type && one.material == order[begin].material;
        };
        Json rows = json_array();
        std::vector<const FaceKey*> packable;
        for (end = begin; end < order.size() && same(order[end]); ++end) {
            const FaceKey& key = faces.keys[order[end].face];
            if (packed && !order[end].is_row)
                packable.push_back(&key);
            else
                rows.items.push_back(json_string(face_row_text(key)));
        }
        for (const bool rows_first : {true, false})
            for (std::size_t i = begin; written != nullptr && i < end; ++i)
                if ((!packed || order[i].is_row) == rows_first) written->push_back(order[i].face);
        const std::size_t first = order[begin].face;
        const std::string& type = *faces.types[first];
        const std::string& material = faces.keys[first].material;
        Json group = json_object();
        if (typed) json_add(group, "type", json_string(type));
        json_add(group, "material", json_string(material));
        json_add(group, "faces", std::move(rows));
        if (!packable.empty()) json_add(group, "packed", json_array_of(pack_faces(packable), json_string));
        unknown.append_to(group, unknown.location(kind, typed ? type + "/" + material : material));
        groups.items.push_back(std::move(group));
    }
    return groups;
}

PaintedFaces painted_faces(const Level& level) {
    std::vector<FaceId> faces;
    if (level.mesh) {
        const std::size_t count = std::min(level.overrides.size(), level.mesh.face_count());
        for (std::size_t face = 0; face < count; ++face) {
            const std::optional<SurfaceId>& surface = level.overrides[face];
            if (surface && *surface < level.surfaces.size()) faces.push_back(static_cast<FaceId>(face));
        }
    }
    PaintedFaces painted;
    if (faces.empty()) return painted;
    const Mesh& mesh = mesh_with(level, faces);
    painted.keys = face_keys(mesh, faces);
    painted.parts = paint_parts(mesh, level.surfaces, faces, painted.keys);
    for (const FaceId face : faces) {
        const SurfaceId surface = *level.overrides[face];
        painted.types.push_back(&level.surfaces[surface].name);
        painted.type_ranks.push_back(surface);
    }
    painted.parts.guessed = which_of(faces, level.guessed);
    return painted;
}

PaintedFaces orphaned_faces(const Level& level) {
    PaintedFaces painted;
    for (const Orphan& orphan : level.orphans) {
        const std::optional<SurfaceId> surface = find_surface(level, orphan.type);
        painted.keys.push_back(orphan.key);
        painted.types.push_back(&orphan.type);
        painted.type_ranks.push_back(surface ? *surface : max_surface_types);
    }
    return painted;
}

PaintedFaces without_types(std::vector<FaceKey> keys) {
    static const std::string no_type;
    PaintedFaces faces{std::move(keys), {}, {}, {}};
    faces.types.resize(faces.keys.size(), &no_type);
    faces.type_ranks.resize(faces.keys.size());
    return faces;
}

// Returns the order of the faces in the file.
std::vector<std::size_t> add_unpainted(Json& parts, const UnpaintedFaces& faces, UnknownMembers& unknown) {
    std::vector<std::size_t> order;
    if (faces.keys.empty()) return order;
    Json groups = groups_json(without_types(faces.keys), true, unknown, "unpainted", false, &order);
    json_add(parts, "unpainted", unpainted_json(faces, order, std::move(groups)));
    return order;
}

Json stored_faces_json(std::vector<FaceKey> keys, UnknownMembers& unknown, const std::string& kind) {
    const PaintedFaces faces = without_types(std::move(keys));
    return groups_json(faces, faces.keys.size() > max_readable_faces, unknown, kind, false);
}

Json with_unknown(Json json, const UnknownMembers& unknown, const std::string& location) {
    unknown.append_to(json, location);
    return json;
}

// Each element with its unknown members, which are stored by its name.
template <class List, class JsonOf>
Json named_json(const List& list, UnknownMembers& unknown, const char* kind, const JsonOf& json_of) {
    return json_array_of(list, [&](const auto& element) {
        return with_unknown(json_of(element), unknown, unknown.location(kind, element.name));
    });
}

// Hidden faces and selections.
void append_stored_faces(Json& root, const Level& level, UnknownMembers& unknown) {
    if (level.hidden.empty() && level.selections.empty()) return;
    FaceKeySets sets = stored_face_keys(level);
    if (!level.hidden.empty())
        json_add(root, "hidden", stored_faces_json(std::move(sets[0]), unknown, "hidden"));
    if (level.selections.empty()) return;
    std::size_t set = 1;
    json_add(root, "selections",
             named_json(level.selections, unknown, "selections", [&](const SavedSelection& saved) {
                 return json_object({{"name", json_string(saved.name)},
                                     {"faces", stored_faces_json(std::move(sets[set++]), unknown,
                                                                 "selected/" + saved.name)}});
             }));
}

// Relative to the level file's folder if the mesh lies in it, else absolute.
std::string mesh_name(const Level& level, const std::filesystem::path& file_path) {
    std::error_code error;
    const auto folder = std::filesystem::absolute(file_path, error).lexically_normal().parent_path();
    if (error) return level.mesh_path.generic_string();
    const auto mesh = std::filesystem::absolute(level.mesh_path, error).lexically_normal();
    if (error) return level.mesh_path.generic_string();
    const auto relative = mesh.lexically_relative(folder);
    const bool inside = !relative.empty() && *relative.begin() != "..";
    return inside ? relative.generic_string() : mesh.generic_string();
}

Json platforms_json(const Level& level, UnknownMembers& unknown) {
    return json_array_of(level.platforms, [&](const Platform& platform) {
        const std::string location = unknown.location("platforms", platform.name);
        Json json = platform_json(platform);
        std::size_t points = 0;
        json_add(json, "path", json_array_of(platform.path, [&](const PathPoint& point) {
                     return with_unknown(path_point_json(point), unknown,
                                         fmt::format("{}/path/{}", location, points++));
                 }));
        json_add(json, "spin", with_unknown(spin_json(platform), unknown, location + "/spin"));
        return with_unknown(std::move(json), unknown, location);
    });
}

Json spawn_json(const Spawn& spawn, bool named) {
    Json json = json_object();
    if (named) json_add(json, "name", json_string(spawn.name));
    json_add(json, "position", vector_json(spawn.position));
    json_add(json, "yaw", json_number(spawn.yaw));
    return json;
}

void append_spawns(Json& root, const Level& level, UnknownMembers& unknown) {
    if (has_spawn(level)) {
        const Spawn main{level.spawn, level.spawn_yaw, level.spawn_name};
        json_add(root, "spawn", with_unknown(spawn_json(main, main.name != Spawn{}.name), unknown, "/spawn"));
    }
    if (!level.more_spawns.empty())
        json_add(root, "spawns", named_json(level.more_spawns, unknown, "spawns", [](const Spawn& spawn) {
                     return spawn_json(spawn, true);
                 }));
    if (level.fall_limit) json_add(root, "fall_limit", json_number(*level.fall_limit));
}

Json goal_json(const Goal& goal) {
    Json json = json_object({{"name", json_string(goal.name)},
                             {"kind", json_string(goal_kind_names[static_cast<std::size_t>(goal.kind)])},
                             {"position", vector_json(goal.position)},
                             {"radius", json_number(goal.radius)}});
    if (goal.within_s) json_add(json, "within_s", json_number(*goal.within_s));
    if (!goal.from.empty()) json_add(json, "from", json_string(goal.from));
    if (!goal.settings.empty()) json_add(json, "settings", json_array_of(goal.settings, json_string));
    return json;
}

Json camera_json(const CameraBookmark& camera) {
    return json_object({{"name", json_string(camera.name)},
                        {"eye", vector_json(camera.eye)},
                        {"target", vector_json(camera.target)},
                        {"fov_y", json_number(camera.fov_y)}});
}

// Writes the parts that few levels have, if the level has them.
void append_parts(Json& root, const Level& level, UnknownMembers& unknown) {
    if (!level.goals.empty()) json_add(root, "goals", named_json(level.goals, unknown, "goals", goal_json));
    if (!level.platforms.empty()) json_add(root, "platforms", platforms_json(level, unknown));
    if (!level.props.empty()) json_add(root, "props", named_json(level.props, unknown, "props", prop_json));
    if (level.heightfield)
        json_add(root, "heightfield",
                 with_unknown(heightfield_json(*level.heightfield), unknown, "/heightfield"));
    if (!(level.sectors == SectorLayout{}))
        json_add(root, "sectors", with_unknown(sectors_json(level.sectors), unknown, "/sectors"));
}

}  // namespace

std::string level_text(const Level& level, const std::filesystem::path& file_path, LevelText written) {
    UnknownMembers unknown = UnknownMembers::parse(level.unknown);
    Json root = json_object();
    const bool plain = std::all_of(level.surfaces.begin(), level.surfaces.end(),
                                   [](const SurfaceType& surface) { return surface.friction == 1.0; });
    json_add(root, "slipface",
             json_number(std::int64_t{plain ? plain_level_file_version : level_file_version}));
    if (!level.mesh_path.empty()) json_add(root, "mesh", json_string(mesh_name(level, file_path)));
    if (const auto& scale = level.import_transform.scale) json_add(root, "scale", json_number(*scale));
    if (const auto& up = level.import_transform.up)
        json_add(root, "up", json_string(up_axis_names[static_cast<std::size_t>(*up)]));
    if (level.import_transform.flip) json_add(root, "flip", json_bool(true));

    append_spawns(root, level, unknown);

    json_add(root, "surfaces", named_json(level.surfaces, unknown, "surfaces", surface_json));
    json_add(root, "rules", json_array_of(level.rules, [&](const MaterialRule& rule) {
                 return with_unknown(
                     json_object({{"pattern", json_string(rule.pattern)}, {"type", json_string(rule.type)}}),
                     unknown, unknown.location("rules", rule.pattern));
             }));
    const PaintedFaces painted = painted_faces(level);
    std::vector<std::size_t> order;
    json_add(root, "overrides",
             groups_json(painted, painted.keys.size() > max_readable_faces, unknown, "faces", true, &order));
    if (!painted.parts.parts.empty() && written == LevelText::whole) {
        Json parts = paint_parts_json(painted.keys, painted.parts, order);
        const std::vector<std::size_t> unpainted_order =
            add_unpainted(parts, painted.parts.unpainted, unknown);
        json_add(parts, "tokens", tokens_json(painted.keys, painted.parts, order, unpainted_order));
        json_add(root, "parts", std::move(parts));
    }
    json_add(root, "orphans", groups_json(orphaned_faces(level), false, unknown, "faces", true));
    append_stored_faces(root, level, unknown);

    json_add(root, "cameras", named_json(level.cameras, unknown, "cameras", camera_json));
    json_add(root, "movement", with_unknown(settings_json(level.movement), unknown, "/movement"));
    append_parts(root, level, unknown);
    if (level.light) json_add(root, "light", with_unknown(light_json(*level.light), unknown, "/light"));
    unknown.append_to(root, "/");
    return json_pretty(root, 0) + "\n";
}

std::string level_to_json(const Level& level, LevelText text) {
    return level_text(level, level.file_path, text);
}

}  // namespace slipface
