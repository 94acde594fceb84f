// Source: the public Quake III source, qcommon/qfiles.h (lumps and records of a BSP of version 46).
#include "bsp/bsp_file.h"

#include <fmt/format.h>

#include <tuple>

#include "slipface/mesh/bsp_flags.h"

namespace slipface {
namespace {

std::string kind_of(std::string_view bytes) {
    if (bytes.size() < 8) return fmt::format("{} bytes", bytes.size());
    if (bytes.substr(1, 3) != "BSP" || bytes[0] < 'A' || bytes[0] > 'Z') return "another kind of file";
    return fmt::format("{}BSP of version {}", bytes[0], u32_at(bytes, 4));
}

}  // namespace

Result<BspFile> open_bsp(std::string_view bytes, const std::string& location) {
    constexpr std::size_t header_size = 144;
    if (bytes.size() < header_size || !bytes.starts_with("IBSP") || u32_at(bytes, 4) != 46)
        return Error{location,
                     fmt::format("is no Quake 3 map; found {}, expected IBSP of version 46", kind_of(bytes))};
    BspFile file;
    BspLump entities;
    for (auto [lump, number] :
         {std::tuple(&entities, std::size_t{0}), std::tuple(&file.textures, std::size_t{1}),
          std::tuple(&file.planes, std::size_t{2}), std::tuple(&file.nodes, std::size_t{3}),
          std::tuple(&file.leaves, std::size_t{4}), std::tuple(&file.models, std::size_t{7}),
          std::tuple(&file.brushes, std::size_t{8}), std::tuple(&file.sides, std::size_t{9}),
          std::tuple(&file.vertices, std::size_t{10}), std::tuple(&file.indices, std::size_t{11}),
          std::tuple(&file.faces, std::size_t{13})}) {
        const std::size_t begin = u32_at(bytes, 8 + 8 * number);
        const std::size_t size = u32_at(bytes, 12 + 8 * number);
        if (begin > bytes.size() || size > bytes.size() - begin || size % lump->record != 0)
            return Error{location, fmt::format("lump {} of {} bytes at {} does not fit into the file of {}",
                                               number, size, begin, bytes.size())};
        lump->bytes = bytes.substr(begin, size);
    }
    file.entities = entities.bytes;
    return file;
}

Result<std::vector<BspTexture>> bsp_textures(std::string_view bytes, const std::string& location) {
    const auto file = open_bsp(bytes, location);
    if (!file) return file.error();
    std::vector<BspTexture> textures;
    for (std::size_t i = 0; i < file->textures.count(); ++i)
        textures.push_back(
            {file->texture_name(i), bsp_surface_type(file->surface_flags(i), file->contents(i))});
    return textures;
}

}  // namespace slipface
