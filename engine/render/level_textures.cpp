#include "level_textures.h"

#include <algorithm>
#include <cstring>
#include <map>

#include "slipface/mesh/texture_file.h"

namespace slipface {

namespace {

constexpr int max_file_side = 8192;  // larger files are refused before they are decoded
constexpr std::uint64_t max_total_bytes = std::uint64_t{1}
                                          << 30;  // of all textures of a level, mipmaps included
constexpr std::size_t max_texture_warnings = 100;

Image checker() {
    Image image = make_image(64, 64, 208, 64, 176);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            if (((x / 16) + (y / 16)) % 2 == 0) continue;
            std::uint8_t* pixel = image.pixel(x, y);
            pixel[0] = pixel[1] = pixel[2] = 44;
        }
    }
    return image;
}

Image halved(const Image& image) {
    Image half = make_image(std::max(1, image.width / 2), std::max(1, image.height / 2), 0, 0, 0);
    for (int y = 0; y < half.height; ++y) {
        const int y0 = std::min(2 * y, image.height - 1), y1 = std::min(2 * y + 1, image.height - 1);
        for (int x = 0; x < half.width; ++x) {
            const int x0 = std::min(2 * x, image.width - 1), x1 = std::min(2 * x + 1, image.width - 1);
            for (int channel = 0; channel < 4; ++channel) {
                const int sum = image.pixel(x0, y0)[channel] + image.pixel(x1, y0)[channel] +
                                image.pixel(x0, y1)[channel] + image.pixel(x1, y1)[channel];
                half.pixel(x, y)[channel] = static_cast<std::uint8_t>((sum + 2) / 4);
            }
        }
    }
    return half;
}

bool is_opaque(const Image& image) {
    for (std::size_t alpha = 3; alpha < image.rgba.size(); alpha += 4)
        if (image.rgba[alpha] != 255) return false;
    return true;
}

}  // namespace

Warnings LevelTextures::load(const Mesh& mesh, const std::filesystem::path& folder) {
    clear();
    Warnings warnings;
    std::size_t unlisted = 0;
    const auto warn = [&](const std::string& position, const std::string& message) {
        if (warnings.size() < max_texture_warnings) {
            warnings.push_back({position, message});
        } else {
            ++unlisted;
        }
    };
    GLint driver_side = 0;
    gl_->GetIntegerv(GL_MAX_TEXTURE_SIZE, &driver_side);

    std::map<std::pair<const std::string*, std::string>, std::uint32_t> known;  // by picture and name
    std::uint32_t checker_texture = none;
    std::uint64_t total_bytes = 0;
    const auto use_checker = [&] {
        if (checker_texture == none) {
            add(checker());
            checker_texture = static_cast<std::uint32_t>(names_.size());
        }
        return checker_texture;
    };
    const auto load_one = [&](const Material& material) -> std::uint32_t {
        const std::string position = location_of(material);
        const Result<TextureBytes> read = read_texture(material, folder);
        if (!read) {
            warn(position, read.error().message + "; drawn as a checker");
            return use_checker();
        }
        if (!read->note.empty()) warn(position, read->note);
        Result<Image> image = decode_image(read->bytes, read->location, max_file_side);
        if (!image) {
            warn(position, image.error().text() + "; drawn as a checker");
            return use_checker();
        }
        while (image->width > driver_side || image->height > driver_side)
            *image = halved(*image);
        const std::uint64_t bytes = image->rgba.size() + image->rgba.size() / 3;
        if (total_bytes + bytes > max_total_bytes) {
            warn(position, "the level's textures exceed 1 GiB; drawn as a checker");
            return use_checker();
        }
        total_bytes += bytes;
        add(*image);
        return static_cast<std::uint32_t>(names_.size());
    };

    material_texture_.reserve(mesh.materials.size());
    for (const Material& material : mesh.materials) {
        if (material.texture.empty()) {
            material_texture_.push_back(none);
            continue;
        }
        const std::pair key(material.picture.get(), material.texture);
        const auto found = known.find(key);
        const std::uint32_t texture = found != known.end() ? found->second : load_one(material);
        known.emplace(key, texture);
        material_texture_.push_back(texture);
    }
    if (unlisted > 0) {
        warnings.push_back({folder.string(), std::to_string(unlisted) + " more textures could not be used"});
    }
    return warnings;
}

MeshPtr with_texture(const Mesh& mesh, const std::string& texture) {
    auto other = std::make_shared<Mesh>(mesh);
    for (Material& material : other->materials) {
        material.texture = texture;
        material.picture = nullptr;
        material.diffuse = Vec3f::Ones();
    }
    return other;
}

void LevelTextures::add(const Image& image) {
    const std::size_t row_bytes = 4 * static_cast<std::size_t>(image.width);
    std::vector<std::uint8_t> from_bottom(image.rgba.size());
    for (int y = 0; y < image.height; ++y) {
        std::memcpy(from_bottom.data() + static_cast<std::size_t>(image.height - 1 - y) * row_bytes,
                    image.pixel(0, y), row_bytes);
    }
    unsigned texture = 0;
    gl_->GenTextures(1, &texture);
    gl_->BindTexture(GL_TEXTURE_2D, texture);
    gl_->BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    gl_->PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    gl_->PixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    gl_->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, image.width, image.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                    from_bottom.data());
    gl_->GenerateMipmap(GL_TEXTURE_2D);
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl_->BindTexture(GL_TEXTURE_2D, 0);
    names_.push_back(texture);
    opaque_.push_back(is_opaque(image));
}

void LevelTextures::clear() {
    if (!names_.empty()) gl_->DeleteTextures(static_cast<GLsizei>(names_.size()), names_.data());
    names_.clear();
    opaque_.clear();
    material_texture_.clear();
}

}  // namespace slipface
