// The code of the narrow phase of rays (ray_triangle.h); included by one file for each instruction set. It
// calls no function that another file could share: see isa.h and lanes.h.
#pragma once

#include "queries/ray_triangle.h"
#include "simd/three.h"

namespace slipface::detail {
namespace {

// The corners relative to the origin, along an axis of the world.
Three corners_along(const ShearedRay& ray, int axis, const LeafTriangle& triangle) {
    return Three(Four::load(triangle.at[axis])) - Three::all(ray.origin[axis]);
}
Threes shear(const ShearedRay& ray, const LeafTriangle& triangle) {
    const Three z = corners_along(ray, ray.kz, triangle);
    return {corners_along(ray, ray.kx, triangle) - Three::all(ray.sx) * z,
            corners_along(ray, ray.ky, triangle) - Three::all(ray.sy) * z, Three::all(ray.sz) * z};
}

// A triangle whose sides, seen along the ray, are less than this fraction of its size apart counts as in line
// with the ray: rounding would decide on which side the ray passes.
constexpr double in_line = 0x1p-40;

// True if the ray passes between the ends of the longest edge. The two long sides of a needle are too close
// to parallel to show where it ends. The slack is for rays through a corner, on which all triangles around it
// must agree.
bool between_ends(const ShearedRay& ray, const LeafTriangle& triangle, const Threes& sheared) {
    const Threes edge = sheared.next() - sheared;
    const Three square = edge.x * edge.x + edge.y * edge.y;
    const Three index = -(sheared.x * edge.x + sheared.y * edge.y);  // along each edge, times its length
    const int longest = first_bit(three_equal(square, largest_of(square)).bits());
    const unsigned along = (three_not_above(Three::all(0.0), index) & three_not_above(index, square)).bits();
    if ((along >> longest & 1U) != 0) return true;
    double squares[4], indices[4];
    square.store(squares);
    index.store(indices);
    double away = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        away = larger(away, largest(corners_along(ray, axis, triangle).vec()));
    const double slack = 4e-15 * away * std::sqrt(squares[longest]);
    return indices[longest] >= -slack && indices[longest] <= squares[longest] + slack;
}

bool ray_triangle_kernel(const LeafTriangle& triangle, const ShearedRay& ray, RayTouch& touch) {
    const Threes corners = shear(ray, triangle);
    const Threes second = corners.next(), third = second.next();
    // The edge functions of the sides opposite to each corner.
    const Three left = third.x * second.y, right = third.y * second.x;
    const Three side = left - right;
    const Three zero = Three::all(0.0);
    const unsigned outside[] = {three_less(side, zero).bits(), three_less(zero, side).bits()};
    if (outside[0] * outside[1] != 0) return false;  // one branch, which is easier to predict than two
    const double determinant = side.sum();
    // The ray lies in the triangle's plane: only the triangle's neighbours can stop it.
    const double size = (left.abs() + right.abs()).sum();
    if (!(std::fabs(determinant) > in_line * size) || !between_ends(ray, triangle, corners)) return false;
    const Three weights = side / Three::all(determinant);
    touch.weights = weights.vec();
    touch.t = (weights * corners.z).sum();
    return touch.t >= 0.0;
}

}  // namespace
}  // namespace slipface::detail
