#include "widgets/own_icons.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace slipface::ui {
namespace {

constexpr ImWchar lasso_code = 0xe000;  // icons::lasso
constexpr float pen = 0.055f;           // half the line width, as a fraction of the icon's side

// A rope's loop, tilted, with its end hanging down: points of a line in a square from 0 to 1, y downwards.
std::vector<ImVec2> lasso_line() {
    std::vector<ImVec2> line;
    constexpr int parts = 40;
    for (int i = 0; i <= parts; ++i) {
        const float turn = 2.05f + 6.2831853f * static_cast<float>(i) / parts;
        const float x = 0.42f * std::cos(turn), y = 0.26f * std::sin(turn);
        line.push_back({0.52f + 0.97f * x + 0.10f * y, 0.36f - 0.12f * x + 0.97f * y});
    }
    for (const ImVec2 point :
         {ImVec2{0.30f, 0.68f}, ImVec2{0.24f, 0.76f}, ImVec2{0.22f, 0.84f}, ImVec2{0.27f, 0.95f}})
        line.push_back(point);
    return line;
}

float distance_to(const std::vector<ImVec2>& line, ImVec2 p) {
    float nearest = 10.0f;
    for (std::size_t i = 1; i < line.size(); ++i) {
        const ImVec2 a = line[i - 1], b = line[i];
        const float dx = b.x - a.x, dy = b.y - a.y;
        const float t = std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy), 0.0f, 1.0f);
        nearest = std::min(nearest, std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy));
    }
    return nearest;
}

float lasso_coverage(int x, int y, int side) {
    static const std::vector<ImVec2> line = lasso_line();
    const float size = static_cast<float>(side);
    const ImVec2 middle{(static_cast<float>(x) + 0.5f) / size, (static_cast<float>(y) + 0.5f) / size};
    return (pen - distance_to(line, middle)) * size + 0.5f;
}

}  // namespace

void draw_own_icons(std::initializer_list<Font> fonts, float pixels) {
    add_drawn_glyph(fonts, {.code = lasso_code,
                            .side = std::max(6, static_cast<int>(std::lround(pixels))),
                            .advance = std::round(pixels * 1.15f),
                            .offset = {std::round(pixels * 0.07f), std::round(pixels * 0.2f)},
                            .coverage = lasso_coverage});
}

}  // namespace slipface::ui
