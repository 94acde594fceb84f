// The code of the kernels; included by one file for each instruction set. It has internal linkage and calls
// no function that another file could share: see lanes.h.
#pragma once

#include "queries/instance_paths.h"
#include "queries/leaf_filter.h"
#include "queries/near_impl.h"

namespace slipface::detail {
namespace {

struct StackEntry {
    float key;
    std::uint32_t child;
};

// Visits leaves in the order of the keys of their boxes. `test(node, limit, keys)` returns the mask of
// children to visit; `visit(leaf, limit)` returns the new limit, negative to stop. Returns the last limit.
template <class Test, class Visit>
inline float walk(const TreeView& tree, float limit, Test&& test, Visit&& visit) {
    if (tree.nodes == nullptr) return limit;
    StackEntry stack[traversal_stack];
    std::size_t size = 0;
    std::uint32_t current = 0;
    alignas(32) float keys[8];
    while (true) {
        if ((current & leaf_bit) != 0) {
            limit = visit(leaf_at(tree, current & leaf_index_mask), limit);
            if (limit < 0.0F) return limit;
        } else {
            const BvhNode& node = tree.nodes[current];
            std::uint32_t mask = test(node, limit, keys);
            if (mask != 0) {
                const std::uint32_t others = mask & (mask - 1);
                if (others == 0) {
                    current = node.child[first_lane(mask)];
                    continue;
                }
                const std::size_t bottom = size;
                for (; mask != 0; mask &= mask - 1) {
                    const unsigned k = first_lane(mask);
                    const StackEntry entry{keys[k], node.child[k]};
                    fetch(tree, entry.child);
                    std::size_t index = size++;
                    for (; index > bottom && stack[index - 1].key < entry.key; --index)
                        stack[index] = stack[index - 1];
                    stack[index] = entry;
                }
            }
        }
        do {
            if (size == 0) return limit;
            --size;
        } while (!(stack[size].key <= limit));
        current = stack[size].child;
    }
}

Prepared prepare_sweep_kernel(const WorldExtent& world, const V3& radii, const V3& from, const V3& move,
                              EllipsoidQuery& query, SweepPath& path) {
    const bool in_floats = in_float_range(radii, from, move, world);
    const double reach = larger(larger(largest(from), largest(move)), world.reach);
    if (in_floats && passes_beside(world, from, move, radii, reach)) return Prepared::beside;
    query = ellipsoid_query(from, radii, move);
    if (!in_floats) return Prepared::beyond_floats;
    path = sweep_path(query, reach);
    return Prepared::in_floats;
}

float sweep_leaf(const LaneBoxPath& box, const LaneSpherePath& sphere, bool usable, const Leaf& leaf,
                 float limit, Consider consider, void* context) {
    Lanes v[9];
    lanes_of_leaf(leaf, v);
    Lanes enter;
    std::uint32_t mask = box.intersect(LeafRows(v), 0.0F, limit, enter) & present(leaf);
    if (mask == 0) return limit;
    if (!usable) {
        for (; mask != 0 && limit >= 0.0F; mask &= mask - 1)
            limit = consider(context, leaf, first_lane(mask));
        return limit;
    }
    const LeafFilter filter(sphere, v);
    const Lanes until = Lanes::all(limit);
    const Lanes plane = filter.apart_by_plane(until);
    mask &= ~lanes_above(plane, until);
    if (mask == 0) return limit;
    mask &= ~filter.apart_beside(until);
    if (mask == 0) return limit;
    const Lanes after = filter.apart_by_border(plane, until);
    while (true) {
        mask &= ~lanes_above(after, Lanes::all(limit));
        if (mask == 0) return limit;
        const unsigned lane = least_lane(mask, after);
        limit = consider(context, leaf, lane);
        if (limit < 0.0F) return limit;
        mask &= ~(1U << lane);
    }
}

// Visits the leaves whose boxes the path touches.
template <class Visit>
inline float walk_path(const TreeView& tree, const LaneBoxPath& box, float limit, const Visit& visit) {
    return walk(
        tree, limit,
        [&](const BvhNode& node, float now, float* keys) {
            Lanes enter;
            const std::uint32_t mask = box.intersect(NodeRows{node}, 0.0F, now, enter);
            enter.store(keys);
            return mask;
        },
        visit);
}

// The same in a whole world: leaves of instances are placed first. `half` is half the size of what moves.
template <class Visit>
inline void walk_world(const WorldView& world, const V3& from, const V3& move, const V3& half,
                       const LaneBoxPath& box, float limit, const Visit& visit) {
    limit = walk_path(world.own, box, limit, visit);
    if (limit < 0.0F || world.boxes.nodes == nullptr) return;
    walk_path(world.boxes, box, limit, [&](const Leaf& boxes, float now) {
        Lanes v[9];
        lanes_of_leaf(boxes, v);
        Lanes enter;
        const std::uint32_t mask = box.intersect(LeafRows(v), 0.0F, now, enter) & present(boxes);
        return visit_instances(world, mask, enter, boxes, now, [&](const InstanceView& in, float until) {
            const BoxPath path = path_in_mesh(in, from, move, half, world.reach);
            const LaneBoxPath local(path);
            PlacedLeaf placed;
            return walk_path(in.tree, local, until, [&](const Leaf& leaf, float at) {
                place_leaf(in, leaf, placed);
                return visit(placed.leaf(), at);
            });
        });
    });
}

void sweep_kernel(const WorldView& world, const EllipsoidQuery& query, const SweepPath& path, float limit,
                  Consider consider, void* context) {
    const LaneBoxPath box(path.box);
    const LaneSpherePath sphere(path.sphere);
    walk_world(world, query.centre, query.move, query.radii, box, limit, [&](const Leaf& leaf, float now) {
        return sweep_leaf(box, sphere, path.sphere.usable, leaf, now, consider, context);
    });
}

// Bit k is set where the ray's line certainly misses triangle k, in the sheared coordinates of the ray
// (ray.cpp). An edge function has an error below its slack. corner(k, axis): of the triangles, world.
template <class Corners>
inline std::uint32_t ray_misses(const RayPath& path, const Corners& corner) {
    Lanes x[3];
    Lanes y[3];
    Lanes xs[3];
    Lanes ys[3];
    const Lanes sx = Lanes::all(path.sx);
    const Lanes sy = Lanes::all(path.sy);
    for (int k = 0; k < 3; ++k) {
        const auto along = [&](int axis) {
            return corner(k, axis) - Lanes::all(path.centre[axis]) - Lanes::all(path.rest[axis]);
        };
        const Lanes ax = along(path.kx);
        const Lanes ay = along(path.ky);
        const Lanes az = along(path.kz);
        x[k] = ax - sx * az;
        y[k] = ay - sy * az;
        // |sx|, |sy| <= 1.
        xs[k] = lanes_abs(ax) + lanes_abs(az);
        ys[k] = lanes_abs(ay) + lanes_abs(az);
    }
    Lanes low = Lanes::all(0.0F);
    Lanes high = low;
    Lanes slack = low;
    for (int k = 0; k < 3; ++k) {
        const int next = k == 2 ? 0 : k + 1;
        const Lanes edge = x[k] * y[next] - y[k] * x[next];
        low = k == 0 ? edge : lanes_min(low, edge);
        high = k == 0 ? edge : lanes_max(high, edge);
        slack = lanes_max(slack, xs[k] * ys[next] + ys[k] * xs[next]);
    }
    slack = slack * Lanes::all(determinant_rounding) + Lanes::all(1e-30F);
    return lanes_above(Lanes::all(0.0F) - low, slack) & lanes_above(high, slack);
}

void ray_kernel(const WorldView& world, const V3& origin, const V3& direction, const RayPath& path,
                float limit, Consider consider, void* context) {
    const LaneBoxPath box(path.box);
    walk_world(world, origin, direction, V3{0.0, 0.0, 0.0}, box, limit, [&](const Leaf& leaf, float now) {
        Lanes v[9];
        lanes_of_leaf(leaf, v);
        std::uint32_t mask = present(leaf);
        if (path.usable) {
            mask &= ~ray_misses(path, [&](int k, int axis) { return v[3 * k + axis]; });
            if (mask == 0) return now;
        }
        Lanes enter;
        mask &= box.intersect(LeafRows(v), 0.0F, now, enter);
        for (; mask != 0 && now >= 0.0F; mask &= mask - 1)
            now = consider(context, leaf, first_lane(mask));
        return now;
    });
}

std::uint32_t near_ray_kernel(const NearTriangles& near, const RayPath& path, std::uint32_t* out) {
    std::uint32_t found = 0;
    for (std::uint32_t first = 0; first < near.count; first += 8) {
        const auto corner = [&](int k, int axis) { return Lanes::load(near.corner[3 * k + axis] + first); };
        std::uint32_t mask = present(near, first) & ~ray_misses(path, corner);
        for (; mask != 0; mask &= mask - 1)
            out[found++] = first + first_lane(mask);
    }
    return found;
}

struct LanePoint {
    Lanes up[3];
    Lanes down[3];

