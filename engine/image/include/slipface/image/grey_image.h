// 16-bit grey images: heights of terrain.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "slipface/base/result.h"

namespace slipface {

// Rows from the top, one value per pixel, linear.
struct GreyImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint16_t> values;
    friend bool operator==(const GreyImage&, const GreyImage&) = default;
};

// Reads a PNG with 16-bit grey pixels; an alpha channel is ignored. Errors: any other format or depth,
// colour, a palette, corrupt data, a width or height above `max_side`. `location` names the source in errors.
Result<GreyImage> load_grey_image(const std::filesystem::path& path, int max_side = 8192);
Result<GreyImage> decode_grey_image(std::string_view bytes, const std::string& location, int max_side = 8192);

// Writes a 16-bit PNG, lossless and atomically. The same image gives the same bytes.
Status save_grey_png(const std::filesystem::path& path, const GreyImage& image);

}  // namespace slipface
