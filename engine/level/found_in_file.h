#pragma once

#include <span>

#include "slipface/level/level.h"

namespace slipface {

// A rule per material, and the surface types that these need. Types beyond max_surface_types and what the
// level has already are left out.
void add_found_types(Level& level, std::span<const FoundType> found);

}  // namespace slipface
