#pragma once

#include <optional>
#include <string_view>

#include "slipface/image/image.h"

namespace slipface {

// Decodes a PNG file with 8 bits per channel, in colour, not interlaced and without a transparent colour.
// This library and most others write such files, and this decoder is several times faster than stb. Returns
// nothing for any other or damaged file; stb then decides. The caller must have checked the size in the
// header.
std::optional<Image> decode_plain_png(std::string_view bytes);

}  // namespace slipface
