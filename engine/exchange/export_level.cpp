#include "export_parts.h"
#include "slipface/base/files.h"
#include "slipface/level/level_sources.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

// All that the level was read from.
std::vector<fs::path> own_files(const Level& level) {
    LevelSources sources = level_sources(level);
    std::vector<fs::path> files{level.mesh_path, level.file_path};
    for (const std::vector<fs::path>& some : {sources.meshes, sources.textures, sources.maps})
        files.insert(files.end(), some.begin(), some.end());
    return files;
}

Status check_own(const std::vector<fs::path>& own, const fs::path& path) {
    for (const fs::path& file : own) {
        std::error_code error;
        if (path == file || fs::equivalent(path, file, error))
            return Error{path.string(), "is a file of the level itself; expected another name"};
    }
    return {};
}

// Two targets of one name share their pictures, but not more.
Status add_file(ExportedFile file, std::vector<ExportedFile>& files) {
    for (const ExportedFile& other : files) {
        if (other.path.lexically_normal() != file.path.lexically_normal()) continue;
        if (other.bytes == file.bytes) return {};
        return Error{file.path.string(),
                     "belongs to two of the exports; expected another name for one of them"};
    }
    files.push_back(std::move(file));
    return {};
}

}  // namespace

Status export_level(const Level& level, const ExportTargets& targets, std::span<const GltfNode> nodes) {
    std::vector<ExportedFile> files;
    Status status;
    if (!level.mesh) return Error{level.mesh_path.string(), "the level has no geometry"};
    const std::vector<fs::path> own = own_files(level);
    const auto add = [&](const std::optional<fs::path>& target, const auto& make) {
        if (!target || !status) return;
        Result<std::vector<ExportedFile>> made = make(*target);
        if (!made) {
            status = made.error();
            return;
        }
        for (std::size_t i = 0; i < made->size() && status; ++i) {
            status = check_own(own, (*made)[i].path);
            if (status) status = add_file(std::move((*made)[i]), files);
        }
    };
    add(targets.obj, [&](const fs::path& path) { return obj_files(level, path); });
    add(targets.gltf, [&](const fs::path& path) { return gltf_files(level, path, nodes); });
    add(targets.flat, [&](const fs::path& path) { return flat_files(level, path); });
    if (!status) return status;
    std::vector<FileToWrite> together;
    for (const ExportedFile& file : files)
        together.push_back({file.path, file.bytes});
    return write_files_atomic(together);
}

}  // namespace slipface
