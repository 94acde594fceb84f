// The text of a level's file.

#include <fmt/format.h>

#include <algorithm>

#include "level_json.h"

namespace slipface {
namespace {

Json vector_json(const Vec3& vector) {
    Json json = json_array();
    for (const double part : {vector.x(), vector.y(), vector.z()})
        json.items.push_back(json_number(part));
    return json;
}

Json surface_json(const SurfaceType& surface) {
    Json json = json_object();
    json_add(json, "name", json_string(surface.name));
    Json color = json_array();
    for (const float part : surface.color)
        color.items.push_back(json_number(part));
    json_add(json, "color", std::move(color));
    json_add(json, "hatch", json_string(hatch_names[static_cast<std::size_t>(surface.hatch)]));
    json_add(json, "hotkey", json_number(std::int64_t{surface.hotkey}));
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

Json movement_json(const MovementSettings& settings) {
    Json json = json_object();
    for (const SettingInfo& info : settings_table()) {
        const double value = get_setting(settings, info);
        if (std::holds_alternative<bool MovementSettings::*>(info.member)) {
            json_add(json, info.name, json_bool(value != 0.0));
        } else if (std::holds_alternative<int MovementSettings::*>(info.member)) {
            json_add(json, info.name, json_number(static_cast<std::int64_t>(value)));
        } else if (std::holds_alternative<PushOut MovementSettings::*>(info.member)) {
            json_add(json, info.name, json_string(setting_text(settings, info)));
        } else {
            json_add(json, info.name, json_number(value));
        }
    }
    return json;
}

struct PaintedFace {
    FaceKey key;
    std::string type;
    std::size_t type_rank;  // types of the level in their order, others behind them
};

// One object for each type and material; its faces sorted by what they are and not by where the mesh holds
// them, so that a mesh whose faces were reordered gives the same text.
Json groups_json(std::vector<PaintedFace> faces, UnknownMembers& unknown) {
    std::sort(faces.begin(), faces.end(), [](const PaintedFace& a, const PaintedFace& b) {
        if (a.type_rank != b.type_rank) return a.type_rank < b.type_rank;
        if (const int order = a.type.compare(b.type); order != 0) return order < 0;
        if (const int order = a.key.material.compare(b.key.material); order != 0) return order < 0;
        if (a.key.loop_hash != b.key.loop_hash) return a.key.loop_hash < b.key.loop_hash;
        return a.key.copy < b.key.copy;
    });
    Json groups = json_array();
    for (std::size_t i = 0; i < faces.size();) {
        const PaintedFace& first = faces[i];
        Json group = json_object();
        json_add(group, "type", json_string(first.type));
        json_add(group, "material", json_string(first.key.material));
        Json rows = json_array();
        for (; i < faces.size() && faces[i].type == first.type && faces[i].key.material == first.key.material;
             ++i) {
            rows.items.push_back(json_string(face_row_text(faces[i].key)));
        }
        json_add(group, "faces", std::move(rows));
        unknown.append_to(group, unknown.place("faces", first.type + "/" + first.key.material));
        groups.items.push_back(std::move(group));
    }
    return groups;
}

std::vector<PaintedFace> painted_faces(const Level& level) {
    std::vector<FaceId> faces;
    if (level.mesh) {
        const std::size_t count = std::min(level.overrides.size(), level.mesh->face_count());
        for (std::size_t face = 0; face < count; ++face) {
            const std::optional<SurfaceId>& surface = level.overrides[face];
            if (surface && *surface < level.surfaces.size()) faces.push_back(static_cast<FaceId>(face));
        }
    }
    std::vector<PaintedFace> painted;
    if (faces.empty()) return painted;
    std::vector<FaceKey> keys = face_keys(*level.mesh, faces);
    painted.reserve(faces.size());
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const SurfaceId surface = *level.overrides[faces[i]];
        painted.push_back({std::move(keys[i]), level.surfaces[surface].name, surface});
    }
    return painted;
}

std::vector<PaintedFace> orphaned_faces(const Level& level) {
    std::vector<PaintedFace> painted;
    painted.reserve(level.orphans.size());
    for (const Orphan& orphan : level.orphans) {
        const std::optional<SurfaceId> surface = find_surface(level, orphan.type);
        painted.push_back({orphan.key, orphan.type, surface ? *surface : max_surface_types});
    }
    return painted;
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

}  // namespace

std::string level_text(const Level& level, const std::filesystem::path& file_path) {
    UnknownMembers unknown = UnknownMembers::parse(level.unknown);
    Json root = json_object();
    json_add(root, "slipface", json_number(std::int64_t{level_file_version}));
    if (!level.mesh_path.empty()) json_add(root, "mesh", json_string(mesh_name(level, file_path)));

    Json spawn = json_object();
    json_add(spawn, "position", vector_json(level.spawn));
    json_add(spawn, "yaw", json_number(level.spawn_yaw));
    unknown.append_to(spawn, "/spawn");
    json_add(root, "spawn", std::move(spawn));

    Json surfaces = json_array();
    for (const SurfaceType& surface : level.surfaces) {
        Json json = surface_json(surface);
        unknown.append_to(json, unknown.place("surfaces", surface.name));
        surfaces.items.push_back(std::move(json));
    }
    json_add(root, "surfaces", std::move(surfaces));

    Json rules = json_array();
    for (const MaterialRule& rule : level.rules) {
        Json json = json_object();
        json_add(json, "pattern", json_string(rule.pattern));
        json_add(json, "type", json_string(rule.type));
        unknown.append_to(json, unknown.place("rules", rule.pattern));
        rules.items.push_back(std::move(json));
    }
    json_add(root, "rules", std::move(rules));
    json_add(root, "overrides", groups_json(painted_faces(level), unknown));
    json_add(root, "orphans", groups_json(orphaned_faces(level), unknown));

    Json cameras = json_array();
    for (const CameraBookmark& camera : level.cameras) {
        Json json = json_object();
        json_add(json, "name", json_string(camera.name));
        json_add(json, "eye", vector_json(camera.eye));
        json_add(json, "target", vector_json(camera.target));
        json_add(json, "fov_y", json_number(camera.fov_y));
        unknown.append_to(json, unknown.place("cameras", camera.name));
        cameras.items.push_back(std::move(json));
    }
    json_add(root, "cameras", std::move(cameras));

    Json movement = movement_json(level.movement);
    unknown.append_to(movement, "/movement");
    json_add(root, "movement", std::move(movement));
    unknown.append_to(root, "/");
    return json_pretty(root, 0) + "\n";
}

std::string level_to_json(const Level& level) {
    return level_text(level, level.file_path);
}

}  // namespace slipface
