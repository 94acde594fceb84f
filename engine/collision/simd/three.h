// One operation on the values of all three axes, corners or edges. The fourth component is unused. Every
// operation rounds as the scalar one does, so SIMD changes no bit.
#pragma once

#include "simd/four.h"
#include "simd/vec.h"

#if defined(__AVX2__)
#include <immintrin.h>
#endif

namespace slipface::detail {
inline namespace SLIPFACE_ISA {

#if defined(__AVX2__)

struct Three {
    __m256d v;

    explicit Three(const V3& from) : v(_mm256_setr_pd(from.x, from.y, from.z, 1.0)) {}
    explicit Three(__m256d value) : v(value) {}
    static Three all(double value) { return Three(_mm256_set1_pd(value)); }
    explicit Three(Four from) : v(_mm256_cvtps_pd(from.v)) {}
    Four rounded() const { return {_mm256_cvtpd_ps(v)}; }
    Three abs() const { return Three(_mm256_andnot_pd(_mm256_set1_pd(-0.0), v)); }
    Three sqrt() const { return Three(_mm256_sqrt_pd(v)); }
    Three next() const { return Three(_mm256_permute4x64_pd(v, 0xC9)); }
    double sum() const {
        const __m128d xy = _mm256_castpd256_pd128(v);
        return _mm_cvtsd_f64(xy) + _mm_cvtsd_f64(_mm_unpackhi_pd(xy, xy)) +
               _mm_cvtsd_f64(_mm256_extractf128_pd(v, 1));
    }
    V3 vec() const {
        const __m128d xy = _mm256_castpd256_pd128(v);
        return {_mm_cvtsd_f64(xy), _mm_cvtsd_f64(_mm_unpackhi_pd(xy, xy)),
                _mm_cvtsd_f64(_mm256_extractf128_pd(v, 1))};
    }
    void store(double (&to)[4]) const { _mm256_storeu_pd(to, v); }
};
inline Three operator+(const Three& a, const Three& b) {
    return Three(_mm256_add_pd(a.v, b.v));
}
inline Three operator-(const Three& a, const Three& b) {
    return Three(_mm256_sub_pd(a.v, b.v));
}
inline Three operator-(const Three& a) {
    return Three(_mm256_xor_pd(a.v, _mm256_set1_pd(-0.0)));
}
inline Three operator*(const Three& a, const Three& b) {
    return Three(_mm256_mul_pd(a.v, b.v));
}
inline Three operator/(const Three& a, const Three& b) {
    return Three(_mm256_div_pd(a.v, b.v));
}
inline Three three_min(const Three& a, const Three& b) {
    return Three(_mm256_min_pd(a.v, b.v));
}
inline Three three_max(const Three& a, const Three& b) {
    return Three(_mm256_max_pd(a.v, b.v));
}
struct ThreeMask {
    __m256d v;
    unsigned bits() const { return static_cast<unsigned>(_mm256_movemask_pd(v)) & 7U; }
};
inline ThreeMask three_less(const Three& a, const Three& b) {
    return {_mm256_cmp_pd(a.v, b.v, _CMP_LT_OS)};
}
inline ThreeMask three_not_above(const Three& a, const Three& b) {
    return {_mm256_cmp_pd(a.v, b.v, _CMP_LE_OS)};
}
inline ThreeMask three_equal(const Three& a, const Three& b) {
    return {_mm256_cmp_pd(a.v, b.v, _CMP_EQ_OQ)};
}
inline ThreeMask operator&(const ThreeMask& a, const ThreeMask& b) {
    return {_mm256_and_pd(a.v, b.v)};
}
inline ThreeMask operator|(const ThreeMask& a, const ThreeMask& b) {
    return {_mm256_or_pd(a.v, b.v)};
}
inline Three three_pick(const ThreeMask& where, const Three& yes, const Three& no) {
    return Three(_mm256_blendv_pd(no.v, yes.v, where.v));
}

#elif defined(__SSE2__)

struct Three {
    __m128d xy, zw;

    explicit Three(const V3& v) : xy(_mm_setr_pd(v.x, v.y)), zw(_mm_setr_pd(v.z, 1.0)) {}
    Three(__m128d first, __m128d second) : xy(first), zw(second) {}
    static Three all(double value) { return {_mm_set1_pd(value), _mm_set1_pd(value)}; }
    explicit Three(Four v) : xy(_mm_cvtps_pd(v.v)), zw(_mm_cvtps_pd(_mm_movehl_ps(v.v, v.v))) {}
    Four rounded() const { return {_mm_movelh_ps(_mm_cvtpd_ps(xy), _mm_cvtpd_ps(zw))}; }
    Three abs() const {
        const __m128d sign = _mm_set1_pd(-0.0);
        return {_mm_andnot_pd(sign, xy), _mm_andnot_pd(sign, zw)};
    }
    Three sqrt() const { return {_mm_sqrt_pd(xy), _mm_sqrt_pd(zw)}; }
    // The second, the third and the first.
    Three next() const { return {_mm_shuffle_pd(xy, zw, 1), xy}; }
    double sum() const {
        return _mm_cvtsd_f64(xy) + _mm_cvtsd_f64(_mm_unpackhi_pd(xy, xy)) + _mm_cvtsd_f64(zw);
    }
    V3 vec() const { return {_mm_cvtsd_f64(xy), _mm_cvtsd_f64(_mm_unpackhi_pd(xy, xy)), _mm_cvtsd_f64(zw)}; }
    void store(double (&to)[4]) const {
        _mm_storeu_pd(to, xy);
        _mm_storeu_pd(to + 2, zw);
    }
};
inline Three operator+(const Three& a, const Three& b) {
    return {_mm_add_pd(a.xy, b.xy), _mm_add_pd(a.zw, b.zw)};
}
inline Three operator-(const Three& a, const Three& b) {
    return {_mm_sub_pd(a.xy, b.xy), _mm_sub_pd(a.zw, b.zw)};
}
inline Three operator-(const Three& a) {
    const __m128d sign = _mm_set1_pd(-0.0);
    return {_mm_xor_pd(a.xy, sign), _mm_xor_pd(a.zw, sign)};
}
inline Three operator*(const Three& a, const Three& b) {
    return {_mm_mul_pd(a.xy, b.xy), _mm_mul_pd(a.zw, b.zw)};
}
inline Three operator/(const Three& a, const Three& b) {
    return {_mm_div_pd(a.xy, b.xy), _mm_div_pd(a.zw, b.zw)};
}
// If one of the two is NaN, the result is the second.
inline Three three_min(const Three& a, const Three& b) {
    return {_mm_min_pd(a.xy, b.xy), _mm_min_pd(a.zw, b.zw)};
}
inline Three three_max(const Three& a, const Three& b) {
    return {_mm_max_pd(a.xy, b.xy), _mm_max_pd(a.zw, b.zw)};
}

// A truth value for each of the three.
struct ThreeMask {
    __m128d xy, zw;

    unsigned bits() const {
        return static_cast<unsigned>(_mm_movemask_pd(xy) | ((_mm_movemask_pd(zw) & 1) << 2));
    }
};
inline ThreeMask three_less(const Three& a, const Three& b) {
    return {_mm_cmplt_pd(a.xy, b.xy), _mm_cmplt_pd(a.zw, b.zw)};
}
inline ThreeMask three_not_above(const Three& a, const Three& b) {
    return {_mm_cmple_pd(a.xy, b.xy), _mm_cmple_pd(a.zw, b.zw)};
}
inline ThreeMask three_equal(const Three& a, const Three& b) {
    return {_mm_cmpeq_pd(a.xy, b.xy), _mm_cmpeq_pd(a.zw, b.zw)};
}
inline ThreeMask operator&(const ThreeMask& a, const ThreeMask& b) {
    return {_mm_and_pd(a.xy, b.xy), _mm_and_pd(a.zw, b.zw)};
}
inline ThreeMask operator|(const ThreeMask& a, const ThreeMask& b) {
    return {_mm_or_pd(a.xy, b.xy), _mm_or_pd(a.zw, b.zw)};
}
inline Three three_pick(const ThreeMask& where, const Three& yes, const Three& no) {
    return {_mm_or_pd(_mm_and_pd(where.xy, yes.xy), _mm_andnot_pd(where.xy, no.xy)),
            _mm_or_pd(_mm_and_pd(where.zw, yes.zw), _mm_andnot_pd(where.zw, no.zw))};
}

#else

struct Three {
    V3 v;

    explicit Three(const V3& from) : v(from) {}
    explicit Three(Four from) : v{double{from.v[0]}, double{from.v[1]}, double{from.v[2]}} {}
    static Three all(double value) { return Three(V3{value, value, value}); }
    Four rounded() const {
        return {{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), 1.0F}};
    }
    Three abs() const { return Three(V3{std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}); }
    Three sqrt() const { return Three(V3{std::sqrt(v.x), std::sqrt(v.y), std::sqrt(v.z)}); }
    Three next() const { return Three(V3{v.y, v.z, v.x}); }
    double sum() const { return v.x + v.y + v.z; }
    V3 vec() const { return v; }
    void store(double (&to)[4]) const {
        to[0] = v.x;
        to[1] = v.y;
        to[2] = v.z;
        to[3] = 0.0;
    }
};
inline Three operator+(const Three& a, const Three& b) {
    return Three(a.v + b.v);
}
inline Three operator-(const Three& a, const Three& b) {
    return Three(a.v - b.v);
}
inline Three operator-(const Three& a) {
    return Three(-a.v);
}
inline Three operator*(const Three& a, const Three& b) {
    return Three(mul(a.v, b.v));
}
inline Three operator/(const Three& a, const Three& b) {
    return Three(V3{a.v.x / b.v.x, a.v.y / b.v.y, a.v.z / b.v.z});
}
inline Three three_min(const Three& a, const Three& b) {
    const auto least = [](double l, double r) { return l < r ? l : r; };
    return Three(V3{least(a.v.x, b.v.x), least(a.v.y, b.v.y), least(a.v.z, b.v.z)});
}
inline Three three_max(const Three& a, const Three& b) {
    return Three(V3{larger(a.v.x, b.v.x), larger(a.v.y, b.v.y), larger(a.v.z, b.v.z)});
}

struct ThreeMask {
    bool x, y, z;

