#include "painting.h"

#include <algorithm>
#include <cmath>

namespace slipface::generate {
namespace {

int wrapped(int value, int period) {
    return ((value % period) + period) % period;
}

}  // namespace

double ramp_between(double a, double b, double t) {
    const double x = std::clamp((t - a) / (b - a), 0.0, 1.0);
    return x * x * (3.0 - 2.0 * x);
}

Color mix(const Color& a, const Color& b, double fraction) {
    return a + (b - a) * std::clamp(fraction, 0.0, 1.0);
}

double hash01(std::uint32_t seed, int x, int y) {
    std::uint32_t bits = seed * 0x9e3779b9U;
    bits ^= static_cast<std::uint32_t>(x) * 0x85ebca6bU;
    bits = (bits ^ (bits >> 15U)) * 0x2c1b3c6dU;
    bits ^= static_cast<std::uint32_t>(y) * 0xc2b2ae35U;
    bits = (bits ^ (bits >> 13U)) * 0x297a2d39U;
    return static_cast<double>((bits ^ (bits >> 16U)) >> 8U) / 16777216.0;
}

double noise(double u, double v, int columns, int rows, std::uint32_t seed) {
    const double x = u * columns, y = v * rows;
    const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
    const double fx = ramp_between(0, 1, x - column), fy = ramp_between(0, 1, y - row);
    const auto corner = [&](int i, int j) {
        return hash01(seed, wrapped(column + i, columns), wrapped(row + j, rows));
    };
    const double low = corner(0, 0) + (corner(1, 0) - corner(0, 0)) * fx;
    const double high = corner(0, 1) + (corner(1, 1) - corner(0, 1)) * fx;
    return low + (high - low) * fy;
}

double cloud(double u, double v, int cells, int octaves, std::uint32_t seed) {
    double sum = 0, weight = 1, total = 0;
    for (int i = 0; i < octaves; ++i) {
        sum += weight * noise(u, v, cells << i, cells << i, seed + static_cast<std::uint32_t>(i));
        total += weight;
        weight *= 0.5;
    }
    return sum / total;
}

CellDistance cell_distance(double u, double v, int cells, std::uint32_t seed) {
    const double x = u * cells, y = v * cells;
    const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
    CellDistance result{.nearest = 9, .second = 9};
    for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
            const int a = wrapped(column + i, cells), b = wrapped(row + j, cells);
            const double dx = column + i + 0.1 + 0.8 * hash01(seed, a, b) - x;
            const double dy = row + j + 0.1 + 0.8 * hash01(seed + 1, a, b) - y;
            const double distance = std::sqrt(dx * dx + dy * dy);
            if (distance < result.nearest) {
                result.second = result.nearest;
                result.nearest = distance;
                result.tint = hash01(seed + 2, a, b);
            } else if (distance < result.second) {
                result.second = distance;
            }
        }
    }
    return result;
}

Block block_at(double u, double v, int columns, int rows, double shift, std::uint32_t seed) {
    const int row = std::min(static_cast<int>(std::floor(v * rows)), rows - 1);
    const double x = u * columns + shift * row;
    const int column = static_cast<int>(std::floor(x));
    const double width = 1.0 / columns, height = 1.0 / rows;
    const double left = (x - column) * width, right = width - left;
    const double below = v - row * height, above = height - below;
    Block block;
    block.edge = std::min(std::min(left, right), std::min(below, above));
    const double fade = 1.0 - ramp_between(0.008, 0.03, block.edge);
    block.lit = (std::min(left, above) <= std::min(right, below) ? 1.0 : -1.0) * fade;
    block.tint = hash01(seed, wrapped(column, columns), row);
    return block;
}

Color grained(const Color& base, double u, double v, double strength, std::uint32_t seed) {
    const double broad = cloud(u, v, 4, 3, seed) - 0.5;
    const double fine = cloud(u, v, 48, 2, seed + 9) - 0.5;
    return base * (1.0 + strength * (1.2 * broad + 0.6 * fine));
}

Image paint(int size, const std::function<Color(double u, double v)>& color) {
    Image image = make_image(size, size, 0, 0, 0);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const Color c = color((x + 0.5) / size, 1.0 - (y + 0.5) / size);
            std::uint8_t* pixel = image.pixel(x, y);
            for (Eigen::Index channel = 0; channel < 3; ++channel) {
                // Steps of four: not seen under the grain, and the files are half as large.
                const double level = std::floor(std::clamp(c[channel], 0.0, 1.0) * 63.0 + 0.5);
                pixel[channel] = static_cast<std::uint8_t>(std::min(255.0, level * 4.0 + 2.0));
            }
        }
    }
    return image;
}

}  // namespace slipface::generate
