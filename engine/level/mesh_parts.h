// All parts of a mesh, painted or not.
#pragma once

#include "part_motion.h"

namespace slipface {

struct MeshParts {
    std::vector<PaintPart> parts;   // without anchors
    std::vector<std::uint32_t> of;  // [face] its part
};
MeshParts mesh_parts(const Mesh& mesh);

}  // namespace slipface
