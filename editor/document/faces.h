// Choosing faces: connected regions and neighbourhoods.
#pragma once

#include "slipface/mesh/mesh.h"

namespace slipface {

// The faces reached from `start` over shared edges where the angle between neighbouring normals is at most
// `max_angle` (radians), ascending; contains `start`. Walls of zero area are crossed freely.
std::vector<FaceId> flood_by_angle(const Mesh& mesh, const FaceNeighbours& neighbours, FaceId start,
                                   double max_angle);

// Faces with a corner or an inner point within `radius` of `centre` that are connected with `start` by such
// faces; what a brush of that size paints. A radius of 0 gives `start` alone.
std::vector<FaceId> brush_faces(const Mesh& mesh, const FaceNeighbours& neighbours, FaceId start,
                                const Vec3& centre, double radius);

// The box around `faces`.
Aabb faces_bounds(const Mesh& mesh, std::span<const FaceId> faces);

}  // namespace slipface
