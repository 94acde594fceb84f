#include "slipface/image/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace slipface {
namespace {

bool well_formed(const Image& image) {
    return image.width >= 0 && image.height >= 0 && image.rgba.size() == 4 * image.pixel_count();
}

int channel_delta(const std::uint8_t* a, const std::uint8_t* b) {
    int delta = 0;
    for (int i = 0; i < 4; ++i)
        delta = std::max(delta, std::abs(static_cast<int>(a[i]) - static_cast<int>(b[i])));
    return delta;
}

// Counts the marked pixels of every window in one pass. columns_ holds the sum of the last `height_` rows for
// each column. The window shrinks to images smaller than itself.
class DensestWindow {
  public:
    DensestWindow(int width, int height, int side)
        : width_(std::clamp(side, 1, std::max(width, 1))),
          height_(std::clamp(side, 1, std::max(height, 1))),
          columns_(static_cast<std::size_t>(width), 0) {}

    // `marked(x, y)` is called for row `y` and for the row that leaves the window.
    template <class Marked>
    void add_row(int y, const Marked& marked) {
        int sum = 0;
        for (int x = 0; x < static_cast<int>(columns_.size()); ++x) {
            int& column = columns_[static_cast<std::size_t>(x)];
            column += marked(x, y) ? 1 : 0;
            if (y >= height_) column -= marked(x, y - height_) ? 1 : 0;
            sum += column;
            if (x >= width_) sum -= columns_[static_cast<std::size_t>(x - width_)];
            if (sum > count) {
                count = sum;
                left = std::max(x - width_ + 1, 0);
                top = std::max(y - height_ + 1, 0);
            }
        }
    }

    int count = 0;
    int left = 0, top = 0;

  private:
    int width_, height_;
    std::vector<int> columns_;
};

std::string verdict_of(const Comparison& result, const CompareTolerance& tolerance, bool too_many,
                       bool too_dense) {
    if (result.max_delta == 0) return "identical";
    std::string text = fmt::format(
        "{} pixels differ by more than {} (limit {}), densest {}x{} window has {} by more than {} "
        "({} fail) at {},{}, largest difference {}",
        result.differing, tolerance.pixel_delta, result.allowed, tolerance.window, tolerance.window,
        result.densest_window, tolerance.strong_delta, tolerance.window_pixels, result.densest_x,
        result.densest_y, result.max_delta);
    if (!too_many && !too_dense) return "within tolerance: " + text;
    const char* why = too_many && too_dense ? "too many and too dense" : too_many ? "too many" : "too dense";
    return fmt::format("{}: {}", why, text);
}

}  // namespace

Comparison compare_images(const Image& expected, const Image& actual, const CompareTolerance& tolerance) {
    Comparison result;
    if (!well_formed(expected) || !well_formed(actual) || expected.width != actual.width ||
        expected.height != actual.height) {
        result.size_differs = true;
        result.verdict = fmt::format("size differs: expected {} x {}, found {} x {}", expected.width,
                                     expected.height, actual.width, actual.height);
        return result;
    }
    const double fraction = std::max(tolerance.ratio, 0.0) * static_cast<double>(expected.pixel_count());
    result.allowed =
        std::max(static_cast<std::size_t>(std::min(fraction, static_cast<double>(expected.pixel_count()))),
                 static_cast<std::size_t>(std::max(tolerance.minimum_pixels, 0)));

    if (expected.rgba == actual.rgba) {
        result.same = true;
        result.verdict = "identical";
        return result;
    }
    DensestWindow densest(expected.width, expected.height, tolerance.window);
    const auto strong = [&](int x, int y) {
        return channel_delta(expected.pixel(x, y), actual.pixel(x, y)) > tolerance.strong_delta;
    };
    for (int y = 0; y < expected.height; ++y) {
        for (int x = 0; x < expected.width; ++x) {
            const int delta = channel_delta(expected.pixel(x, y), actual.pixel(x, y));
            result.max_delta = std::max(result.max_delta, delta);
            if (delta > tolerance.pixel_delta) ++result.differing;
        }
        densest.add_row(y, strong);
    }
    result.densest_window = densest.count;
    result.densest_x = densest.left;
    result.densest_y = densest.top;

    const bool too_many = result.differing > result.allowed;
    const bool too_dense = result.densest_window >= std::max(tolerance.window_pixels, 1);
    result.same = !too_many && !too_dense;
    result.verdict = verdict_of(result, tolerance, too_many, too_dense);
    return result;
}

