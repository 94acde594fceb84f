// A world where a pose puts it: queries of geometry that moves, without writing its triangles anew.
#pragma once

#include "slipface/base/pose.h"
#include "slipface/collision/filter.h"

namespace slipface {

// What the world is turned and moved by. The queries of collision_world.h and filter.h take one in place of a
// world, with world-space arguments and results; `world` must outlive it, and its pose must be a rigid
// motion. A pose that does not turn changes no triangle: the query is moved instead, and the answer is that
// of the world. A pose that turns rounds corners to float as seen from the middle of the world, so that what
// is far out is as precise as what is near the origin. Worlds of CollisionWorld::build_movable() answer as
// fast turned as unturned; others look at each of their triangles.
class PosedWorld {
  public:
    explicit PosedWorld(const CollisionWorld& world, const Pose& pose = {});

    const CollisionWorld& world() const { return *world_; }
    const Pose& pose() const { return pose_; }
    bool turned() const { return turned_; }

    std::size_t triangle_count() const { return world_->triangle_count(); }
    FaceId triangle_face(TriangleId triangle) const { return world_->triangle_face(triangle); }
    SurfaceId face_surface(FaceId face) const { return world_->face_surface(face); }
    SurfaceRule surface_rule(SurfaceId surface) const { return world_->surface_rule(surface); }
    std::array<Vec3, 3> triangle(TriangleId triangle) const;
    Vec3 triangle_normal(TriangleId triangle) const {
        return pose_.rotate(world_->triangle_normal(triangle));
    }
    Aabb bounds() const;  // contains the world there

    // Where the origin of a query's own coordinates lies.
    const Vec3& origin() const { return origin_; }

  private:
    const CollisionWorld* world_;
    Pose pose_;
    bool turned_;
    Vec3 origin_;
};

std::optional<Contact> sweep_ellipsoid(const PosedWorld& world, const Vec3& radii, const Vec3& from,
                                       const Vec3& move, const QueryFilter& filter = {});
std::optional<RayHit> cast_ray(const PosedWorld& world, const Vec3& origin, const Vec3& direction,
                               double max_t = std::numeric_limits<double>::infinity(),
                               RayStops stops = RayStops::solid, const QueryFilter& filter = {});
std::optional<ClosestPoint> closest_point(const PosedWorld& world, const Vec3& point,
                                          double max_distance = std::numeric_limits<double>::infinity(),
                                          const QueryFilter& filter = {});
std::size_t find_overlaps(const PosedWorld& world, const Vec3& radii, const Vec3& centre,
                          std::span<Overlap> out, const QueryFilter& filter = {});
bool overlaps_any(const PosedWorld& world, const Vec3& radii, const Vec3& centre,
                  const QueryFilter& filter = {});
std::size_t find_sweep_hits(const PosedWorld& world, const Vec3& radii, const Vec3& from, const Vec3& move,
                            std::span<Contact> out, const QueryFilter& filter = {});
std::size_t find_ray_hits(const PosedWorld& world, const Vec3& origin, const Vec3& direction, double max_t,
                          RayStops stops, std::span<RayHit> out, const QueryFilter& filter = {});

}  // namespace slipface
