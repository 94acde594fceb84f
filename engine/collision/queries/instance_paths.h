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
    alignas(32) std::byte
        bytes[sizeof(Leaf) + std::size_t{3} * leaf_capacity * 12 + leaf_capacity * 4 + leaf_overread];

    const Leaf& leaf() const { return *reinterpret_cast<const Leaf*>(bytes); }
};

inline void place_leaf(const InstanceView& in, const Leaf& from, PlacedLeaf& to) {
    Leaf& head = *reinterpret_cast<Leaf*>(to.bytes);
    std::memcpy(&head, &from, sizeof head);
    if (in.mirrors) {
        std::memcpy(head.corner[1], from.corner[2], sizeof head.corner[1]);
        std::memcpy(head.corner[2], from.corner[1], sizeof head.corner[2]);
    }
    const std::uint32_t count = from.vertices;
    const auto* __restrict x = reinterpret_cast<const float*>(&from + 1);
    const auto* __restrict y = x + count;
    const auto* __restrict z = y + count;
    auto* __restrict out = reinterpret_cast<float*>(&head + 1);
    // As Placement::apply().
    for (int axis = 0; axis < 3; ++axis) {
        const double cx = in.linear[0][axis], cy = in.linear[1][axis], cz = in.linear[2][axis];
        const double offset = in.offset[axis];
        for (std::uint32_t i = 0; i < count; ++i)
            out[i] = static_cast<float>(cx * double{x[i]} + cy * double{y[i]} + cz * double{z[i]} + offset);
        out += count;
    }
    const auto* ids = reinterpret_cast<const std::uint32_t*>(z + count);
    auto* numbers = reinterpret_cast<std::uint32_t*>(out);
    for (std::uint32_t i = 0; i < from.count; ++i)
        numbers[i] = in.first + ids[i];
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
    const auto* numbers =
        reinterpret_cast<const std::uint32_t*>(&boxes + 1) + std::size_t{3} * boxes.vertices;
    while (limit >= 0.0F && (mask &= ~lanes_above(keys, Lanes::all(limit))) != 0) {
        const unsigned lane = least_lane(mask, keys);
        mask &= ~(1U << lane);
        limit = visit(world.instances[numbers[lane]], limit);
    }
    return limit;
}

}  // namespace
}  // namespace slipface::detail