    explicit LanePoint(const PointBoxes& point) {
        for (int axis = 0; axis < 3; ++axis) {
            up[axis] = Lanes::all(point.up[axis]);
            down[axis] = Lanes::all(point.down[axis]);
        }
    }
    // Bit k is set where box k is within `limit`, a squared distance. `square`: lower bounds of the squared
    // distances.
    template <class Rows>
    std::uint32_t within(const Rows& rows, float limit, Lanes& square) const {
        square = Lanes::all(0.0F);
        for (int axis = 0; axis < 3; ++axis) {
            const Lanes distance =
                lanes_max(lanes_max(rows(axis) - up[axis], down[axis] - rows(axis + 3)), Lanes::all(0.0F));
            square = square + distance * distance;
        }
        // There are four roundings before; the slack is larger than their sum.
        square = square * Lanes::all(1.0F - 2.0F * time_slack);
        return lanes_not_above(square, Lanes::all(limit));
    }
};

// Visits the leaves within the limit.
template <class Visit>
inline float walk_point(const TreeView& tree, const LanePoint& boxes, float limit, const Visit& visit) {
    return walk(
        tree, limit,
        [&](const BvhNode& node, float now, float* keys) {
            Lanes square;
            const std::uint32_t mask = boxes.within(NodeRows{node}, now, square);
            square.store(keys);
            return mask;
        },
        visit);
}

// The squared distance in the mesh of what is at most at the squared distance `limit` in the world.
inline float limit_in_mesh(const InstanceView& in, double slack, float limit) {
    if (limit < 0.0F) return limit;
    constexpr float most = 3e38F;
    const double distance = (std::sqrt(double{limit}) + slack) / in.least_scale;
    const double square = distance * distance * (1.0 + 1e-6) + 1e-30;
    return square < double{most} ? round_up(square) : most;
}

float closest_in_leaf(const LanePoint& boxes, const LaneSpherePath& sphere, bool usable, const Leaf& leaf,
                      float now, Consider consider, void* context) {
    Lanes v[9];
    lanes_of_leaf(leaf, v);
    Lanes square;
    std::uint32_t mask = boxes.within(LeafRows(v), now, square) & present(leaf);
    if (mask == 0) return now;
    if (!usable) {
        for (; mask != 0 && now >= 0.0F; mask &= mask - 1)
            now = consider(context, leaf, first_lane(mask));
        return now;
    }
    const LeafFilter filter(sphere, v);
    const Lanes order = filter.border_distance();
    for (float tested = -1.0F; mask != 0 && now >= 0.0F;) {
        if (now != tested && now < 1e12F) {
            const float radius = __builtin_sqrtf(now) * (1.0F + time_slack) + least_time;
            mask &= ~filter.apart_at_rest(mask, radius);
            tested = now;
            continue;
        }
        const unsigned lane = least_lane(mask, order);
        now = consider(context, leaf, lane);
        mask &= ~(1U << lane);
    }
    return now;
}

void closest_kernel(const WorldView& world, const V3& at, const PointBoxes& point, float limit,
                    Consider consider, void* context) {
    const LanePoint boxes(point);
    const LaneSpherePath sphere(point.sphere);
    const auto visit = [&](const Leaf& leaf, float now) {
        return closest_in_leaf(boxes, sphere, point.sphere.usable, leaf, now, consider, context);
    };
    limit = walk_point(world.own, boxes, limit, visit);
    if (limit < 0.0F || world.boxes.nodes == nullptr) return;
    walk_point(world.boxes, boxes, limit, [&](const Leaf& leaf, float now) {
        Lanes v[9];
        lanes_of_leaf(leaf, v);
        Lanes square;
        const std::uint32_t mask = boxes.within(LeafRows(v), now, square) & present(leaf);
        return visit_instances(world, mask, square, leaf, now, [&](const InstanceView& in, float until) {
            const double slack = placing_slack(in, at, V3{0.0, 0.0, 0.0}, world.reach).x * 2.0;
            PointBoxes local = point;
            const V3 there = point_in_mesh(in, at);
            const double there_at[3] = {there.x, there.y, there.z};
            for (int axis = 0; axis < 3; ++axis) {
                local.up[axis] = round_up(there_at[axis]);
                local.down[axis] = round_down(there_at[axis]);
            }
            PlacedLeaf placed;
            walk_point(in.tree, LanePoint(local), limit_in_mesh(in, slack, until),
                       [&](const Leaf& mesh_leaf, float) {
                           place_leaf(in, mesh_leaf, placed);
                           until = visit(placed.leaf(), until);
                           return limit_in_mesh(in, slack, until);
                       });
            return until;
        });
    });
}

}  // namespace
}  // namespace slipface::detail
