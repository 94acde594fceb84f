// Sources: glTF 2.0, section 3.9, and the extensions KHR_texture_transform, EXT_texture_webp and
// KHR_materials_pbrSpecularGlossiness, whose diffuse picture is the base colour.
#include "gltf/gltf_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "obj/obj_text.h"
#include "slipface/base/text.h"
#include "slipface/mesh/srgb.h"

namespace slipface {
namespace {

constexpr std::string_view type_key = "slipface_type";
constexpr std::size_t longest_type = 255;  // bytes

struct Picture {
    std::string name;
    std::shared_ptr<const std::string> bytes;  // null: `name` is a file beside
};

class Pictures {
  public:
    Pictures(GltfFile& file, WarningList& warnings) : file_(file), warnings_(warnings) {}

    // The picture of a texture, or nothing if there is none that is read.
    std::optional<Picture> of(const GltfValue& reference) {
        const GltfValue texture = file_.element("textures", reference);
        const GltfValue webp = texture.extension("EXT_texture_webp")["source"];
        const GltfValue source = webp ? webp : texture["source"];
        if (!source) {
            const GltfValue compressed = texture.extension("KHR_texture_basisu");
            warnings_.add(texture.place(), compressed
                                               ? "the picture is KTX 2, which is not read; save it as PNG"
                                               : "the texture has no picture that is read");
            return std::nullopt;
        }
        const std::uint64_t index = source.whole();
        const auto known = known_.find(index);
        return known != known_.end() ? known->second : known_.emplace(index, read(source)).first->second;
    }

  private:
    std::optional<Picture> read(const GltfValue& source) {
        const GltfValue image = file_.element("images", source);
        const GltfValue uri = image["uri"];
        Picture picture;
        if (!uri) {
            picture.bytes = std::make_shared<const std::string>(file_.view(image["bufferView"]));
        } else if (auto bytes = GltfFile::data_of(uri)) {
            picture.bytes = std::make_shared<const std::string>(std::move(*bytes));
        } else {
            bool converted = false;
            picture.name = utf8_name(GltfFile::without_escapes(uri.text()), converted);
            return picture;
        }
        picture.name = name_of(image, source.whole(), *picture.bytes);
        return picture;
    }

    // The image's name without folders, or "picture-N", with the ending of its format.
    std::string name_of(const GltfValue& image, std::size_t index, std::string_view bytes) {
        const std::string whole = image["name"].text("");
        std::string stem = whole.substr(whole.find_last_of("/\\") + 1), ending;
        if (const std::size_t dot = stem.rfind('.'); dot != std::string::npos && dot > 0) {
            ending = stem.substr(dot);
            stem.resize(dot);
        } else {
            std::string type = image["mimeType"].text("");
            if (const std::string uri = image["uri"].text(""); uri.starts_with("data:image/"))
                type = uri.substr(5, uri.find_first_of(";,") - 5);
            if (type.empty()) type = bytes.starts_with("\x89PNG") ? "image/png" : "image/jpeg";
            ending = "." + (type == "image/jpeg" ? std::string("jpg") : type.substr(type.find('/') + 1));
        }
        if (stem.empty()) stem = fmt::format("picture-{}", index + 1);
        std::string name = stem + ending;
        for (std::size_t next = 2; !taken_.insert(name).second; ++next)
            name = fmt::format("{}-{}{}", stem, next, ending);
        return name;
    }

    GltfFile& file_;
    WarningList& warnings_;
    std::map<std::size_t, std::optional<Picture>> known_;
    std::set<std::string> taken_;
};

// The extension: scale, then rotation counter-clockwise as seen with V down, then offset.
Eigen::Matrix<float, 2, 3> uv_transform(const GltfValue& from) {
    float offset[2] = {0, 0}, scale[2] = {1, 1};
    from["offset"].numbers(offset, 2);
    from["scale"].numbers(scale, 2);
    const double angle = from["rotation"].number(0.0), c = std::cos(angle), s = std::sin(angle);
    // With V down: u' = c sx u + s sy v + x, v' = -s sx u + c sy v + y. Then V is turned up.
    Eigen::Matrix<double, 2, 3> up;
    up << c * scale[0], s * scale[1], offset[0], s * scale[0], -c * scale[1], 1.0 - offset[1];
    return up.cast<float>();
}

std::string plain(std::string_view text) {
    std::string result = to_lower(text);
    std::replace(result.begin(), result.end(), ' ', '_');
    return result;
}

std::string with_type(std::string name, const GltfValue& type, const std::string& location,
                      WarningList& warnings) {
    if (!type) return name;
    const std::string text = type.is_text() ? type.text() : std::string();
    if (!type.is_text() || text.size() > longest_type || find_binary(text) != std::string_view::npos) {
        warnings.add(location, fmt::format("ignored \"{}\" of the material {}: expected a name", type_key,
                                           in_quotes(name)));
        return name;
    }
    const std::string suffix = "__" + text;
    if (!text.empty() && !plain(name).ends_with(plain(suffix))) name += suffix;
    return name;
}

}  // namespace

std::vector<GltfMaterial> gltf_materials(GltfFile& file, WarningList& warnings) {
    Pictures pictures(file, warnings);
    std::vector<GltfMaterial> materials;
    const GltfValue list = file.root()["materials"];
    for (std::size_t i = 0; i < list.size(); ++i) {
        const GltfValue from = list.at(i);
        GltfMaterial made;
        Material& material = made.material;
        material.name = with_type(from["name"].text(""), from["extras"][type_key], file.location(), warnings);
        const GltfValue old = from.extension("KHR_materials_pbrSpecularGlossiness");
        const GltfValue look = old ? old : from["pbrMetallicRoughness"];
        float color[4] = {1, 1, 1, 1};
        look[old ? "diffuseFactor" : "baseColorFactor"].numbers(color, 4);
        const Vec3f linear = Vec3f(color[0], color[1], color[2]).cwiseMax(0.0F).cwiseMin(1.0F);
        material.diffuse = srgb_of_linear(linear);
        if (const GltfValue texture = look[old ? "diffuseTexture" : "baseColorTexture"]) {
            if (const auto picture = pictures.of(texture["index"])) {
                material.texture = picture->name;
                material.picture = picture->bytes;
            }
            const GltfValue transform = texture.extension("KHR_texture_transform");
            made.uv_set =
                fmt::format("TEXCOORD_{}", transform["texCoord"].whole(texture["texCoord"].whole(0)));
            made.uv_transform = uv_transform(transform);
        }
        materials.push_back(std::move(made));
    }
    materials.emplace_back().material.diffuse = Vec3f::Ones();
    return materials;
}

}  // namespace slipface
