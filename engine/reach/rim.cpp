#include "rim.h"

namespace slipface {

std::vector<Rim> rims_of(const Mesh& mesh, FaceId face) {
    std::vector<Rim> rims;
    const Vec3 normal = face_normal(mesh, face);
    const std::uint32_t first = mesh.face_first_corner[face], count = mesh.face_corner_count(face);
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec3 from = mesh.corner_position(first + i).cast<double>();
        const Vec3 along = mesh.corner_position(first + (i + 1) % count).cast<double>() - from;
        Vec3 out = along.cross(normal);
        out.y() = 0.0;
        if (out.norm() >= 1e-9) rims.push_back({from, along, out.normalized()});
    }
    return rims;
}

}  // namespace slipface
