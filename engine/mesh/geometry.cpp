#include <algorithm>
#include <numeric>
#include <utility>

#include "newell.h"
#include "slipface/mesh/mesh.h"

namespace slipface {
namespace {

Vec3 face_sum(const Mesh& mesh, FaceId face) {
    const std::uint32_t first = mesh.face_first_corner[face];
    return newell_sum(mesh.face_corner_count(face), [&](std::size_t i) {
        return mesh.corner_position(first + static_cast<std::uint32_t>(i));
    });
}

}  // namespace

std::uint32_t Mesh::number_in_group(std::uint32_t group, std::uint32_t vertex) const {
    const std::uint32_t first = vertex_number.empty() ? vertex : vertex_number[vertex];
    if (group == no_id) return first;
    const auto found =
        std::lower_bound(group_vertices.begin(), group_vertices.end(), std::pair(group, vertex),
                         [](const GroupVertex& a, const std::pair<std::uint32_t, std::uint32_t>& b) {
                             return std::pair(a.group, a.vertex) < b;
                         });
    const bool other = found != group_vertices.end() && found->group == group && found->vertex == vertex;
    return other ? found->number : first;
}

std::vector<FaceId> faces_by_group(const Mesh& mesh) {
    std::vector<std::uint32_t> next(mesh.groups.size() + 1, 0);  // [group]
    for (const std::uint32_t group : mesh.face_group)
        ++next[group + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    std::vector<FaceId> faces(mesh.face_count());
    for (FaceId face = 0; face < mesh.face_count(); ++face)
        faces[next[mesh.face_group[face]]++] = face;
    return faces;
}

Vec3 face_normal(const Mesh& mesh, FaceId face) {
    const Vec3 sum = face_sum(mesh, face);
    const double length = sum.norm();
    return length > 0.0 ? Vec3(sum / length) : Vec3(Vec3::Zero());
}

Vec3 face_centroid(const Mesh& mesh, FaceId face) {
    const std::uint32_t first = mesh.face_first_corner[face];
    const std::uint32_t count = mesh.face_corner_count(face);
    Vec3 sum = Vec3::Zero();
    for (std::uint32_t i = 0; i < count; ++i)
        sum += mesh.corner_position(first + i).cast<double>();
    return count > 0 ? Vec3(sum / count) : sum;
}

double face_area(const Mesh& mesh, FaceId face) {
    return 0.5 * face_sum(mesh, face).norm();
}

}  // namespace slipface
