// Sorting by position.
#pragma once

#include <cstdint>
#include <span>

#include "slipface/base/types.h"

namespace slipface::doctor {

struct NearItem {
    std::uint32_t key;  // for sort_near
    std::uint32_t id;
};

// Ten bits of each coordinate in turns, of whole numbers up to 1023: what has consecutive ones is near each
// other.
std::uint32_t interleaved(const Vec3f& cell);

// Puts items that are near each other together: [id] `centre`, metres. `spare` has room for as many.
void sort_near(std::span<NearItem> items, std::span<NearItem> spare, std::span<const Vec3f> centre);

}  // namespace slipface::doctor
