// Eight floats side by side, for tests whose outcome only ever decides what is looked at more closely:
// nothing that a query answers is computed here.
#pragma once

#include <cstdint>

#if defined(__SSE2__)
#include <emmintrin.h>
#else
#include <algorithm>
#endif

namespace slipface::detail {

#if defined(__SSE2__)

struct Lanes {
    __m128 low, high;

    static Lanes all(float value) { return {_mm_set1_ps(value), _mm_set1_ps(value)}; }
    static Lanes load(const float* from) { return {_mm_load_ps(from), _mm_load_ps(from + 4)}; }
    void store(float* to) const {
        _mm_store_ps(to, low);
        _mm_store_ps(to + 4, high);
    }
};
inline Lanes operator+(Lanes a, Lanes b) {
    return {_mm_add_ps(a.low, b.low), _mm_add_ps(a.high, b.high)};
}
inline Lanes operator-(Lanes a, Lanes b) {
    return {_mm_sub_ps(a.low, b.low), _mm_sub_ps(a.high, b.high)};
}
inline Lanes operator*(Lanes a, Lanes b) {
    return {_mm_mul_ps(a.low, b.low), _mm_mul_ps(a.high, b.high)};
}
// Where one of the two is not a number: the second.
inline Lanes lanes_min(Lanes a, Lanes b) {
    return {_mm_min_ps(a.low, b.low), _mm_min_ps(a.high, b.high)};
}
inline Lanes lanes_max(Lanes a, Lanes b) {
    return {_mm_max_ps(a.low, b.low), _mm_max_ps(a.high, b.high)};
}
// Bit k is set where a[k] <= b[k].
inline std::uint32_t lanes_not_above(Lanes a, Lanes b) {
    return static_cast<std::uint32_t>(_mm_movemask_ps(_mm_cmple_ps(a.low, b.low)) |
                                      (_mm_movemask_ps(_mm_cmple_ps(a.high, b.high)) << 4));
}

#else

struct Lanes {
    float value[8];

    static Lanes all(float v) { return {{v, v, v, v, v, v, v, v}}; }
    static Lanes load(const float* from) {
        Lanes out;
        std::copy(from, from + 8, out.value);
        return out;
    }
    void store(float* to) const { std::copy(value, value + 8, to); }
    template <class Function>
    static Lanes each(Function&& function) {
        Lanes out;
        for (int k = 0; k < 8; ++k)
            out.value[k] = function(k);
        return out;
    }
};
inline Lanes operator+(Lanes a, Lanes b) {
    return Lanes::each([&](int k) { return a.value[k] + b.value[k]; });
}
inline Lanes operator-(Lanes a, Lanes b) {
    return Lanes::each([&](int k) { return a.value[k] - b.value[k]; });
}
inline Lanes operator*(Lanes a, Lanes b) {
    return Lanes::each([&](int k) { return a.value[k] * b.value[k]; });
}
inline Lanes lanes_min(Lanes a, Lanes b) {
    return Lanes::each([&](int k) { return a.value[k] < b.value[k] ? a.value[k] : b.value[k]; });
}
inline Lanes lanes_max(Lanes a, Lanes b) {
    return Lanes::each([&](int k) { return a.value[k] > b.value[k] ? a.value[k] : b.value[k]; });
}
inline std::uint32_t lanes_not_above(Lanes a, Lanes b) {
    std::uint32_t mask = 0;
    for (int k = 0; k < 8; ++k)
        mask |= static_cast<std::uint32_t>(a.value[k] <= b.value[k]) << k;
    return mask;
}

#endif

}  // namespace slipface::detail
