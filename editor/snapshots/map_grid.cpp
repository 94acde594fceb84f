// A grid in metres over a level seen from above, and its scale.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "snapshots/scene_camera.h"

namespace slipface {

namespace {

constexpr Color fine_color{1.0f, 1.0f, 1.0f, 0.16f}, coarse_color{1.0f, 1.0f, 1.0f, 0.42f},
    dark_color{0.02f, 0.03f, 0.05f, 0.16f};
constexpr Color ink{1.0f, 1.0f, 1.0f, 1.0f}, shadow{0.05f, 0.06f, 0.08f, 0.85f};

// The seven strokes of a digit's cell, 1 wide and 2 high, from the upper one clockwise, then the middle.
constexpr std::array<std::array<double, 4>, 7> strokes{
    {{0, 2, 1, 2}, {1, 2, 1, 1}, {1, 1, 1, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}, {0, 1, 0, 2}, {0, 1, 1, 1}}};
constexpr std::array<unsigned, 10> digits{0x3f, 0x06, 0x5b, 0x4f, 0x66, 0x6d, 0x7d, 0x07, 0x7f, 0x6f};
// A low "m": both sides, the top and the middle.
constexpr std::array<std::array<double, 4>, 4> letter_m{
    {{0, 0, 0, 1.2}, {0.6, 0, 0.6, 1.2}, {1.2, 0, 1.2, 1.2}, {0, 1.2, 1.2, 1.2}}};

struct Plane {
    Overlay& overlay;
    double y;

    // A map has -Z upwards.
    void line(double x1, double z1, double x2, double z2, Color color, float width) const {
        overlay.line({x1, y, z1}, {x2, y, z2}, color, width, true);
    }
    void glyph_line(const std::array<double, 4>& s, double x, double z, double size, Color color,
                    float width) const {
        line(x + s[0] * size, z - s[1] * size, x + s[2] * size, z - s[3] * size, color, width);
    }
};

void write_metres(const Plane& plane, int metres, double x, double z, double size, Color color, float width) {
    for (const char c : std::to_string(metres)) {
        for (std::size_t i = 0; i < strokes.size(); ++i)
            if ((digits[static_cast<std::size_t>(c - '0')] >> i & 1U) != 0)
                plane.glyph_line(strokes[i], x, z, size, color, width);
        x += 1.6 * size;
    }
    x += 0.5 * size;
    for (const auto& stroke : letter_m)
        plane.glyph_line(stroke, x, z, size, color, width);
}

// 1, 2, 5, 10, 20, ... metres, so that at most `maximum` steps fit into `extent`.
int round_step(double extent, double maximum) {
    int step = 1;
    for (const int factor : {2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000})
        if (extent / step > maximum) step = factor;
    return step;
}

}  // namespace

void draw_grid(Overlay& overlay, const Aabb& bounds) {
    if (bounds.empty() || bounds.size().maxCoeff() > 1e5) return;
    const Plane plane{overlay, bounds.max.y()};
    const double extent = std::max(bounds.size().x(), bounds.size().z());
    const int step = round_step(extent, 60.0);
    const auto first = [&](double from) { return std::ceil(from / step) * step; };
    const auto color = [&](double at) {
        return std::fmod(std::abs(at) / step, 5.0) < 0.5 ? coarse_color : fine_color;
    };
    // Dark beside light, so that the grid is visible over bright floors and over the dark background.
    for (const bool dark : {true, false}) {
        const float width = dark ? 3.0f : 1.0f;
        for (double x = first(bounds.min.x()); x <= bounds.max.x(); x += step)
            plane.line(x, bounds.min.z(), x, bounds.max.z(), dark ? dark_color : color(x), width);
        for (double z = first(bounds.min.z()); z <= bounds.max.z(); z += step)
            plane.line(bounds.min.x(), z, bounds.max.x(), z, dark ? dark_color : color(z), width);
    }

    const int length = round_step(extent, 8.0);
    const double size = 0.016 * extent;
    const double x = bounds.min.x() + size, z = bounds.max.z() - size;
    for (const auto& [ink_color, width] : {std::pair(shadow, 6.0f), std::pair(ink, 2.5f)}) {
        plane.line(x, z, x + length, z, ink_color, width);
        plane.line(x, z, x, z - size, ink_color, width);
        plane.line(x + length, z, x + length, z - size, ink_color, width);
        write_metres(plane, length, x + 0.4 * size, z - 0.8 * size, 0.8 * size, ink_color, width);
    }
}

}  // namespace slipface
