// The float paths that the kernels walk with, made from a query in double.
#pragma once

#include <cmath>
#include <limits>

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

// The latest float time at which something may still improve on `best`.
inline float time_limit(double best) {
    constexpr double most = 1e38;
    if (!(best < most)) return std::numeric_limits<float>::infinity();
    return round_up(best) * (1.0F + 2.0F * time_slack) + least_time;
}

// Half extents of an ellipsoid's box, widened to cover what the float tests and the narrow phase round off: a
// millionth of the radius, the rounding of float differences as long as the move, and that of double
// coordinates.
inline V3 box_half_extents(const V3& radii, const V3& move, double reach) {
    const auto widen = [reach](double radius, double step) {
        return radius * (1.0 + 1e-6) + 3e-7 * std::fabs(step) + 1e-14 * reach;
    };
    return {widen(radii.x, move.x), widen(radii.y, move.y), widen(radii.z, move.z)};
}

// Whether an ellipsoid's whole way lies beside the box of all triangles: small worlds, like moving platforms,
// are asked by everybody and met by few. `reach`: the largest coordinate of the query and the world.
inline bool passes_beside(const Bvh& bvh, const V3& from, const V3& move, const V3& radii, double reach) {
    const V3 half = box_half_extents(radii, move, reach);
    const auto beside = [](double start, double step, double room, float low, float high) {
        return larger(start, start + step) + room < double{low} ||
               -larger(-start, -start - step) - room > double{high};
    };
    return beside(from.x, move.x, half.x, bvh.low[0], bvh.high[0]) ||
           beside(from.y, move.y, half.y, bvh.low[1], bvh.high[1]) ||
           beside(from.z, move.z, half.z, bvh.low[2], bvh.high[2]);
}

inline BoxPath box_path(const V3& from, const V3& move, const V3& half) {
    BoxPath path;
    const double f[3] = {from.x, from.y, from.z};
    const double m[3] = {move.x, move.y, move.z};
    const double r[3] = {half.x, half.y, half.z};
    for (int axis = 0; axis < 3; ++axis) {
        const auto step = static_cast<float>(m[axis]);
        path.inverse[axis] = step == 0.0F ? std::numeric_limits<float>::infinity() : 1.0F / step;
        // Looked up, not branched on: directions are as good as random.
        const float sides[2] = {round_up(f[axis] + r[axis]), round_down(f[axis] - r[axis])};
        const int backward = path.inverse[axis] < 0.0F ? 1 : 0;
        path.near_row[axis] = axis + 3 * backward;
        path.far_row[axis] = axis + 3 - 3 * backward;
        path.near_offset[axis] = sides[backward];
        path.far_offset[axis] = sides[1 - backward];
    }
    return path;
}

inline void split(const V3& point, float (&centre)[3], float (&rest)[3], const V3& scale) {
    const double p[3] = {point.x, point.y, point.z};
    const double s[3] = {scale.x, scale.y, scale.z};
    for (int axis = 0; axis < 3; ++axis) {
        centre[axis] = static_cast<float>(p[axis]);
        rest[axis] = static_cast<float>((p[axis] - double{centre[axis]}) * s[axis]);
    }
}

inline SpherePath sphere_path(const EllipsoidQuery& query, double reach) {
    SpherePath path;
    split(query.centre, path.centre, path.rest, query.inverse);
    const double inverse[3] = {query.inverse.x, query.inverse.y, query.inverse.z};
    const double d[3] = {query.d.x, query.d.y, query.d.z};
    for (int axis = 0; axis < 3; ++axis) {
        path.inverse[axis] = static_cast<float>(inverse[axis]);
        path.d[axis] = static_cast<float>(d[axis]);
    }
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
    path.box = box_path(query.centre, query.move, box_half_extents(query.radii, query.move, reach));
    path.sphere = sphere_path(query, reach);
    return true;
}

}  // namespace slipface::detail
