// Eight floats side by side, for tests that only decide which triangles are examined more closely. No result
// of a query is computed here.
//
// Each file that includes this may be compiled for another instruction set. So all of it has internal linkage
// and calls no function that another file could share.
#pragma once

#include "tree/leaf.h"

#if defined(__AVX2__)
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace slipface::detail {
namespace {

#if defined(__AVX2__)

struct Lanes {
    __m256 v;

    static Lanes all(float value) { return {_mm256_set1_ps(value)}; }
    static Lanes load(const float* from) { return {_mm256_loadu_ps(from)}; }
    void store(float* to) const { _mm256_storeu_ps(to, v); }
};
using LaneMask = Lanes;
inline Lanes operator+(Lanes a, Lanes b) {
    return {_mm256_add_ps(a.v, b.v)};
}
inline Lanes operator-(Lanes a, Lanes b) {
    return {_mm256_sub_ps(a.v, b.v)};
}
inline Lanes operator*(Lanes a, Lanes b) {
    return {_mm256_mul_ps(a.v, b.v)};
}
inline Lanes operator/(Lanes a, Lanes b) {
    return {_mm256_div_ps(a.v, b.v)};
}
// a b + c and a b - c, with one rounding or two.
inline Lanes lanes_product_plus(Lanes a, Lanes b, Lanes c) {
    return {_mm256_fmadd_ps(a.v, b.v, c.v)};
}
inline Lanes lanes_product_minus(Lanes a, Lanes b, Lanes c) {
    return {_mm256_fmsub_ps(a.v, b.v, c.v)};
}
// If one of the two is NaN, the result is the second.
inline Lanes lanes_min(Lanes a, Lanes b) {
    return {_mm256_min_ps(a.v, b.v)};
}
inline Lanes lanes_max(Lanes a, Lanes b) {
    return {_mm256_max_ps(a.v, b.v)};
}
inline Lanes lanes_abs(Lanes a) {
    return {_mm256_andnot_ps(_mm256_set1_ps(-0.0F), a.v)};
}
inline Lanes lanes_sqrt(Lanes a) {
    return {_mm256_sqrt_ps(a.v)};
}
inline LaneMask lanes_less(Lanes a, Lanes b) {
    return {_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ)};
}
inline Lanes lanes_pick(LaneMask where, Lanes yes, Lanes no) {
    return {_mm256_blendv_ps(no.v, yes.v, where.v)};
}
// Bit k is set where a[k] <= b[k].
inline std::uint32_t lanes_not_above(Lanes a, Lanes b) {
    return static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ)));
}
// Bit k is set where a[k] > b[k]; not where one of them is NaN.
inline std::uint32_t lanes_above(Lanes a, Lanes b) {
    return static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_cmp_ps(a.v, b.v, _CMP_GT_OQ)));
}

// Bit k is set where child k is a leaf.
inline std::uint32_t leaf_children(const BvhNode& node) {
    static_assert(leaf_bit == 0x80000000U);
    return static_cast<std::uint32_t>(
        _mm256_movemask_ps(_mm256_load_ps(reinterpret_cast<const float*>(node.child))));
}

inline __m256i lane_vertices(const std::uint8_t* corner) {
    return _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(corner)));
}

// table[index] for a table of 8, 16 or 24 floats; bits 3 and 4 of the index select the part.
template <int Parts>
inline Lanes look_up(const float* table, __m256i index) {
    const __m256 first = _mm256_loadu_ps(table);
    if constexpr (Parts == 1) return {_mm256_permutevar8x32_ps(first, index)};
#if defined(__AVX512VL__)
    const __m256 two = _mm256_permutex2var_ps(first, index, _mm256_loadu_ps(table + 8));
    if constexpr (Parts == 2) return {two};
    const __mmask8 beyond = _mm256_test_epi32_mask(index, _mm256_set1_epi32(16));
    return {_mm256_mask_permutexvar_ps(two, beyond, index, _mm256_loadu_ps(table + 16))};
#else
    const __m256 bit3 = _mm256_castsi256_ps(_mm256_slli_epi32(index, 28));
    const __m256 two = _mm256_blendv_ps(_mm256_permutevar8x32_ps(first, index),
                                        _mm256_permutevar8x32_ps(_mm256_loadu_ps(table + 8), index), bit3);
    if constexpr (Parts == 2) return {two};
    const __m256 bit4 = _mm256_castsi256_ps(_mm256_slli_epi32(index, 27));
    return {_mm256_blendv_ps(two, _mm256_permutevar8x32_ps(_mm256_loadu_ps(table + 16), index), bit4)};
#endif
}

