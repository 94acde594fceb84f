#include "slipface/image/grey_image.h"

#include <fmt/format.h>
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <memory>

#include "png_chunk.h"
#include "png_limit.h"
#include "slipface/base/files.h"

// In Debian's libstb, but not declared in its headers.
extern "C" unsigned char* stbi_zlib_compress(unsigned char* data, int size, int* out_size, int quality);

namespace slipface {
namespace {

constexpr std::size_t largest_file = std::size_t{512} << 20;

Result<GreyImage> decode(std::string_view bytes, const std::string& location, int max_side) {
    const auto header = png_size(bytes);
    if (!header || bytes.size() > largest_file)
        return Error{location, "is no PNG image; expected one with 16-bit grey"};
    const auto limit = static_cast<std::uint32_t>(std::max(max_side, 0));
    if (header->width < 1 || header->height < 1 || header->width > limit || header->height > limit) {
        return Error{location, fmt::format("is {} x {} pixels; at most {} x {} are read", header->width,
                                           header->height, max_side, max_side)};
    }
    // After signature, chunk header and size follow depth and colour type. Eight bits would make terraces,
    // and colours are not heights.
    constexpr std::size_t depth_at = 24;
    const int depth = static_cast<unsigned char>(bytes[depth_at]);
    const int colour = static_cast<unsigned char>(bytes[depth_at + 1]);
    if (depth != 16 || (colour != 0 && colour != 4)) {
        const bool grey = colour == 0 || colour == 4;
        return Error{location, fmt::format("has {} bits of {}; expected 16-bit grey", depth,
                                           grey          ? "grey"
                                           : colour == 3 ? "a palette"
                                                         : "colour")};
    }
    if (!png_data_fits_header(bytes)) return Error{location, "is corrupt: its data do not fit its size"};
    int width = 0;
    int height = 0;
    int channels = 0;
    const std::unique_ptr<stbi_us, void (*)(void*)> pixels(
        stbi_load_16_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()),
                                 static_cast<int>(bytes.size()), &width, &height, &channels, 1),
        stbi_image_free);
    if (!pixels) {
        const char* reason = stbi_failure_reason();
        return Error{location, fmt::format("is corrupt: {}", reason != nullptr ? reason : "unknown")};
    }
    const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    return GreyImage{.width = width, .height = height, .values = {pixels.get(), pixels.get() + count}};
}

}  // namespace

Result<GreyImage> decode_grey_image(std::string_view bytes, const std::string& location, int max_side) {
    try {
        return decode(bytes, location, max_side);
    } catch (const std::exception&) {
        return Error{location, "needs more memory than there is"};
    }
}

Result<GreyImage> load_grey_image(const std::filesystem::path& path, int max_side) {
    const auto bytes = read_file(path, largest_file);
    if (!bytes) return bytes.error();
    return decode_grey_image(*bytes, path.string(), max_side);
}

Status save_grey_png(const std::filesystem::path& path, const GreyImage& image) {
    const std::size_t count = static_cast<std::size_t>(std::max(image.width, 0)) *
                              static_cast<std::size_t>(std::max(image.height, 0));
    if (image.width < 1 || image.height < 1 || image.values.size() != count ||
        count > (std::size_t{1} << 28)) {
        return Error{path.string(), fmt::format("cannot hold an image of {} x {} pixels and {} values",
                                                image.width, image.height, image.values.size())};
    }
    std::string rows;
    for (std::size_t i = 0; i < count; ++i) {
        if (i % static_cast<std::size_t>(image.width) == 0) rows.push_back('\0');  // filter: none
        rows.push_back(static_cast<char>(image.values[i] >> 8));
        rows.push_back(static_cast<char>(image.values[i] & 0xFF));
    }
    int packed_size = 0;
    const std::unique_ptr<unsigned char, void (*)(void*)> packed(
        stbi_zlib_compress(reinterpret_cast<unsigned char*>(rows.data()), static_cast<int>(rows.size()),
                           &packed_size, 8),
        std::free);
    if (!packed) return Error{path.string(), "the image does not fit into memory"};

    return write_file_atomic(
        path,
        png_file(static_cast<std::uint32_t>(image.width), static_cast<std::uint32_t>(image.height), 16, 0,
                 {reinterpret_cast<const char*>(packed.get()), static_cast<std::size_t>(packed_size)}));
}

}  // namespace slipface
