// The colours of the lab's runs in both themes: legible on their background, and distinct to every eye.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "panels/lab_track.h"
#include "widgets/theme.h"

namespace slipface {
namespace {

using Color = std::array<double, 3>;
using Matrix = std::array<Color, 3>;

double linear(float value) {
    const double v = static_cast<double>(value);
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}
Color linear(const ImVec4& c) {
    return {linear(c.x), linear(c.y), linear(c.z)};
}
Color times(const Matrix& m, const Color& c) {
    Color result{};
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t i = 0; i < 3; ++i)
            result[row] += m[row][i] * c[i];
    return result;
}

// WCAG 2.1.
double contrast(const ImVec4& a, const ImVec4& b) {
    const auto luminance = [](const ImVec4& color) {
        const Color c = linear(color);
        return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
    };
    const double of_a = luminance(a), of_b = luminance(b);
    const double low = std::min(of_a, of_b), high = std::max(of_a, of_b);
    return (high + 0.05) / (low + 0.05);
}

// CIELAB of linear sRGB, white D65.
Color lab_of(Color c) {
    for (double& part : c)
        part = std::clamp(part, 0.0, 1.0);
    const Color xyz = times({{{0.4124564, 0.3575761, 0.1804375},
                              {0.2126729, 0.7151522, 0.0721750},
                              {0.0193339, 0.1191920, 0.9503041}}},
                            c);
    const Color white{0.9504700, 1.0, 1.0888300};
    Color f{};
    for (std::size_t i = 0; i < 3; ++i) {
        const double t = xyz[i] / white[i];
        f[i] = t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0;
    }
    return {116.0 * f[1] - 16.0, 500.0 * (f[0] - f[1]), 200.0 * (f[1] - f[2])};
}

// Full colour vision, and without long, middle or short cones (Machado, Oliveira and Fernandes 2009, table
// 1).
constexpr std::array<Matrix, 4> eyes{{
    {{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}},
    {{{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}},
    {{{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}},
    {{{1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.303900}}},
}};

// The smallest distance of two colours as any of the eyes sees them.
double told_apart(const ImVec4& a, const ImVec4& b) {
    double smallest = 1e9;
    for (const Matrix& eye : eyes) {
        const Color x = lab_of(times(eye, linear(a))), y = lab_of(times(eye, linear(b)));
        smallest = std::min(smallest, std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]));
    }
    return smallest;
}

class RunColors : public testing::TestWithParam<bool> {
  protected:
    void SetUp() override { ui::use_light_palette(GetParam()); }
    void TearDown() override { ui::use_light_palette(false); }
};

TEST_P(RunColors, StandOutFromEveryGroundTheyAreDrawnOn) {
    const ui::Palette& p = ui::palette();
    // The view's top and foot, the panels of timeline, plots and ghosts, the labels in the view.
    const std::array<ImVec4, 4> grounds{p.view_top, p.view_bottom, p.panel, p.window};
    for (const ImVec4& ground : grounds) {
        for (std::size_t i = 0; i < Lab::max_runs; ++i)
            EXPECT_GE(contrast(run_color(i), ground), 3.0) << "run " << i;
        EXPECT_GE(contrast(lit_color(), ground), 3.0);
        EXPECT_GE(contrast(parting_color(), ground), 3.0);
    }
}

TEST_P(RunColors, AreDistinctToEveryEye) {
    for (std::size_t i = 0; i < Lab::max_runs; ++i)
        for (std::size_t k = 0; k < i; ++k)
            EXPECT_GE(told_apart(run_color(i), run_color(k)), 10.0) << "runs " << k << " and " << i;
}

TEST(RunColorsOfThemes, TheOtherThemesColoursWouldNotDo) {
    ui::use_light_palette(false);
    const ImVec4 white = run_color(0);
    ui::use_light_palette(true);
    EXPECT_LT(contrast(white, ui::palette().panel), 1.5);
    EXPECT_FALSE(white.x == run_color(0).x);
    ui::use_light_palette(false);
}

INSTANTIATE_TEST_SUITE_P(Themes, RunColors, testing::Bool(),
                         [](const auto& row) { return std::string(row.param ? "Light" : "Dark"); });

}  // namespace
}  // namespace slipface
