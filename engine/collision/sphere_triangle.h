// The narrow phase: one triangle against a point, a resting and a moving ellipsoid, in double. docs/sweep.md
// derives every formula, sphere_triangle_impl.h computes them, and kernels.h has them for each instruction
// set.
//
// Each function is pure: its answer depends on the triangle and the query and never on what was found before,
// which is what makes the answer of a world independent of the order in which its tree is walked.
#pragma once

#include "leaf_triangle.h"
#include "slipface/collision/feature.h"
#include "three.h"

namespace slipface::detail {

// An ellipsoid at `centre` that moves by `move`, with what every triangle needs of it.
struct EllipsoidQuery {
    V3 centre;   // world
    V3 radii;    // world
    V3 inverse;  // 1 / radii
    V3 move;     // world
    V3 d;        // move in sphere space
};

inline namespace SLIPFACE_ISA {
inline EllipsoidQuery ellipsoid_query(const V3& centre, const V3& radii, const V3& move) {
    const V3 inverse = (Three::all(1.0) / Three(radii)).vec();
    return {centre, radii, inverse, move, mul(move, inverse)};
}
}  // namespace SLIPFACE_ISA

// The point of a triangle nearest to the centre.
struct Nearest {
    double distance2;  // sphere space
    Feature feature;
    int part;  // number of the edge or corner
    double s;  // place on the edge, [0, 1]
};

// First touch of a moving ellipsoid and a triangle.
struct TriangleHit {
    double t;  // [0, 1]
    Feature feature;
    int part;      // number of the edge or corner
    bool started;  // in touch from the start, and moving further in
};

// Where and how a hit or a nearest part touches, in world space.
struct Touch {
    V3 point;
    V3 normal;  // unit, towards the centre
};

}  // namespace slipface::detail
