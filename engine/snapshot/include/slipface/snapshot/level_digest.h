// A level as it was when a golden was approved: geometry and surface types, small enough to lie beside the
// goldens. With it a check can say which faces changed, and walk the old level again.
#pragma once

#include <string>
#include <string_view>

#include "slipface/level/level.h"

namespace slipface {

inline constexpr std::size_t max_digest_triangles = 300'000;  // larger levels have none

// "easy-1f2e3d4c5b6a7988": equal names, equal digests. Of geometry, surface types, platforms and all else
// that the level file says but for painted faces, whose resolved types are counted instead.
std::string digest_name(const Level& level);

// Without texture coordinates. Errors: too many triangles.
Result<std::string> encode_digest(const Level& level);

// The level; its overrides are the resolved types, and `mesh_path` is empty. Every index is checked.
Result<Level> decode_digest(std::string_view bytes, const std::string& location);

}  // namespace slipface
