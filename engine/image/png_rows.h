// Row filters of PNG files: applied before compression, and undone (PNG specification, section 9).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace slipface {

inline constexpr int png_filters = 5;  // none, left, up, average, Paeth

// Filters one row into `out` (row.size() bytes). A byte is predicted from the one `bytes_per_pixel` to its
// left and from `above`, the row before or zeros. `filter` is one of the five.
void png_filter_row(int filter, std::span<const std::uint8_t> row, std::span<const std::uint8_t> above,
                    std::size_t bytes_per_pixel, std::uint8_t* out);

// Undoes a filter in place. Returns false for a filter that does not exist.
bool png_unfilter_row(int filter, std::span<std::uint8_t> row, std::span<const std::uint8_t> above,
                      std::size_t bytes_per_pixel);

}  // namespace slipface
