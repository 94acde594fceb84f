// Open edges of a mesh: those that belong to one face only.
#pragma once

#include <cstddef>

#include "slipface/mesh/mesh.h"

namespace slipface {

// The number of open edges (pairs of vertices). 0 if the mesh is closed vertex to vertex. A level of
// overlapping parts, such as a Quake map, has many and can still be tight.
std::size_t open_edge_count(const Mesh& mesh);

}  // namespace slipface
