#include "export_parts.h"
#include "slipface/base/files.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

Status check_target(const Level& level, const fs::path& path) {
    if (!level.mesh) return Error{path.string(), "the level has no geometry"};
    std::error_code error;
    for (const fs::path& own : {level.mesh_path, level.file_path})
        if (path == own || fs::equivalent(path, own, error))
            return Error{path.string(), "is a file of the level itself; expected another name"};
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
    const auto add = [&](const std::optional<fs::path>& target, const auto& make) {
        if (!target || !status) return;
        status = check_target(level, *target);
        if (!status) return;
        Result<std::vector<ExportedFile>> made = make(*target);
        if (!made) {
            status = made.error();
            return;
        }
        for (std::size_t i = 0; i < made->size() && status; ++i)
            status = add_file(std::move((*made)[i]), files);
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
