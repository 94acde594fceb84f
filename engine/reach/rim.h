// The edges of a face, as one standing on it sees them.
#pragma once

#include "slipface/mesh/mesh.h"

namespace slipface {

// Calls visit(from, along, out) for each edge: its first corner, the vector to the next one, and the
// horizontal unit vector away from the face. An edge without a horizontal outside is left out.
template <class Visit>
void for_each_rim(const Mesh& mesh, FaceId face, Visit visit) {
    const Vec3 normal = face_normal(mesh, face);
    const std::uint32_t first = mesh.face_first_corner[face], count = mesh.face_corner_count(face);
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec3 from = mesh.corner_position(first + i).cast<double>();
        const Vec3 along = mesh.corner_position(first + (i + 1) % count).cast<double>() - from;
        Vec3 out = along.cross(normal);
        out.y() = 0.0;
        if (out.norm() < 1e-9) continue;
        out.normalize();
        visit(from, along, out);
    }
}

}  // namespace slipface
