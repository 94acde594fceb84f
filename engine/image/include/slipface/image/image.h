// 8-bit RGBA images, and PNG files of them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "slipface/base/result.h"

namespace slipface {

// Rows from the top, four bytes per pixel (red, green, blue, alpha), sRGB.
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

// An image of one colour. Negative sizes count as 0.
Image make_image(int width, int height, std::uint8_t red, std::uint8_t green, std::uint8_t blue,
                 std::uint8_t alpha = 255);

// Reads PNG, JPEG, WebP, TGA, BMP or the first picture of a GIF, whatever the name of the file; of a few
// others the error names the format. Images wider or higher than `max_side` pixels are refused before
// decoding, so that a small file cannot demand gigabytes. `location` names the source in errors.
Result<Image> load_image(const std::filesystem::path& path, int max_side = 8192);
Result<Image> decode_image(std::string_view bytes, const std::string& location, int max_side = 8192);

// The errors that the header shows already, without decoding the image.
Status check_image_header(std::string_view bytes, const std::string& location, int max_side = 8192);

// How much time compression may take. `fast` keeps up with rasterising. `small` tries several row filters,
// for images that are stored: about a second per million pixels.
enum class PngEffort { fast, small };

// Writes PNG, lossless. The same image and effort give the same bytes. save_png replaces the file atomically.
Result<std::string> encode_png(const Image& image, PngEffort effort = PngEffort::fast);
Status save_png(const std::filesystem::path& path, const Image& image, PngEffort effort = PngEffort::fast);

}  // namespace slipface
