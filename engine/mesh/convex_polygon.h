// Cutting flat convex polygons with planes, in double precision.
#pragma once

#include <vector>

#include "slipface/base/types.h"

namespace slipface {

struct Plane {
    Vec3 normal = Vec3::UnitY();  // unit
    double distance = 0.0;        // of the origin along it
    double above(const Vec3& point) const { return normal.dot(point) - distance; }
};

using ConvexPolygon = std::vector<Vec3>;  // counter-clockwise seen from its front; empty: no area

// A square around the point of the plane nearest to the origin; `reach` is the distance from its centre to
// its sides.
ConvexPolygon square_on(const Plane& plane, double reach);

// The parts in front of and behind the plane. Corners within `tolerance` lie on the plane. A polygon without
// a corner farther in front (behind) has no part there; one that lies in the plane counts as behind.
struct PolygonParts {
    ConvexPolygon front, back;
};
PolygonParts cut(const ConvexPolygon& polygon, const Plane& plane, double tolerance);

double area_of(const ConvexPolygon& polygon);
// Area divided by longest side: a measure of slivers. 0 for a polygon without area.
double width_of(const ConvexPolygon& polygon);
Aabb bounds_of(const ConvexPolygon& polygon);

// Appends to `out` the parts of `polygon` in front of any of `planes`, that is outside the convex solid that
// they bound. If the part inside is not wider than `tolerance`, the whole polygon is appended in one piece.
void subtract(const ConvexPolygon& polygon, const std::vector<Plane>& planes, double tolerance,
              std::vector<ConvexPolygon>& out);

}  // namespace slipface
