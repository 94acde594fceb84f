// All parts of a mesh, painted or not.
#pragma once

#include <map>

#include "part_motion.h"

namespace slipface {

struct MeshParts {
    std::vector<PaintPart> parts;   // without anchors
    std::vector<std::uint32_t> of;  // [face] its part
};

// The objects of the old file and of a mesh by their names (object_name()). Empty if the old file has no
// parts.
struct ObjectNames {
    ObjectNames(const Mesh& mesh, const PaintParts& parts);

    // Whether what the mesh has in the object `now` is nothing of the old object `before`: the old file had
    // both, and that one is still there.
    bool differ(std::uint32_t before, std::uint32_t now) const {
        return before != now && in_mesh.contains(before) && in_old.contains(now);
    }

    std::map<std::uint32_t, std::size_t> in_old, in_mesh;  // [name] number of faces
    std::vector<std::uint32_t> of_group;                   // of the mesh
};

MeshParts mesh_parts(const Mesh& mesh);

}  // namespace slipface
