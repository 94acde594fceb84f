#include "convex_polygon.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace slipface {

ConvexPolygon square_on(const Plane& plane, double reach) {
    Eigen::Index thinnest = 0;
    plane.normal.cwiseAbs().minCoeff(&thinnest);
    const Vec3 u = plane.normal.cross(Vec3::Unit(thinnest)).normalized() * reach;
    const Vec3 v = plane.normal.cross(u);
    const Vec3 middle = plane.normal * plane.distance;
    return {middle - u - v, middle + u - v, middle + u + v, middle - u + v};
}

PolygonParts cut(const ConvexPolygon& polygon, const Plane& plane, double tolerance) {
    double highest = 0, lowest = 0;
    for (const Vec3& corner : polygon) {
        const double above = plane.above(corner);
        highest = std::max(highest, above);
        lowest = std::min(lowest, above);
    }
    if (highest <= tolerance) return {{}, polygon};
    if (lowest >= -tolerance) return {polygon, {}};
    PolygonParts parts;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double at_a = plane.above(a), at_b = plane.above(b);
        if (at_a >= -tolerance) parts.front.push_back(a);
        if (at_a <= tolerance) parts.back.push_back(a);
        if ((at_a > tolerance && at_b < -tolerance) || (at_a < -tolerance && at_b > tolerance)) {
            const Vec3 between = a + (b - a) * (at_a / (at_a - at_b));
            parts.front.push_back(between);
            parts.back.push_back(between);
        }
    }
    return parts;
}

double area_of(const ConvexPolygon& polygon) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 2; i < polygon.size(); ++i)
        sum += (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]);
    return 0.5 * sum.norm();
}

double width_of(const ConvexPolygon& polygon) {
    double longest = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        longest = std::max(longest, (polygon[(i + 1) % polygon.size()] - polygon[i]).norm());
    return longest > 0 ? area_of(polygon) / longest : 0.0;
}

Aabb bounds_of(const ConvexPolygon& polygon) {
    Aabb bounds;
    for (const Vec3& corner : polygon)
        bounds.add(corner);
    return bounds;
}

void subtract(const ConvexPolygon& polygon, const std::vector<Plane>& planes, double tolerance,
              std::vector<ConvexPolygon>& out) {
    const std::size_t before = out.size();
    ConvexPolygon inside = polygon;
    for (const Plane& plane : planes) {
        PolygonParts parts = cut(inside, plane, tolerance);
        if (!parts.front.empty()) out.push_back(std::move(parts.front));
        inside = std::move(parts.back);
        if (inside.empty()) break;
    }
    if (width_of(inside) > tolerance) return;
    out.resize(before);
    out.push_back(polygon);
}

}  // namespace slipface
