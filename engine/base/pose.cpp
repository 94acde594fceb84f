#include "slipface/base/pose.h"

#include <cmath>

namespace slipface {

SinCos sin_cos(double angle) {
    // Reduces the angle to within an eighth of a turn; remquo is exact in every C library.
    constexpr double quarter = 1.5707963267948966;
    int quarters = 0;
    const double x = std::remquo(angle, quarter, &quarters);
    const double square = x * x;
    double sine = 1.0;
    double cosine = 1.0;
    for (int n = 20; n >= 2; n -= 2) {
        cosine = 1.0 - cosine * square / static_cast<double>(n * (n - 1));
        sine = 1.0 - sine * square / static_cast<double>(n * (n + 1));
    }
    sine *= x;
    switch (quarters & 3) {
        case 1: return {cosine, -sine};
        case 2: return {-sine, -cosine};
        case 3: return {-cosine, sine};
        default: return {sine, cosine};
    }
}

Pose rotation_about(const Vec3& pivot, const Vec3& axis, double angle, const Vec3& offset) {
    Pose pose;
    const double length = axis.norm();
    const SinCos turn = sin_cos(angle);
    if (length > 0.0 && std::isfinite(length)) {
        const Vec3 unit = axis / length;
        for (int i = 0; i < 3; ++i) {
            const Vec3 e = Vec3::Unit(i);
            pose.columns[static_cast<std::size_t>(i)] =
                e * turn.cosine + unit.cross(e) * turn.sine + unit * (unit[i] * (1.0 - turn.cosine));
        }
    }
    pose.offset = pivot - pose.rotate(pivot) + offset;
    return pose;
}

}  // namespace slipface
