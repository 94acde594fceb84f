#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "slipface/image/compare.h"

namespace slipface {
namespace {

using testing::HasSubstr;

constexpr int width = 640;
constexpr int height = 480;

// A picture with soft gradients, far from black and white so that changes are not clipped.
Image scene() {
    Image image = make_image(width, height, 0, 0, 0);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            image.pixel(x, y)[0] = static_cast<std::uint8_t>(60 + x * 120 / width);
            image.pixel(x, y)[1] = static_cast<std::uint8_t>(60 + y * 120 / height);
            image.pixel(x, y)[2] = static_cast<std::uint8_t>(60 + (x + y) * 120 / (width + height));
        }
    }
    return image;
}

void change(Image& image, int x, int y, int by) {
    for (int c = 0; c < 3; ++c) {
        image.pixel(x, y)[c] = static_cast<std::uint8_t>(std::clamp(image.pixel(x, y)[c] + by, 0, 255));
    }
}

TEST(Compare, IdenticalPicturesAreTheSame) {
    const Comparison result = compare_images(scene(), scene(), scene_tolerance);
    EXPECT_TRUE(result.same);
    EXPECT_EQ(result.max_delta, 0);
    EXPECT_EQ(result.verdict, "identical");
}

// Fused multiply-add changes about 0.13 % of the pixels by one or two levels.
TEST(Compare, RasteriserNoisePasses) {
    Image noisy = scene();
    std::mt19937 random(1);
    for (int i = 0; i < 400; ++i) {
        change(noisy, static_cast<int>(random() % width), static_cast<int>(random() % height),
               random() % 2 ? 1 : -2);
    }
    const Comparison result = compare_images(scene(), noisy, scene_tolerance);
    EXPECT_TRUE(result.same) << result.verdict;
    EXPECT_LE(result.max_delta, 4);  // a pixel may have been drawn twice
    EXPECT_GT(result.max_delta, 0);
}

// 640 * 480 * 0.0005 = 153.6: 153 pixels may differ, 154 may not.
TEST(Compare, TheShareOfDifferingPixelsIsExact) {
    for (const int count : {153, 154}) {
        Image changed = scene();
        for (int i = 0; i < count; ++i)
            change(changed, (i % 30) * 20, (i / 30) * 20, 3);  // weak: no density
        const Comparison result = compare_images(scene(), changed, scene_tolerance);
        EXPECT_EQ(result.allowed, 153U);
        EXPECT_EQ(result.differing, static_cast<std::size_t>(count));
        EXPECT_EQ(result.same, count == 153) << result.verdict;
    }
}

// A delta of exactly pixel_delta is no difference, one more is; the same for strong_delta.
TEST(Compare, ThresholdsAreExclusive) {
    for (const int by : {2, 3, 4, 5}) {
        Image changed = scene();
        for (int x = 0; x < 6; ++x)
            change(changed, 100 + x, 100, by);
        const Comparison result = compare_images(scene(), changed, scene_tolerance);
        EXPECT_EQ(result.differing, by > 2 ? 6U : 0U);
        EXPECT_EQ(result.densest_window, by > 4 ? 6 : 0);
        EXPECT_EQ(result.same, by <= 4);
    }
}

// A line one pixel wide that moved: 28 pixels are far below the fraction of 153, but 16 of them lie in one
// window.
TEST(Compare, AThinLineFailsByDensity) {
    Image changed = scene();
    for (int i = 0; i < 28; ++i)
        change(changed, 300 + i, 200, 40);
    const Comparison result = compare_images(scene(), changed, scene_tolerance);
    EXPECT_FALSE(result.same);
    EXPECT_LT(result.differing, result.allowed);
    EXPECT_EQ(result.densest_window, 16);
    EXPECT_THAT(result.verdict, HasSubstr("too dense"));
}

// Six pixels in a window that no grid of 16 has: two each side of the grid lines at 16, 32.
TEST(Compare, EveryWindowPositionIsTried) {
    Image changed = scene();
    for (const auto& [x, y] : {std::pair{15, 15}, {16, 15}, {15, 16}, {16, 16}, {9, 20}, {22, 11}}) {
        change(changed, x, y, 40);
    }
    const Comparison result = compare_images(scene(), changed, scene_tolerance);
    EXPECT_FALSE(result.same);
    EXPECT_EQ(result.densest_window, 6);
    EXPECT_LE(result.densest_x, 9);
    EXPECT_GE(result.densest_x + 15, 22);
    EXPECT_LE(result.densest_y, 11);
    EXPECT_GE(result.densest_y + 15, 20);
}

// The oracle counts each window pixel by pixel.
TEST(Compare, DensestWindowEqualsBruteForce) {
    std::mt19937 random(3);
    for (int round = 0; round < 30; ++round) {
        const int w = 1 + static_cast<int>(random() % 40);
        const int h = 1 + static_cast<int>(random() % 40);
        const CompareTolerance tolerance{.window = 1 + static_cast<int>(random() % 20)};
        const Image before = make_image(w, h, 100, 100, 100);
        Image after = before;
        for (int i = 0; i < w * h / 10 + 1; ++i) {
            change(after, static_cast<int>(random() % static_cast<unsigned>(w)),
                   static_cast<int>(random() % static_cast<unsigned>(h)), 50);
        }
        int densest = 0;
        for (int top = 0; top < h; ++top) {
            for (int left = 0; left < w; ++left) {
                int count = 0;
                for (int y = top; y < std::min(h, top + tolerance.window); ++y) {
                    for (int x = left; x < std::min(w, left + tolerance.window); ++x) {
                        count += before.pixel(x, y)[0] != after.pixel(x, y)[0];
                    }
                }
                densest = std::max(densest, count);
            }
        }
        EXPECT_EQ(compare_images(before, after, tolerance).densest_window, densest) << w << " x " << h;
    }
}

