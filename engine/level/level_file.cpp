#include "slipface/level/level_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <map>
#include <span>
#include <system_error>

#include "face_match.h"
#include "found_in_file.h"
#include "level_json.h"
#include "slipface/base/files.h"
#include "slipface/base/named_file.h"
#include "slipface/base/system.h"
#include "slipface/base/text.h"
#include "slipface/level/find_start.h"
#include "slipface/mesh/formats.h"
#include "slipface/mesh/import.h"
#include "slipface/mesh/upright.h"

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

// An absolute path may lead anywhere: a level file saved in another folder than its geometry has one.
Result<fs::path> mesh_of_level_file(const fs::path& file_path, const Json& root) {
    const std::string location = file_path.string();
    const Json* mesh = root.find("mesh");
    if (mesh == nullptr || mesh->kind != Json::Kind::string || mesh->text.empty()) {
        return Error{location + ":/mesh", fmt::format("found {}, expected the name of the level's OBJ file",
                                                      mesh == nullptr ? "nothing" : json_kind_text(*mesh))};
    }
    const fs::path name = path_of(mesh->text);
    const fs::path folder = file_path.parent_path();
    if (!name.is_absolute() && named_file(mesh->text, folder).state == NamedFile::State::outside) {
        return Error{location + ":/mesh",
                     fmt::format("found {}, expected a path inside the level's folder or an absolute one",
                                 json_quoted(json_excerpt(mesh->text)))};
    }
    return folder / name.lexically_normal();
}

Result<LoadedLevel> load_mesh(const fs::path& mesh_path, const ImportTransform& transform, Progress* progress,
                              const std::string* content = nullptr) {
    const auto start = std::chrono::steady_clock::now();
    ImportOptions options;
    options.transform = transform;
    options.progress = progress;
    options.content = content;
    Result<ImportedMesh> imported = import_mesh(mesh_path, options);
    if (!imported) return imported.error();
    LoadedLevel loaded;
    loaded.mesh_load_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    loaded.warnings = std::move(imported->warnings);
    loaded.level.mesh = std::move(imported->mesh);
    loaded.level.mesh_path = mesh_path;
    loaded.level.mesh_stamp = imported->stamp;
    loaded.level.import_transform = transform;
    loaded.level.import_summary = std::move(imported->summary);
    loaded.found_spawns = std::move(imported->spawns);
    loaded.found_types = std::move(imported->types);
    loaded.type_table = std::move(imported->type_table);
    loaded.undrawn = std::move(imported->undrawn);
    loaded.level.file_path = level_file_for(mesh_path);
    loaded.level.spawn_is_set = false;
    loaded.level.overrides.resize(loaded.level.mesh.face_count());
    return loaded;
}

// Loads the geometry with the level file's transform, and applies the file's annotations.
Result<LoadedLevel> load_annotated(const fs::path& mesh_path, const fs::path& file_path, const Json& root,
                                   Progress* progress) {
    const Result<ImportTransform> transform = read_import_transform(root, file_path.string());
    if (!transform) return transform.error();
    Result<LoadedLevel> geometry = load_mesh(mesh_path, *transform, progress);
    if (!geometry) return geometry;
    begin_stage(progress, "Finding painted faces", 1.0, 1.0);
    Result<LoadedLevel> loaded =
        read_level(root, file_path.string(), geometry->level.mesh.own(), {mesh_path, {}});
    if (!loaded) return loaded;
    const fs::path named = loaded->level.mesh_path;
    loaded->level.mesh_path = mesh_path;
    loaded->level.mesh_stamp = geometry->level.mesh_stamp;
    loaded->level.import_summary = std::move(geometry->level.import_summary);
    loaded->found_spawns = std::move(geometry->found_spawns);
    loaded->level.file_path = file_path;
    loaded->mesh_load_s = geometry->mesh_load_s;
    if (!named.empty() && named.lexically_normal() != mesh_path.lexically_normal()) {
        loaded->warnings.insert(
            loaded->warnings.begin(),
            {file_path.string() + ":/mesh",
             fmt::format("names {}, but is next to {}, which was opened", quoted(named), quoted(mesh_path))});
    }
    loaded->warnings.insert(loaded->warnings.begin(), geometry->warnings.begin(), geometry->warnings.end());
    if (cancelled(progress)) return cancelled_error(file_path);
    return loaded;
}

