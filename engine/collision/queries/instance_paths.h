// Instances: their triangles, placed for one query, and the query's boxes in the space of their mesh. A query
// walks the mesh's tree with a box that contains its own box, or ellipsoid, as the mesh sees it. Every leaf
// that it reaches is placed, and examined as if it were a leaf of the world: so the answers are those of the
// placed triangles, whatever the boxes round. Part of the kernels: see lanes.h.
#pragma once

#include <cstring>

#include "queries/leaf_filter.h"
#include "queries/paths.h"

namespace slipface::detail {
namespace {

// A leaf with its corners where the instance puts them.
struct PlacedLeaf {
    alignas(32) std::byte bytes[largest_leaf + leaf_overread];

    const Leaf& leaf() const { return *reinterpret_cast<const Leaf*>(bytes); }
};

// The leaf is not by axis (LeafForm::vertices).
inline void place_leaf(const InstanceView& in, const Leaf& from, PlacedLeaf& to) {
    Leaf& head = *reinterpret_cast<Leaf*>(to.bytes);
    head = from;
    head.first_id += in.first;
    const std::uint16_t* corners = leaf_corners(from, 0);
    auto* placed_corners = const_cast<std::uint16_t*>(leaf_corners(head, 0));
    std::memcpy(placed_corners, corners, leaf_capacity * sizeof *corners);
    for (std::uint32_t lane = 0; in.mirrors && lane < leaf_capacity; ++lane)
        placed_corners[lane] =
            static_cast<std::uint16_t>(corner_of(corners[lane], 0) | corner_of(corners[lane], 2) << 5 |
                                       corner_of(corners[lane], 1) << 10);
    const std::uint32_t count = from.values[0];
    const float* __restrict x = leaf_values(from);
    const auto* __restrict y = x + count;
    const auto* __restrict z = y + count;
    auto* __restrict out = const_cast<float*>(leaf_values(head));
    // As Placement::apply().
    for (int axis = 0; axis < 3; ++axis) {
        const double cx = in.linear[0][axis], cy = in.linear[1][axis], cz = in.linear[2][axis];
        const double offset = in.offset[axis];
        for (std::uint32_t i = 0; i < count; ++i)
            out[i] = static_cast<float>(cx * double{x[i]} + cy * double{y[i]} + cz * double{z[i]} + offset);
        out += count;
    }
    std::memcpy(out, z + count, leaf_capacity * sizeof(std::uint32_t));
}

// A point or a displacement in the space of the mesh.
inline V3 in_mesh(const InstanceView& in, const V3& world) {
    const auto& m = in.inverse;
    return {m[0][0] * world.x + m[0][1] * world.y + m[0][2] * world.z,
            m[1][0] * world.x + m[1][1] * world.y + m[1][2] * world.z,
            m[2][0] * world.x + m[2][1] * world.y + m[2][2] * world.z};
}
inline V3 point_in_mesh(const InstanceView& in, const V3& world) {
    return in_mesh(in, world - V3{in.offset[0], in.offset[1], in.offset[2]});
}

// Half the size of the box, along the axes of the mesh, of a box of the world with the half size `half`.
inline V3 box_in_mesh(const InstanceView& in, const V3& half) {
    const auto row = [&](int i) {
        return std::fabs(in.inverse[i][0]) * half.x + std::fabs(in.inverse[i][1]) * half.y +
               std::fabs(in.inverse[i][2]) * half.z;
    };
    return {row(0), row(1), row(2)};
}
// The same of an ellipsoid with axes along the world's.
inline V3 ellipsoid_in_mesh(const InstanceView& in, const V3& radii) {
    const auto row = [&](int i) {
        const V3 scaled = mul(V3{in.inverse[i][0], in.inverse[i][1], in.inverse[i][2]}, radii);
        return std::sqrt(dot(scaled, scaled));
    };
    return {row(0), row(1), row(2)};
}

// What widens a query's box at `point`, in the world: the rounding of the placed corners and of the way into
// the mesh, and what box_half_extents() allows for.
inline V3 placing_slack(const InstanceView& in, const V3& point, const V3& move, double reach) {
    const double all = in.slack + 4.0 * coordinate_margin *
                                      (reach + largest(point) + largest(move) +
                                       largest(V3{in.offset[0], in.offset[1], in.offset[2]}));
    return V3{all, all, all} + move_margin * V3{std::fabs(move.x), std::fabs(move.y), std::fabs(move.z)};
}

inline BoxPath path_in_mesh(const InstanceView& in, const V3& from, const V3& move, const V3& radii,
                            double reach) {
    const V3 at = point_in_mesh(in, from), motion = in_mesh(in, move);
    const V3 half = ellipsoid_in_mesh(in, radii) + box_in_mesh(in, placing_slack(in, from, move, reach));
    return box_path(Three(at), Three(motion), box_half_extents(Three(half), Three(motion), largest(at)));
}

// Calls visit(instance, limit), which returns the new limit (negative: stop), for the instances of the lanes
// in `mask`, the one with the lowest key first.
template <class Visit>
inline float visit_instances(const WorldView& world, std::uint32_t mask, Lanes keys, const Leaf& boxes,
                             float limit, const Visit& visit) {
    while (limit >= 0.0F && (mask &= ~lanes_above(keys, Lanes::all(limit))) != 0) {
        const unsigned lane = least_lane(mask, keys);
        mask &= ~(1U << lane);
        limit = visit(world.instances[leaf_id(boxes, lane)], limit);
    }
    return limit;
}

}  // namespace
}  // namespace slipface::detail