template <int Parts>
inline void look_up_leaf(const Leaf& leaf, Lanes (&to)[9]) {
    const float* values = leaf_values(leaf);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        // Only the lowest bits of an index count, so nothing needs to be cleared above them.
        const __m256i corners = _mm256_cvtepu16_epi32(
            _mm_loadu_si128(reinterpret_cast<const __m128i*>(leaf_corners(leaf, axis))));
        to[axis] = look_up<Parts>(values, corners);
        to[3 + axis] = look_up<Parts>(values, _mm256_srli_epi32(corners, 5));
        to[6 + axis] = look_up<Parts>(values, _mm256_srli_epi32(corners, 10));
        values += leaf.values[axis];
    }
}

// x, y, z of the three corners of a leaf's triangles.
inline void lanes_of_leaf(const Leaf& leaf, Lanes (&to)[9]) {
    // All three axes at once: adding 15 sets bit 5 for 17 to 24 values, adding 7 bit 4 for 9 to 24.
    std::uint32_t values;
    __builtin_memcpy(&values, leaf.values, sizeof values);
    values &= 0xffffffU;
#if !defined(__AVX512VL__)  // there, two parts cost no more than one
    if (((values + 0x070707U) & 0x101010U) == 0) return look_up_leaf<1>(leaf, to);
#endif
    if (((values + 0x0f0f0fU) & 0x202020U) == 0) return look_up_leaf<2>(leaf, to);
    look_up_leaf<3>(leaf, to);
}

#else

inline std::uint32_t leaf_children(const BvhNode& node) {
    std::uint32_t mask = 0;
    for (int k = 0; k < 8; ++k)
        mask |= (node.child[k] / leaf_bit) << k;
    return mask;
}

#if defined(__SSE2__)

struct Lanes {
    __m128 low, high;

    static Lanes all(float value) { return {_mm_set1_ps(value), _mm_set1_ps(value)}; }
    static Lanes load(const float* from) { return {_mm_loadu_ps(from), _mm_loadu_ps(from + 4)}; }
    void store(float* to) const {
        _mm_storeu_ps(to, low);
        _mm_storeu_ps(to + 4, high);
    }
};
using LaneMask = Lanes;
inline Lanes operator+(Lanes a, Lanes b) {
    return {_mm_add_ps(a.low, b.low), _mm_add_ps(a.high, b.high)};
}
inline Lanes operator-(Lanes a, Lanes b) {
    return {_mm_sub_ps(a.low, b.low), _mm_sub_ps(a.high, b.high)};
}
inline Lanes operator*(Lanes a, Lanes b) {
    return {_mm_mul_ps(a.low, b.low), _mm_mul_ps(a.high, b.high)};
}
inline Lanes operator/(Lanes a, Lanes b) {
    return {_mm_div_ps(a.low, b.low), _mm_div_ps(a.high, b.high)};
}
// If one of the two is NaN, the result is the second.
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
inline LaneMask lanes_less(Lanes a, Lanes b) {
    return {_mm_cmplt_ps(a.low, b.low), _mm_cmplt_ps(a.high, b.high)};
}
inline Lanes lanes_pick(LaneMask where, Lanes yes, Lanes no) {
    const auto pick = [](__m128 m, __m128 y, __m128 n) {
        return _mm_or_ps(_mm_and_ps(m, y), _mm_andnot_ps(m, n));
    };
    return {pick(where.low, yes.low, no.low), pick(where.high, yes.high, no.high)};
}
// Bit k is set where a[k] <= b[k].
inline std::uint32_t lanes_not_above(Lanes a, Lanes b) {
    return static_cast<std::uint32_t>(_mm_movemask_ps(_mm_cmple_ps(a.low, b.low)) |
                                      (_mm_movemask_ps(_mm_cmple_ps(a.high, b.high)) << 4));
}
// Bit k is set where a[k] > b[k]; not where one of them is NaN.
inline std::uint32_t lanes_above(Lanes a, Lanes b) {
    return static_cast<std::uint32_t>(_mm_movemask_ps(_mm_cmpgt_ps(a.low, b.low)) |
                                      (_mm_movemask_ps(_mm_cmpgt_ps(a.high, b.high)) << 4));
}

#else

struct Lanes {
    float value[8];

