// Better places for nodes of the binary tree. Splits decide from above: a triangle that is larger than the
// half it went to, or lies beside it, makes that half's box larger, and all boxes between the two. Such a
// node is taken out and put where queries visit the least of the tree (J. Bittner, M. Hapala, V. Havran,
// "Fast insertion-based optimization of bounding volume hierarchies", 2013; D. Meister, J. Bittner, "Parallel
// reinsertion for bounding volume hierarchy optimization", 2018).
#pragma once

#include "tree/bvh_plan.h"

namespace slipface::detail {

// Sets boxes, counts, heights and fits_leaf; `first` and `left` must be set anew. The triangles are all of
// one body. No tree becomes deeper than max_depth.
void move_nodes(BinaryNode& top);

}  // namespace slipface::detail
