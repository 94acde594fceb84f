// What a query computes for each axis, for all three at once. The fourth number means nothing. Every
// operation rounds as the scalar one does, so SIMD changes no bit.
#pragma once

#include "four.h"
#include "vec.h"

namespace slipface::detail {

#if defined(__SSE2__)

struct Axes {
    __m128d xy, zw;

    explicit Axes(const V3& v) : xy(_mm_setr_pd(v.x, v.y)), zw(_mm_setr_pd(v.z, 1.0)) {}
    Axes(__m128d first, __m128d second) : xy(first), zw(second) {}
    static Axes all(double value) { return {_mm_set1_pd(value), _mm_set1_pd(value)}; }
    explicit Axes(Four v) : xy(_mm_cvtps_pd(v.v)), zw(_mm_cvtps_pd(_mm_movehl_ps(v.v, v.v))) {}
    Four rounded() const { return {_mm_movelh_ps(_mm_cvtpd_ps(xy), _mm_cvtpd_ps(zw))}; }
    Axes abs() const {
        const __m128d sign = _mm_set1_pd(-0.0);
        return {_mm_andnot_pd(sign, xy), _mm_andnot_pd(sign, zw)};
    }
    V3 vec() const { return {_mm_cvtsd_f64(xy), _mm_cvtsd_f64(_mm_unpackhi_pd(xy, xy)), _mm_cvtsd_f64(zw)}; }
};
inline Axes operator+(const Axes& a, const Axes& b) {
    return {_mm_add_pd(a.xy, b.xy), _mm_add_pd(a.zw, b.zw)};
}
inline Axes operator-(const Axes& a, const Axes& b) {
    return {_mm_sub_pd(a.xy, b.xy), _mm_sub_pd(a.zw, b.zw)};
}
inline Axes operator*(const Axes& a, const Axes& b) {
    return {_mm_mul_pd(a.xy, b.xy), _mm_mul_pd(a.zw, b.zw)};
}
inline Axes operator/(const Axes& a, const Axes& b) {
    return {_mm_div_pd(a.xy, b.xy), _mm_div_pd(a.zw, b.zw)};
}
// Where one of the two is not a number: the second.
inline Axes axes_min(const Axes& a, const Axes& b) {
    return {_mm_min_pd(a.xy, b.xy), _mm_min_pd(a.zw, b.zw)};
}
inline Axes axes_max(const Axes& a, const Axes& b) {
    return {_mm_max_pd(a.xy, b.xy), _mm_max_pd(a.zw, b.zw)};
}
// On some axis.
inline bool any_less(const Axes& a, const Axes& b) {
    return (_mm_movemask_pd(_mm_cmplt_pd(a.xy, b.xy)) | (_mm_movemask_pd(_mm_cmplt_pd(a.zw, b.zw)) & 1)) != 0;
}

#else

struct Axes {
    V3 v;

    explicit Axes(const V3& from) : v(from) {}
    explicit Axes(Four from) : v{double{from.v[0]}, double{from.v[1]}, double{from.v[2]}} {}
    static Axes all(double value) { return Axes(V3{value, value, value}); }
    Four rounded() const {
        return {{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), 1.0F}};
    }
    Axes abs() const { return Axes(V3{std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}); }
    V3 vec() const { return v; }
};
inline Axes operator+(const Axes& a, const Axes& b) {
    return Axes(a.v + b.v);
}
inline Axes operator-(const Axes& a, const Axes& b) {
    return Axes(a.v - b.v);
}
inline Axes operator*(const Axes& a, const Axes& b) {
    return Axes(mul(a.v, b.v));
}
inline Axes operator/(const Axes& a, const Axes& b) {
    return Axes(V3{a.v.x / b.v.x, a.v.y / b.v.y, a.v.z / b.v.z});
}
inline Axes axes_min(const Axes& a, const Axes& b) {
    const auto least = [](double l, double r) { return l < r ? l : r; };
    return Axes(V3{least(a.v.x, b.v.x), least(a.v.y, b.v.y), least(a.v.z, b.v.z)});
}
inline Axes axes_max(const Axes& a, const Axes& b) {
    return Axes(V3{larger(a.v.x, b.v.x), larger(a.v.y, b.v.y), larger(a.v.z, b.v.z)});
}
inline bool any_less(const Axes& a, const Axes& b) {
    return a.v.x < b.v.x || a.v.y < b.v.y || a.v.z < b.v.z;
}

#endif

}  // namespace slipface::detail
