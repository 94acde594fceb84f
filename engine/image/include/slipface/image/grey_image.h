// 16-bit grey pictures: heights of terrain.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "slipface/base/result.h"

namespace slipface {

// Rows from the top, one value a pixel, linear.
struct GreyImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint16_t> values;
    friend bool operator==(const GreyImage&, const GreyImage&) = default;
};

// Reads a PNG. One with 16 bits a channel keeps them all, one with 8 bits becomes value * 257; of a coloured
// one the luminance counts, and alpha does not. Refuses what load_image refuses.
Result<GreyImage> load_grey_image(const std::filesystem::path& path, int max_side = 8192);
Result<GreyImage> decode_grey_image(std::string_view bytes, const std::string& location, int max_side = 8192);

// PNG, 16 bits, lossless, written atomically. The same picture gives the same bytes.
Status save_grey_png(const std::filesystem::path& path, const GreyImage& image);

}  // namespace slipface
