// All parts of a mesh, painted or not.
#pragma once

#include "part_motion.h"

namespace slipface {

struct MeshParts {
    std::vector<PaintPart> parts;   // without anchors
    std::vector<bool> scattered;    // [part] the small pieces of a group together
    std::vector<std::uint32_t> of;  // [face] its part
    // The faces of each part in the order of AnchorFace::rank.
    std::vector<std::uint32_t> first;  // [part + 1]
    std::vector<FaceId> sorted;
    std::vector<std::uint32_t> rank;         // [face]
    std::vector<std::uint32_t> first_there;  // [vertex] the first vertex at the same position
};

std::vector<MeshObject> objects_of(const Mesh& mesh);  // [group]

MeshParts mesh_parts(const Mesh& mesh, SurfaceTable surfaces);

}  // namespace slipface
