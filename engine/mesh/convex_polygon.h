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

using ConvexPolygon = std::vector<Vec3>;  // counter-clockwise seen from its front; empty: nothing

// A square about the plane's point that is nearest to the origin, `reach` from its middle to its sides.
ConvexPolygon square_on(const Plane& plane, double reach);

// Parts before and behind the plane. Corners within `tolerance` lie on it, and a polygon that has no corner
// farther before (behind) it has nothing there; one that lies in the plane counts as behind.
struct PolygonParts {
    ConvexPolygon front, back;
};
PolygonParts cut(const ConvexPolygon& polygon, const Plane& plane, double tolerance);

double area_of(const ConvexPolygon& polygon);
// Area by longest side: below it, a polygon is a sliver. 0 for what has no area.
double width_of(const ConvexPolygon& polygon);
Aabb bounds_of(const ConvexPolygon& polygon);

// What of `polygon` lies in front of any of `planes`, that is outside of the convex solid that they bound, is
// appended to `out`, in one piece where nothing wider than `tolerance` lies inside.
void subtract(const ConvexPolygon& polygon, const std::vector<Plane>& planes, double tolerance,
              std::vector<ConvexPolygon>& out);

}  // namespace slipface
