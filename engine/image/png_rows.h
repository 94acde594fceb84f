// The rows of a PNG file: filtered for packing, and back (PNG specification, section 9).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace slipface {

inline constexpr int png_filters = 5;  // none, left, up, average, Paeth

// One row, `bytes_per_pixel` apart from its left neighbour; `above` is the row before, or zeros.
void png_filter_row(int filter, std::span<const std::uint8_t> row, std::span<const std::uint8_t> above,
                    std::size_t bytes_per_pixel, std::uint8_t* out);

// Undoes it in place. False for a filter that does not exist.
bool png_unfilter_row(int filter, std::span<std::uint8_t> row, std::span<const std::uint8_t> above,
                      std::size_t bytes_per_pixel);

}  // namespace slipface
