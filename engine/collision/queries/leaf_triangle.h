// One triangle copied from a leaf, in world space.
#pragma once

#include <cstdint>

#include "simd/vec.h"

namespace slipface::detail {

struct LeafTriangle {
    float at[3][4];    // [axis][corner]; the fourth is unused
    std::uint32_t id;  // TriangleId
};

inline namespace SLIPFACE_ISA {

inline V3 corner(const LeafTriangle& triangle, int k) {
    return {double{triangle.at[0][k]}, double{triangle.at[1][k]}, double{triangle.at[2][k]}};
}

// a b - c d with in effect one rounding (W. Kahan): the rounding errors of the products are added back.
inline double difference_of_products(double a, double b, double c, double d) {
    const double cd = c * d;
    return std::fma(a, b, -cd) + std::fma(-c, d, cd);
}
inline V3 exact_cross(const V3& a, const V3& b) {
    return {difference_of_products(a.y, b.z, a.z, b.y), difference_of_products(a.z, b.x, a.x, b.z),
            difference_of_products(a.x, b.y, a.y, b.x)};
}

// Squared sines between two edges, independent of scale. Below the first the plain cross product loses too
// much precision; below the second the precision of the corners does not determine the plane.
inline constexpr double plane_sine2 = 1e-8;
inline constexpr double flat_sine2 = 1e-18;

// e1 x e2 of a triangle's edges; zero if they are parallel to within the precision of the corners.
inline V3 face_vector(const V3& e1, const V3& e2) {
    const V3 plain = cross(e1, e2);
    const double product = dot(e1, e1) * dot(e2, e2);
    if (dot(plain, plain) > plane_sine2 * product) return plain;
    const V3 careful = exact_cross(e1, e2);
    if (dot(careful, careful) > flat_sine2 * product) return careful;
    return {0.0, 0.0, 0.0};
}

// Unit; zero for a triangle that counts as its edges only.
inline V3 winding_normal(const LeafTriangle& triangle) {
    const V3 a = corner(triangle, 0);
    return unit(face_vector(corner(triangle, 1) - a, corner(triangle, 2) - a));
}

}  // namespace SLIPFACE_ISA
}  // namespace slipface::detail
