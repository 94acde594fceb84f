#include "impl.h"
#include "sphere_triangle.h"
#include "traverse.h"

namespace slipface {
namespace {

using namespace detail;

// A lower bound of the squared distance to each child's box, as float.
struct PointBoxes {
    float centre[3];
    float up[3];  // the point lies off `centre` by a number in [down, up]
    float down[3];

    explicit PointBoxes(const V3& point) {
        const double p[3] = {point.x, point.y, point.z};
        for (int axis = 0; axis < 3; ++axis) {
            centre[axis] = static_cast<float>(p[axis]);
            up[axis] = round_up(p[axis] - double{centre[axis]});
            down[axis] = round_down(p[axis] - double{centre[axis]});
        }
    }

    // Which of eight boxes (rows as BvhNode::bound orders them) are within `limit`, a squared distance.
    template <class Row>
    std::uint32_t within(Row&& row, float limit, Lanes& sum) const {
        sum = Lanes::all(0.0F);
        for (int axis = 0; axis < 3; ++axis) {
            const Lanes origin = Lanes::all(centre[axis]);
            const Lanes below = row(axis) - origin - Lanes::all(up[axis]);
            const Lanes above = Lanes::all(down[axis]) - (row(axis + 3) - origin);
            const Lanes distance = lanes_max(lanes_max(below, above), Lanes::all(0.0F));
            sum = sum + distance * distance;
        }
        // Four roundings on the way; the slack is larger than their sum.
        sum = sum * Lanes::all(1.0F - 2.0F * time_slack);
        return lanes_not_above(sum, Lanes::all(limit));
    }
    std::uint32_t within(const BvhNode& node, float limit, float* keys) const {
        Lanes sum;
        const std::uint32_t mask = within([&](int k) { return Lanes::load(node.bound[k]); }, limit, sum);
        sum.store(keys);
        return mask;
    }
};

float distance_limit(double distance2) {
    return std::min(time_limit(std::min(distance2, double{std::numeric_limits<float>::max()} / 2)),
                    std::numeric_limits<float>::max());
}

}  // namespace

std::optional<ClosestPoint> closest_point(const CollisionWorld& world, const Vec3& point,
                                          double max_distance) {
    const CollisionWorld::Impl& impl = world.impl();
    if (impl.bvh.nodes.empty() || !point.allFinite() || !(max_distance >= 0.0)) return std::nullopt;
    const EllipsoidQuery query(v3(point), V3{1.0, 1.0, 1.0}, V3{0.0, 0.0, 0.0});
    double best2 = max_distance * max_distance;
    Nearest best{};
    std::uint32_t best_slot = no_id;
    TriangleId best_triangle = no_id;
    const auto consider = [&](std::uint32_t slot) {
        const LeafTriangle& leaf = impl.bvh.triangles[slot];
        const Nearest nearest = nearest_part(SphereTriangle(leaf, query));
        const bool nearer =
            nearest.distance2 < best2 || (nearest.distance2 == best2 && leaf.id < best_triangle);
        if (!nearer || !impl.rule_of(leaf.id).solid) return;
        best = nearest;
        best2 = nearest.distance2;
        best_slot = slot;
        best_triangle = leaf.id;
    };
    if (std::fmax(largest(query.centre), impl.reach) <= float_range) {
        const PointBoxes boxes(query.centre);
        float limit = distance_limit(best2);
        walk_ordered(
            impl.bvh, [&](const BvhNode& node, float* keys) { return boxes.within(node, limit, keys); },
            [&] { return limit; },
            [&](std::uint32_t first, std::uint32_t count) {
                const LeafLanes leaf(&impl.bvh.triangles[first], count);
                Lanes distance;
                std::uint32_t mask = boxes.within(leaf, limit, distance) & leaf.present;
                for (; mask != 0; mask &= mask - 1)
                    consider(first + static_cast<std::uint32_t>(std::countr_zero(mask)));
                limit = distance_limit(best2);
                return true;
            });
    } else {
        for (std::uint32_t slot = 0; slot < impl.bvh.triangles.size(); ++slot)
            consider(slot);
    }
    if (best_triangle == no_id) return std::nullopt;
    const LeafTriangle& leaf = impl.bvh.triangles[best_slot];
    const Touch touch = touch_of(SphereTriangle(leaf, query), leaf, query, best);
    return ClosestPoint{std::sqrt(best2), vec(touch.point), best_triangle,
                        world.triangle_face(best_triangle)};
}

}  // namespace slipface
