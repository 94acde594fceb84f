#include "weld.h"

#include <bit>

namespace slipface {
namespace {

// The multiplication carries low bits up and the shift brings them back down. So coordinates on a grid, whose
// low bits are all zero, also spread over the table.
std::size_t hash(const Vec3f& p) {
    std::uint64_t state = 0;
    for (int i = 0; i < 3; ++i) {
        state = (state ^ std::bit_cast<std::uint32_t>(p[i])) * 0x9E3779B97F4A7C15ULL;
        state ^= state >> 32;
    }
    return static_cast<std::size_t>(state);
}

}  // namespace

Welded weld_positions(std::span<const Vec3f> positions) {
    Welded result;
    result.index.reserve(positions.size());
    std::vector<std::uint32_t> slots(std::bit_ceil(2 * positions.size() + 1), no_id);
    const std::size_t mask = slots.size() - 1;
    for (const Vec3f& input : positions) {
        const Vec3f position = input + Vec3f::Zero();  // -0 + 0 is 0
        std::size_t slot = hash(position) & mask;
        while (slots[slot] != no_id && result.positions[slots[slot]] != position)
            slot = (slot + 1) & mask;
        if (slots[slot] == no_id) {
            slots[slot] = static_cast<std::uint32_t>(result.positions.size());
            result.positions.push_back(position);
        }
        result.index.push_back(slots[slot]);
    }
    return result;
}

}  // namespace slipface
