// Rigid motions and the sines and cosines for them. Only operations with exactly rounded results are used, so
// every C library gives the same bits.
#pragma once

#include <array>

#include "slipface/base/types.h"

namespace slipface {

struct SinCos {
    double sine = 0.0;
    double cosine = 1.0;
};

// Sine and cosine of any finite `angle`, radians. Error about 1e-15, plus about 4e-17 per radian of `angle`.
SinCos sin_cos(double angle);

// A rigid motion: first rotate about the origin, then add the offset. world = rotation * rest + offset.
struct Pose {
    std::array<Vec3, 3> columns{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};  // of the rotation matrix
    Vec3 offset = Vec3::Zero();

    Vec3 rotate(const Vec3& direction) const {
        return columns[0] * direction.x() + columns[1] * direction.y() + columns[2] * direction.z();
    }
    Vec3 rotate_back(const Vec3& direction) const {
        return {columns[0].dot(direction), columns[1].dot(direction), columns[2].dot(direction)};
    }
    Vec3 apply(const Vec3& point) const { return rotate(point) + offset; }
    Vec3 undo(const Vec3& point) const { return rotate_back(point - offset); }
    friend bool operator==(const Pose&, const Pose&) = default;
};

// The pose that rotates by `angle` radians about `axis` through `pivot`, counter-clockwise seen from the tip
// of the axis, and then adds `offset`. `axis` may have any length; with a zero or infinite one nothing is
// rotated. Source: Rodrigues' rotation formula.
Pose rotation_about(const Vec3& pivot, const Vec3& axis, double angle, const Vec3& offset = Vec3::Zero());

}  // namespace slipface
