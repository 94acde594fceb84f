#include "slipface/mesh/texture_file.h"

#include <algorithm>

#include "slipface/base/files.h"
#include "slipface/base/system.h"

namespace slipface {

FoundTexture find_texture(const std::string& authored, const std::filesystem::path& folder,
                          TextureAccess access) {
    FoundTexture found;
    if (authored.find('\0') != std::string::npos || authored.size() > 4096) return found;
    std::string portable = authored;
    std::replace(portable.begin(), portable.end(), '\\', '/');
    const std::filesystem::path path = path_of(portable);
    for (const auto& candidate : {folder / path, folder / path.filename()}) {
        std::error_code error;
        if (!std::filesystem::is_regular_file(candidate, error)) continue;
        if (access == TextureAccess::anywhere || lies_within(candidate, folder)) {
            found.path = candidate;
            break;
        }
        found.refused = true;
    }
    return found;
}

std::string location_of(const Material& material) {
    return material.name.empty() ? "a material without a name" : "material \"" + material.name + "\"";
}

std::vector<std::string> outside_textures(const Mesh& mesh, const std::filesystem::path& folder) {
    std::vector<std::string> textures;
    for (const Material& material : mesh.materials) {
        if (material.texture.empty() || material.picture ||
            !find_texture(material.texture, folder, TextureAccess::folder).refused ||
            std::find(textures.begin(), textures.end(), material.texture) != textures.end())
            continue;
        textures.push_back(material.texture);
    }
    return textures;
}

}  // namespace slipface
