// Converts between the vectors of the public headers and those of the collision code.
#pragma once

#include "simd/vec.h"
#include "slipface/base/types.h"

namespace slipface::detail {

inline V3 v3(const Vec3& v) {
    return {v.x(), v.y(), v.z()};
}
inline Vec3 vec(const V3& v) {
    return {v.x, v.y, v.z};
}

}  // namespace slipface::detail
