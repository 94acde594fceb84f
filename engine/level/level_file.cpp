// Levels on disk.

#include "slipface/level/level_file.h"

#include <fmt/format.h>

#include <chrono>

#include "level_json.h"
#include "slipface/base/files.h"
#include "slipface/base/text.h"
#include "slipface/mesh/import.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t max_level_file_bytes = 256ULL << 20;

bool is_level_file(const fs::path& path) {
    return to_lower(path.extension().string()) == ".json";
}

// A relative path may not lead out of the folder: a level from elsewhere must not make the editor open any
// file it names.
Result<fs::path> mesh_of_level_file(const fs::path& file_path, std::string_view text) {
    const std::string place = file_path.string();
    const Result<Json> root = parse_json(text, place);
    if (!root) return root.error();
    const Json* mesh = root->find("mesh");
    if (mesh == nullptr || mesh->kind != Json::Kind::string || mesh->text.empty()) {
        return Error{place + ":/mesh", fmt::format("found {}, expected the name of the level's OBJ file",
                                                   mesh == nullptr ? "nothing" : json_kind_text(*mesh))};
    }
    const fs::path name(mesh->text);
    const fs::path normal = name.lexically_normal();
    if (!name.is_absolute() && !normal.empty() && *normal.begin() == "..") {
        return Error{place + ":/mesh",
                     fmt::format("found {}, expected a path inside the level's folder or an absolute one",
                                 json_quoted(mesh->text))};
    }
    return file_path.parent_path() / normal;
}

Result<LoadedLevel> load_mesh(const fs::path& mesh_path) {
    const auto start = std::chrono::steady_clock::now();
    Result<ImportedMesh> imported = import_mesh(mesh_path);
    if (!imported) return imported.error();
    LoadedLevel loaded;
    loaded.mesh_load_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    loaded.warnings = std::move(imported->warnings);
    loaded.level.mesh = std::move(imported->mesh);
    loaded.level.mesh_path = mesh_path;
    loaded.level.file_path = level_file_for(mesh_path);
    loaded.level.overrides.resize(loaded.level.mesh->face_count());
    return loaded;
}

Result<LoadedLevel> with_annotations(LoadedLevel geometry, const fs::path& file_path, std::string_view text) {
    Result<LoadedLevel> loaded = level_from_json(text, file_path.string(), geometry.level.mesh);
    if (!loaded) return loaded;
    const fs::path named = loaded->level.mesh_path;
    loaded->level.mesh_path = geometry.level.mesh_path;
    loaded->level.file_path = file_path;
    loaded->mesh_load_s = geometry.mesh_load_s;
    if (!named.empty() && named.lexically_normal() != geometry.level.mesh_path.lexically_normal()) {
        loaded->warnings.insert(loaded->warnings.begin(),
                                {file_path.string() + ":/mesh",
                                 fmt::format("names \"{}\", but lies beside \"{}\", which was opened",
                                             named.string(), geometry.level.mesh_path.string())});
    }
    loaded->warnings.insert(loaded->warnings.begin(), geometry.warnings.begin(), geometry.warnings.end());
    return loaded;
}

Result<LoadedLevel> load_from_level_file(const fs::path& file_path) {
    const Result<std::string> text = read_file(file_path, max_level_file_bytes);
    if (!text) return text.error();
    const Result<fs::path> mesh_path = mesh_of_level_file(file_path, *text);
    if (!mesh_path) return mesh_path.error();
    std::error_code error;
    if (!fs::exists(*mesh_path, error)) {
        return Error{
            file_path.string() + ":/mesh",
            fmt::format("found no file \"{}\", expected the level's OBJ file there", mesh_path->string())};
    }
    Result<LoadedLevel> geometry = load_mesh(*mesh_path);
    if (!geometry) return geometry;
    return with_annotations(std::move(*geometry), file_path, *text);
}

Result<LoadedLevel> load_from_mesh(const fs::path& mesh_path) {
    Result<LoadedLevel> geometry = load_mesh(mesh_path);
    if (!geometry) return geometry;
    const fs::path file_path = geometry->level.file_path;
    std::error_code error;
    if (fs::status(file_path, error).type() == fs::file_type::not_found) return geometry;
    const Result<std::string> text = read_file(file_path, max_level_file_bytes);
    if (!text) return text.error();
    return with_annotations(std::move(*geometry), file_path, *text);
}

}  // namespace

std::string MatchSummary::text() const {
    std::string text = fmt::format("{} exact, {} by plane", exact, by_plane);
    if (by_nearest > 0) text += fmt::format(", {} by nearest", by_nearest);
    return text + fmt::format(", {} orphaned", orphaned);
}

std::filesystem::path level_file_for(const std::filesystem::path& mesh_path) {
    fs::path path = mesh_path;
    return path.replace_extension(".slipface.json");
}

Result<LoadedLevel> load_level(const std::filesystem::path& path) {
    try {
        return is_level_file(path) ? load_from_level_file(path) : load_from_mesh(path);
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
