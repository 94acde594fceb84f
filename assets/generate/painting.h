// What the textures are painted with: colours, noise that repeats at the border, and patterns of stones. Only
// additions, products and exactly rounded roots, so that every compiler paints the same bytes.
#pragma once

#include <cstdint>
#include <functional>

#include "slipface/base/types.h"
#include "slipface/image/image.h"

namespace slipface::generate {

using Color = Vec3;  // sRGB, 0..1

// Warm sandstone with teal and bronze accents.
namespace palette {
inline const Color sand{0.80, 0.70, 0.55}, sand_light{0.89, 0.82, 0.69}, sand_dark{0.58, 0.48, 0.37},
    mortar{0.47, 0.40, 0.32};
inline const Color cream{0.91, 0.86, 0.75}, teal{0.16, 0.46, 0.47}, teal_dark{0.08, 0.27, 0.30},
    teal_light{0.42, 0.71, 0.69};
inline const Color bronze{0.55, 0.40, 0.22}, gold{0.85, 0.67, 0.34}, terracotta{0.72, 0.40, 0.27};
inline const Color wood{0.50, 0.34, 0.20}, wood_dark{0.29, 0.19, 0.11}, moss{0.33, 0.42, 0.18},
    leaf{0.30, 0.50, 0.26};
inline const Color ice{0.74, 0.88, 0.93}, sky{0.66, 0.82, 0.92}, soot{0.13, 0.11, 0.11},
    ember{0.98, 0.46, 0.10};
}  // namespace palette

// Fraction from 0 to 1 as t passes from a to b, smooth at both ends.
double ramp_between(double a, double b, double t);
Color mix(const Color& a, const Color& b, double fraction);

// Repeatable noise in [0, 1).
double hash01(std::uint32_t seed, int x, int y);

// Smooth noise over the unit square with `columns` x `rows` cells, equal at opposite borders; 0..1.
double noise(double u, double v, int columns, int rows, std::uint32_t seed);

// `octaves` of it, each twice as fine and half as strong; 0..1.
double cloud(double u, double v, int cells, int octaves, std::uint32_t seed);

// Distances from (u, v) to the nearest and second nearest of one point a cell, in cells.
struct CellDistance {
    double nearest = 0, second = 0;
    double tint = 0;  // repeatable fraction of the nearest point, 0..1
};
CellDistance cell_distance(double u, double v, int cells, std::uint32_t seed);

// Rows of blocks in running bond: where in its block (u, v) lies.
struct Block {
    double edge = 0;  // distance to the block's border, in texture widths
    double lit = 0;   // 1 near its upper and left border, -1 near its lower and right one, fading inward
    double tint = 0;  // 0..1, the block's own
};
Block block_at(double u, double v, int columns, int rows, double shift, std::uint32_t seed);

// Stone: a colour varied by clouds and grain.
Color grained(const Color& base, double u, double v, double strength, std::uint32_t seed);

// A square image; u to the right, v up, both 0..1 at the pixels' centres.
Image paint(int size, const std::function<Color(double u, double v)>& color);

}  // namespace slipface::generate
