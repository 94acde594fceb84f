// Where a mesh ends: edges that one face alone has.
#pragma once

#include <cstddef>

#include "slipface/mesh/mesh.h"

namespace slipface {

// The number of edges (pairs of vertices) that belong to one face only. 0 where the mesh is closed vertex to
// vertex; a level of overlapping parts, such as a Quake map, has many and can still be tight.
std::size_t open_edge_count(const Mesh& mesh);

}  // namespace slipface
