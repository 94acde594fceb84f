// The undrawn walls of a Quake 3 map, which stop a player: sides of clip, caulk and sky brushes.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bsp/bsp_entities.h"
#include "bsp/bsp_file.h"
#include "convex_polygon.h"
#include "slipface/base/progress.h"

namespace slipface {

// A drawn triangle that stops the player; counter-clockwise seen from its front, in coordinates of the map.
using BspTriangle = std::array<Vec3, 3>;

struct BspWall {
    ConvexPolygon corners;
    std::size_t texture = 0;
};

// Returns the parts of the sides of solid and playerclip brushes that face open space and are not covered by
// a drawn triangle. A part does not count if it lies in another such brush, or in a leaf of the tree that is
// solid or outside of a sealed map. `models`: the moving parts of the entities. Errors: indices out of range,
// and brushes that overlap so often that the work would have no bound.
struct BspModel {
    std::size_t number = 0;  // in the lump of models
    Vec3 origin = Vec3::Zero();
};
Result<std::vector<BspWall>> undrawn_walls(const BspFile& file, std::span<const BspModel> models,
                                           std::span<const BspTriangle> drawn, const std::string& location,
                                           Progress* progress);

}  // namespace slipface
