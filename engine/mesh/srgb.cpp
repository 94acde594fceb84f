#include "slipface/mesh/srgb.h"

#include <cmath>

namespace slipface {

Vec3f srgb_of_linear(const Vec3f& linear) {
    return linear.unaryExpr([](float value) {
        const double v = static_cast<double>(value);
        return static_cast<float>(v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055);
    });
}

Vec3f linear_of_srgb(const Vec3f& srgb) {
    return srgb.unaryExpr([](float value) {
        const double v = static_cast<double>(value);
        return static_cast<float>(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
    });
}

}  // namespace slipface
