#include <cmath>

#include "painting.h"
#include "textures.h"

namespace slipface::generate {
namespace {

using namespace palette;

Color blocks(double u, double v, int columns, int rows, double shift, const Color& light, const Color& dark,
             std::uint32_t seed) {
    const Block block = block_at(u, v, columns, rows, shift, seed);
    Color color = mix(dark, light, 0.35 + 0.6 * block.tint);
    color = grained(color, u, v, 0.22, seed + 3) * (1.0 + 0.10 * block.lit);
    return mix(mortar, color, ramp_between(0.002, 0.008, block.edge));
}

Image stone_wall() {
    return paint(256, [](double u, double v) {
        return blocks(u, v, 2, 4, 0.5, sand, mix(sand, sand_dark, 0.35), 11);
    });
}

Image stone_floor() {
    return paint(256, [](double u, double v) {
        const Color stone =
            blocks(u, v, 3, 3, 0.333333, mix(sand, sand_light, 0.3), mix(sand, sand_dark, 0.45), 23);
        return Color(stone.cwiseProduct(Color(0.93, 0.94, 0.97)));
    });
}

Image plaster() {
    return paint(256, [](double u, double v) {
        const double stain = ramp_between(0.55, 0.8, cloud(u, v, 3, 4, 31));
        return Color(grained(mix(mix(cream, sand_light, 0.75), sand, 0.45 * stain), u, v, 0.10, 33));
    });
}

Image stone_trim() {
    return paint(256,
                 [](double u, double v) { return grained(mix(sand_light, cream, 0.4), u, v, 0.13, 41); });
}

// Four flutes across.
Image column_stone() {
    return paint(128, [](double u, double v) {
        const double flute = 2.0 * std::abs(4.0 * u - std::floor(4.0 * u) - 0.5);
        const double shade = 0.80 + 0.26 * flute * flute - 0.14 * ramp_between(0.86, 1.0, flute);
        return Color(grained(mix(sand_light, sand, 0.25), u, v, 0.12, 47) * shade);
    });
}

Image step_stone() {
    return paint(
        128, [](double u, double v) { return grained(mix(sand_light, teal_light, 0.12), u, v, 0.15, 53); });
}

Image rock() {
    return paint(256, [](double u, double v) {
        const double crack =
            ramp_between(0.0, 0.12, cell_distance(u, v, 5, 61).second - cell_distance(u, v, 5, 61).nearest);
        const Color stone = grained(Color(0.52, 0.49, 0.45), u, v, 0.45, 63);
        return Color(mix(0.72 * stone, stone, crack));
    });
}

Image terracotta_pot() {
    return paint(128, [](double u, double v) {
        const double band = ramp_between(0.02, 0.04, std::abs(v - std::floor(v) - 0.5));
        return Color(mix(0.8 * terracotta, grained(terracotta, u, v, 0.2, 67), band));
    });
}

Image test_floor() {
    return paint(256, [](double u, double v) {
        // Two metres a tile: a line each metre, a cross in the middle of each square.
        const double x = std::abs(2.0 * u - std::floor(2.0 * u + 0.5)),
                     y = std::abs(2.0 * v - std::floor(2.0 * v + 0.5));
        const double cx = std::abs(x - 0.5), cy = std::abs(y - 0.5);
        const bool line = x < 0.012 || y < 0.012;
        const bool cross = (cx < 0.01 && cy < 0.06) || (cy < 0.01 && cx < 0.06);
        const bool odd = (static_cast<int>(2.0 * u) + static_cast<int>(2.0 * v)) % 2 == 1;
        const Color base = grained(mix(cream, sand, odd ? 0.35 : 0.15), u, v, 0.08, 71);
        return line ? mix(base, teal_dark, 0.55) : cross ? mix(base, teal, 0.45) : base;
    });
}

Image seam_floor() {
    return paint(256, [](double u, double v) {
        const CellDistance cell = cell_distance(u, v, 12, 73);
        const Color chip = mix(mix(sand, sand_light, cell.tint), teal_light, cell.tint > 0.86 ? 0.6 : 0.0);
        return Color(
            mix(mix(mortar, chip, 0.55), chip, ramp_between(0.05, 0.14, cell.second - cell.nearest)));
    });
}

// Marks across the slope, two a metre at 2 m a tile.
Image ramp_with(const Color& base, const Color& mark, std::uint32_t seed) {
    return paint(128, [=](double u, double v) {
        const double across = 4.0 * v - std::floor(4.0 * v);
        const Color stone = grained(base, u, v, 0.14, seed);
        return across < 0.06 ? mix(stone, mark, 0.6) : stone;
    });
}

}  // namespace

std::vector<Texture> stone_textures() {
    return {
        {"stone_wall", stone_wall},
        {"stone_floor", stone_floor},
        {"plaster", plaster},
        {"stone_trim", stone_trim},
        {"column_stone", column_stone},
        {"step_stone", step_stone},
        {"rock", rock},
        {"terracotta", terracotta_pot},
        {"test_floor", test_floor},
        {"seam_floor", seam_floor},
        {"ramp_stone", [] { return ramp_with(mix(sand_light, teal_light, 0.45), teal_dark, 81); }},
        {"ramp_steep", [] { return ramp_with(mix(sand, terracotta, 0.6), Color(0.42, 0.18, 0.10), 83); }},
    };
}

}  // namespace slipface::generate
