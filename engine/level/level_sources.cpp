#include "slipface/level/level_sources.h"

#include <set>
#include <string_view>

#include "slipface/base/files.h"
#include "slipface/base/system.h"
#include "slipface/mesh/texture_file.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

class Sources {
  public:
    explicit Sources(const Level& level) : level_(level), folder_(level.mesh_path.parent_path()) {}

    LevelSources find() {
        if (level_.mesh) add_mesh(*own_mesh(level_), folder_);
        for (const PropMesh& mesh : level_.placed.meshes) {
            const fs::path path = folder_ / path_of(mesh.file);
            if (lies_within(path, folder_)) meshes_.insert(path);
            if (mesh.mesh) add_mesh(*mesh.mesh, path.parent_path());
        }
        std::set<std::string_view> textures;
        for (const Prop& prop : level_.props)
            if (textures.insert(prop.texture).second) add_texture(prop.texture, folder_);
        const fs::path beside = level_.file_path.parent_path();
        std::set<fs::path> maps;
        if (level_.heightfield) maps.insert(beside / path_of(level_.heightfield->file));
        if (level_.light && !level_.light->image.empty()) maps.insert(beside / path_of(level_.light->image));
        return {{meshes_.begin(), meshes_.end()},
                {textures_.begin(), textures_.end()},
                {maps.begin(), maps.end()}};
    }

  private:
    void add_mesh(const Mesh& mesh, const fs::path& from) {
        meshes_.insert(mesh.other_files.begin(), mesh.other_files.end());
        for (const Material& material : mesh.materials)
            if (!material.picture) add_texture(material.texture, from);
    }

    void add_texture(const std::string& texture, const fs::path& from) {
        if (texture.empty()) return;
        const FoundTexture found = find_texture(texture, from, TextureAccess::folder);
        if (!found.refused) textures_.insert(found.path.value_or(from / texture));
    }

    const Level& level_;
    const fs::path folder_;
    std::set<fs::path> meshes_, textures_;
};

}  // namespace

LevelSources level_sources(const Level& level) {
    return Sources(level).find();
}

}  // namespace slipface
