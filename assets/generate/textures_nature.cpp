#include <algorithm>
#include <cmath>

#include "painting.h"
#include "textures.h"

namespace slipface::generate {
namespace {

using namespace palette;

Color mossy(double u, double v, const Color& base, std::uint32_t seed) {
    const double clump = cell_distance(u, v, 9, seed).nearest;
    const double tuft = cell_distance(u, v, 26, seed + 5).nearest;
    const double light = 1.18 - 0.40 * clump - 0.28 * tuft;
    return mix(base, Color(0.52, 0.56, 0.24), 0.5 * cloud(u, v, 4, 3, seed + 7)) * light;
}

Image moss_bed() {
    return paint(256, [](double u, double v) { return mossy(u, v, moss, 201); });
}

Image foliage() {
    return paint(128, [](double u, double v) {
        const double rib = std::abs(u - 0.5);
        const Color blade =
            mix(0.75 * leaf, mix(leaf, teal_light, 0.35), v) * (0.92 + 0.16 * noise(u, v, 24, 4, 211));
        return rib < 0.03 ? mix(blade, cream, 0.35) : rib > 0.42 ? mix(blade, gold, 0.45) : blade;
    });
}

Image mushroom_stem() {
    return paint(128, [](double u, double v) {
        return Color(grained(cream, u, v, 0.10, 221) * (0.86 + 0.16 * noise(u, v, 24, 2, 223)));
    });
}

Image crystal() {
    return paint(128, [](double u, double v) {
        const CellDistance facet = cell_distance(u, v, 4, 231);
        const Color glow = mix(Color(0.20, 0.66, 0.68), Color(0.74, 0.97, 0.92), facet.tint);
        return Color(
            mix(Color(0.88, 1.0, 0.97), glow, ramp_between(0.02, 0.10, facet.second - facet.nearest)));
    });
}

Image ice_sheet() {
    return paint(256, [](double u, double v) {
        const CellDistance broad = cell_distance(u, v, 3, 241), fine = cell_distance(u, v, 7, 243);
        const double crack = std::max(1.0 - ramp_between(0.0, 0.035, broad.second - broad.nearest),
                                      0.5 * (1.0 - ramp_between(0.0, 0.05, fine.second - fine.nearest)));
        const double depth = cloud(u, v, 3, 4, 245);
        return mix(mix(Color(0.50, 0.74, 0.84), ice, ramp_between(0.25, 0.7, depth)), Color(0.96, 0.99, 1.0),
                   0.75 * crack);
    });
}

}  // namespace

std::vector<Texture> nature_textures() {
    return {
        {"moss", moss_bed},   {"foliage", foliage}, {"mushroom_stem", mushroom_stem},
        {"crystal", crystal}, {"ice", ice_sheet},
    };
}

}  // namespace slipface::generate
