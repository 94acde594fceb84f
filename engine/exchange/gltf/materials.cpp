#include "gltf/materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "slipface/base/files.h"
#include "slipface/base/text.h"
#include "slipface/image/image.h"
#include "slipface/mesh/srgb.h"
#include "slipface/mesh/texture_file.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view png_head = "\x89PNG\r\n\x1a\n", jpeg_head = "\xff\xd8\xff";

bool has_alpha(std::string_view png) {
    constexpr std::size_t color_type = 25;  // in the header of a PNG; 4 and 6 have an alpha channel
    return png.starts_with(png_head) && png.size() > color_type && (png[color_type] & 4) != 0;
}

class PictureWriter {
  public:
    PictureWriter(const Level& level, const fs::path& file, bool embed, GltfBuffer& buffer)
        : level_folder_(level.mesh_path.parent_path()), embed_(embed), buffer_(buffer), beside_(file) {}

    struct Texture {
        std::size_t index = 0;
        bool alpha = false;
    };
    // The texture of a material's image file; each file once. Nothing if it cannot be read.
    std::optional<Texture> texture(const Material& material) {
        if (material.texture.empty()) return std::nullopt;
        const auto [entry, added] = known_.try_emplace({material.picture.get(), material.texture});
        if (added) entry->second = make(material);
        return entry->second;
    }

    void append_to(GltfJson& root) const {
        if (images_.empty()) return;
        root["textures"] = textures_;
        root["images"] = images_;
    }
    std::vector<ExportedFile> take() { return beside_.take(); }

  private:
    std::optional<Texture> make(const Material& material) {
        Result<TextureBytes> read = read_texture(material, level_folder_);
        if (!read) return std::nullopt;
        fs::path file = read->file.empty() ? fs::path(material.texture) : read->file;
        Result<std::string> bytes = std::move(read->bytes);
        const bool converted = !bytes->starts_with(png_head) && !bytes->starts_with(jpeg_head);
        if (converted) {
            const Result<Image> image = decode_image(*bytes, file.string());
            if (!image) return std::nullopt;
            bytes = encode_png(*image);
            if (!bytes) return std::nullopt;
            file.replace_extension(".png");
        }
        const Texture texture{textures_.size(), has_alpha(*bytes)};
        textures_.push_back({{"source", images_.size()}});
        const std::string name = file.stem().string();
        if (embed_) {
            const char* type = bytes->starts_with(png_head) ? "image/png" : "image/jpeg";
            images_.push_back(
                {{"name", name}, {"mimeType", type}, {"bufferView", buffer_.bytes_view(*bytes)}});
        } else {
            images_.push_back(
                {{"uri", uri_text(place(file, !converted && !material.picture, std::move(*bytes)))}});
        }
        return texture;
    }

    // The picture's name as seen from the file. `in_place`: there is a file of these bytes.
    fs::path place(const fs::path& picture, bool in_place, std::string bytes) {
        if (in_place && lies_within(picture, beside_.folder())) {
            std::error_code error;
            const fs::path seen = fs::relative(picture, beside_.folder(), error);
            if (!error && !seen.empty()) return seen;
        }
        return beside_.add(picture, std::move(bytes));
    }

    fs::path level_folder_;
    bool embed_;
    GltfBuffer& buffer_;
    std::map<std::pair<const std::string*, std::string>, std::optional<Texture>> known_;  // by picture, name
    GltfJson textures_ = GltfJson::array(), images_ = GltfJson::array();
    PicturesBeside beside_;
};

}  // namespace

std::vector<ExportedFile> add_gltf_materials(const Level& level, const TypedMaterials& materials,
                                             const fs::path& file, bool embed, GltfBuffer& buffer,
                                             GltfJson& root) {
    PictureWriter pictures(level, file, embed, buffer);
    GltfJson list = GltfJson::array();
    for (std::size_t i = 0; i < materials.names.size(); ++i) {
        const Material& base = level.mesh->materials[materials.base[i]];
        const auto& type = materials.of_type[i];
        const Vec3f color = linear_of_srgb(type ? tinted(base.diffuse, level.surfaces[*type]) : base.diffuse);
        GltfJson pbr{{"baseColorFactor", {color[0], color[1], color[2], 1.0}}, {"metallicFactor", 0.0}};
        const auto texture = pictures.texture(base);
        if (texture) pbr["baseColorTexture"] = {{"index", texture->index}};
        GltfJson material = GltfJson::object();
        if (!materials.names[i].empty()) material["name"] = materials.names[i];
        material["pbrMetallicRoughness"] = std::move(pbr);
        if (texture && texture->alpha) material["alphaMode"] = "MASK";
        if (type) material["extras"] = {{"slipface_type", level.surfaces[*type].name}};
        list.push_back(std::move(material));
    }
    root["materials"] = std::move(list);
    pictures.append_to(root);
    return pictures.take();
}

}  // namespace slipface