// The spawns of the geometry's file as a level's spawns. Duplicate names get a number.
std::vector<Spawn> spawns_of(std::span<const FoundSpawn> found, const MovementSettings& movement) {
    std::vector<Spawn> spawns;
    std::map<std::string, int> names;  // how often each was used
    for (const FoundSpawn& one : found) {
        const std::string wanted = one.name.empty() ? Spawn{}.name : one.name;
        std::string name = wanted;
        while (names.contains(name))
            name = fmt::format("{} {}", wanted, ++names[wanted]);
        names[name] = 1;
        const Vec3 centre = one.feet + Vec3(0.0, movement.radii.y() + movement.skin, 0.0);
        spawns.push_back({centre, one.yaw, std::move(name)});
        if (spawns.size() == max_spawns || !spawns_problem({&spawns.back(), 1}).empty()) break;
    }
    if (!spawns.empty() && !spawns_problem({&spawns.back(), 1}).empty()) spawns.pop_back();
    return spawns;
}

// The version is checked first: in another version the other members may have another meaning.
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

// The types of a table in the geometry's file. It is read as a level file that has nothing else, so it is
// checked like one; a bad table is a warning.
void take_type_table(LoadedLevel& loaded) {
    const std::string location = loaded.level.mesh_path.string() + ":slipface_types";
    const Result<Json> root =
        parse_json(fmt::format("{{\"slipface\": {}, \"mesh\": {}, \"surfaces\": {}}}", level_file_version,
                               json_quoted(loaded.level.mesh_path.filename().string()), loaded.type_table),
                   location);
    Result<LoadedLevel> read =
        root ? read_level(*root, location, loaded.level.mesh.own()) : Result<LoadedLevel>(root.error());
    if (read) {
        loaded.level.surfaces = std::move(read->level.surfaces);
    } else {
        loaded.warnings.push_back(
            {read.error().location, "the file's types are ignored: " + read.error().message});
    }
}

// A level without a level file: types, rules and hidden faces of the geometry's file.
Result<LoadedLevel> load_fresh(const fs::path& mesh_path, Progress* progress) {
    Result<LoadedLevel> loaded = load_mesh(mesh_path, {}, progress);
    if (!loaded) return loaded;
    if (!loaded->type_table.empty()) take_type_table(*loaded);
    add_found_types(loaded->level, loaded->found_types);
    loaded->level.hidden = loaded->undrawn;
    return loaded;
}

Result<LoadedLevel> load_from_mesh(const fs::path& mesh_path, Progress* progress) {
    const fs::path file_path = level_file_for(mesh_path);
    std::error_code error;
    // A name too long for the file system means that there is no such file.
    if (fs::status(file_path, error).type() == fs::file_type::not_found ||
        error == std::errc::filename_too_long)
        return load_fresh(mesh_path, progress);
    // A missing geometry is reported before errors of the level file.
    if (!fs::exists(mesh_path, error)) return load_mesh(mesh_path, {}, progress);
    const Result<Json> root = read_json(file_path);
    if (!root) return root.error();
    return load_annotated(mesh_path, file_path, *root, progress);
}

// A copy of `level` with the given geometry.
LoadedLevel with_geometry(const Level& level, LoadedLevel geometry) {
    Level copy = level;
    copy.mesh = std::move(geometry.level.mesh);
    copy.placed = {};  // what another program changed may be a prop's mesh
    copy.mesh_stamp = geometry.level.mesh_stamp;
    copy.import_transform = geometry.level.import_transform;
    copy.import_summary = std::move(geometry.level.import_summary);
    Warnings warnings = place_props(copy);
    geometry.warnings.insert(geometry.warnings.end(), warnings.begin(), warnings.end());
    geometry.level = std::move(copy);
    return geometry;
}

// The spawns of `level` under the scale and axis of `after`. The feet move with the geometry.
std::vector<Spawn> moved_spawns(const Level& level, const ImportSummary& after) {
    const ImportSummary& before = level.import_summary;
    const Vec3 above_feet(0, level.movement.radii.y(), 0);
    const Eigen::Matrix3d turned =
        (upright_rotation(after.up) * upright_rotation(before.up).transpose()).cast<double>();
    std::vector<Spawn> spawns = all_spawns(level);
    for (Spawn& spawn : spawns)
        spawn.position = turned * (spawn.position - above_feet) * (after.scale / before.scale) + above_feet;
    return spawns;
}

}  // namespace

