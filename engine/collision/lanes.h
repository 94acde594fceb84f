// Eight floats side by side, for tests whose outcome only ever decides what is looked at more closely:
// nothing that a query answers is computed here.
#pragma once

#include <cstdint>

#if defined(__SSE2__)
#include <emmintrin.h>
#else
#include <algorithm>
#include <cmath>
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
// Nine floats from each of eight places, turned into nine times eight.
inline void lanes_gather9(const float* const (&from)[8], Lanes (&to)[9]) {
    const auto four = [&from](int k, __m128(&out)[9]) {
        for (int part = 0; part < 2; ++part) {
            __m128 a = _mm_loadu_ps(from[k] + 4 * part);
            __m128 b = _mm_loadu_ps(from[k + 1] + 4 * part);
            __m128 c = _mm_loadu_ps(from[k + 2] + 4 * part);
            __m128 d = _mm_loadu_ps(from[k + 3] + 4 * part);
            _MM_TRANSPOSE4_PS(a, b, c, d);
            out[4 * part] = a;
            out[4 * part + 1] = b;
            out[4 * part + 2] = c;
            out[4 * part + 3] = d;
        }
        out[8] = _mm_setr_ps(from[k][8], from[k + 1][8], from[k + 2][8], from[k + 3][8]);
    };
    __m128 low[9];
    __m128 high[9];
    four(0, low);
    four(4, high);
    for (int i = 0; i < 9; ++i)
        to[i] = {low[i], high[i]};
}
// Where one of the two is not a number: the second.
inline Lanes lanes_min(Lanes a, Lanes b) {
    return {_mm_min_ps(a.low, b.low), _mm_min_ps(a.high, b.high)};
}
inline Lanes lanes_max(Lanes a, Lanes b) {
    return {_mm_max_ps(a.low, b.low), _mm_max_ps(a.high, b.high)};
}
inline Lanes lanes_abs(Lanes a) {
    const __m128 sign = _mm_set1_ps(-0.0F);
    return {_mm_andnot_ps(sign, a.low), _mm_andnot_ps(sign, a.high)};
}
inline Lanes lanes_sqrt(Lanes a) {
    return {_mm_sqrt_ps(a.low), _mm_sqrt_ps(a.high)};
}
// Bit k is set where a[k] <= b[k].
inline std::uint32_t lanes_not_above(Lanes a, Lanes b) {
    return static_cast<std::uint32_t>(_mm_movemask_ps(_mm_cmple_ps(a.low, b.low)) |
                                      (_mm_movemask_ps(_mm_cmple_ps(a.high, b.high)) << 4));
}

// Bit k is set where a[k] > b[k]; not where one of them is no number.
inline std::uint32_t lanes_above(Lanes a, Lanes b) {
    return static_cast<std::uint32_t>(_mm_movemask_ps(_mm_cmpgt_ps(a.low, b.low)) |
                                      (_mm_movemask_ps(_mm_cmpgt_ps(a.high, b.high)) << 4));
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
inline Lanes lanes_abs(Lanes a) {
    return Lanes::each([&](int k) { return std::fabs(a.value[k]); });
}
inline Lanes lanes_sqrt(Lanes a) {
    return Lanes::each([&](int k) { return std::sqrt(a.value[k]); });
}
inline void lanes_gather9(const float* const (&from)[8], Lanes (&to)[9]) {
    for (int i = 0; i < 9; ++i)
        to[i] = Lanes::each([&](int k) { return from[k][i]; });
}
inline std::uint32_t lanes_not_above(Lanes a, Lanes b) {
    std::uint32_t mask = 0;
    for (int k = 0; k < 8; ++k)
        mask |= static_cast<std::uint32_t>(a.value[k] <= b.value[k]) << k;
    return mask;
}

#endif

}  // namespace slipface::detail