    unsigned bits() const { return (x ? 1U : 0U) | (y ? 2U : 0U) | (z ? 4U : 0U); }
};
inline ThreeMask three_less(const Three& a, const Three& b) {
    return {a.v.x < b.v.x, a.v.y < b.v.y, a.v.z < b.v.z};
}
inline ThreeMask three_not_above(const Three& a, const Three& b) {
    return {a.v.x <= b.v.x, a.v.y <= b.v.y, a.v.z <= b.v.z};
}
inline ThreeMask three_equal(const Three& a, const Three& b) {
    return {a.v.x == b.v.x, a.v.y == b.v.y, a.v.z == b.v.z};
}
inline ThreeMask operator&(const ThreeMask& a, const ThreeMask& b) {
    return {a.x && b.x, a.y && b.y, a.z && b.z};
}
inline ThreeMask operator|(const ThreeMask& a, const ThreeMask& b) {
    return {a.x || b.x, a.y || b.y, a.z || b.z};
}
inline Three three_pick(const ThreeMask& where, const Three& yes, const Three& no) {
    return Three(V3{where.x ? yes.v.x : no.v.x, where.y ? yes.v.y : no.v.y, where.z ? yes.v.z : no.v.z});
}

#endif

// True if a < b on at least one axis.
inline bool any_less(const Three& a, const Three& b) {
    return three_less(a, b).bits() != 0;
}

// The number of the lowest bit that is set.
inline int first_bit(unsigned bits) {
    return __builtin_ctz(bits);
}

// The least or largest of the three, three times.
inline Three least_of(const Three& a) {
    return three_min(three_min(a, a.next()), a.next().next());
}
inline Three largest_of(const Three& a) {
    return three_max(three_max(a, a.next()), a.next().next());
}

// Three vectors side by side. Sums are evaluated in the order of V3.
struct Threes {
    Three x, y, z;

    static Threes all(const V3& v) { return {Three::all(v.x), Three::all(v.y), Three::all(v.z)}; }
    Threes next() const { return {x.next(), y.next(), z.next()}; }
    V3 vec(int k) const {
        double xs[4];
        double ys[4];
        double zs[4];
        x.store(xs);
        y.store(ys);
        z.store(zs);
        return {xs[k], ys[k], zs[k]};
    }
};
inline Threes operator+(const Threes& a, const Threes& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Threes operator-(const Threes& a, const Threes& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Threes operator-(const Threes& a) {
    return {-a.x, -a.y, -a.z};
}
inline Threes operator*(const Three& s, const Threes& a) {
    return {s * a.x, s * a.y, s * a.z};
}
inline Threes mul(const Threes& a, const Threes& b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
inline Three dot(const Threes& a, const Threes& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Threes cross(const Threes& a, const Threes& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Threes three_pick(const ThreeMask& where, const Threes& yes, const Threes& no) {
    return {three_pick(where, yes.x, no.x), three_pick(where, yes.y, no.y), three_pick(where, yes.z, no.z)};
}

}  // namespace SLIPFACE_ISA
}  // namespace slipface::detail
