// Queries that see only some triangles, and queries for all hits instead of the first one.
#pragma once

#include <bitset>
#include <span>

#include "slipface/collision/collision_world.h"

namespace slipface {

// The triangles that a query sees. The rules of their types hold as well: nothing meets a type that is not
// solid, unless the query is for those alone.
struct QueryFilter {
    std::bitset<256> ignored;                 // [SurfaceId] true: not seen
    std::span<const std::uint32_t> groups{};  // [triangle] one bit per group; empty: all are in every group
    std::uint32_t mask = ~std::uint32_t{0};   // a triangle is seen if one of its groups is in it
    // Asked last, of the triangle `triangle` of the world that the asker calls `part`; null: all are seen. It
    // may be called from several threads, and must answer the same every time while a query or step runs.
    bool (*ask)(void* user, std::uint32_t part, TriangleId triangle) = nullptr;
    void* user = nullptr;
    std::uint32_t part = no_id;
    bool solid = true;  // false: sees what is not solid instead

    bool sees(TriangleId triangle, SurfaceId surface) const {
        return !ignored[surface] && (triangle >= groups.size() || (groups[triangle] & mask) != 0) &&
               (ask == nullptr || ask(user, part, triangle));
    }
};

// As the functions of these names without a filter (collision_world.h), as if the world had only the
// triangles that `filter` sees.
std::optional<Contact> sweep_ellipsoid(const CollisionWorld& world, const Vec3& radii, const Vec3& from,
                                       const Vec3& move, const QueryFilter& filter);
std::optional<RayHit> cast_ray(const CollisionWorld& world, const Vec3& origin, const Vec3& direction,
                               double max_t, RayStops stops, const QueryFilter& filter);
std::optional<ClosestPoint> closest_point(const CollisionWorld& world, const Vec3& point, double max_distance,
                                          const QueryFilter& filter);
std::size_t find_overlaps(const CollisionWorld& world, const Vec3& radii, const Vec3& centre,
                          std::span<Overlap> out, const QueryFilter& filter);
bool overlaps_any(const CollisionWorld& world, const Vec3& radii, const Vec3& centre,
                  const QueryFilter& filter);

// The contact of the sweep with each triangle as if it were alone in the world, the earliest first; of equal
// t interior before edge before vertex, then the lowest triangle. Writes as many of the first as `out` holds
// and returns the total, which may be larger.
std::size_t find_sweep_hits(const CollisionWorld& world, const Vec3& radii, const Vec3& from,
                            const Vec3& move, std::span<Contact> out, const QueryFilter& filter = {});

// The same for a ray; of equal t the lowest triangle first. A triangle in line with the ray is not hit.
std::size_t find_ray_hits(const CollisionWorld& world, const Vec3& origin, const Vec3& direction,
                          double max_t, RayStops stops, std::span<RayHit> out,
                          const QueryFilter& filter = {});

}  // namespace slipface