// Spread out, six strong pixels are noise along an edge; each window has one.
TEST(Compare, LoneStrongPixelsPass) {
    Image changed = scene();
    for (int i = 0; i < 6; ++i)
        change(changed, 40 + 100 * i, 50, 29);
    EXPECT_TRUE(compare_images(scene(), changed, scene_tolerance).same);
}

// 5 % less light: 60..180 become 57..171, so nearly every pixel differs by 3 to 9.
TEST(Compare, AGlobalChangeOfLightFails) {
    Image darker = scene();
    for (std::size_t i = 0; i < darker.rgba.size(); ++i) {
        if (i % 4 != 3) darker.rgba[i] = static_cast<std::uint8_t>(darker.rgba[i] * 95 / 100);
    }
    const Comparison result = compare_images(scene(), darker, scene_tolerance);
    EXPECT_FALSE(result.same);
    EXPECT_GT(result.differing, 100'000U);
}

TEST(Compare, AlphaCounts) {
    Image changed = scene();
    for (int x = 0; x < 20; ++x)
        changed.pixel(x, 0)[3] = 0;
    EXPECT_FALSE(compare_images(scene(), changed, scene_tolerance).same);
}

TEST(Compare, UiIsJudgedMoreStrictly) {
    Image changed = scene();
    for (int x = 0; x < 4; ++x)
        change(changed, 100 + 2 * x, 100, 20);  // the dot of an i
    EXPECT_TRUE(compare_images(scene(), changed, scene_tolerance).same);
    EXPECT_FALSE(compare_images(scene(), changed, ui_tolerance).same);
}

TEST(Compare, SizesMustAgree) {
    const Comparison result =
        compare_images(scene(), make_image(width, height - 1, 0, 0, 0), scene_tolerance);
    EXPECT_FALSE(result.same);
    EXPECT_TRUE(result.size_differs);
    EXPECT_THAT(result.verdict, HasSubstr("expected 640 x 480, found 640 x 479"));

    const Image broken{.width = width, .height = height, .rgba = {1, 2, 3}};
    EXPECT_FALSE(compare_images(scene(), broken, scene_tolerance).same);
    EXPECT_FALSE(compare_images(broken, broken, scene_tolerance).same);
}

TEST(DifferenceImage, GreyWhereEqualYellowToRedWhereNot) {
    Image changed = scene();
    change(changed, 10, 10, 1);
    change(changed, 20, 20, 60);
    const Image result = difference_image(scene(), changed);
    ASSERT_EQ(result.width, width);
    const auto color = [&](int x, int y) {
        return std::array{result.pixel(x, y)[0], result.pixel(x, y)[1], result.pixel(x, y)[2]};
    };
    using Color = std::array<std::uint8_t, 3>;
    EXPECT_EQ(color(10, 10), (Color{255, 255, 0}));
    EXPECT_EQ(color(20, 20), (Color{255, 0, 0}));
    EXPECT_EQ(color(0, 0)[0], color(0, 0)[1]);
    EXPECT_EQ(color(0, 0)[1], color(0, 0)[2]);
    EXPECT_LT(color(0, 0)[0], 110) << "must be faint";
}

TEST(DifferenceImage, CoversTheLargerOfBoth) {
    const Image result = difference_image(make_image(4, 2, 9, 9, 9), make_image(2, 4, 9, 9, 9));
    ASSERT_EQ(result.width, 4);
    ASSERT_EQ(result.height, 4);
    EXPECT_EQ(result.pixel(3, 0)[0], 255);  // only in the first
    EXPECT_EQ(result.pixel(0, 3)[0], 255);  // only in the second
    EXPECT_EQ(result.pixel(3, 3)[0], 255);  // in neither
    EXPECT_LT(result.pixel(1, 1)[0], 110);
}

TEST(Masks, HideWhatLiesBelowThemAndNothingElse) {
    const Image expected = make_image(64, 48, 10, 20, 30);
    Image actual = expected;
    for (int y = 10; y < 20; ++y)
        for (int x = 30; x < 40; ++x)
            actual.pixel(x, y)[0] = 200;
    ASSERT_FALSE(compare_images(expected, actual, scene_tolerance).same);
    const MaskRect exact{30, 10, 10, 10}, short_of{30, 10, 9, 10}, outside{-50, -50, 20, 20},
        huge{-5, -5, 2147483647, 2147483647};
    EXPECT_EQ(masked(expected, actual, std::array{exact}), expected);
    EXPECT_EQ(masked(expected, actual, std::array{huge}), expected);
    EXPECT_EQ(masked(expected, actual, std::array{outside}), actual);
    EXPECT_FALSE(
        compare_images(expected, masked(expected, actual, std::array{short_of}), scene_tolerance).same);
    EXPECT_EQ(masked(expected, make_image(3, 3, 1, 1, 1), std::array{exact}), make_image(3, 3, 1, 1, 1));
}

TEST(ThresholdSweep, CountsPixelsBeyondEachThreshold) {
    const Image expected = make_image(20, 10, 100, 100, 100);
    Image actual = expected;
    actual.pixel(1, 1)[0] = 101;
    actual.pixel(2, 1)[1] = 95;
    actual.pixel(3, 1)[2] = 200;
    std::vector<std::size_t> counts;
    for (const SweepRow& row : threshold_sweep(expected, actual))
        counts.push_back(row.differing);
    EXPECT_EQ(counts, (std::vector<std::size_t>{3, 2, 2, 2, 1, 1, 1, 1}));
    EXPECT_EQ(threshold_sweep(expected, make_image(1, 1, 0, 0, 0))[0].differing, 0U);
}

}  // namespace
}  // namespace slipface
