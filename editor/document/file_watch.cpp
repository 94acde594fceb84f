#include "document/file_watch.h"

#include <sys/stat.h>

#include <utility>

namespace slipface {
FileWatch::Stamp FileWatch::stamp_of(const std::filesystem::path& file) {
    struct stat status {};
    if (::stat(file.c_str(), &status) != 0) return {};
    return {static_cast<std::int64_t>(status.st_mtim.tv_sec) * 1000000000 + status.st_mtim.tv_nsec,
            static_cast<std::uint64_t>(status.st_size), true};
}

void FileWatch::look(Group& group) {
    group.now.clear();
    for (const std::filesystem::path& file : group.files)
        group.now.push_back(stamp_of(file));
}

void FileWatch::start(const std::filesystem::path& mesh, const std::filesystem::path& level_file,
                      bool level_is_known, std::vector<std::filesystem::path> libraries,
                      std::vector<std::filesystem::path> textures) {
    mesh_ = mesh;
    level_ = level_file;
    mesh_known_ = mesh_now_ = stamp_of(mesh_);
    level_now_ = stamp_of(level_);
    level_known_ = level_is_known ? level_now_ : Stamp{.changed_ns = -1};
    libraries_.files = std::move(libraries);
    textures_.files = std::move(textures);
    for (Group* group : {&libraries_, &textures_}) {
        look(*group);
        group->known = group->now;
    }
    watching_ = true;
    reported_ = false;
}

bool FileWatch::poll() {
    if (!watching_) return false;
    const Stamp mesh = stamp_of(mesh_), level = stamp_of(level_);
    const std::vector<Stamp> libraries = libraries_.now, textures = textures_.now;
    look(libraries_);
    look(textures_);
    at_rest_ =
        mesh == mesh_now_ && level == level_now_ && libraries == libraries_.now && textures == textures_.now;
    if (!at_rest_) reported_ = false;
    mesh_now_ = mesh;
    level_now_ = level;
    if (!at_rest_ || reported_ || !mesh.there) return false;
    if (!mesh_changed() && !level_changed() && !libraries_changed() && !textures_changed()) return false;
    reported_ = true;
    return true;
}

}  // namespace slipface
