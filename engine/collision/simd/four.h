// Four floats side by side, for building the tree and preparing queries. Gives the same bits with and without
// SIMD.
#pragma once

#include <array>
#include <cstdint>

#include "simd/isa.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace slipface::detail {
inline namespace SLIPFACE_ISA {

#if defined(__SSE2__)

struct Four {
    __m128 v;

    static Four all(float value) { return {_mm_set1_ps(value)}; }
    static Four load(const float* from) { return {_mm_loadu_ps(from)}; }
    static Four of(float a, float b, float c) { return {_mm_setr_ps(a, b, c, 0.0F)}; }
    void store(float* to) const { _mm_storeu_ps(to, v); }
    void store_truncated(std::int32_t* to) const {
        _mm_storeu_si128(reinterpret_cast<__m128i*>(to), _mm_cvttps_epi32(v));
    }
    // The first three, which must be at least 0 and fit.
    std::array<std::uint32_t, 3> truncated() const {
        const __m128i whole = _mm_cvttps_epi32(v);
        return {static_cast<std::uint32_t>(_mm_cvtsi128_si32(whole)),
                static_cast<std::uint32_t>(_mm_cvtsi128_si32(_mm_shuffle_epi32(whole, 1))),
                static_cast<std::uint32_t>(_mm_cvtsi128_si32(_mm_shuffle_epi32(whole, 2)))};
    }
    // Sets the fourth to 0.
    Four first_three() const { return {_mm_and_ps(v, _mm_castsi128_ps(_mm_setr_epi32(-1, -1, -1, 0)))}; }
};
inline Four operator+(Four a, Four b) {
    return {_mm_add_ps(a.v, b.v)};
}
inline Four operator-(Four a, Four b) {
    return {_mm_sub_ps(a.v, b.v)};
}
inline Four operator*(Four a, Four b) {
    return {_mm_mul_ps(a.v, b.v)};
}
inline Four operator/(Four a, Four b) {
    return {_mm_div_ps(a.v, b.v)};
}
inline Four four_abs(Four a) {
    return {_mm_andnot_ps(_mm_set1_ps(-0.0F), a.v)};
}
// All bits set where a < b (or a == b), else 0.
inline Four four_less(Four a, Four b) {
    return {_mm_cmplt_ps(a.v, b.v)};
}
inline Four four_equal(Four a, Four b) {
    return {_mm_cmpeq_ps(a.v, b.v)};
}
inline Four four_pick(Four where, Four yes, Four no) {
    return {_mm_or_ps(_mm_and_ps(where.v, yes.v), _mm_andnot_ps(where.v, no.v))};
}
// If one of the two is NaN, the result is the second.
inline Four four_min(Four a, Four b) {
    return {_mm_min_ps(a.v, b.v)};
}
inline Four four_max(Four a, Four b) {
    return {_mm_max_ps(a.v, b.v)};
}
// Returns the first components of the three, then their second, then their third.
inline std::array<Four, 3> transposed(Four a, Four b, Four c) {
    const __m128 low = _mm_unpacklo_ps(a.v, b.v);
    const __m128 high = _mm_unpackhi_ps(a.v, b.v);
    return {Four{_mm_movelh_ps(low, c.v)}, Four{_mm_shuffle_ps(low, c.v, _MM_SHUFFLE(1, 1, 3, 2))},
            Four{_mm_shuffle_ps(high, c.v, _MM_SHUFFLE(2, 2, 1, 0))}};
}

#else

struct Four {
    float v[4];

    static Four all(float value) { return {{value, value, value, value}}; }
    // The fourth component may be any four bytes.
    static Four load(const float* from) { return {{from[0], from[1], from[2], from[3]}}; }
    static Four of(float a, float b, float c) { return {{a, b, c, 0.0F}}; }
    void store(float* to) const {
        for (int k = 0; k < 4; ++k)
            to[k] = v[k];
    }
    void store_truncated(std::int32_t* to) const {
        for (int k = 0; k < 3; ++k)
            to[k] = static_cast<std::int32_t>(v[k]);
    }
    std::array<std::uint32_t, 3> truncated() const {
        return {static_cast<std::uint32_t>(v[0]), static_cast<std::uint32_t>(v[1]),
                static_cast<std::uint32_t>(v[2])};
    }
    Four first_three() const { return {{v[0], v[1], v[2], 0.0F}}; }
};
inline Four operator+(Four a, Four b) {
    return {{a.v[0] + b.v[0], a.v[1] + b.v[1], a.v[2] + b.v[2], 0.0F}};
}
inline Four operator-(Four a, Four b) {
    return {{a.v[0] - b.v[0], a.v[1] - b.v[1], a.v[2] - b.v[2], 0.0F}};
}
inline Four operator*(Four a, Four b) {
    return {{a.v[0] * b.v[0], a.v[1] * b.v[1], a.v[2] * b.v[2], 0.0F}};
}
inline Four operator/(Four a, Four b) {
    return {{a.v[0] / b.v[0], a.v[1] / b.v[1], a.v[2] / b.v[2], 0.0F}};
}
inline Four four_abs(Four a) {
    return {{__builtin_fabsf(a.v[0]), __builtin_fabsf(a.v[1]), __builtin_fabsf(a.v[2]), 0.0F}};
}
// 1 where a < b (or a == b), else 0.
inline Four four_less(Four a, Four b) {
    Four out;
    for (int k = 0; k < 4; ++k)
        out.v[k] = a.v[k] < b.v[k] ? 1.0F : 0.0F;
    return out;
}
inline Four four_equal(Four a, Four b) {
    Four out;
    for (int k = 0; k < 4; ++k)
        out.v[k] = a.v[k] == b.v[k] ? 1.0F : 0.0F;
    return out;
}
inline Four four_pick(Four where, Four yes, Four no) {
    Four out;
    for (int k = 0; k < 4; ++k)
        out.v[k] = where.v[k] != 0.0F ? yes.v[k] : no.v[k];
    return out;
}
inline Four four_min(Four a, Four b) {
    Four out;
    for (int k = 0; k < 4; ++k)
        out.v[k] = a.v[k] < b.v[k] ? a.v[k] : b.v[k];
    return out;
}
inline Four four_max(Four a, Four b) {
    Four out;
    for (int k = 0; k < 4; ++k)
        out.v[k] = a.v[k] > b.v[k] ? a.v[k] : b.v[k];
    return out;
}
inline std::array<Four, 3> transposed(Four a, Four b, Four c) {
    return {Four::of(a.v[0], b.v[0], c.v[0]), Four::of(a.v[1], b.v[1], c.v[1]),
            Four::of(a.v[2], b.v[2], c.v[2])};
}

#endif

}  // namespace SLIPFACE_ISA
}  // namespace slipface::detail
