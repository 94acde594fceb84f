// 8-bit RGBA pictures, and PNG files of them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "slipface/base/result.h"

namespace slipface {

// Rows from the top, four bytes a pixel (red, green, blue, alpha), sRGB.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;

    std::size_t pixel_count() const {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
    const std::uint8_t* pixel(int x, int y) const {
        return rgba.data() + 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                  static_cast<std::size_t>(x));
    }
    std::uint8_t* pixel(int x, int y) { return const_cast<std::uint8_t*>(std::as_const(*this).pixel(x, y)); }
    friend bool operator==(const Image&, const Image&) = default;
};

Image make_image(int width, int height, std::uint8_t red, std::uint8_t green, std::uint8_t blue,
                 std::uint8_t alpha = 255);

// Reads PNG, JPEG, TGA or BMP (stb_image). Refuses pictures wider or higher than `max_side` before decoding
// them, so that a small file cannot demand gigabytes.
Result<Image> load_image(const std::filesystem::path& path, int max_side = 8192);
Result<Image> decode_image(std::string_view bytes, const std::string& location, int max_side = 8192);

// How much time packing may take. `fast` keeps up with rasterising; `small` tries the ways of filtering one
// after the other, for pictures that are kept: about a second for a million pixels.
enum class PngEffort { fast, small };

// PNG, lossless. The same picture and effort give the same bytes. save_png replaces the file atomically.
Result<std::string> encode_png(const Image& image, PngEffort effort = PngEffort::fast);
Status save_png(const std::filesystem::path& path, const Image& image, PngEffort effort = PngEffort::fast);

}  // namespace slipface
