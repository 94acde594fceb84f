#include "face_cover.h"

#include <algorithm>
#include <cmath>

namespace slipface {
namespace {

constexpr double many = 6.0;      // a face of so many old ones holds nearly all of their outlines
constexpr double samples = 64.0;  // of a face
// Of an old face's points from its centre, in the root of its area. For a large face some beyond the edges of
// a square, because what is counted too much and too little is about equal; for a part of it what lies inside
// of a triangle, too, because a small face beside the edge must not be taken for a part.
constexpr double reach = 0.62, part_reach = 0.5, small_reach = 0.4;
constexpr double part_fraction_of_old = 0.6;

// The old face that `point` of a face with that area lies on; the number of them: none.
std::size_t old_face_at(const Vec3& point, const Vec3& normal, double area, std::span<const OldFace> faces) {
    std::size_t best = faces.size();
    double best_distance = reach;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const FaceKey& key = *faces[i].key;
        const Vec3 offset = point - key.centroid;
        const double distance = (offset - normal.dot(offset) * normal).norm() / std::sqrt(key.area);
        if (distance >= best_distance) continue;
        if (area < part_fraction_of_old * key.area && distance > part_reach) continue;
        if (area < small_fraction * key.area && distance > small_reach) continue;
        best = i;
        best_distance = distance;
    }
    return best;
}

}  // namespace

std::vector<double> covered_areas(const Mesh& mesh, FaceId face, std::span<const OldFace> faces) {
    struct Triangle {
        Vec3 corner[3];
        double area;
    };
    std::vector<Triangle> triangles;
    double area = 0.0;
    for (std::uint32_t t = mesh.face_first_triangle[face]; t < mesh.face_first_triangle[face + 1]; ++t) {
        Triangle& triangle = triangles.emplace_back();
        for (std::size_t i = 0; i < 3; ++i)
            triangle.corner[i] = mesh.corner_position(mesh.triangles[t][i]).cast<double>();
        const auto& corner = triangle.corner;
        triangle.area = 0.5 * (corner[1] - corner[0]).cross(corner[2] - corner[0]).norm();
        area += triangle.area;
    }
    std::vector<double> covered(faces.size(), 0.0);
    if (!(area > 0.0)) return covered;
    double inside = 0.0, largest = 0.0;
    for (const OldFace& old : faces) {
        if (!old.centre_inside) continue;
        inside += old.key->area;
        largest = std::max(largest, old.key->area);
    }
    if (largest > 0.0 && area >= many * largest) {
        for (std::size_t i = 0; i < faces.size(); ++i)
            if (faces[i].centre_inside) covered[i] = faces[i].key->area * std::min(1.0, area / inside);
        return covered;
    }
    const Vec3 normal = face_normal(mesh, face);
    for (const auto& [corner, size] : triangles) {
        // n * n small triangles of equal area.
        const int n = static_cast<int>(std::ceil(std::sqrt(samples * size / area)));
        for (int a = 0; a < n; ++a) {
            for (int b = 0; b < 2 * (n - a) - 1; ++b) {
                const double third = b % 2 == 0 ? 1.0 / 3.0 : 2.0 / 3.0;
                const Vec3 point = corner[0] + (a + third) / n * (corner[1] - corner[0]) +
                                   (b / 2 + third) / n * (corner[2] - corner[0]);
                const std::size_t old = old_face_at(point, normal, area, faces);
                if (old < faces.size()) covered[old] += size / (n * n);
            }
        }
    }
    return covered;
}

}  // namespace slipface
