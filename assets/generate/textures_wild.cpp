#include <cmath>

#include "painting.h"
#include "textures.h"

namespace slipface::generate {
namespace {

using namespace palette;

Image grass() {
    return paint(256, [](double u, double v) {
        const double broad = cloud(u, v, 3, 3, 401), fine = cloud(u, v, 24, 2, 403);
        const Color base =
            mix(Color(0.33, 0.50, 0.19), Color(0.55, 0.64, 0.27), ramp_between(0.3, 0.7, broad));
        const CellDistance flower = cell_distance(u, v, 9, 405);
        const Color blades = mix(0.72 * base, 1.12 * base, ramp_between(0.25, 0.75, fine));
        return flower.tint > 0.86 && flower.nearest < 0.10 ? Color(0.93, 0.88, 0.66) : blades;
    });
}

// Ripples that the wind left, and grains.
Image ripple_sand() {
    return paint(256, [](double u, double v) {
        const double bent = v + 0.05 * noise(u, v, 4, 4, 411) + 0.02 * noise(u, v, 9, 9, 412);
        const double phase = 9.0 * bent - std::floor(9.0 * bent);
        const double ripple = ramp_between(0.0, 0.6, phase) - ramp_between(0.6, 1.0, phase);
        return Color(grained(Color(0.90, 0.80, 0.60), u, v, 0.10, 413) * (0.92 + 0.09 * ripple));
    });
}

Image water() {
    return paint(256, [](double u, double v) {
        const CellDistance net = cell_distance(u, v, 6, 421);
        const double line = 1.0 - ramp_between(0.02, 0.16, net.second - net.nearest);
        const Color deep = mix(Color(0.10, 0.42, 0.52), Color(0.16, 0.55, 0.62), cloud(u, v, 4, 3, 423));
        return mix(deep, Color(0.55, 0.85, 0.86), 0.5 * line);
    });
}

// Layered warm sandstone of the cliffs.
Image cliff() {
    return paint(256, [](double u, double v) {
        const double bent = v + 0.06 * noise(u, v, 3, 3, 431);
        const double layer = 6.0 * bent - std::floor(6.0 * bent);
        const double tint = hash01(433, static_cast<int>(std::floor(6.0 * bent)) % 6, 0);
        const Color stone = mix(Color(0.64, 0.50, 0.38), Color(0.80, 0.66, 0.49), tint);
        const double shade = 1.0 - 0.28 * ramp_between(0.86, 1.0, layer);
        return Color(grained(stone, u, v, 0.30, 435) * shade);
    });
}

// Dark columns of the mines.
Image basalt() {
    return paint(256, [](double u, double v) {
        const CellDistance cell = cell_distance(u, v, 4, 441), fine = cell_distance(u, v, 11, 443);
        const double crack = ramp_between(0.0, 0.07, cell.second - cell.nearest);
        const Color stone = mix(Color(0.27, 0.25, 0.32), Color(0.38, 0.34, 0.40), cell.tint);
        const double vein = 1.0 - ramp_between(0.0, 0.05, fine.second - fine.nearest);
        return Color(mix(grained(stone, u, v, 0.30, 445), Color(0.47, 0.42, 0.52), 0.25 * vein) *
                     (0.66 + 0.34 * crack));
    });
}

// Paler stone of the floors that people walked on.
Image flagstone() {
    return paint(256, [](double u, double v) {
        const CellDistance cell = cell_distance(u, v, 4, 451);
        const double joint = ramp_between(0.02, 0.07, cell.second - cell.nearest);
        const Color stone = mix(Color(0.50, 0.47, 0.48), Color(0.64, 0.60, 0.57), cell.tint);
        return mix(Color(0.26, 0.24, 0.25), grained(stone, u, v, 0.22, 453), joint);
    });
}

Image gem() {
    return paint(128, [](double u, double v) {
        const double streak = noise(u, v, 8, 2, 461), bright = ramp_between(0.35, 0.9, v);
        return mix(Color(0.56, 0.16, 0.52), Color(0.98, 0.62, 0.86), 0.55 * bright + 0.4 * streak);
    });
}

Image palm_trunk() {
    return paint(128, [](double u, double v) {
        const double band = 4.0 * v - std::floor(4.0 * v);
        return Color(grained(Color(0.55, 0.42, 0.29), u, v, 0.25, 471) * (0.75 + 0.3 * band));
    });
}

Image lamp_glass() {
    return paint(64, [](double u, double v) { return grained(Color(1.0, 0.91, 0.66), u, v, 0.05, 491); });
}

Image snow() {
    return paint(256, [](double u, double v) {
        return Color(grained(Color(0.93, 0.95, 0.98), u, v, 0.06, 481) *
                     (0.94 + 0.08 * cloud(u, v, 4, 3, 483)));
    });
}

}  // namespace

std::vector<Texture> wild_textures() {
    return {
        {"grass", grass},   {"sand", ripple_sand},      {"water", water}, {"cliff", cliff},
        {"basalt", basalt}, {"flagstone", flagstone},   {"gem", gem},     {"palm_trunk", palm_trunk},
        {"snow", snow},     {"lamp_glass", lamp_glass},
    };
}

}  // namespace slipface::generate
