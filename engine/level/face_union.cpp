#include "face_union.h"

#include <algorithm>
#include <cmath>

#include "face_match.h"

namespace slipface {

bool has_corner_mean(const Mesh& mesh, const FaceKey& key, std::span<const FaceId> parts, double slack) {
    std::vector<std::uint32_t> vertices;
    for (const FaceId part : parts)
        for (std::uint32_t c = mesh.face_first_corner[part]; c < mesh.face_first_corner[part + 1]; ++c)
            vertices.push_back(mesh.corner_vertex[c]);
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    Vec3 sum = Vec3::Zero();
    for (const std::uint32_t vertex : vertices)
        sum += mesh.positions[vertex].cast<double>();
    const Vec3 mean = sum / static_cast<double>(vertices.size());
    return (mean - key.centroid).norm() <= slack * std::sqrt(key.area) + position_tolerance(key.centroid);
}

bool has_area_vector(const FaceIndex& index, const FaceKey& key, std::span<const FaceId> parts) {
    Vec3 sum = -key.area * key.normal;
    for (const FaceId part : parts)
        sum += index.key(part).area * index.key(part).normal;
    return sum.norm() <= 2e-3 * key.area;
}

bool has_middle(const Mesh& mesh, const FaceKey& key, std::span<const FaceId> parts) {
    if (has_corner_mean(mesh, key, parts, mean_slack)) return true;
    double area = 0.0;
    Vec3 sum = Vec3::Zero();
    for (const FaceId part : parts) {
        for (std::uint32_t t = mesh.face_first_triangle[part]; t < mesh.face_first_triangle[part + 1]; ++t) {
            Vec3 corner[3];
            for (std::size_t i = 0; i < 3; ++i)
                corner[i] = mesh.corner_position(mesh.triangles[t][i]).cast<double>();
            const double doubled = (corner[1] - corner[0]).cross(corner[2] - corner[0]).norm();
            sum += doubled * (corner[0] + corner[1] + corner[2]) / 3.0;
            area += doubled;
        }
    }
    return area > 0.0 && (sum / area - key.centroid).norm() <=
                             0.02 * std::sqrt(key.area) + position_tolerance(key.centroid);
}

bool cover_middle(const FaceIndex& index, const FaceKey& key, const Vec3& normal,
                  std::span<const FaceId> parts) {
    const Vec3 side = 0.01 * std::sqrt(key.area) * normal.unitOrthogonal();
    const Vec3 other = normal.cross(side);
    const Vec3 points[] = {side, -side, other, -other};
    return std::all_of(std::begin(points), std::end(points), [&](const Vec3& point) {
        return std::any_of(parts.begin(), parts.end(),
                           [&](FaceId face) { return index.covers(face, key.centroid + point, normal); });
    });
}

}  // namespace slipface
