// The float paths that the kernels walk with, made from a query in double.
#pragma once

#include <cmath>
#include <limits>

#include "axes.h"
#include "kernels.h"
#include "sphere_triangle.h"

namespace slipface::detail {

// Coordinates, radii and moves within this range leave the float box tests free of overflow and underflow.
// Queries outside it look at every triangle instead.
inline constexpr double float_range = 1e15;
inline bool in_float_range(double radius) {
    return radius >= 1.0 / float_range && radius <= float_range;
}
// Products of three factors up to this, and of a rounding each, stay far from float's ends.
inline constexpr double filter_range = 1e9;

// A float above (below) any that rounds to `value`, which is within float_range: a step of one unit in the
// last place or two, without asking which way the conversion went.
inline float round_up(double value) {
    const auto nearest = static_cast<float>(value);
    return nearest + std::fabs(nearest) * 0x1.8p-23F + std::numeric_limits<float>::min();
}
inline float round_down(double value) {
    const auto nearest = static_cast<float>(value);
    return nearest - std::fabs(nearest) * 0x1.8p-23F - std::numeric_limits<float>::min();
}
// The same for values that were made floats already.
inline Four round_up(Four nearest) {
    return nearest + four_abs(nearest) * Four::all(0x1.8p-23F) + Four::all(std::numeric_limits<float>::min());
}
inline Four round_down(Four nearest) {
    return nearest - four_abs(nearest) * Four::all(0x1.8p-23F) - Four::all(std::numeric_limits<float>::min());
}

// The latest float time at which something may still improve on `best`.
inline float time_limit(double best) {
    constexpr double most = 1e38;
    if (!(best < most)) return std::numeric_limits<float>::infinity();
    return round_up(best) * (1.0F + 2.0F * time_slack) + least_time;
}

// Half extents of an ellipsoid's box, widened to cover what the float tests and the narrow phase round off: a
// millionth of the radius, the rounding of float differences as long as the move, and that of double
// coordinates.
inline Axes box_half_extents(const Axes& radii, const Axes& move, double reach) {
    return radii * Axes::all(1.0 + 1e-6) + Axes::all(3e-7) * move.abs() + Axes::all(1e-14 * reach);
}

// Whether an ellipsoid's whole way lies beside the box of all triangles: small worlds, like moving platforms,
// are asked by everybody and met by few. `reach`: the largest coordinate of the query and the world.
inline bool passes_beside(const Bvh& bvh, const V3& centre, const V3& path, const V3& radii, double reach) {
    const Axes from(centre), move(path), to = from + move;
    const Axes half = box_half_extents(Axes(radii), move, reach);
    const Axes low(V3{double{bvh.low[0]}, double{bvh.low[1]}, double{bvh.low[2]}});
    const Axes high(V3{double{bvh.high[0]}, double{bvh.high[1]}, double{bvh.high[2]}});
    return any_less(axes_max(from, to) + half, low) || any_less(high, axes_min(from, to) - half);
}

inline BoxPath box_path(const Axes& from, const Axes& move, const Axes& half) {
    const Four zero = Four::all(0.0F);
    const Four step = move.rounded();
    const Four inverse = four_pick(four_equal(step, zero), Four::all(std::numeric_limits<float>::infinity()),
                                   Four::all(1.0F) / step);
    const Four backward = four_less(inverse, zero);
    const Four up = round_up((from + half).rounded()), down = round_down((from - half).rounded());
    BoxPath path;
    inverse.store(path.inverse);
    four_pick(backward, down, up).store(path.near_offset);
    four_pick(backward, up, down).store(path.far_offset);
    four_pick(backward, Four::all(1.0F), zero).store_truncated(path.backward);
    return path;
}

// The nearest floats, and what they leave.
inline void split(const Axes& point, const Axes& scale, float (&centre)[4], float (&rest)[4]) {
    const Four nearest = point.rounded();
    nearest.store(centre);
    ((point - Axes(nearest)) * scale).rounded().store(rest);
}

inline SpherePath sphere_path(const EllipsoidQuery& query, double reach) {
    SpherePath path;
    const Axes inverse(query.inverse);
    split(Axes(query.centre), inverse, path.centre, path.rest);
    inverse.rounded().store(path.inverse);
    Axes(query.d).rounded().store(path.d);
    const auto inverse_dd = static_cast<float>(1.0 / query.dd);
    path.inverse_dd = std::isfinite(inverse_dd) ? inverse_dd : 0.0F;
    path.usable = reach * largest(query.inverse) < filter_range;
    return path;
}

// The sweep of a query whose coordinates are at most `reach`; nothing if it is beyond the floats.
inline bool make_sweep_path(const EllipsoidQuery& query, double reach, SweepPath& path) {
    if (!(reach <= float_range)) return false;
    for (const double radius : {query.radii.x, query.radii.y, query.radii.z}) {
        if (!in_float_range(radius)) return false;
    }
    const Axes move(query.move);
    path.box = box_path(Axes(query.centre), move, box_half_extents(Axes(query.radii), move, reach));
    path.sphere = sphere_path(query, reach);
    return true;
}

}  // namespace slipface::detail
