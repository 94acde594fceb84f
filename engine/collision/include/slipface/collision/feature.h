// The parts of a triangle that can be touched.
#pragma once

#include <cstdint>

namespace slipface {

// The part that is touched first. Of parts touched at the same time, the one that is first in this order
// wins.
enum class Feature : std::uint8_t { interior, edge, vertex };

// "interior", "edge" or "vertex".
const char* feature_name(Feature feature);

}  // namespace slipface
