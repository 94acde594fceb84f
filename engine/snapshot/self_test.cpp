// Shipped mutations of a picture. Their sizes come from measurements (docs/snapshots.md): the faint ones are
// the smallest real changes that were seen, the noise is the largest that another processor or another Mesa
// made.
#include <algorithm>
#include <cmath>
#include <functional>

#include "slipface/snapshot/golden.h"

namespace slipface {

namespace {

// The same numbers on every machine; std's distributions are not.
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

// Moved by `amount`, towards the side where there is room.
std::uint8_t moved(std::uint8_t value, int amount) {
    return static_cast<std::uint8_t>(value < 128 ? value + amount : value - amount);
}

void move_pixel(Image& image, int x, int y, int amount) {
    for (int channel = 0; channel < 3; ++channel) {
        std::uint8_t& value = image.pixel(x, y)[channel];
        value = moved(value, amount);
    }
}

Image mapped(const Image& image, const std::function<double(double)>& change) {
    Image image = image;
    for (std::size_t i = 0; i < image.rgba.size(); ++i) {
        if (i % 4 != 3) image.rgba[i] = clamped(255.0 * change(image.rgba[i] / 255.0));
    }
    return image;
}

// A line one pixel wide and a fifth of the picture long is there, or not there.
Image one_line(const Image& image) {
    Image image = image;
    const int length = std::max(8, image.width / 5);
    const int x0 = image.width / 3, y0 = image.height / 2;
    for (int i = 0; i < length; ++i) {
        const int x = x0 + i, y = y0 + i / 3;
        if (x < image.width && y < image.height) move_pixel(image, x, y, 40);
    }
    return image;
}

// The quarter of the picture with the most detail, one pixel to the right.
Image object_moved_one_pixel(const Image& image) {
    const int block_width = std::max(2, image.width / 4), block_height = std::max(2, image.height / 4);
    const auto detail = [&](int left, int top) {
        std::int64_t sum = 0;
        for (int y = top; y < top + block_height; ++y) {
            for (int x = left + 1; x < left + block_width; ++x) {
                for (int channel = 0; channel < 3; ++channel) {
                    sum += std::abs(image.pixel(x, y)[channel] - image.pixel(x - 1, y)[channel]);
                }
            }
        }
        return sum;
    };
    int best_left = 0, best_top = 0;
    std::int64_t best = -1;
    for (int top = 0; top + block_height <= image.height; top += block_height) {
        for (int left = 0; left + block_width <= image.width; left += block_width) {
            const std::int64_t found = detail(left, top);
            if (found <= best) continue;
            best = found;
            best_left = left;
            best_top = top;
        }
    }
    Image image = image;
    for (int y = best_top; y < best_top + std::min(block_height, image.height); ++y) {
        for (int x = best_left + 1; x < best_left + std::min(block_width, image.width); ++x) {
            std::copy_n(image.pixel(x - 1, y), 4, image.pixel(x, y));
        }
    }
    return image;
}

Image patch(const Image& image) {
    Image image = image;
    const int left = (image.width - 6) / 2, top = (image.height - 6) / 2;
    for (int y = std::max(0, top); y < std::min(image.height, top + 6); ++y) {
        for (int x = std::max(0, left); x < std::min(image.width, left + 6); ++x) {
            std::uint8_t* pixel = image.pixel(x, y);
            pixel[0] = moved(pixel[0], 60);
        }
    }
    return image;
}

Image rounding_noise(const Image& image) {
    Image image = image;
    Random random;
    const auto width = static_cast<std::uint32_t>(image.width),
               height = static_cast<std::uint32_t>(image.height);
    const std::size_t count = image.pixel_count() * 13 / 10000;
    for (std::size_t i = 0; i < count; ++i) {
        const int x = static_cast<int>(random.below(width)), y = static_cast<int>(random.below(height));
        const std::uint32_t channel = random.below(3);
        image.pixel(x, y)[channel] = moved(image.pixel(x, y)[channel], 1);
    }
    return image;
}

// One pixel in 5000 is off by up to 29 levels, each in a cell of 32 pixels of its own and away from that
// cell's border, so that no window of 16 pixels holds two.
Image edge_noise(const Image& image) {
    Image image = image;
    Random random;
    const int columns = image.width / 32, rows = image.height / 32;
    const int cells = columns * rows;
    if (cells == 0) return image;
    const int wanted = std::min(cells, std::max(1, static_cast<int>(image.pixel_count() / 5000)));
    for (int i = 0; i < wanted; ++i) {
        const int cell = static_cast<int>(static_cast<std::int64_t>(i) * cells / wanted);
        const int x = 32 * (cell % columns) + 8 + static_cast<int>(random.below(16));
        const int y = 32 * (cell / columns) + 8 + static_cast<int>(random.below(16));
        move_pixel(image, x, y, 3 + static_cast<int>(random.below(27)));
    }
    return image;
}

}  // namespace

std::vector<SelfTestCase> self_test_cases(const Image& image) {
    if (image.width < 16 || image.height < 16) return {};
    Image smaller = make_image(image.width - 1, image.height, 0, 0, 0);
    for (int y = 0; y < smaller.height; ++y) {
        std::copy_n(image.pixel(0, y), 4 * static_cast<std::size_t>(smaller.width), smaller.pixel(0, y));
    }
    return {{"unchanged", true, image},
            {"rounding of another processor", true, rounding_noise(image)},
            {"edges of another Mesa", true, edge_noise(image)},
            {"light 5 % lower", false, mapped(image, [](double value) { return 0.95 * value; })},
            {"gamma 2.4 instead of 2.2", false,
             mapped(image, [](double value) { return std::pow(value, 2.2 / 2.4); })},
            {"one line gone", false, one_line(image)},
            {"object moved by one pixel", false, object_moved_one_pixel(image)},
            {"patch of 6 x 6 pixels", false, patch(image)},
            {"one column missing", false, std::move(smaller)}};
}

SelfTestReport run_self_test(const Image& image, const CompareTolerance& tolerance) {
    SelfTestReport report;
    for (const SelfTestCase& test : self_test_cases(image)) {
        const Comparison comparison = compare_images(image, test.image, tolerance);
        const bool right = comparison.same == test.must_pass;
        report.passed = report.passed && right;
        report.lines.push_back(test.name + ": " + (right ? "as expected, " : "WRONG, ") +
                               (comparison.same ? "same" : "different") + " (" + comparison.verdict + ")");
    }
    if (report.lines.empty()) {
        report.passed = false;
        report.lines.push_back("the picture is smaller than 16 x 16 pixels");
    }
    return report;
}

}  // namespace slipface
