// Boxes, alone and eight side by side.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "slipface/base/types.h"

namespace slipface::doctor {

inline constexpr std::size_t lanes = 8;
using Lanes = std::array<float, lanes>;
using LaneMask = std::array<std::int32_t, lanes>;  // 0 or 1, as wide as a float: such loops are vectorised

// The lanes of a mask, each a bit.
inline std::uint32_t bits_of(const LaneMask& mask) {
    constexpr std::array<std::int32_t, lanes> bit{1, 2, 4, 8, 16, 32, 64, 128};
    std::int32_t bits = 0;
    for (std::size_t lane = 0; lane < lanes; ++lane)
        bits |= -mask[lane] & bit[lane];
    return static_cast<std::uint32_t>(bits);
}

// Calls visit(lane) for each.
template <class Visit>
void each_bit(std::uint32_t bits, Visit visit) {
    for (; bits != 0; bits &= bits - 1)
        visit(static_cast<std::size_t>(std::countr_zero(bits)));
}

struct Box {
    Vec3f min = Vec3f::Constant(std::numeric_limits<float>::infinity());
    Vec3f max = Vec3f::Constant(-std::numeric_limits<float>::infinity());

    void add(const Vec3f& low, const Vec3f& high) {
        min = min.cwiseMin(low);
        max = max.cwiseMax(high);
    }
    float extent() const { return (max - min).sum(); }  // at least its diagonal
};

// Eight boxes. One that was never set touches nothing.
struct Boxes {
    std::array<Lanes, 3> min, max;

    Boxes();
    void set(std::size_t lane, const Box& box);
    Box at(std::size_t lane) const {
        return {{min[0][lane], min[1][lane], min[2][lane]}, {max[0][lane], max[1][lane], max[2][lane]}};
    }
    LaneMask touching(const Box& box) const {
        const float low[3] = {box.min.x(), box.min.y(), box.min.z()};
        const float high[3] = {box.max.x(), box.max.y(), box.max.z()};
        LaneMask touches;
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            touches[lane] = int{min[0][lane] <= high[0]} & int{min[1][lane] <= high[1]} &
                            int{min[2][lane] <= high[2]} & int{max[0][lane] >= low[0]} &
                            int{max[1][lane] >= low[1]} & int{max[2][lane] >= low[2]};
        }
        return touches;
    }
};

}  // namespace slipface::doctor
