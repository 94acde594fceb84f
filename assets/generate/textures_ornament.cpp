#include <algorithm>
#include <cmath>

#include "painting.h"
#include "textures.h"

namespace slipface::generate {
namespace {

using namespace palette;

// (u, v) about the centre of the image, folded into the eighth between +u and the diagonal.
Vec2 folded(double u, double v) {
    const double x = std::abs(u - 0.5), y = std::abs(v - 0.5);
    return {std::max(x, y), std::min(x, y)};
}

bool in_disc(const Vec2& p, const Vec2& centre, double radius) {
    return (p - centre).squaredNorm() < radius * radius;
}

// An eight-pointed star of two squares, one standing on its corner.
bool in_star(const Vec2& p, double size) {
    return p.x() < size || p.x() + p.y() < 1.41421356 * size;
}

Image mosaic_floor() {
    return paint(256, [](double u, double v) {
        const Vec2 p = folded(u, v);
        const CellDistance chip = cell_distance(u, v, 28, 101);
        Color color = mix(sand_light, cream, 0.5);
        if (p.x() > 0.46)
            color = mix(sand, sand_dark, 0.3);
        else if (p.x() > 0.40)
            color = teal;
        else if (p.x() > 0.385)
            color = gold;
        else if (in_star(p, 0.07))
            color = gold;
        else if (in_star(p, 0.20))
            color = teal;
        else if (in_star(p, 0.225))
            color = cream;
        else if (in_star(p, 0.245))
            color = terracotta;
        else if (in_disc(p, {0.33, 0.33}, 0.035))
            color = terracotta;
        color *= 0.90 + 0.16 * chip.tint;
        return Color(
            mix(mix(color, mortar, 0.35), color, ramp_between(0.04, 0.16, chip.second - chip.nearest)));
    });
}

Image tile_teal() {
    return paint(256, [](double u, double v) {
        const double x = 3.0 * u - std::floor(3.0 * u), y = 3.0 * v - std::floor(3.0 * v);
        const Vec2 p = folded(x, y);
        const double tint = hash01(113, static_cast<int>(3.0 * u), static_cast<int>(3.0 * v));
        Color color = mix(teal, teal_dark, 0.25 + 0.35 * tint);
        if (in_star(p, 0.09))
            color = gold;
        else if (in_star(p, 0.24) && !in_star(p, 0.205))
            color = teal_light;
        color = grained(color, u, v, 0.14, 117) * (1.0 + 0.10 * (y - x));
        return p.x() > 0.475 ? mix(color, cream, 0.5) : color;
    });
}

// Shown once on each panel of the vault.
Image coffer_panel() {
    return paint(256, [](double u, double v) {
        const Vec2 p = folded(u, v);
        Color color = mix(teal_dark, teal, 0.35 + 0.5 * cloud(u, v, 5, 3, 121));
        if (p.x() > 0.47)
            color = mix(sand_light, gold, 0.5);
        else if (p.x() > 0.44 && p.x() < 0.455)
            color = gold;
        else if (in_star(p, 0.15))
            color = in_star(p, 0.11) ? gold : mix(gold, bronze, 0.7);
        else if (in_disc(p, {0.0, 0.0}, 0.32) && !in_disc(p, {0.0, 0.0}, 0.30))
            color = mix(teal, teal_light, 0.7);
        else if (in_disc(p, {0.36, 0.36}, 0.05))
            color = gold;
        else if (hash01(127, static_cast<int>(u * 24), static_cast<int>(v * 24)) > 0.93)
            color = teal_light;
        return Color(grained(color, u, v, 0.12, 123));
    });
}

// Scales, each row shifted by half a scale.
Image apse_mosaic() {
    return paint(256, [](double u, double v) {
        const int rows = 8, columns = 6;
        Color color = teal;
        for (int step = 0; step < 2; ++step) {
            const int row = static_cast<int>(std::floor(v * rows)) + step;
            const double x = u * columns + 0.5 * (row % 2), across = x - std::floor(x) - 0.5;
            const double up = v * rows - row + 1.0;
            const double distance = across * across * 4.0 + (1.0 - up) * (1.0 - up);
            if (distance > 1.0) continue;
            const double tint = hash01(131, static_cast<int>(std::floor(x)) % columns, row % rows);
            color = mix(mix(teal_dark, teal_light, 0.25 + 0.6 * tint), gold, tint > 0.8 ? 0.75 : 0.0);
            color = distance > 0.8 ? mix(color, cream, 0.55) : Color(color * (0.82 + 0.22 * distance));
            break;
        }
        return Color(grained(color, u, v, 0.12, 133));
    });
}

Image rose_glass() {
    return paint(256, [](double u, double v) {
        const Vec2 p = folded(u, v);
        const double radius = p.norm();
        const double light = 0.85 + 0.3 * cloud(u, v, 6, 2, 141);
        const auto pane = [&](const Vec2& centre, double size, const Color& color) {
            return in_disc(p, centre, size) ? Color(color * light) : mix(soot, bronze, 0.35);
        };
        if (in_disc(p, {0.0, 0.0}, 0.12)) return pane({0, 0}, 0.105, gold);
        if (in_disc(p, {0.24, 0.0}, 0.088)) return pane({0.24, 0.0}, 0.074, teal_light);
        if (in_disc(p, {0.17, 0.17}, 0.088)) return pane({0.17, 0.17}, 0.074, sky);
        if (in_disc(p, {0.40, 0.166}, 0.075)) return pane({0.40, 0.166}, 0.062, terracotta);
        if (radius > 0.47) return Color(mix(soot, bronze, 0.35));
        const Color field = mix(teal, sky, ramp_between(0.1, 0.45, radius));
        return Color(field * light);
    });
}

Image banner_cloth() {
    return paint(128, [](double u, double v) {
        const double x = std::abs(u - 0.5), y = std::abs(v - 0.56);
        const double weave = 0.94 + 0.06 * noise(u, v, 64, 64, 151);
        const double fold = 0.88 + 0.16 * noise(u, 0.5, 5, 1, 153);
        Color color = mix(teal_dark, teal, 0.7);
        const double radius = std::sqrt(x * x + y * y);
        if (x > 0.45 || v < 0.06 || v > 0.95)
            color = gold;
        else if (v < 0.14 && static_cast<int>(u * 16) % 2 == 0)
            color = gold;
        else if (radius < 0.13)
            color = gold;
        else if (radius < 0.28 && radius > 0.17 && (x < 0.03 || y < 0.03 || std::abs(x - y) < 0.042))
            color = gold;
        return Color(color * weave * fold);
    });
}

Image bronze_metal() {
    return paint(128, [](double u, double v) {
        const double patina = ramp_between(0.55, 0.75, cloud(u, v, 6, 3, 161));
        return Color(grained(mix(bronze, teal, 0.55 * patina), u, v, 0.25, 163));
    });
}

Image sky_light() {
    return paint(256, [](double u, double v) {
        return Color(mix(sky, Color(0.97, 0.98, 0.97), ramp_between(0.42, 0.72, cloud(u, v, 3, 4, 171))));
    });
}

// Whose planks run along u; `count` of them, with a joint in each.
Color planks(double u, double v, int count, const Color& base, std::uint32_t seed) {
    const double position = v * count;
    const int plank = static_cast<int>(std::floor(position));
    const double edge = std::min(position - plank, 1.0 - (position - plank)) / count;
    const double joint = std::abs(u - hash01(seed, plank, 0));
    const double grain = noise(u, v, 4, 96, seed + 1) * 0.6 + noise(u, v, 10, 160, seed + 2) * 0.4;
    const Color color = base * (0.80 + 0.22 * hash01(seed, plank, 1) + 0.24 * (grain - 0.5));
    const double gap = std::min(ramp_between(0.001, 0.007, edge), ramp_between(0.001, 0.006, joint));
    return mix(0.45 * color, color, gap);
}

Image door_wood() {
    return paint(256, [](double u, double v) {
        const double x = 4.0 * u - std::floor(4.0 * u) - 0.5, y = 4.0 * v - std::floor(4.0 * v) - 0.5;
        const Color board = planks(v, u, 4, mix(wood, wood_dark, 0.45), 181);
        const double stud = std::sqrt(x * x + y * y);
        return stud < 0.09 ? Color(mix(gold, bronze, ramp_between(-0.06, 0.06, x - y))) : board;
    });
}

}  // namespace

std::vector<Texture> ornament_textures() {
    return {
        {"mosaic_floor", mosaic_floor},
        {"tile_teal", tile_teal},
        {"coffer_panel", coffer_panel},
        {"apse_mosaic", apse_mosaic},
        {"rose_glass", rose_glass},
        {"banner_cloth", banner_cloth},
        {"bronze", bronze_metal},
        {"sky", sky_light},
        {"wood_planks",
         [] { return paint(256, [](double u, double v) { return planks(v, u, 6, wood, 191); }); }},
        {"wood_floor",
         [] {
             return paint(256,
                          [](double u, double v) { return planks(u, v, 8, mix(wood, sand, 0.25), 193); });
         }},
        {"door_wood", door_wood},
    };
}

}  // namespace slipface::generate
