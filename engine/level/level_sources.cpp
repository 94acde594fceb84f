#include "slipface/level/level_sources.h"

#include <set>
#include <span>
#include <string_view>

#include "slipface/base/named_file.h"
#include "slipface/level/prop_materials.h"
#include "slipface/mesh/texture_file.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

class Sources {
  public:
    explicit Sources(const Level& level) : level_(level), folder_(level.mesh_path.parent_path()) {}

    LevelSources find() {
        if (level_.mesh) {
            meshes_.insert(own_mesh(level_)->other_files.begin(), own_mesh(level_)->other_files.end());
            add_materials(own_mesh(level_)->materials);
        }
        for (const PropMesh& mesh : level_.placed.meshes) {
            add_named(mesh.file, folder_, meshes_);
            if (!mesh.mesh) continue;
            meshes_.insert(mesh.mesh->other_files.begin(), mesh.mesh->other_files.end());
            add_materials(prop_materials(*mesh.mesh, mesh.file, {}));
        }
        std::set<std::string_view> textures;
        for (const Prop& prop : level_.props)
            if (textures.insert(prop.texture).second) add_texture(prop.texture);
        const fs::path beside = level_.file_path.parent_path();
        std::set<fs::path> maps;
        if (level_.heightfield) add_named(level_.heightfield->file, beside, maps);
        if (level_.light) add_named(level_.light->image, beside, maps);
        return {{meshes_.begin(), meshes_.end()},
                {textures_.begin(), textures_.end()},
                {maps.begin(), maps.end()}};
    }

  private:
    static void add_named(const std::string& name, const fs::path& folder, std::set<fs::path>& to) {
        const NamedFile file = named_file(name, folder);
        if (!name.empty() && file.state != NamedFile::State::outside) to.insert(file.path);
    }

    void add_materials(std::span<const Material> materials) {
        for (const Material& material : materials)
            if (!material.picture) add_texture(material.texture);
    }

    void add_texture(const std::string& texture) {
        if (const FoundTexture found = find_texture(texture, folder_); found.path)
            textures_.insert(*found.path);
        else
            add_named(texture, folder_, textures_);
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
