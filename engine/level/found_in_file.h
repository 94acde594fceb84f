#pragma once

#include <span>

#include "slipface/level/level.h"

namespace slipface {

// Adds a rule for each found material, and the surface types that these rules use. Rules and types that the
// level already has are not added, nor are types beyond max_surface_types and their rules.
void add_found_types(Level& level, std::span<const FoundType> found);

}  // namespace slipface
