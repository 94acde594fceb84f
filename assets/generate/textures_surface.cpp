#include <algorithm>
#include <array>
#include <cmath>

#include "labels.h"
#include "painting.h"
#include "textures.h"

namespace slipface::generate {
namespace {

using namespace palette;

// Three rungs a metre between two rails, with the dark behind them.
Image ladder_wood() {
    return paint(256, [](double u, double v) {
        const double rung = std::abs(3.0 * v - std::floor(3.0 * v) - 0.5);
        const double rail = std::min(u, 1.0 - u);
        const double grain = 0.86 + 0.28 * noise(u, v, 6, 64, 301);
        if (rail < 0.10)
            return Color(mix(wood, sand, 0.35) *
                         (0.75 + 0.3 * ramp_between(0.0, 0.05, std::min(rail, 0.10 - rail))) *
                         (0.86 + 0.28 * noise(u, v, 64, 6, 303)));
        if (rung < 0.17) return Color(mix(wood, gold, 0.35) * grain * (1.12 - 2.2 * rung));
        return Color(mix(wood_dark, soot, 0.2) * (rung < 0.24 ? 0.7 : 1.0));
    });
}

// Moss with drops of resin, for surfaces that hold a player that touches them.
Image sticky_moss() {
    return paint(256, [](double u, double v) {
        const CellDistance tuft = cell_distance(u, v, 20, 311), drop = cell_distance(u, v, 5, 313);
        const Color green = mix(Color(0.17, 0.34, 0.16), Color(0.40, 0.55, 0.20), cloud(u, v, 4, 4, 315));
        const Color bed = green * (1.15 - 0.45 * tuft.nearest);
        const double size = 0.12 + 0.12 * drop.tint;
        if (drop.nearest > size) return bed;
        return Color(mix(Color(0.95, 0.86, 0.45), Color(0.66, 0.48, 0.12), drop.nearest / size));
    });
}

Image bouncy_mushroom() {
    return paint(256, [](double u, double v) {
        const CellDistance spot = cell_distance(u, v, 5, 321);
        const Color skin = grained(Color(0.80, 0.27, 0.20), u, v, 0.18, 323);
        return mix(cream, skin, ramp_between(0.20 + 0.1 * spot.tint, 0.25 + 0.1 * spot.tint, spot.nearest));
    });
}

// A stretched skin in rings; shown once on a disc.
Image bouncy_pad() {
    return paint(256, [](double u, double v) {
        const double radius = 2.0 * std::sqrt((u - 0.5) * (u - 0.5) + (v - 0.5) * (v - 0.5));
        const double ring = 4.0 * radius - std::floor(4.0 * radius);
        const Color skin = mix(Color(0.86, 0.36, 0.24), cream, ring < 0.45 ? 0.85 : 0.0);
        const Color rim = mix(bronze, gold, 0.4);
        return Color(grained(radius > 0.9 ? rim : skin, u, v, 0.10, 331) * (0.92 + 0.12 * ring));
    });
}

// Chevrons that point up the image, in the direction of the belt.
Image conveyor_belt() {
    return paint(256, [](double u, double v) {
        const double x = std::abs(u - 0.5);
        const double along = 2.0 * (v + 0.6 * x), phase = along - std::floor(along);
        const double slat = 10.0 * v - std::floor(10.0 * v);
        if (x > 0.44) return Color(grained(bronze, u, v, 0.25, 341));
        const Color belt = grained(Color(0.23, 0.22, 0.23), u, v, 0.25, 343) * (slat < 0.08 ? 0.65 : 1.0);
        return phase < 0.30 && x < 0.36 ? mix(belt, Color(0.95, 0.72, 0.22), 0.85) : belt;
    });
}

// Rings of stone with eight marks that lean the way it turns; shown once on a disc.
Image turntable_stone() {
    return paint(256, [](double u, double v) {
        const double x = u - 0.5, y = v - 0.5, radius = 2.0 * std::sqrt(x * x + y * y);
        const Color stone = grained(mix(sand, teal_light, 0.18), u, v, 0.22, 351);
        if (radius > 0.93) return mix(stone, teal, 0.7);
        if (radius < 0.14) return mix(stone, gold, 0.7);
        if (std::abs(radius - 0.45) < 0.012 || std::abs(radius - 0.90) < 0.012 ||
            std::abs(radius - 0.17) < 0.012)
            return Color(0.6 * stone);
        // Spirals: turn the point back by an angle that grows with its radius, then ask how far it is from
        // the nearest axis.
        const double lean = radius > 0.45 ? 0.5 * (radius - 0.45) : 0.35 * (0.45 - radius);
        const double scale = 1.0 / std::sqrt(1.0 + lean * lean);
        const double rx = (x + lean * y) * scale, ry = (y - lean * x) * scale;
        const double axis = std::min(std::abs(rx), std::abs(ry)),
                     diagonal = 0.70710678 * std::abs(std::abs(rx) - std::abs(ry));
        const double arm = std::min(axis, diagonal);
        return arm < 0.012 + 0.03 * (0.9 - radius) ? mix(stone, teal_dark, 0.75) : stone;
    });
}

Image hazard_embers() {
    return paint(256, [](double u, double v) {
        const CellDistance crust = cell_distance(u, v, 6, 361);
        const double heat = 1.0 - ramp_between(0.03, 0.30, crust.second - crust.nearest);
        const Color rock = grained(mix(soot, Color(0.30, 0.13, 0.10), crust.tint), u, v, 0.4, 363);
        return heat > 0.6 ? mix(ember, Color(1.0, 0.90, 0.45), (heat - 0.6) / 0.4)
                          : mix(rock, ember, heat / 0.6);
    });
}

struct Glyph {
    char letter;
    std::array<const char*, 7> rows;  // five columns, '#' is ink
};

constexpr std::array<Glyph, 18> glyphs{{
    {'0', {" ### ", "#   #", "#   #", "#   #", "#   #", "#   #", " ### "}},
    {'1', {"  #  ", " ##  ", "# #  ", "  #  ", "  #  ", "  #  ", "#####"}},
    {'2', {" ### ", "#   #", "    #", "  ## ", " #   ", "#    ", "#####"}},
    {'3', {"#### ", "    #", "    #", " ### ", "    #", "    #", "#### "}},
    {'4', {"#  # ", "#  # ", "#  # ", "#####", "   # ", "   # ", "   # "}},
    {'5', {"#####", "#    ", "#### ", "    #", "    #", "#   #", " ### "}},
    {'6', {" ### ", "#    ", "#    ", "#### ", "#   #", "#   #", " ### "}},
    {'7', {"#####", "    #", "   # ", "   # ", "  #  ", "  #  ", "  #  "}},
    {'8', {" ### ", "#   #", "#   #", " ### ", "#   #", "#   #", " ### "}},
    {'.', {"     ", "     ", "     ", "     ", "     ", " ##  ", " ##  "}},
    {'*', {" ##  ", "#  # ", "#  # ", " ##  ", "     ", "     ", "     "}},
    {'S', {" ####", "#    ", "#    ", " ### ", "    #", "    #", "#### "}},
    {'E', {"#####", "#    ", "#    ", "#### ", "#    ", "#    ", "#####"}},
    {'A', {" ### ", "#   #", "#   #", "#####", "#   #", "#   #", "#   #"}},
    {'M', {"#   #", "## ##", "# # #", "# # #", "#   #", "#   #", "#   #"}},
    {'I', {" ### ", "  #  ", "  #  ", "  #  ", "  #  ", "  #  ", " ### "}},
    {'C', {" ####", "#    ", "#    ", "#    ", "#    ", "#    ", " ####"}},
    {'9', {" ### ", "#   #", "#   #", " ####", "    #", "    #", " ### "}},
}};

bool has_ink(char letter, int column, int row) {
    if (column < 0 || column >= 5 || row < 0 || row >= 7) return false;
    const auto* glyph =
        std::find_if(glyphs.begin(), glyphs.end(), [&](const Glyph& g) { return g.letter == letter; });
    return glyph != glyphs.end() && glyph->rows[static_cast<std::size_t>(row)][column] == '#';
}

}  // namespace

Image paint_labels() {
    const int size = 512, cell_width = size / label_columns, cell_height = size / label_rows, dot = 6;
    return paint(size, [=](double u, double v) {
        const int x = static_cast<int>(u * size), y = static_cast<int>((1.0 - v) * size);
        const auto cell = static_cast<std::size_t>((y / cell_height) * label_columns + x / cell_width);
        const int px = x % cell_width, py = y % cell_height;
        const int border = std::min(std::min(px, cell_width - 1 - px), std::min(py, cell_height - 1 - py));
        if (border < 3) return mix(gold, bronze, 0.3);
        const Color board = mix(teal_dark, teal, 0.25);
        if (cell >= labels.size()) return board;
        const std::string text = labels[cell];
        const int advance = 6 * dot, length = static_cast<int>(text.size()) * advance - dot;
        const int left = px - (cell_width - length) / 2, top = py - (cell_height - 7 * dot) / 2;
        if (left < 0 || top < 0 || left >= length) return board;
        const char letter = text[static_cast<std::size_t>(left / advance)];
        return has_ink(letter, (left % advance) / dot, top / dot) ? cream : board;
    });
}

std::vector<Texture> surface_textures() {
    return {
        {"ladder_wood", ladder_wood},         {"sticky_moss", sticky_moss},
        {"bouncy_mushroom", bouncy_mushroom}, {"bouncy_pad", bouncy_pad},
        {"conveyor_belt", conveyor_belt},     {"turntable_stone", turntable_stone},
        {"hazard_embers", hazard_embers},     {"sign_labels", paint_labels},
    };
}

}  // namespace slipface::generate
