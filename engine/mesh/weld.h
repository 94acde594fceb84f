#pragma once

#include <span>
#include <vector>

#include "slipface/base/types.h"

namespace slipface {

struct Welded {
    std::vector<std::uint32_t> index;  // [input] into positions
    std::vector<Vec3f> positions;      // each once, in the order of first use, -0 as 0
};

// Gives all inputs at exactly the same position one vertex. O(n) expected; fewer than 2^32 - 1 inputs.
Welded weld_positions(std::span<const Vec3f> positions);

}  // namespace slipface
