// The tree of a file's objects, from readers of formats that have one.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "slipface/mesh/build.h"

namespace slipface {

// The shapes that a node shows, by their numbers in the file.
using NodeShapes = std::map<std::uint32_t, std::vector<std::size_t>>;  // [node]

// Removes the nodes without faces in or below them from soup.nodes, and finds the copies among the others.
void drop_empty_nodes(PolygonSoup& soup, const NodeShapes& shapes);

}  // namespace slipface
