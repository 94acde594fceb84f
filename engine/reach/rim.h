#pragma once

#include <vector>

#include "slipface/mesh/mesh.h"

namespace slipface {

// An edge of a face that is not vertical.
struct Rim {
    Vec3 from, along;  // begins at `from` and ends at `from + along`
    Vec3 out;          // horizontal, of length 1, across the edge and away from the face
};

std::vector<Rim> rims_of(const Mesh& mesh, FaceId face);

}  // namespace slipface
