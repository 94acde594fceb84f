#include "slipface/render/overlay.h"

#include <cmath>
#include <numbers>

namespace slipface {

namespace {

constexpr int disc_segments = 48;

}  // namespace

void Overlay::line(const Vec3& a, const Vec3& b, Color color, float width, bool on_top) {
    lines.push_back({a, b, color, width, on_top, false});
}

void Overlay::arrow(const Vec3& from, const Vec3& to, Color color, float width, bool on_top) {
    lines.push_back({from, to, color, width, on_top, true});
}

void Overlay::cross(const Vec3& centre, double size, Color color, float width) {
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3 half = 0.5 * size * Vec3::Unit(axis);
        line(centre - half, centre + half, color, width);
    }
}

void Overlay::ellipsoid(const Vec3& centre, const Vec3& radii, Color fill, Color outline) {
    ellipsoids.push_back({centre, radii, fill, outline});
}

void Overlay::disc(const Vec3& centre, const Vec3& normal, double radius, Color fill, Color outline) {
    const double length = normal.norm();
    if (!(length > 0.0) || !std::isfinite(length)) return;
    const Vec3 n = normal / length;
    // Every axis except the one nearest to the normal gives a well-conditioned tangent.
    const Vec3 size = n.cwiseAbs();
    const int least = size.x() <= size.y() && size.x() <= size.z() ? 0 : size.y() <= size.z() ? 1 : 2;
    const Vec3 u = Vec3::Unit(least).cross(n).normalized() * radius;
    const Vec3 v = n.cross(u);
    Vec3 previous = centre + u;
    for (int i = 1; i <= disc_segments; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / disc_segments;
        const Vec3 next = centre + u * std::cos(angle) + v * std::sin(angle);
        if (fill.alpha > 0.0f) triangle(centre, previous, next, fill);
        if (outline.alpha > 0.0f) line(previous, next, outline, 1.5f);
        previous = next;
    }
}

void Overlay::triangle(const Vec3& a, const Vec3& b, const Vec3& c, Color color) {
    triangles.push_back({a, b, c, color});
}

}  // namespace slipface
