#include "document/faces.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <unordered_set>

namespace slipface {
namespace {

// Float coordinates bend what was authored flat by up to about this much, radians.
constexpr double flat_tolerance = 1e-4;

double angle_between(const Vec3& a, const Vec3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

double squared_distance_to_segment(const Vec3& point, const Vec3& a, const Vec3& b) {
    const Vec3 along = b - a;
    const double length2 = along.squaredNorm();
    const double share = length2 > 0.0 ? std::clamp((point - a).dot(along) / length2, 0.0, 1.0) : 0.0;
    return (point - (a + share * along)).squaredNorm();
}

double squared_distance_to_triangle(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 normal = (b - a).cross(c - a);
    const double length2 = normal.squaredNorm();
    const bool above = length2 > 0.0 && normal.dot((b - a).cross(point - a)) >= 0.0 &&
                       normal.dot((c - b).cross(point - b)) >= 0.0 &&
                       normal.dot((a - c).cross(point - c)) >= 0.0;
    if (above) {
        const double height = normal.dot(point - a);
        return height * height / length2;
    }
    return std::min({squared_distance_to_segment(point, a, b), squared_distance_to_segment(point, b, c),
                     squared_distance_to_segment(point, c, a)});
}

bool face_within(const Mesh& mesh, FaceId face, const Vec3& centre, double radius) {
    const double radius2 = radius * radius;
    for (std::uint32_t t = mesh.face_first_triangle[face]; t < mesh.face_first_triangle[face + 1]; ++t) {
        const auto& corners = mesh.triangles[t];
        const auto corner = [&](std::size_t i) {
            return Vec3(mesh.corner_position(corners[i]).cast<double>());
        };
        if (squared_distance_to_triangle(centre, corner(0), corner(1), corner(2)) <= radius2) return true;
    }
    return false;
}

}  // namespace

std::vector<FaceId> flood_by_angle(const Mesh& mesh, const FaceNeighbours& neighbours, FaceId start,
                                   double max_angle) {
    if (start >= mesh.face_count()) return {};
    struct Reached {
        FaceId face;
        Vec3 normal;  // a face without area carries on the normal it was reached with
    };
    std::vector<bool> seen(mesh.face_count(), false);
    std::vector<FaceId> result;
    std::deque<Reached> open{{start, face_normal(mesh, start)}};
    seen[start] = true;
    while (!open.empty()) {
        const Reached current = open.front();
        open.pop_front();
        result.push_back(current.face);
        for (const FaceId next : neighbours.of(current.face)) {
            if (seen[next]) continue;
            Vec3 normal = face_normal(mesh, next);
            if (normal.isZero(0.0)) {
                normal = current.normal;
            } else if (!current.normal.isZero(0.0) &&
                       !(angle_between(current.normal, normal) <= max_angle + flat_tolerance)) {
                continue;
            }
            seen[next] = true;
            open.push_back({next, normal});
        }
    }
    std::sort(result.begin(), result.end());
    return result;
}

std::vector<FaceId> brush_faces(const Mesh& mesh, const FaceNeighbours& neighbours, FaceId start,
                                const Vec3& centre, double radius) {
    if (start >= mesh.face_count()) return {};
    std::vector<FaceId> result{start};
    if (!(radius > 0.0)) return result;
    std::unordered_set<FaceId> seen{start};
    for (std::size_t done = 0; done < result.size(); ++done) {
        for (const FaceId next : neighbours.of(result[done]))
            if (seen.insert(next).second && face_within(mesh, next, centre, radius)) result.push_back(next);
    }
    std::sort(result.begin(), result.end());
    return result;
}

Aabb faces_bounds(const Mesh& mesh, std::span<const FaceId> faces) {
    Aabb bounds;
    for (const FaceId face : faces) {
        if (face >= mesh.face_count()) continue;
        for (std::uint32_t corner = mesh.face_first_corner[face]; corner < mesh.face_first_corner[face + 1];
             ++corner)
            bounds.add(mesh.corner_position(corner).cast<double>());
    }
    return bounds;
}

}  // namespace slipface
