// Levels on disk.

#include "slipface/level/level_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "face_match.h"
#include "level_json.h"
#include "slipface/base/files.h"
#include "slipface/base/text.h"
#include "slipface/mesh/import.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t max_level_file_bytes = 256ULL << 20;

std::string quoted(const fs::path& path) {
    return '"' + json_excerpt(path.string()) + '"';
}

bool is_level_file(const fs::path& path) {
    return to_lower(path.extension().string()) == ".json";
}

// A relative path may not lead out of the folder: a level from elsewhere must not make the editor open any
// file it names.
Result<fs::path> mesh_of_level_file(const fs::path& file_path, const Json& root) {
    const std::string place = file_path.string();
    const Json* mesh = root.find("mesh");
    if (mesh == nullptr || mesh->kind != Json::Kind::string || mesh->text.empty()) {
        return Error{place + ":/mesh", fmt::format("found {}, expected the name of the level's OBJ file",
                                                   mesh == nullptr ? "nothing" : json_kind_text(*mesh))};
    }
    const fs::path name(mesh->text);
    const fs::path normal = name.lexically_normal();
    if (!name.is_absolute() && !normal.empty() && *normal.begin() == "..") {
        return Error{place + ":/mesh",
                     fmt::format("found {}, expected a path inside the level's folder or an absolute one",
                                 json_quoted(json_excerpt(mesh->text)))};
    }
    return file_path.parent_path() / normal;
}

Result<LoadedLevel> load_mesh(const fs::path& mesh_path, const ImportTransform& transform,
                              Progress* progress) {
    const auto start = std::chrono::steady_clock::now();
    ImportOptions options;
    options.transform = transform;
    options.progress = progress;
    Result<ImportedMesh> imported = import_mesh(mesh_path, options);
    if (!imported) return imported.error();
    LoadedLevel loaded;
    loaded.mesh_load_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    loaded.warnings = std::move(imported->warnings);
    loaded.level.mesh = std::move(imported->mesh);
    loaded.level.mesh_path = mesh_path;
    loaded.level.mesh_stamp = imported->stamp;
    loaded.level.import_transform = transform;
    loaded.level.file_path = level_file_for(mesh_path);
    loaded.level.overrides.resize(loaded.level.mesh->face_count());
    return loaded;
}

// The geometry as the level file wants it, and the file's annotations on it.
Result<LoadedLevel> load_annotated(const fs::path& mesh_path, const fs::path& file_path, const Json& root,
                                   Progress* progress) {
    const Result<ImportTransform> transform = read_import_transform(root, file_path.string());
    if (!transform) return transform.error();
    Result<LoadedLevel> geometry = load_mesh(mesh_path, *transform, progress);
    if (!geometry) return geometry;
    begin_stage(progress, "Finding painted faces", 1.0, 1.0);
    Result<LoadedLevel> loaded = read_level(root, file_path.string(), geometry->level.mesh);
    if (!loaded) return loaded;
    const fs::path named = loaded->level.mesh_path;
    loaded->level.mesh_path = mesh_path;
    loaded->level.mesh_stamp = geometry->level.mesh_stamp;
    loaded->level.file_path = file_path;
    loaded->mesh_load_s = geometry->mesh_load_s;
    if (!named.empty() && named.lexically_normal() != mesh_path.lexically_normal()) {
        loaded->warnings.insert(
            loaded->warnings.begin(),
            {file_path.string() + ":/mesh", fmt::format("names {}, but lies beside {}, which was opened",
                                                        quoted(named), quoted(mesh_path))});
    }
    loaded->warnings.insert(loaded->warnings.begin(), geometry->warnings.begin(), geometry->warnings.end());
    if (cancelled(progress)) return cancelled_error(file_path);
    return loaded;
}

// The version is looked at first: what another version says of its mesh may mean something else.
Result<Json> read_json(const fs::path& file_path) {
    const Result<std::string> text = read_file(file_path, max_level_file_bytes);
    if (!text) return text.error();
    Result<Json> root = parse_json(*text, file_path.string());
    if (!root) return root;
    if (const Status status = check_level_version(*root, file_path.string()); !status) return status.error();
    return root;
}

Result<LoadedLevel> load_from_level_file(const fs::path& file_path, Progress* progress) {
    const Result<Json> root = read_json(file_path);
    if (!root) return root.error();
    const Result<fs::path> mesh_path = mesh_of_level_file(file_path, *root);
    if (!mesh_path) return mesh_path.error();
    std::error_code error;
    if (!fs::exists(*mesh_path, error)) {
        return Error{
            file_path.string() + ":/mesh",
            fmt::format("found no file {}, expected the level's OBJ file there", quoted(*mesh_path))};
    }
    return load_annotated(*mesh_path, file_path, *root, progress);
}

