// Rigid motions, and the angles they are made of, from additions and multiplications alone: every C library
// gives the same bits.
#pragma once

#include <array>

#include "slipface/base/types.h"

namespace slipface {

struct SinCos {
    double sine = 0.0;
    double cosine = 1.0;
};

// Of any finite angle, to about 1e-15; radians.
SinCos sin_cos(double angle);

// First turned about the origin, then shifted: world = rotation * rest + offset.
struct Pose {
    std::array<Vec3, 3> columns{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};  // of the rotation
    Vec3 offset = Vec3::Zero();

    Vec3 turn(const Vec3& direction) const {
        return columns[0] * direction.x() + columns[1] * direction.y() + columns[2] * direction.z();
    }
    Vec3 turn_back(const Vec3& direction) const {
        return {columns[0].dot(direction), columns[1].dot(direction), columns[2].dot(direction)};
    }
    Vec3 apply(const Vec3& point) const { return turn(point) + offset; }
    Vec3 undo(const Vec3& point) const { return turn_back(point - offset); }
    friend bool operator==(const Pose&, const Pose&) = default;
};

// Turned by `angle` about `axis` (any length but zero; zero turns nothing) through `pivot`, counter-clockwise
// seen from the axis's tip, then shifted by `offset`. Source: Rodrigues' rotation formula.
Pose turned_about(const Vec3& pivot, const Vec3& axis, double angle, const Vec3& offset = Vec3::Zero());

}  // namespace slipface
