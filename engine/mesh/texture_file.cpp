#include "slipface/mesh/texture_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "slipface/base/files.h"
#include "slipface/base/named_file.h"
#include "slipface/base/system.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t max_texture_bytes = std::uint64_t{512} << 20;

// The name as authored, then the file name alone in each folder on the way, the deepest first.
std::vector<std::string> names_to_try(std::string authored) {
    constexpr std::size_t most = 16;
    std::replace(authored.begin(), authored.end(), '\\', '/');
    std::vector<std::string> names{authored};
    const std::size_t last = authored.find_last_of('/');
    if (last == std::string::npos) return names;
    const std::string file = authored.substr(last + 1);
    const bool from_root = path_of(authored).has_root_directory();
    for (std::size_t end = last; !from_root && end != std::string::npos && end > 0 && names.size() < most;
         end = authored.find_last_of('/', end - 1))
        names.push_back(authored.substr(0, end + 1) + file);
    names.push_back(file);
    return names;
}

}  // namespace

FoundTexture find_texture(const std::string& authored, const fs::path& folder) {
    FoundTexture found;
    for (const std::string& name : names_to_try(authored)) {
        const NamedFile file = named_file(name, folder);
        std::error_code error;
        if (!fs::is_regular_file(file.path, error)) continue;
        if (file) {
            found.path = file.path;
            break;
        }
        found.refused = true;
    }
    return found;
}

Result<TextureBytes> read_texture(const Material& material, const fs::path& folder) {
    TextureBytes read;
    if (material.picture) {
        read.bytes = *material.picture;
        read.location = "picture " + material.texture;
        return read;
    }
    const auto [path, refused] = find_texture(material.texture, folder);
    const std::string outside =
        fmt::format("the texture \"{}\" lies outside the level's folder: not read", material.texture);
    if (!path)
        return Error{location_of(material),
                     refused ? outside
                             : fmt::format("found no texture \"{}\" in {}", material.texture,
                                           folder.empty() ? "." : folder.string())};
    if (refused) read.note = outside + "; the image with that name in the level's folder is used";
    Result<std::string> bytes = read_file(*path, max_texture_bytes);
    if (!bytes) return Error{location_of(material), bytes.error().text()};
    read.bytes = std::move(*bytes);
    read.file = *path;
    read.location = path->string();
    return read;
}

std::string location_of(const Material& material) {
    return material.name.empty() ? "a material without a name" : "material \"" + material.name + "\"";
}

}  // namespace slipface
