// The narrow phase: one triangle against a point, a resting and a moving ellipsoid, in double. docs/sweep.md
// derives every formula here.
//
// Each function is pure: its answer depends on the triangle and the query and never on what was found before,
// which is what makes the answer of a world independent of the order in which its tree is walked.
#pragma once

#include "bvh.h"
#include "slipface/collision/contact.h"
#include "three.h"
#include "vec.h"

namespace slipface::detail {

// An ellipsoid at `centre` that moves by `move`, with what every triangle needs of it.
struct EllipsoidQuery {
    V3 centre;   // world
    V3 radii;    // world
    V3 inverse;  // 1 / radii
    V3 move;     // world
    V3 d;        // move in sphere space
    double dd;   // d . d

    EllipsoidQuery(const V3& centre_world, const V3& radii_world, const V3& move_world)
        : centre(centre_world),
          radii(radii_world),
          inverse((Three::all(1.0) / Three(radii_world)).vec()),
          move(move_world),
          d(mul(move_world, inverse)),
          dd(dot(d, d)) {}
    // A point of the world relative to the centre, in sphere space.
    V3 relative(const V3& world) const { return mul(world - centre, inverse); }
};

// A triangle relative to a query's centre, in sphere space.
struct SphereTriangle {
    Threes a;  // corners
    Threes e;  // edge k runs from corner k to corner (k + 1) % 3; taken from the world's corners, so exact up
               // to one rounding
    V3 n;      // winding normal, any length
    double nn;  // n . n; 0 exactly if the triangle counts as its edges only
    double h;   // n . a for corner 0: the plane is n . x = h

    SphereTriangle(const LeafTriangle& triangle, const EllipsoidQuery& query);

  private:
    SphereTriangle(const Threes& world, const EllipsoidQuery& query);
};

// The point of a triangle nearest to the centre.
struct Nearest {
    double distance2;  // sphere space
    Feature feature;
    int part;  // number of the edge or corner
    double s;  // place on the edge, [0, 1]
};
Nearest nearest_part(const SphereTriangle& triangle);

// First touch of a moving ellipsoid and a triangle.
struct TriangleHit {
    double t;  // [0, 1]
    Feature feature;
    int part;      // number of the edge or corner
    bool started;  // in touch from the start, and moving further in
};
// False if there is none with t <= t_max.
bool sweep_triangle(const SphereTriangle& triangle, const EllipsoidQuery& query, double t_max,
                    TriangleHit& hit);

// Whether a one-sided triangle lets the query pass: its centre is behind the plane, the move does not go
// against the winding normal, or there is no winding normal.
bool passes_one_sided(const SphereTriangle& triangle, const EllipsoidQuery& query);
// The centre is behind the plane of the winding, or there is none.
bool is_behind(const SphereTriangle& triangle);

// Where and how a hit or a nearest part touches, in world space.
struct Touch {
    V3 point;
    V3 normal;  // unit, towards the centre
};
Touch touch_of(const SphereTriangle& triangle, const LeafTriangle& leaf, const EllipsoidQuery& query,
               const TriangleHit& hit);
Touch touch_of(const SphereTriangle& triangle, const LeafTriangle& leaf, const EllipsoidQuery& query,
               const Nearest& nearest);

// Winding normal of a triangle in world space, unit; zero for one that counts as its edges only.
V3 winding_normal(const LeafTriangle& triangle);

}  // namespace slipface::detail