    static Lanes all(float v) { return {{v, v, v, v, v, v, v, v}}; }
    static Lanes load(const float* from) {
        return each([&](int k) { return from[k]; });
    }
    void store(float* to) const {
        for (int k = 0; k < 8; ++k)
            to[k] = value[k];
    }
    template <class Function>
    static Lanes each(Function&& function) {
        Lanes out;
        for (int k = 0; k < 8; ++k)
            out.value[k] = function(k);
        return out;
    }
};
struct LaneMask {
    bool value[8];
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
inline Lanes operator/(Lanes a, Lanes b) {
    return Lanes::each([&](int k) { return a.value[k] / b.value[k]; });
}
inline Lanes lanes_min(Lanes a, Lanes b) {
    return Lanes::each([&](int k) { return a.value[k] < b.value[k] ? a.value[k] : b.value[k]; });
}
inline Lanes lanes_max(Lanes a, Lanes b) {
    return Lanes::each([&](int k) { return a.value[k] > b.value[k] ? a.value[k] : b.value[k]; });
}
inline Lanes lanes_abs(Lanes a) {
    return Lanes::each([&](int k) { return __builtin_fabsf(a.value[k]); });
}
inline Lanes lanes_sqrt(Lanes a) {
    return Lanes::each([&](int k) { return __builtin_sqrtf(a.value[k]); });
}
inline LaneMask lanes_less(Lanes a, Lanes b) {
    LaneMask mask;
    for (int k = 0; k < 8; ++k)
        mask.value[k] = a.value[k] < b.value[k];
    return mask;
}
inline Lanes lanes_pick(LaneMask where, Lanes yes, Lanes no) {
    return Lanes::each([&](int k) { return where.value[k] ? yes.value[k] : no.value[k]; });
}
inline std::uint32_t lanes_not_above(Lanes a, Lanes b) {
    std::uint32_t mask = 0;
    for (int k = 0; k < 8; ++k)
        mask |= static_cast<std::uint32_t>(a.value[k] <= b.value[k]) << k;
    return mask;
}
inline std::uint32_t lanes_above(Lanes a, Lanes b) {
    return lanes_not_above(a, a) & lanes_not_above(b, b) & ~lanes_not_above(a, b);
}

#endif

inline Lanes lanes_product_plus(Lanes a, Lanes b, Lanes c) {
    return a * b + c;
}
inline Lanes lanes_product_minus(Lanes a, Lanes b, Lanes c) {
    return a * b - c;
}

// x, y, z of the three corners of a leaf's triangles.
inline void lanes_of_leaf(const Leaf& leaf, Lanes (&to)[9]) {
    const float* values = leaf_values(leaf);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::uint16_t* corners = leaf_corners(leaf, axis);
        for (std::size_t k = 0; k < 3; ++k) {
            const auto at = [&](int lane) { return values[corner_of(corners[lane], k)]; };
#if defined(__SSE2__)
            to[3 * k + axis] = {_mm_setr_ps(at(0), at(1), at(2), at(3)),
                                _mm_setr_ps(at(4), at(5), at(6), at(7))};
#else
            to[3 * k + axis] = Lanes::each(at);
#endif
        }
        values += leaf.values[axis];
    }
}

#endif

#if !defined(__AVX512VL__)
// [mask] the lanes of the mask, then any.
struct LanesOfMasks {
    alignas(64) std::uint8_t lane[256][8] = {};
    std::uint8_t count[256] = {};
};
inline constexpr LanesOfMasks lanes_of_masks = [] {
    LanesOfMasks table;
    for (int mask = 0; mask < 256; ++mask) {
        int count = 0;
        for (int lane = 0; lane < 8; ++lane)
            if ((mask >> lane & 1) != 0) table.lane[mask][count++] = static_cast<std::uint8_t>(lane);
        table.count[mask] = static_cast<std::uint8_t>(count);
    }
    return table;
}();
// Writes the lanes of `mask`, and then any, to `to`: four or eight, because a loop over the lanes that are
// set ends where no processor predicts.
template <class T>
inline void copy_lanes(const T* from, std::uint32_t mask, T* to) {
    const std::uint8_t* lane = lanes_of_masks.lane[mask];
    for (int k = 0; k < 4; ++k)
        to[k] = from[lane[k]];
    if (lane[4] == 0) return;
    for (int k = 4; k < 8; ++k)
        to[k] = from[lane[k]];
}
#endif

// Of a mask that has at least one.
inline unsigned first_lane(std::uint32_t mask) {
    return static_cast<unsigned>(__builtin_ctz(mask));
}

