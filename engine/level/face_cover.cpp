#include "face_cover.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace slipface {
namespace {

constexpr double more_than_half = 0.52;
constexpr double many = 6.0;      // a face of so many old ones holds nearly all of their outlines
constexpr double samples = 64.0;  // of a face
// Of a square's points from its centre, in sides: some lie beyond its edges. A small face beside the edge must
// not be taken for a part of the square.
constexpr double reach = 0.62;
constexpr double small_reach = 0.5;

std::optional<SurfaceId> largest(const std::map<SurfaceId, double>& shares, double whole) {
    for (const auto& [type, share] : shares)
        if (share > more_than_half * whole) return type;
    return std::nullopt;
}

// Adds `weight` to the type of the old face that `point` lies on.
void count(const Vec3& point, const Vec3& normal, double area, double weight, std::span<const OldFace> faces,
           std::map<SurfaceId, double>& shares) {
    const OldFace* best = nullptr;
    double best_distance = reach;
    for (const OldFace& old : faces) {
        const Vec3 offset = point - old.key->centroid;
        const double distance = (offset - normal.dot(offset) * normal).norm() / std::sqrt(old.key->area);
        if (distance >= best_distance) continue;
        if (area < small_fraction * old.key->area && distance > small_reach) continue;
        best = &old;
        best_distance = distance;
    }
    if (best) shares[best->type] += weight;
}

}  // namespace

std::optional<SurfaceId> covered_type(const Mesh& mesh, FaceId face, std::span<const OldFace> faces) {
    double area = 0.0;
    std::vector<double> areas;
    for (std::uint32_t t = mesh.face_first_triangle[face]; t < mesh.face_first_triangle[face + 1]; ++t) {
        Vec3 corner[3];
        for (std::size_t i = 0; i < 3; ++i)
            corner[i] = mesh.corner_position(mesh.triangles[t][i]).cast<double>();
        areas.push_back(0.5 * (corner[1] - corner[0]).cross(corner[2] - corner[0]).norm());
        area += areas.back();
    }
    if (!(area > 0.0)) return std::nullopt;
    std::map<SurfaceId, double> shares;
    double inside = 0.0, largest_inside = 0.0;
    for (const OldFace& old : faces) {
        if (!old.centre_inside) continue;
        inside += old.key->area;
        largest_inside = std::max(largest_inside, old.key->area);
        shares[old.type] += old.key->area;
    }
    if (area >= many * largest_inside && largest_inside > 0.0) return largest(shares, std::max(area, inside));

    shares.clear();
    const Vec3 normal = face_normal(mesh, face);
    for (std::size_t i = 0; i < areas.size(); ++i) {
        Vec3 corner[3];
        for (std::size_t c = 0; c < 3; ++c)
            corner[c] = mesh.corner_position(mesh.triangles[mesh.face_first_triangle[face] + i][c]).cast<double>();
        // n * n small triangles of equal area.
        const int n = static_cast<int>(std::ceil(std::sqrt(samples * areas[i] / area)));
        for (int a = 0; a < n; ++a) {
            for (int b = 0; b < 2 * (n - a) - 1; ++b) {
                const double third = b % 2 == 0 ? 1.0 / 3.0 : 2.0 / 3.0;
                const Vec3 point = corner[0] + (a + third) / n * (corner[1] - corner[0]) +
                                   (b / 2 + third) / n * (corner[2] - corner[0]);
                count(point, normal, area, areas[i] / (n * n), faces, shares);
            }
        }
    }
    return largest(shares, area);
}

}  // namespace slipface
