#pragma once

#include <optional>
#include <string_view>

#include "slipface/image/image.h"

namespace slipface {

// The picture of a PNG file with 8 bits a channel, in colour, neither interlaced nor with a transparent
// colour: what this library and most others write, several times faster than stb. Nothing for every other
// file, and for a damaged one: stb judges those. The caller has checked that the header's size is acceptable.
std::optional<Image> decode_plain_png(std::string_view bytes);

}  // namespace slipface
