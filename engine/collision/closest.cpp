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

    std::uint32_t within(const BvhNode& node, float limit, float* keys) const {
        Lanes sum = Lanes::all(0.0F);
        for (int axis = 0; axis < 3; ++axis) {
            const Lanes origin = Lanes::all(centre[axis]);
            const Lanes below = Lanes::load(node.bound[axis]) - origin - Lanes::all(up[axis]);
            const Lanes above = Lanes::all(down[axis]) - (Lanes::load(node.bound[axis + 3]) - origin);
            const Lanes distance = lanes_max(lanes_max(below, above), Lanes::all(0.0F));
            sum = sum + distance * distance;
        }
        // Four roundings on the way; the slack is larger than their sum.
        sum = sum * Lanes::all(1.0F - 2.0F * time_slack);
        sum.store(keys);
        return lanes_not_above(sum, Lanes::all(limit));
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
    const auto consider = [&](std::uint32_t first, std::uint32_t count) {
        for (std::uint32_t slot = first; slot < first + count; ++slot) {
            const LeafTriangle& leaf = impl.bvh.triangles[slot];
            const Nearest nearest = nearest_part(SphereTriangle(leaf, query));
            const bool nearer =
                nearest.distance2 < best2 || (nearest.distance2 == best2 && leaf.id < best_triangle);
            if (!nearer || !impl.rule_of(leaf.id).solid) continue;
            best = nearest;
            best2 = nearest.distance2;
            best_slot = slot;
            best_triangle = leaf.id;
        }
        return true;
    };
    if (std::fmax(largest(query.centre), impl.reach) <= float_range) {
        const PointBoxes boxes(query.centre);
        walk_ordered(
            impl.bvh,
            [&](const BvhNode& node, float* keys) { return boxes.within(node, distance_limit(best2), keys); },
            [&] { return distance_limit(best2); }, consider);
    } else {
        consider(0, static_cast<std::uint32_t>(impl.bvh.triangles.size()));
    }
    if (best_triangle == no_id) return std::nullopt;
    const LeafTriangle& leaf = impl.bvh.triangles[best_slot];
    const Touch touch = touch_of(SphereTriangle(leaf, query), leaf, query, best);
    return ClosestPoint{std::sqrt(best2), vec(touch.point), best_triangle,
                        world.triangle_face(best_triangle)};
}

}  // namespace slipface
