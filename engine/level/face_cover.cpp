#include "face_cover.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace slipface {
namespace {

using Polygon = std::vector<Vec2>;

constexpr double nearly_all = 0.9;   // of a new face's area
constexpr double overlapping = 1.1;  // of a new face's area: more than it can cover of faces side by side

double cross(const Vec2& a, const Vec2& b) {
    return a.x() * b.y() - a.y() * b.x();
}

double signed_area(std::span<const Vec2> polygon) {
    double doubled = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        doubled += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
    return 0.5 * doubled;
}

// What of the polygon, which may be concave, lies to the left of the line from `a` to `b`. Cut pieces stay
// connected along the line, which does not change their area.
void keep_left(Polygon& polygon, Polygon& scratch, const Vec2& a, const Vec2& b) {
    scratch.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2& here = polygon[i];
        const Vec2& next = polygon[(i + 1) % polygon.size()];
        const double side = cross(b - a, here - a), next_side = cross(b - a, next - a);
        if (side >= 0.0) scratch.push_back(here);
        if ((side > 0.0 && next_side < 0.0) || (side < 0.0 && next_side > 0.0))
            scratch.push_back(here + side / (side - next_side) * (next - here));
    }
    polygon.swap(scratch);
}

// Of old faces that lie on each other the one that a new face of this area is, if it is much like one of
// them. `covered`: of each, by the new face; `sizes`: of each.
std::optional<std::size_t> alike_face(std::span<const double> covered, std::span<const double> sizes,
                                      double area) {
    constexpr double alike = 0.5, much_more = 1.25;
    std::size_t best = 0;
    double most = 0.0, second = 0.0;
    for (std::size_t i = 0; i < covered.size(); ++i) {
        const double common = covered[i] / std::max(sizes[i], area);
        second = std::max(second, std::min(common, most));
        if (common > most) best = i;
        most = std::max(most, common);
    }
    return most >= alike && most >= much_more * second ? std::optional(best) : std::nullopt;
}

struct Plane {
    Vec3 origin, u, v;
    Vec2 operator()(const Vec3& point) const { return {u.dot(point - origin), v.dot(point - origin)}; }
};

}  // namespace

std::vector<Vec3> likely_outline(const FaceKey& key) {
    const double radius = std::sqrt(key.area / 2.8284271247461903);  // of an octagon: 2 sqrt(2) r^2
    const Vec3 normal = key.normal.normalized();
    const Vec3 u = radius * normal.unitOrthogonal(), v = normal.cross(u);
    const double root = 0.70710678118654757;
    std::vector<Vec3> corners;
    for (const auto& [x, y] : {std::pair{1.0, 0.0},
                               {root, root},
                               {0.0, 1.0},
                               {-root, root},
                               {-1.0, 0.0},
                               {-root, -root},
                               {0.0, -1.0},
                               {root, -root}})
        corners.emplace_back(key.centroid + x * u + y * v);
    return corners;
}

std::vector<double> covered_areas(const Mesh& mesh, FaceId face, std::span<const OldFace> faces,
                                  double slack) {
    const Vec3 normal = face_normal(mesh, face);
    Plane plane{
        mesh.corner_position(mesh.face_first_corner[face]).cast<double>(), normal.unitOrthogonal(), {}};
    plane.v = normal.cross(plane.u);
    std::vector<Polygon> triangles;
    double area = 0.0;
    for (std::uint32_t t = mesh.face_first_triangle[face]; t < mesh.face_first_triangle[face + 1]; ++t) {
        Polygon& triangle = triangles.emplace_back();
        for (std::size_t i = 0; i < 3; ++i)
            triangle.push_back(plane(mesh.corner_position(mesh.triangles[t][i]).cast<double>()));
        const double size = signed_area(triangle);
        if (size < 0.0) std::swap(triangle[1], triangle[2]);
        area += std::abs(size);
    }
    std::vector<double> covered(faces.size(), 0.0), sizes;
    Polygon cut, scratch;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        cut.clear();
        for (const Vec3& corner : faces[i].outline)
            cut.push_back(plane(corner));
        sizes.push_back(std::abs(signed_area(cut)));
        for (const Polygon& triangle : triangles) {
            cut.clear();
            for (const Vec3& corner : faces[i].outline)
                cut.push_back(plane(corner));
            for (std::size_t k = 0; k < 3 && !cut.empty(); ++k)
                keep_left(cut, scratch, triangle[k], triangle[(k + 1) % 3]);
            covered[i] += std::abs(signed_area(cut));
        }
    }
    // Before or behind faces in its plane that have nearly all of it, no face is it, however alike.
    double in_plane = 0.0;
    for (std::size_t i = 0; i < faces.size(); ++i)
        in_plane += faces[i].distance <= slack ? covered[i] : 0.0;
    for (std::size_t i = 0; i < faces.size() && in_plane > nearly_all * area; ++i)
        if (faces[i].distance > slack) covered[i] = 0.0;
    if (std::accumulate(covered.begin(), covered.end(), 0.0) > overlapping * area) {
        if (const std::optional<std::size_t> own = alike_face(covered, sizes, area)) {
            const double common = covered[*own];
            std::fill(covered.begin(), covered.end(), 0.0);
            covered[*own] = common;
            return covered;
        }
    }
    std::vector<std::size_t> order(faces.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return faces[a].distance < faces[b].distance; });
    double left = area;
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
        double sum = 0.0;
        for (end = begin;
             end < order.size() && faces[order[end]].distance <= faces[order[begin]].distance + slack; ++end)
            sum += covered[order[end]];
        const double share = sum > left ? left / sum : 1.0;
        for (std::size_t k = begin; k < end; ++k)
            covered[order[k]] *= share;
        left = std::max(0.0, left - sum);
    }
    return covered;
}

}  // namespace slipface
