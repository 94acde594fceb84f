#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace slipface {

struct PngSize {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
};

// The size in the header of a PNG file, or nothing if `bytes` do not begin with one.
std::optional<PngSize> png_size(std::string_view bytes);

// True if the chunks of a PNG file lie within it and its pixel data unpack to no more than its header
// declares. A decoder that trusts the data could be made to fill memory by a small file. True for any other
// file, which other code checks.
bool png_data_fits_header(std::string_view bytes);

}  // namespace slipface
