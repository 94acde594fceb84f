// Three doubles with explicit operations, so that the source fixes the order of every rounding for all
// compilers.
#pragma once

#include <cmath>

#include "simd/isa.h"

namespace slipface::detail {

struct V3 {
    double x, y, z;
};

inline namespace SLIPFACE_ISA {

inline V3 operator+(const V3& a, const V3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline V3 operator-(const V3& a, const V3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline V3 operator-(const V3& a) {
    return {-a.x, -a.y, -a.z};
}
inline V3 operator*(double s, const V3& a) {
    return {s * a.x, s * a.y, s * a.z};
}
inline V3 mul(const V3& a, const V3& b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
inline double dot(const V3& a, const V3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline V3 cross(const V3& a, const V3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
// Unlike std::fmax this needs no call. If one of the two is NaN, the result is the second.
inline double larger(double a, double b) {
    return a > b ? a : b;
}
inline double least(const V3& a) {
    const double two = a.x < a.y ? a.x : a.y;
    return two < a.z ? two : a.z;
}
inline double largest(const V3& a) {
    return larger(larger(std::fabs(a.x), std::fabs(a.y)), std::fabs(a.z));
}
inline bool finite(const V3& a) {
    // inf - inf is NaN.
    return (a.x - a.x) + (a.y - a.y) + (a.z - a.z) == 0.0;
}

// Unit length, without overflow or underflow on the way; zero for zero and for vectors that are not finite.
inline V3 unit(const V3& a) {
    const double scale = largest(a);
    if (!(scale > 0.0) || !(scale < HUGE_VAL)) return {0.0, 0.0, 0.0};
    const V3 b{a.x / scale, a.y / scale, a.z / scale};
    const double length = std::sqrt(dot(b, b));
    return {b.x / length, b.y / length, b.z / length};
}

}  // namespace SLIPFACE_ISA
}  // namespace slipface::detail
