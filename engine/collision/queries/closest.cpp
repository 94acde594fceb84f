#include "impl.h"
#include "queries/paths.h"
#include "queries/sight.h"
#include "simd/kernels.h"
#include "slipface/collision/filter.h"

namespace slipface {
namespace {

using namespace detail;

struct Search {
    const CollisionWorld::Impl& world;
    const EllipsoidQuery& query;  // a unit sphere at rest
    double distance2;
    double rounding;  // error of distances, metres: a triangle this much further away may get the smaller
                      // distance
    const QueryFilter* filter = nullptr;  // null: all triangles are seen
    Nearest nearest{};
    LeafTriangle triangle = no_triangle();

    void consider(const LeafTriangle& leaf) {
        const Nearest other = kernels().nearest_part(leaf, query);
        if (!(other.distance2 < distance2 || (other.distance2 == distance2 && leaf.id < triangle.id))) return;
        if (world.rule_of(leaf.id).solid != (filter == nullptr || filter->solid)) return;
        if (filter != nullptr && !filter->sees(leaf.id, world.surface_of(leaf.id))) return;
        nearest = other;
        distance2 = other.distance2;
        triangle = leaf;
    }
};

// The largest squared distance of a box that may still hold something nearer.
float distance_limit(const Search& search) {
    constexpr double most = std::numeric_limits<float>::max() / 2;
    const double distance = std::sqrt(search.distance2) + search.rounding;
    const float limit = time_limit(distance * distance < most ? distance * distance : most);
    return limit < std::numeric_limits<float>::max() ? limit : std::numeric_limits<float>::max();
}

float consider_lane(void* context, const Leaf& leaf, std::uint32_t lane) {
    Search& search = *static_cast<Search*>(context);
    search.consider(leaf_triangle(leaf, lane));
    return distance_limit(search);
}

std::optional<ClosestPoint> nearest_point(const Sight& sight, const Vec3& point, double max_distance,
                                          const QueryFilter* filter) {
    const CollisionWorld::Impl& impl = sight.world;
    if (impl.empty() || !point.allFinite() || !(max_distance >= 0.0)) return std::nullopt;
    const EllipsoidQuery query = ellipsoid_query(v3(point), V3{1.0, 1.0, 1.0}, V3{0.0, 0.0, 0.0});
    const double reach = larger(largest(query.centre), sight.extent->reach);
    Search search{impl, query, max_distance * max_distance, 1e-14 * reach, filter};
    if (reach <= float_range && sight.has_tree) {
        kernels().closest(sight.view, query.centre, point_boxes(query, reach), distance_limit(search),
                          consider_lane, &search);
    } else {
        for (TriangleId id = 0; id < impl.triangle_count(); ++id)
            search.consider(sight.triangle(id));
    }
    const LeafTriangle& leaf = search.triangle;
    if (leaf.id == no_id) return std::nullopt;
    const Touch touch = kernels().touch_of_nearest(leaf, query, search.nearest);
    return ClosestPoint{std::sqrt(search.distance2), vec(touch.point), leaf.id, impl.face_of(leaf.id)};
}

}  // namespace

std::optional<ClosestPoint> closest_point(const CollisionWorld& world, const Vec3& point,
                                          double max_distance) {
    return nearest_point(Sight(world.impl()), point, max_distance, nullptr);
}

std::optional<ClosestPoint> closest_point(const CollisionWorld& world, const Vec3& point, double max_distance,
                                          const QueryFilter& filter) {
    return nearest_point(Sight(world.impl()), point, max_distance, &filter);
}

std::optional<ClosestPoint> closest_point(const PosedWorld& world, const Vec3& point, double max_distance,
                                          const QueryFilter& filter) {
    auto closest = nearest_point(PosedSight(world), point - world.origin(), max_distance, &filter);
    if (closest) closest->point += world.origin();
    return closest;
}

}  // namespace slipface