Result<LoadedLevel> load_from_mesh(const fs::path& mesh_path, Progress* progress) {
    const fs::path file_path = level_file_for(mesh_path);
    std::error_code error;
    if (fs::status(file_path, error).type() == fs::file_type::not_found)
        return load_mesh(mesh_path, {}, progress);
    // What is wrong with the geometry is said first.
    if (!fs::exists(mesh_path, error)) return load_mesh(mesh_path, {}, progress);
    const Result<Json> root = read_json(file_path);
    if (!root) return root.error();
    return load_annotated(mesh_path, file_path, *root, progress);
}

// Everything of `level` but what its geometry decides.
LoadedLevel with_geometry(const Level& level, LoadedLevel geometry) {
    Level copy = level;
    copy.mesh = std::move(geometry.level.mesh);
    copy.mesh_stamp = geometry.level.mesh_stamp;
    copy.import_transform = geometry.level.import_transform;
    geometry.level = std::move(copy);
    return geometry;
}

}  // namespace

Result<LoadedLevel> reload_mesh(const Level& level, Progress* progress) {
    try {
        Result<LoadedLevel> geometry = load_mesh(level.mesh_path, level.import_transform, progress);
        if (!geometry) return geometry;
        begin_stage(progress, "Finding painted faces", 1.0, 1.0);
        LoadedLevel loaded = with_geometry(level, std::move(*geometry));
        MatchedOverrides matched =
            match_overrides(*loaded.level.mesh, level.surfaces, stored_overrides(level));
        loaded.level.overrides = std::move(matched.overrides);
        loaded.level.orphans = std::move(matched.orphans);
        loaded.match = matched.summary;
        for (Diagnostic& warning : matched.warnings) {
            if (warning.place.empty()) warning.place = level.mesh_path.string();
            loaded.warnings.push_back(std::move(warning));
        }
        for (Diagnostic& warning : match_kept_faces(loaded.level, kept_face_keys(level)))
            loaded.warnings.push_back({level.mesh_path.string(), std::move(warning.message)});
        if (cancelled(progress)) return cancelled_error(level.mesh_path);
        return loaded;
    } catch (const std::exception& error) {
        return Error{level.mesh_path.string(), std::string("could not be read again: ") + error.what()};
    }
}

Result<LoadedLevel> reload_mesh(const Level& level, const ImportTransform& transform, Progress* progress) {
    if (!(transform.scale >= smallest_import_scale && transform.scale <= largest_import_scale))
        return Error{level.mesh_path.string(),
                     fmt::format("a scale of {} is out of range; expected {} to {}", transform.scale,
                                 smallest_import_scale, largest_import_scale)};
    try {
        Result<LoadedLevel> geometry = load_mesh(level.mesh_path, transform, progress);
        if (!geometry) return geometry;
        if (geometry->level.mesh_stamp != level.mesh_stamp)
            return Error{level.mesh_path.string(), "was changed on disk; reload it first"};
        LoadedLevel loaded = with_geometry(level, std::move(*geometry));
        loaded.match.exact =
            static_cast<std::size_t>(std::count_if(level.overrides.begin(), level.overrides.end(),
                                                   [](const auto& type) { return type.has_value(); }));
        loaded.match.orphaned = level.orphans.size();
        return loaded;
    } catch (const std::exception& error) {
        return Error{level.mesh_path.string(), std::string("could not be read again: ") + error.what()};
    }
}

bool mesh_changed_on_disk(const Level& level) {
    const Result<std::string> bytes = read_file(level.mesh_path);
    return !bytes || file_stamp(*bytes) != level.mesh_stamp;
}

std::string MatchSummary::text() const {
    std::string text = fmt::format("{} exact, {} by plane", exact, by_plane);
    if (by_nearest > 0) text += fmt::format(", {} by nearest", by_nearest);
    return text + fmt::format(", {} orphaned", orphaned);
}

std::filesystem::path level_file_for(const std::filesystem::path& mesh_path) {
    fs::path path = mesh_path;
    return path.replace_extension(".slipface.json");
}

Result<LoadedLevel> load_level(const std::filesystem::path& path, Progress* progress) {
    try {
        Result<LoadedLevel> loaded =
            is_level_file(path) ? load_from_level_file(path, progress) : load_from_mesh(path, progress);
        if (!loaded) return loaded;
        if (const Status status = load_terrain(loaded->level); !status) {
            loaded->warnings.push_back({loaded->level.file_path.string() + ":/heightfield",
                                        "there is no terrain: " + status.error().text()});
        }
        return loaded;
    } catch (const std::exception& error) {
        return Error{path.string(), std::string("could not be opened: ") + error.what()};
    }
}

Status save_level(const Level& level) {
    return save_level(level, level.file_path);
}

Status save_level(const Level& level, const std::filesystem::path& file_path) {
    try {
        return write_file_atomic(file_path, level_text(level, file_path));
    } catch (const std::exception& error) {
        return Error{file_path.string(), std::string("could not be written: ") + error.what()};
    }
}

}  // namespace slipface
