// Mutations of an image. Their sizes come from measurements (docs/snapshots.md): the faint ones are the
// smallest real changes that were seen, the noise is the largest that another processor or Mesa made.
#include <algorithm>
#include <cmath>
#include <functional>

#include "goldens/golden.h"

namespace slipface {

namespace {

// Random numbers that are the same on every machine, unlike std's distributions.
class Random {
  public:
    std::uint32_t below(std::uint32_t limit) {
        state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
        return static_cast<std::uint32_t>((state_ >> 33U) % limit);
    }

  private:
    std::uint64_t state_ = 20231117;
};

std::uint8_t clamped(double value) {
    return static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
}

// Changed by `amount`, up or down so that it stays in range.
std::uint8_t moved(std::uint8_t value, int amount) {
    return static_cast<std::uint8_t>(value < 128 ? value + amount : value - amount);
}

void move_pixel(Image& image, int x, int y, int amount) {
    for (int channel = 0; channel < 3; ++channel) {
        std::uint8_t& value = image.pixel(x, y)[channel];
        value = moved(value, amount);
    }
}

Image mapped(const Image& original, const std::function<double(double)>& change) {
    Image image = original;
    for (std::size_t i = 0; i < image.rgba.size(); ++i) {
        if (i % 4 != 3) image.rgba[i] = clamped(255.0 * change(image.rgba[i] / 255.0));
    }
    return image;
}

// Adds a line one pixel wide and a fifth of the image long.
Image one_line(const Image& original) {
    Image image = original;
    const int length = std::max(8, original.width / 5);
    const int x0 = original.width / 3, y0 = original.height / 2;
    for (int i = 0; i < length; ++i) {
        const int x = x0 + i, y = y0 + i / 3;
        if (x < original.width && y < original.height) move_pixel(image, x, y, 40);
    }
    return image;
}

// Moves the most detailed block, a quarter of the image on each side, one pixel to the right.
Image object_moved_one_pixel(const Image& original) {
    const int block_width = std::max(2, original.width / 4), block_height = std::max(2, original.height / 4);
    const auto detail = [&](int left, int top) {
        std::int64_t sum = 0;
        for (int y = top; y < top + block_height; ++y) {
            for (int x = left + 1; x < left + block_width; ++x) {
                for (int channel = 0; channel < 3; ++channel) {
                    sum += std::abs(original.pixel(x, y)[channel] - original.pixel(x - 1, y)[channel]);
                }
            }
        }
        return sum;
    };
    int best_left = 0, best_top = 0;
    std::int64_t best = -1;
    for (int top = 0; top + block_height <= original.height; top += block_height) {
        for (int left = 0; left + block_width <= original.width; left += block_width) {
            const std::int64_t found = detail(left, top);
            if (found <= best) continue;
            best = found;
            best_left = left;
            best_top = top;
        }
    }
    Image image = original;
    for (int y = best_top; y < best_top + std::min(block_height, original.height); ++y) {
        for (int x = best_left + 1; x < best_left + std::min(block_width, original.width); ++x) {
            std::copy_n(original.pixel(x - 1, y), 4, image.pixel(x, y));
        }
    }
    return image;
}

Image patch(const Image& original) {
    Image image = original;
    const int left = (original.width - 6) / 2, top = (original.height - 6) / 2;
    for (int y = std::max(0, top); y < std::min(original.height, top + 6); ++y) {
        for (int x = std::max(0, left); x < std::min(original.width, left + 6); ++x) {
            std::uint8_t* pixel = image.pixel(x, y);
            pixel[0] = moved(pixel[0], 60);
        }
    }
    return image;
}

Image rounding_noise(const Image& original) {
    Image image = original;
    Random random;
    const auto width = static_cast<std::uint32_t>(original.width),
               height = static_cast<std::uint32_t>(original.height);
    const std::size_t count = original.pixel_count() * 13 / 10000;
    for (std::size_t i = 0; i < count; ++i) {
        const int x = static_cast<int>(random.below(width)), y = static_cast<int>(random.below(height));
        const std::uint32_t channel = random.below(3);
        image.pixel(x, y)[channel] = moved(original.pixel(x, y)[channel], 1);
    }
    return image;
}

// Changes one pixel in 5000 by up to 29 levels, each in its own cell of 32 pixels and away from the cell's
// border, so that no window of 16 pixels contains two.
Image edge_noise(const Image& original) {
    Image image = original;
    Random random;
    const int columns = original.width / 32, rows = original.height / 32;
    const int cells = columns * rows;
    if (cells == 0) return image;
    const int wanted = std::min(cells, std::max(1, static_cast<int>(original.pixel_count() / 5000)));
    for (int i = 0; i < wanted; ++i) {
        const int cell = static_cast<int>(static_cast<std::int64_t>(i) * cells / wanted);
        const int x = 32 * (cell % columns) + 8 + static_cast<int>(random.below(16));
        const int y = 32 * (cell / columns) + 8 + static_cast<int>(random.below(16));
        move_pixel(image, x, y, 3 + static_cast<int>(random.below(27)));
    }
    return image;
}

}  // namespace

std::vector<SelfTestCase> self_test_cases(const Image& original) {
    if (original.width < 16 || original.height < 16) return {};
    Image smaller = make_image(original.width - 1, original.height, 0, 0, 0);
    for (int y = 0; y < smaller.height; ++y) {
        std::copy_n(original.pixel(0, y), 4 * static_cast<std::size_t>(smaller.width), smaller.pixel(0, y));
    }
    return {{"unchanged", true, original},
            {"rounding of another processor", true, rounding_noise(original)},
            {"edges of another Mesa", true, edge_noise(original)},
            {"light 5 % lower", false, mapped(original, [](double value) { return 0.95 * value; })},
            {"gamma 2.4 instead of 2.2", false,
             mapped(original, [](double value) { return std::pow(value, 2.2 / 2.4); })},
            {"one line gone", false, one_line(original)},
            {"object moved by one pixel", false, object_moved_one_pixel(original)},
            {"patch of 6 x 6 pixels", false, patch(original)},
            {"one column missing", false, std::move(smaller)}};
}

SelfTestReport run_self_test(const Image& original, const CompareTolerance& tolerance) {
    SelfTestReport report;
    for (const SelfTestCase& test : self_test_cases(original)) {
        const Comparison comparison = compare_images(original, test.image, tolerance);
        const bool right = comparison.same == test.must_pass;
        report.passed = report.passed && right;
        report.lines.push_back(test.name + ": " + (right ? "as expected, " : "WRONG, ") +
                               (comparison.same ? "same" : "different") + " (" + comparison.verdict + ")");
    }
    if (report.lines.empty()) {
        report.passed = false;
        report.lines.push_back("the image is smaller than 16 x 16 pixels");
    }
    return report;
}

}  // namespace slipface
