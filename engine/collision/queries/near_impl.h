// Collecting the triangles around a body, and sweeps that stay among them. Part of the kernels: see lanes.h.
#pragma once

#include "queries/instance_paths.h"
#include "queries/leaf_filter.h"

namespace slipface::detail {
namespace {

// In radii. At larger distances floats are too coarse.
inline constexpr double max_reach = 1e3;
// How many nodes of the tree one neighbourhood may visit.
inline constexpr std::uint32_t near_nodes = 256;

// A box against eight boxes.
struct LaneBox {
    Lanes low[3];
    Lanes high[3];

    LaneBox(const Three& centre, const Three& half) {
        float lows[4];
        float highs[4];
        round_down((centre - half).rounded()).store(lows);
        round_up((centre + half).rounded()).store(highs);
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = Lanes::all(lows[axis]);
            high[axis] = Lanes::all(highs[axis]);
        }
    }
    template <class Rows>
    std::uint32_t intersect(const Rows& rows) const {
        const auto gap = [&](int axis) {
            return lanes_max(rows(axis) - high[axis], low[axis] - rows(axis + 3));
        };
        return lanes_not_above(lanes_max(lanes_max(gap(0), gap(1)), gap(2)), Lanes::all(0.0F));
    }
};

using NearRow = float[near_capacity + 8];

inline LaneVec load_vec(const NearRow* rows, std::uint32_t first) {
    return {Lanes::load(rows[0] + first), Lanes::load(rows[1] + first), Lanes::load(rows[2] + first)};
}
inline void store_vec(const LaneVec& v, NearRow* rows, std::uint32_t first) {
    v.x.store(rows[0] + first);
    v.y.store(rows[1] + first);
    v.z.store(rows[2] + first);
}

inline LanePlane load_plane(const NearTriangles& near, std::uint32_t first) {
    return {load_vec(near.normal, first), Lanes::load(near.offset + first), Lanes::load(near.slack + first),
            Lanes::load(near.slack_per_length + first)};
}

// The lanes of `first` to `first` + 7 that hold a triangle.
inline std::uint32_t present(const NearTriangles& near, std::uint32_t first) {
    const std::uint32_t left = near.count - first;
    return left < 8 ? (1U << left) - 1 : 0xFFU;
}

// Computes the sphere-space data of eight triangles; returns their clearances.
inline Lanes look_at(NearTriangles& near, std::uint32_t first, const LaneSpherePath& body) {
    Lanes v[9];
    for (int row = 0; row < 9; ++row)
        v[row] = Lanes::load(near.corner[row] + first);
    const LeafFilter seen(body, v);
    for (int k = 0; k < 3; ++k) {
        store_vec(seen.corner(k), near.seen + 3 * k, first);
        store_vec(seen.edge(k), near.edge + 3 * k, first);
    }
    const LanePlane plane = seen.plane();
    store_vec(plane.normal, near.normal, first);
    plane.offset.store(near.offset + first);
    plane.slack.store(near.slack + first);
    plane.slack_per_length.store(near.slack_per_length + first);
    const Lanes clearance = seen.clearance(plane);
    clearance.store(near.clearance + first);
    return clearance;
}

inline Three three_at(const double (&v)[4]) {
    return Three(V3{v[0], v[1], v[2]});
}

// Calls visit(leaf) for the leaves that the box touches, until it returns false; false if there are too many.
template <class Visit>
bool visit_leaves(const TreeView& tree, const LaneBox& box, const Visit& visit) {
    if (tree.nodes == nullptr) return true;
    std::uint32_t nodes[near_nodes + 8];
    std::uint32_t leaves[near_capacity + 8];
    std::uint32_t node_count = 1;
    std::uint32_t leaf_count = 0;
    nodes[0] = 0;
    // Breadth first: the test of the next box does not wait for the children of this one.
    for (std::uint32_t i = 0; i < node_count; ++i) {
        const BvhNode& node = tree.nodes[nodes[i]];
        const std::uint32_t hit = box.intersect(NodeRows{node});
        const std::uint32_t ends = leaf_children(node);
        const std::uint32_t first_leaf = leaf_count;
        const std::uint32_t first_node = node_count;
        leaf_count = append_children(node, hit & ends, leaves, leaf_count);
        node_count = append_children(node, hit & ~ends, nodes, node_count);
        for (std::uint32_t k = first_leaf; k < leaf_count; ++k)
            fetch(tree, leaves[k]);
        for (std::uint32_t k = first_node; k < node_count; ++k)
            fetch(tree, nodes[k]);
        if (leaf_count > near_capacity || node_count > near_nodes) return false;
    }
    for (std::uint32_t i = 0; i < leaf_count; ++i)
        if (!visit(leaf_at(tree, leaves[i] & leaf_index_mask))) return false;
    return true;
}

// Copies the triangles of a leaf whose boxes touch `box`; false if they are too many.
bool gather_leaf(const Leaf& leaf, const LaneBox& box, NearTriangles& out) {
    Lanes v[9];
    lanes_of_leaf(leaf, v);
    const std::uint32_t mask = box.intersect(LeafRows(v)) & present(leaf);
    const std::uint32_t more = lane_count(mask);
    if (out.count + more > near_capacity) return false;
    for (int row = 0; row < 9; ++row)
        append(v[row], mask, out.corner[row] + out.count);
    append_ids(leaf, mask, out.id + out.count);
    out.count += more;
    return true;
}

// Copies the triangles whose boxes touch `box` from the world; false if they are too many.
bool gather(const WorldView& world, const Three& centre, const Three& half, NearTriangles& out) {
    const LaneBox box(centre, half);
    out.count = 0;
    if (!visit_leaves(world.own, box, [&](const Leaf& leaf) { return gather_leaf(leaf, box, out); }))
        return false;
    const auto of_instance = [&](const InstanceView& in, float) {
        const V3 at = point_in_mesh(in, centre.vec());
        const V3 wide = half.vec() + placing_slack(in, centre.vec(), V3{0.0, 0.0, 0.0}, world.reach);
        const V3 size = box_in_mesh(in, wide);
        PlacedLeaf placed;
        const bool fits = visit_leaves(in.tree, LaneBox(Three(at), Three(size)), [&](const Leaf& leaf) {
            place_leaf(in, leaf, placed);
            return gather_leaf(placed.leaf(), box, out);
        });
        return fits ? 0.0F : -1.0F;
    };
    const bool fits = visit_leaves(world.boxes, box, [&](const Leaf& leaf) {
        Lanes v[9];
        lanes_of_leaf(leaf, v);
        const std::uint32_t mask = box.intersect(LeafRows(v)) & present(leaf);
        return visit_instances(world, mask, Lanes::all(0.0F), leaf, 0.0F, of_instance) >= 0.0F;
    });
    if (!fits) return false;
    if (out.count == 0) return true;
    for (auto& row : out.corner)
        Lanes::all(row[0]).store(row + out.count);
    return true;
}

inline float least_of(Lanes lanes) {
    alignas(32) float each[8];
    lanes.store(each);
    float least = each[0];
    for (const float one : each)
        least = one < least ? one : least;
    return least;
}

void near_kernel(const WorldView& view, const WorldExtent& world, const V3& radii, const V3& centre,
                 const V3& reach, NearTriangles& out) {
    const Three at(centre), axes(radii), around(reach);
    const ThreeMask fair =
        three_not_above(Three::all(0.0), around) & three_not_above(around, axes * Three::all(max_reach));
    if (fair.bits() != 7 || !in_float_range(radii, centre, reach, world)) return;
    const double coordinate = larger(largest(centre) + largest(reach), world.reach);
    const EllipsoidQuery body = ellipsoid_query(centre, radii, V3{0.0, 0.0, 0.0});
    const SpherePath sphere = sphere_path(body, coordinate);
    if (!sphere.usable) return;
    // No move within the neighbourhood is longer than twice the reach.
    const Three half = box_half_extents(axes, around + around, coordinate) + around;
    if (!gather(view, at, half, out)) {
        out.count = 0;
        return;
    }
    const LaneSpherePath path(sphere);
    // Where the last eight are not full, gather() has repeated the first.
    Lanes clear = Lanes::all(HUGE_VALF);
    for (std::uint32_t first = 0; first < out.count; first += 8)
        clear = lanes_min(look_at(out, first, path), clear);
    out.clear = least_of(clear);
    at.store(out.centre);
    axes.store(out.radii);
    Three(body.inverse).store(out.inverse);
    around.store(out.reach);
}

inline bool is_for(const NearTriangles& near, const V3& radii) {
    return radii.x == near.radii[0] && radii.y == near.radii[1] && radii.z == near.radii[2];
}
inline bool covers_offset(const NearTriangles& near, const Three& offset) {
    return three_not_above(offset.abs(), three_at(near.reach)).bits() == 7;
}

std::uint32_t near_rest_kernel(const NearTriangles& near, const V3& radii, const V3& centre,
                               EllipsoidQuery& query, NearCandidate* out) {
    const Three offset = Three(centre) - three_at(near.centre);
    if (!is_for(near, radii) || !covers_offset(near, offset)) return leads_out;
    const Three inverse = three_at(near.inverse);
    const Three rest = offset * inverse;
    const auto distance = static_cast<float>((rest * rest).sum());
    if (near.clear > distance) return 0;

    float p[4];
    rest.rounded().store(p);
    const LaneVec at = all(p);
    const LaneVec zero = all({0.0F, 0.0F, 0.0F, 0.0F});
    const LaneSpherePath path(zero, zero, zero, zero);
    const Lanes size = size_of(at);
    std::uint32_t found = 0;
    for (std::uint32_t first = 0; first < near.count; first += 8) {
        std::uint32_t mask =
            present(near, first) & ~lanes_above(Lanes::load(near.clearance + first), Lanes::all(distance));
        if (mask == 0) continue;
        mask &= ~load_plane(near, first).apart_at_rest(at, size);
        if (mask == 0) continue;
        const LeafFilter filter(
            path, at,
            {load_vec(near.seen, first), load_vec(near.seen + 3, first), load_vec(near.seen + 6, first)},
            {load_vec(near.edge, first), load_vec(near.edge + 3, first), load_vec(near.edge + 6, first)});
        mask &= ~filter.apart_at_rest(mask, 1.0F);
        for (; mask != 0; mask &= mask - 1)
            out[found++] = {first + first_lane(mask), 0.0F};
    }
    if (found != 0) query = {centre, radii, inverse.vec(), {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
    return found;
}

std::uint32_t near_sweep_kernel(const NearTriangles& near, const V3& radii, const V3& from, const V3& move,
                                EllipsoidQuery& query, NearCandidate* out) {
    if (!is_for(near, radii)) return leads_out;
    const Three inverse = three_at(near.inverse);
    const Three begin = Three(from) - three_at(near.centre);
    const Three end = begin + Three(move);
    if (!covers_offset(near, begin) || !covers_offset(near, end)) return leads_out;
    const Three start = begin * inverse;
    const Three d = Three(move) * inverse;
    // No point of the path is further from the centre than one of its ends.
    const Three finish = end * inverse;
    const auto furthest = static_cast<float>(larger((start * start).sum(), (finish * finish).sum()));
    if (near.clear > furthest) return 0;

    float p[4];
    float motion[4];
    start.rounded().store(p);
    d.rounded().store(motion);
    const LaneVec at = all(p);
    const LaneVec zero = all({0.0F, 0.0F, 0.0F, 0.0F});
    const LaneSpherePath path(zero, zero, zero, all(motion));
    // The plane that a short move crosses mostly is one that it touches: to make sure costs more than the
    // exact test. In radii.
    const bool is_short =
        __builtin_fabsf(motion[0]) + __builtin_fabsf(motion[1]) + __builtin_fabsf(motion[2]) < 0.3F;
    const Lanes until = Lanes::all(time_limit(1.0));
    const Lanes motions = size_of(at) + until * path.d_size;
    std::uint32_t found = 0;
    for (std::uint32_t first = 0; first < near.count; first += 8) {
        std::uint32_t mask =
            present(near, first) & ~lanes_above(Lanes::load(near.clearance + first), Lanes::all(furthest));
        if (mask == 0) continue;
        // For a move along the ground the planes alone reject nearly all.
        const Lanes plane = load_plane(near, first).apart_until(at, path.d, motions);
        mask &= ~lanes_above(plane, until);
        if (mask == 0) continue;
        Lanes after = plane;
        if (!is_short || (mask & (mask - 1)) != 0) {
            const LeafFilter filter(
                path, at,
                {load_vec(near.seen, first), load_vec(near.seen + 3, first), load_vec(near.seen + 6, first)},
                {load_vec(near.edge, first), load_vec(near.edge + 3, first), load_vec(near.edge + 6, first)});
            after = filter.apart_by_border(plane, until);
            mask &= ~lanes_above(after, until);
            if (mask == 0) continue;
            mask &= ~filter.apart_beside(until);
        }
        alignas(32) float times[8];
        after.store(times);
        for (; mask != 0; mask &= mask - 1) {
            const unsigned lane = first_lane(mask);
            out[found++] = {first + lane, times[lane]};
        }
    }
    if (found != 0) query = {from, radii, inverse.vec(), move, d.vec()};
    return found;
}

float near_highest_kernel(const NearTriangles& near, const V3& from, const V3& to, double cosine) {
    float begin[4];
    float way[4];
    Three(from).rounded().store(begin);
    Three(to - from).rounded().store(way);
    const Lanes dx = Lanes::all(way[0]);
    const Lanes dz = Lanes::all(way[2]);
    const Lanes top = Lanes::all(round_up(from.y));
    const Lanes zero = Lanes::all(0.0F);
    const auto least = [](const Lanes(&of)[3]) { return lanes_min(lanes_min(of[0], of[1]), of[2]); };
    const auto most = [](const Lanes(&of)[3]) { return lanes_max(lanes_max(of[0], of[1]), of[2]); };
    float highest = -HUGE_VALF;
    for (std::uint32_t first = 0; first < near.count; first += 8) {
        LaneVec corner[3];
        Lanes along[3];
        Lanes across[3];
        Lanes size = Lanes::all(__builtin_fabsf(begin[0]) + __builtin_fabsf(begin[2]));
        for (int k = 0; k < 3; ++k) {
            corner[k] = load_vec(near.corner + 3 * k, first);
            const Lanes x = corner[k].x - Lanes::all(begin[0]);
            const Lanes z = corner[k].z - Lanes::all(begin[2]);
            along[k] = x * dx + z * dz;
            across[k] = x * dz - z * dx;
            size = size + lanes_abs(x) + lanes_abs(z);
        }
        const Lanes lengths = lanes_abs(dx) + lanes_abs(dz);
        const Lanes slack = Lanes::all(determinant_rounding) * (size + lengths) * lengths;
        const Lanes heights[3] = {corner[0].y, corner[1].y, corner[2].y};
        const LaneVec a = corner[1] - corner[0];
        const LaneVec b = corner[2] - corner[1];
        const LaneVec normal = cross(a, b);
        const Lanes upward = lanes_abs(normal.y) + Lanes::all(determinant_rounding) * size_of(a) * size_of(b);
        const Lanes square = lanes_min(dot(normal, normal), Lanes::all(1e38F));  // not infinite
        std::uint32_t mask =
            present(near, first) &
            ~(lanes_above(least(along), dx * dx + dz * dz + slack) | lanes_above(zero - slack, most(along)) |
              lanes_above(least(across), slack) | lanes_above(zero - slack, most(across)) |
              lanes_above(least(heights), top) |
              lanes_above(Lanes::all(static_cast<float>(cosine)) * lanes_sqrt(square), upward));
        alignas(32) float tops[8];
        most(heights).store(tops);
        for (; mask != 0; mask &= mask - 1) {
            const float one = tops[first_lane(mask)];
            highest = one > highest ? one : highest;
        }
    }
    return highest;
}

}  // namespace
}  // namespace slipface::detail
