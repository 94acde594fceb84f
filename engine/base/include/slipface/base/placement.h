// Where an instance of a mesh stands: position, rotation, and a scale for each axis.
#pragma once

#include <array>

#include "slipface/base/pose.h"

namespace slipface {

// placed = linear * rest + offset. The same bits from every compiler, and wherever a mesh is placed: at once,
// or triangle by triangle during a query.
struct Placement {
    std::array<Vec3, 3> columns{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};  // of the linear map
    Vec3 offset = Vec3::Zero();

    Vec3f apply(const Vec3f& rest) const;
    // True if it turns left hands into right ones. The corners of its faces are then read backwards, so that
    // they keep their front.
    bool mirrors() const { return columns[0].cross(columns[1]).dot(columns[2]) < 0.0; }
    friend bool operator==(const Placement&, const Placement&) = default;
};

// Scales along the mesh's own axes, rotates about z, then x, then y (radians), and moves to `position`.
Placement placement(const Vec3& position, const Vec3& rotation, const Vec3& scale);

// First placed, then moved by a rigid motion.
Placement moved(const Placement& placed, const Pose& motion);

}  // namespace slipface
