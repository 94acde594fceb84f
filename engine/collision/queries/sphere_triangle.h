// The narrow phase: one triangle against a point, a resting and a moving ellipsoid, in double. docs/sweep.md
// derives every formula, sphere_triangle_impl.h computes them, and kernels.h provides them for each
// instruction set.
//
// Each function is pure: its result depends on the triangle and the query only, never on earlier results. So
// the result of a world does not depend on the order in which its tree is walked.
#pragma once

#include "queries/leaf_triangle.h"
#include "simd/three.h"
#include "slipface/collision/feature.h"

namespace slipface::detail {

// An ellipsoid at `centre` that moves by `move`, with the values that every triangle needs.
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

// The point of a triangle nearest to the query's centre.
struct Nearest {
    double distance2;  // sphere space
    Feature feature;
    int part;  // number of the edge or corner
    double s;  // position on the edge, [0, 1]
};

// The first touch of a moving ellipsoid and a triangle.
struct TriangleHit {
    double t;  // [0, 1]
    Feature feature;
    int part;      // number of the edge or corner
    bool started;  // in contact at the start, and moving further in
};

// The point and normal of a hit or a nearest part, in world space.
struct Touch {
    V3 point;
    V3 normal;  // unit, towards the centre
};

}  // namespace slipface::detail
