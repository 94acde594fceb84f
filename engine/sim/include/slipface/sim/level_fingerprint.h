// What the runs in a level depend on, as one number.
#pragma once

#include <cstdint>

#include "slipface/level/level.h"
#include "slipface/movement/scene.h"

namespace slipface {

// A hash of all that any run in the level depends on beside its geometry, settings and start: the surface
// types, the type of every face, also of those that move, the platforms at all times, terrain, sectors and
// the fall limit. Parts of one audit, and a search that goes on, must have it in common. `at_first`: the
// level's scene at time 0.
std::uint64_t level_fingerprint(const Level& level, const MovementScene& at_first);

}  // namespace slipface
