#include "slipface/base/placement.h"

namespace slipface {

Vec3f Placement::apply(const Vec3f& rest) const {
    const double x{rest.x()};
    const double y{rest.y()};
    const double z{rest.z()};
    Vec3f placed;
    for (int axis = 0; axis < 3; ++axis)
        placed[axis] = static_cast<float>(columns[0][axis] * x + columns[1][axis] * y + columns[2][axis] * z +
                                          offset[axis]);
    return placed;
}

Placement placement(const Vec3& position, const Vec3& rotation, const Vec3& scale) {
    const auto [sx, cx] = sin_cos(rotation.x());
    const auto [sy, cy] = sin_cos(rotation.y());
    const auto [sz, cz] = sin_cos(rotation.z());
    // The columns of Ry * Rx * Rz.
    return {{Vec3(cy * cz + sy * sx * sz, cx * sz, cy * sx * sz - sy * cz) * scale.x(),
             Vec3(sy * sx * cz - cy * sz, cx * cz, sy * sz + cy * sx * cz) * scale.y(),
             Vec3(sy * cx, -sx, cy * cx) * scale.z()},
            position};
}

Placement moved(const Placement& placed, const Pose& motion) {
    Placement at = placed;
    for (Vec3& column : at.columns)
        column = motion.rotate(column);
    at.offset = motion.apply(placed.offset);
    return at;
}

}  // namespace slipface
