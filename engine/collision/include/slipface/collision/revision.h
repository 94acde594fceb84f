// Whether a world is still what it was.
#pragma once

#include <cstdint>

#include "slipface/collision/collision_world.h"

namespace slipface {

// A number that no other world has in this process, and another one after every change: of triangles,
// instances, types of faces or rules. For what is kept between queries; it differs from run to run.
std::uint64_t revision(const CollisionWorld& world);

}  // namespace slipface