Comparison compare_coarsely(const Image& expected, const Image& actual, const CoarseTolerance& tolerance) {
    Comparison result = compare_images(expected, actual, {});
    if (result.size_differs) return result;
    const int side = std::max(tolerance.square, 1);
    std::size_t squares = 0, differing = 0;
    double largest = 0.0;
    for (int top = 0; top < expected.height; top += side)
        for (int left = 0; left < expected.width; left += side) {
            const int bottom = std::min(top + side, expected.height),
                      right = std::min(left + side, expected.width);
            std::array<int, 4> sum{};
            for (int y = top; y < bottom; ++y)
                for (int x = left; x < right; ++x)
                    for (std::size_t i = 0; i < sum.size(); ++i)
                        sum[i] += static_cast<int>(expected.pixel(x, y)[i]) -
                                  static_cast<int>(actual.pixel(x, y)[i]);
            double delta = 0.0;
            for (const int channel : sum)
                delta =
                    std::max(delta, std::abs(channel) / static_cast<double>((bottom - top) * (right - left)));
            ++squares;
            differing += delta > tolerance.mean_delta ? 1U : 0U;
            largest = std::max(largest, delta);
        }
    result.differing = differing;
    result.allowed = static_cast<std::size_t>(tolerance.ratio * static_cast<double>(squares));
    result.same = differing <= result.allowed;
    result.verdict = fmt::format(
        "{}: the mean colours of {} of {} squares of {} pixels differ by more than {:g} (limit {}), the "
        "largest "
        "by {:.1f}",
        result.same ? "within tolerance" : "too many", differing, squares, side, tolerance.mean_delta,
        result.allowed, largest);
    return result;
}

Image masked(const Image& expected, Image actual, std::span<const MaskRect> masks) {
    if (!well_formed(expected) || !well_formed(actual) || expected.width != actual.width ||
        expected.height != actual.height)
        return actual;
    for (const MaskRect& mask : masks) {
        const int left = std::clamp(mask.x, 0, actual.width), top = std::clamp(mask.y, 0, actual.height);
        const auto end = [](int from, int length, int limit) {
            return static_cast<int>(std::clamp<std::int64_t>(std::int64_t{from} + length, 0, limit));
        };
        const int right = end(mask.x, mask.width, actual.width);
        const int bottom = end(mask.y, mask.height, actual.height);
        for (int y = top; y < bottom && left < right; ++y)
            std::copy_n(expected.pixel(left, y), 4 * (right - left), actual.pixel(left, y));
    }
    return actual;
}

std::array<SweepRow, 8> threshold_sweep(const Image& expected, const Image& actual) {
    std::array<SweepRow, 8> rows{{{0}, {1}, {2}, {4}, {8}, {16}, {32}, {64}}};
    if (!well_formed(expected) || !well_formed(actual) || expected.width != actual.width ||
        expected.height != actual.height)
        return rows;
    for (std::size_t i = 0; i < expected.rgba.size(); i += 4) {
        const int delta = channel_delta(expected.rgba.data() + i, actual.rgba.data() + i);
        for (SweepRow& row : rows)
            row.differing += delta > row.pixel_delta ? 1U : 0U;
    }
    return rows;
}

Image difference_image(const Image& expected, const Image& actual) {
    static const Image nothing;
    const Image& left = well_formed(expected) ? expected : nothing;
    const Image& right = well_formed(actual) ? actual : nothing;
    Image result =
        make_image(std::max(left.width, right.width), std::max(left.height, right.height), 0, 0, 0);

    constexpr int strongest = 32;  // this and larger differences are plain red; rasteriser noise stays yellow
    for (int y = 0; y < result.height; ++y) {
        for (int x = 0; x < result.width; ++x) {
            const bool in_left = x < left.width && y < left.height;
            const bool in_right = x < right.width && y < right.height;
            const int delta = in_left && in_right ? channel_delta(left.pixel(x, y), right.pixel(x, y)) : 255;
            std::uint8_t* out = result.pixel(x, y);
            if (delta > 0) {
                out[0] = 255;
                out[1] = static_cast<std::uint8_t>(255 - 255 * std::min(delta - 1, strongest - 1) /
                                                             (strongest - 1));
                continue;
            }
            const std::uint8_t* in = left.pixel(x, y);
            const int grey =
                20 + (in[0] * 54 + in[1] * 183 + in[2] * 19) / 256 / 3;  // Rec. 709 weights of 256
            out[0] = out[1] = out[2] = static_cast<std::uint8_t>(grey);
        }
    }
    return result;
}

}  // namespace slipface
