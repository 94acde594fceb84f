#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace slipface {

struct PngSize {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
};

// What the header of a PNG file says, or nothing where `bytes` do not begin with one.
std::optional<PngSize> png_size(std::string_view bytes);

// Whether the chunks of a PNG file lie within it and its pixel data unpack to no more than its header
// promises. A decoder that trusts the data would fill memory with what a small file unpacks to. True for what
// is no PNG file: others judge that.
bool png_data_fits_header(std::string_view bytes);

}  // namespace slipface
