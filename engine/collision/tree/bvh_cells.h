// The first splits of a large level divide whole cells of a grid, a few triangles each, instead of single
// triangles. The planes available to them lie close together in any case. Construction becomes a quarter
// faster, and queries no slower.
#pragma once

#include <span>
#include <vector>

#include "tree/bvh_items.h"

namespace slipface::detail {

inline constexpr std::size_t cells_worth_it = 64;

// Copies the items, in the order of the cells of a grid, to `sorted` (same size) and returns the cells that
// are not empty, each with the index of its first item in `sorted`. Returns none if they would be fewer than
// cells_worth_it; the contents of `sorted` are then undefined. `centres`: the box of the items' centres.
std::vector<Cell> sort_into_cells(std::span<const Item> items, const Box& centres, std::span<Item> sorted);

}  // namespace slipface::detail