Result<LoadedLevel> reload_mesh(const Level& level, Progress* progress, const std::string* content) {
    try {
        Result<LoadedLevel> geometry = load_mesh(level.mesh_path, level.import_transform, progress, content);
        if (!geometry) return geometry;
        begin_stage(progress, "Finding painted faces", 1.0, 1.0);
        LoadedLevel loaded = with_geometry(level, std::move(*geometry));
        PaintParts parts;
        const std::vector<StoredOverride> stored = stored_overrides(level, parts);
        MatchedOverrides matched = match_overrides(loaded.level, stored, parts);
        loaded.level.overrides = std::move(matched.overrides);
        loaded.level.orphans = std::move(matched.orphans);
        loaded.match = matched.summary;
        loaded.second = std::move(matched.second);
        loaded.level.guessed = std::move(matched.guessed);
        for (Diagnostic& warning : matched.warnings) {
            if (warning.location.empty()) warning.location = level.mesh_path.string();
            loaded.warnings.push_back(std::move(warning));
        }
        for (Diagnostic& warning : match_stored_faces(loaded.level, stored_face_keys(level)))
            loaded.warnings.push_back({level.mesh_path.string(), std::move(warning.message)});
        if (cancelled(progress)) return cancelled_error(level.mesh_path);
        return loaded;
    } catch (const std::exception& error) {
        return Error{level.mesh_path.string(), std::string("could not be read again: ") + error.what()};
    }
}

Result<LoadedLevel> reload_mesh(const Level& level, const ImportTransform& transform, Progress* progress) {
    try {
        Result<LoadedLevel> geometry = load_mesh(level.mesh_path, transform, progress);
        if (!geometry) return geometry;
        if (geometry->level.mesh_stamp != level.mesh_stamp)
            return Error{level.mesh_path.string(), "was changed on disk; reload it first"};
        LoadedLevel loaded = with_geometry(level, std::move(*geometry));
        set_spawns(loaded.level, moved_spawns(level, loaded.level.import_summary));
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
    const Result<std::string> bytes = read_file(level.mesh_path, max_geometry_bytes);
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
        finish_interrupted_writes(path.parent_path());
        Result<LoadedLevel> loaded =
            is_level_file(path) ? load_from_level_file(path, progress) : load_from_mesh(path, progress);
        if (!loaded) return loaded;
        if (!has_spawn(loaded->level))
            set_spawns(loaded->level, spawns_of(loaded->found_spawns, loaded->level.movement));
        if (const Status status = load_terrain(loaded->level); !status) {
            loaded->warnings.push_back({loaded->level.file_path.string() + ":/heightfield",
                                        "there is no terrain: " + status.error().text()});
        }
        return loaded;
    } catch (const std::exception& error) {
        return Error{path.string(), std::string("could not be opened: ") + error.what()};
    }
}

LevelFiles files_of_level(const fs::path& path) {
    LevelFiles found;
    const fs::path file_path = is_level_file(path) ? path : level_file_for(path);
    fs::path mesh = path;
    found.files = {file_path};
    if (const Result<Json> root = read_json(file_path); root) {
        if (is_level_file(path))
            if (const Result<fs::path> named = mesh_of_level_file(file_path, *root); named) mesh = *named;
        if (const Json* goals = root->find("goals")) found.goals = goals->items.size();
        const auto add_named = [&](const Json* object, const char* key, const fs::path& folder) {
            const Json* name = object != nullptr ? object->find(key) : nullptr;
            if (name == nullptr || name->text.empty()) return;
            const NamedFile file = named_file(name->text, folder);
            if (file.state != NamedFile::State::outside) found.files.push_back(file.path);
        };
        add_named(root->find("heightfield"), "file", file_path.parent_path());
        if (const Json* props = root->find("props"))
            for (const Json& prop : props->items)
                add_named(&prop, "mesh", mesh.parent_path());
    }
    found.files.push_back(mesh);
    const std::string ending = to_lower(mesh.extension().string());
    const fs::path folder = mesh.parent_path().empty() ? fs::path(".") : mesh.parent_path();
    std::error_code error;
    fs::directory_iterator entry(folder, error);
    for (; ending != ".obj" && ending != ".bsp" && !error && entry != fs::directory_iterator();
         entry.increment(error)) {
        const fs::path& other = entry->path();
        if (other.stem() == mesh.stem() || to_lower(other.extension().string()) == ".bin")
            found.files.push_back(mesh.parent_path() / other.filename());
    }
    std::sort(found.files.begin(), found.files.end());
    found.files.erase(std::unique(found.files.begin(), found.files.end()), found.files.end());
    return found;
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