// The lane of the mask with the least key; of keys that differ in their last three bits, any. The mask has at
// least one lane, and no key is below 0.
inline unsigned least_lane(std::uint32_t mask, Lanes keys) {
#if defined(__AVX2__)
    // Floats of one sign are ordered like their bits. Without branches, which would be hard to predict.
    const __m256i all = _mm256_set1_epi32(-1);
    const __m256i key = _mm256_andnot_si256(_mm256_set1_epi32(7), _mm256_castps_si256(keys.v));
    const __m256i key_and_lane = _mm256_or_si256(key, _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
#if defined(__AVX512VL__)
    const __m256i among = _mm256_mask_mov_epi32(all, static_cast<__mmask8>(mask), key_and_lane);
#else
    const __m256i bit = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
    const __m256i bits = _mm256_and_si256(_mm256_set1_epi32(static_cast<int>(mask)), bit);
    const __m256i among = _mm256_blendv_epi8(all, key_and_lane, _mm256_cmpeq_epi32(bits, bit));
#endif
    __m128i least = _mm_min_epu32(_mm256_castsi256_si128(among), _mm256_extracti128_si256(among, 1));
    least = _mm_min_epu32(least, _mm_shuffle_epi32(least, 0x4E));
    least = _mm_min_epu32(least, _mm_shuffle_epi32(least, 0xB1));
    return static_cast<unsigned>(_mm_cvtsi128_si32(least)) & 7U;
#else
    alignas(32) float key[8];
    keys.store(key);
    unsigned best = first_lane(mask);
    for (mask &= mask - 1; mask != 0; mask &= mask - 1) {
        const unsigned lane = first_lane(mask);
        if (key[lane] < key[best]) best = lane;
    }
    return best;
#endif
}

inline std::uint32_t lane_count(std::uint32_t mask) {
#if defined(__POPCNT__)
    return static_cast<std::uint32_t>(__builtin_popcount(mask));
#else
    return lanes_of_masks.count[mask];
#endif
}

// Appends the children of `mask` to a list of `size` entries that has room for eight more; returns the new
// size.
inline std::uint32_t append_children(const BvhNode& node, std::uint32_t mask, std::uint32_t* list,
                                     std::uint32_t size) {
#if defined(__AVX512VL__)
    const __m256i children = _mm256_load_si256(reinterpret_cast<const __m256i*>(node.child));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(list + size),
                        _mm256_maskz_compress_epi32(static_cast<__mmask8>(mask), children));
    return size + lane_count(mask);
#elif defined(__AVX2__)
    const __m256i children = _mm256_load_si256(reinterpret_cast<const __m256i*>(node.child));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(list + size),
                        _mm256_permutevar8x32_epi32(children, lane_vertices(lanes_of_masks.lane[mask])));
    return size + lane_count(mask);
#else
    copy_lanes(node.child, mask, list + size);
    return size + lane_count(mask);
#endif
}

// Writes the lanes of `mask` to `to`, which has room for eight.
inline void append(Lanes lanes, std::uint32_t mask, float* to) {
#if defined(__AVX512VL__)
    _mm256_storeu_ps(to, _mm256_maskz_compress_ps(static_cast<__mmask8>(mask), lanes.v));
#elif defined(__AVX2__)
    _mm256_storeu_ps(to, _mm256_permutevar8x32_ps(lanes.v, lane_vertices(lanes_of_masks.lane[mask])));
#else
    float all[8];
    lanes.store(all);
    copy_lanes(all, mask, to);
#endif
}
inline void append(const std::uint32_t* numbers, std::uint32_t mask, std::uint32_t* to) {
#if defined(__AVX512VL__)
    const __m256i all = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(numbers));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to),
                        _mm256_maskz_compress_epi32(static_cast<__mmask8>(mask), all));
#elif defined(__AVX2__)
    const __m256i all = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(numbers));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to),
                        _mm256_permutevar8x32_epi32(all, lane_vertices(lanes_of_masks.lane[mask])));
#else
    copy_lanes(numbers, mask, to);
#endif
}

// Writes the numbers of a leaf's triangles, those of `mask`, to `to`, which has room for eight.
inline void append_ids(const Leaf& leaf, std::uint32_t mask, std::uint32_t* to) {
    alignas(32) std::uint32_t ids[leaf_capacity];
#if defined(__AVX2__)
    // [width] the bytes of four numbers; 128: 0.
    alignas(16) static constexpr std::uint8_t bytes[3][16] = {
        {0, 128, 128, 128, 1, 128, 128, 128, 2, 128, 128, 128, 3, 128, 128, 128},
        {0, 1, 128, 128, 2, 3, 128, 128, 4, 5, 128, 128, 6, 7, 128, 128},
        {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15}};
    const std::uint32_t width = leaf_width(leaf);
    const std::byte* offsets = leaf_offsets(leaf);
    const __m128i spread = _mm_load_si128(reinterpret_cast<const __m128i*>(bytes[width]));
    const auto four = [&](std::size_t at) {
        return _mm_add_epi32(
            _mm_shuffle_epi8(_mm_loadu_si128(reinterpret_cast<const __m128i*>(offsets + at)), spread),
            _mm_set1_epi32(static_cast<int>(leaf.first_id)));
    };
    const __m128i low = four(0), high = four(std::size_t{4} << width);
    _mm256_store_si256(reinterpret_cast<__m256i*>(ids), _mm256_set_m128i(high, low));
#else
    for (std::size_t lane = 0; lane < leaf_capacity; ++lane)
        ids[lane] = leaf_id(leaf, lane);
#endif
    append(ids, mask, to);
}

}  // namespace
}  // namespace slipface::detail
