// The float paths for the kernels, made from a query in double.
#pragma once

#include <cfloat>
#include <cmath>

#include "simd/kernels.h"

namespace slipface::detail {
inline namespace SLIPFACE_ISA {

// Within this range of coordinates, radii and moves the float box tests neither overflow nor underflow.
// Queries outside it examine every triangle instead.
inline constexpr double float_range = 1e15;
// Products of three factors up to this, with a rounding each, stay far from the ends of float.
inline constexpr double filter_range = 1e9;

// A float above (below) any that `value` may round to, for values within float_range: a step of one or two
// units in the last place, whichever way the conversion rounded.
inline float round_up(double value) {
    const auto nearest = static_cast<float>(value);
    return nearest + __builtin_fabsf(nearest) * 0x1.8p-23F + FLT_MIN;
}
inline float round_down(double value) {
    const auto nearest = static_cast<float>(value);
    return nearest - __builtin_fabsf(nearest) * 0x1.8p-23F - FLT_MIN;
}
// The same for values that are already floats.
inline Four round_up(Four nearest) {
    return nearest + four_abs(nearest) * Four::all(0x1.8p-23F) + Four::all(FLT_MIN);
}
inline Four round_down(Four nearest) {
    return nearest - four_abs(nearest) * Four::all(0x1.8p-23F) - Four::all(FLT_MIN);
}

// The latest float time at which a touch may still be better than `best`.
inline float time_limit(double best) {
    constexpr double most = 1e38;
    if (!(best < most)) return HUGE_VALF;
    return round_up(best) * (1.0F + 2.0F * time_slack) + least_time;
}

// How much wider than the ellipsoid its box is, to cover the rounding of the float tests and the narrow
// phase: fractions of the radius, of the move along the axis (five roundings of 2^-24 of a float difference),
// and of the largest coordinate (ninety of 2^-53).
inline constexpr double radius_margin = 1e-6;
inline constexpr double move_margin = 3e-7;
inline constexpr double coordinate_margin = 1e-14;

// `reach`: the largest coordinate of the query and the world.
inline Three box_half_extents(const Three& radii, const Three& move, double reach) {
    return radii * Three::all(1.0 + radius_margin) + Three::all(move_margin) * move.abs() +
           Three::all(coordinate_margin * reach);
}

// True if the whole path of an ellipsoid lies outside the box of all triangles. This matters for small worlds
// such as moving platforms: every body queries them and few touch them. `reach`: the largest coordinate of
// the query and the world.
inline bool passes_beside(const WorldExtent& world, const V3& centre, const V3& path, const V3& radii,
                          double reach) {
    const Three from(centre), move(path), to = from + move;
    const Three half = box_half_extents(Three(radii), move, reach);
    const Three low(V3{double{world.low[0]}, double{world.low[1]}, double{world.low[2]}});
    const Three high(V3{double{world.high[0]}, double{world.high[1]}, double{world.high[2]}});
    return any_less(three_max(from, to) + half, low) || any_less(high, three_min(from, to) - half);
}

inline BoxPath box_path(const Three& from, const Three& move, const Three& half) {
    const Four zero = Four::all(0.0F);
    const Four step = move.rounded();
    const Four inverse = four_pick(four_equal(step, zero), Four::all(HUGE_VALF), Four::all(1.0F) / step);
    const Four backward = four_less(inverse, zero);
    const Four up = round_up((from + half).rounded()), down = round_down((from - half).rounded());
    BoxPath path;
    inverse.store(path.inverse);
    (inverse * Four::all(late)).store(path.far_inverse);
    four_pick(backward, down, up).store(path.near_offset);
    four_pick(backward, up, down).store(path.far_offset);
    constexpr float low_rows[4] = {0.0F, 1.0F, 2.0F, 0.0F};
    constexpr float high_rows[4] = {3.0F, 4.0F, 5.0F, 3.0F};
    const Four low = Four::load(low_rows), high = Four::load(high_rows);
    four_pick(backward, high, low).store_truncated(path.near_row);
    four_pick(backward, low, high).store_truncated(path.far_row);
    return path;
}

// The nearest floats, and the remainder.
inline void split(const Three& point, const Three& scale, float (&centre)[4], float (&rest)[4]) {
    const Four nearest = point.rounded();
    nearest.store(centre);
    ((point - Three(nearest)) * scale).rounded().store(rest);
}

inline SpherePath sphere_path(const EllipsoidQuery& query, double reach) {
    SpherePath path;
    const Three inverse(query.inverse);
    split(Three(query.centre), inverse, path.centre, path.rest);
    inverse.rounded().store(path.inverse);
    Three(query.d).rounded().store(path.d);
    path.usable = reach * largest(query.inverse) < filter_range;
    return path;
}

inline PointBoxes point_boxes(const EllipsoidQuery& query, double reach) {
    PointBoxes boxes;
    const double p[3] = {query.centre.x, query.centre.y, query.centre.z};
    for (int axis = 0; axis < 3; ++axis) {
        boxes.up[axis] = round_up(p[axis]);
        boxes.down[axis] = round_down(p[axis]);
    }
    boxes.sphere = sphere_path(query, reach);
    return boxes;
}

// True if floats can hold the query; it is then finite and its radii are above 0.
inline bool in_float_range(const V3& radii, const V3& from, const V3& move, const WorldExtent& world) {
    const Three most = Three::all(float_range), axes(radii);
    const ThreeMask held = three_not_above(Three(from).abs(), most) &
                           three_not_above(Three(move).abs(), most) & three_not_above(axes, most) &
                           three_not_above(Three::all(1.0 / float_range), axes);
    return held.bits() == 7 && world.reach <= float_range;
}
inline bool is_zero(const V3& v) {
    return v.x == 0.0 && v.y == 0.0 && v.z == 0.0;
}

// The query must be in float range.
inline SweepPath sweep_path(const EllipsoidQuery& query, double reach) {
    const Three move(query.move);
    return {box_path(Three(query.centre), move, box_half_extents(Three(query.radii), move, reach)),
            sphere_path(query, reach)};
}

}  // namespace SLIPFACE_ISA
}  // namespace slipface::detail
