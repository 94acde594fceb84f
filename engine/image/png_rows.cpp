#include "png_rows.h"

#include <algorithm>
#include <cstdlib>

namespace slipface {

namespace {

int paeth(int left, int above, int above_left) {
    const int estimate = left + above - above_left;
    const int to_left = std::abs(estimate - left), to_above = std::abs(estimate - above),
              to_above_left = std::abs(estimate - above_left);
    if (to_left <= to_above && to_left <= to_above_left) return left;
    return to_above <= to_above_left ? above : above_left;
}

int predicted(int filter, int left, int above, int above_left) {
    switch (filter) {
        case 1: return left;
        case 2: return above;
        case 3: return (left + above) / 2;
        case 4: return paeth(left, above, above_left);
        default: return 0;
    }
}

template <int filter>
void filter_bytes(std::span<const std::uint8_t> row, std::span<const std::uint8_t> above, std::size_t step,
                  std::uint8_t* out) {
    for (std::size_t i = 0; i < std::min(step, row.size()); ++i)
        out[i] = static_cast<std::uint8_t>(row[i] - predicted(filter, 0, above[i], 0));
    for (std::size_t i = step; i < row.size(); ++i)
        out[i] =
            static_cast<std::uint8_t>(row[i] - predicted(filter, row[i - step], above[i], above[i - step]));
}

template <int filter>
void unfilter_bytes(std::span<std::uint8_t> row, std::span<const std::uint8_t> above, std::size_t step) {
    for (std::size_t i = 0; i < std::min(step, row.size()); ++i)
        row[i] = static_cast<std::uint8_t>(row[i] + predicted(filter, 0, above[i], 0));
    for (std::size_t i = step; i < row.size(); ++i)
        row[i] =
            static_cast<std::uint8_t>(row[i] + predicted(filter, row[i - step], above[i], above[i - step]));
}

}  // namespace

void png_filter_row(int filter, std::span<const std::uint8_t> row, std::span<const std::uint8_t> above,
                    std::size_t bytes_per_pixel, std::uint8_t* out) {
    constexpr decltype(&filter_bytes<0>) filters[png_filters] = {
        filter_bytes<0>, filter_bytes<1>, filter_bytes<2>, filter_bytes<3>, filter_bytes<4>};
    filters[filter](row, above, bytes_per_pixel, out);
}

bool png_unfilter_row(int filter, std::span<std::uint8_t> row, std::span<const std::uint8_t> above,
                      std::size_t bytes_per_pixel) {
    constexpr decltype(&unfilter_bytes<0>) filters[png_filters] = {
        unfilter_bytes<0>, unfilter_bytes<1>, unfilter_bytes<2>, unfilter_bytes<3>, unfilter_bytes<4>};
    if (filter < 0 || filter >= png_filters) return false;
    if (filter > 0) filters[filter](row, above, bytes_per_pixel);
    return true;
}

}  // namespace slipface
