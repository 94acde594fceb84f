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
