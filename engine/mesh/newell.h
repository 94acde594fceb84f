#pragma once

#include "slipface/base/types.h"

namespace slipface {

// Newell's sum over a closed polygon of `count` corners, relative to its first corner: twice the area times
// the unit normal. `corner(i)` returns the position of corner i.
template <class Corner>
Vec3 newell_sum(std::size_t count, const Corner& corner) {
    Vec3 sum = Vec3::Zero();
    if (count < 3) return sum;
    const Vec3 origin = corner(0).template cast<double>();
    Vec3 before = corner(1).template cast<double>() - origin;
    for (std::size_t i = 2; i < count; ++i) {
        const Vec3 here = corner(i).template cast<double>() - origin;
        sum += before.cross(here);
        before = here;
    }
    return sum;
}

}  // namespace slipface
