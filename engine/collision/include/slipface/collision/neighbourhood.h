// The triangles around a body, taken out of a world once for the many queries of one step. A character asks
// half a dozen times a step, never far from where it stands; each of those would walk the whole tree.
#pragma once

#include "slipface/collision/collision_world.h"
#include "slipface/collision/near_triangles.h"

namespace slipface {

// Answers as its world does, bit for bit. It refers to the world, which must not change meanwhile. A query
// that leads out of the neighbourhood is asked of the world itself: one too small is slower, never wrong.
// Allocates nothing; about 6 KB on the stack.
class Neighbourhood {
  public:
    // What an ellipsoid `radii` that starts at `centre` could touch while its centre moves by up to `reach`
    // in sphere space, a share of the radii (>= 0). Where that are more than near_capacity triangles, or a
    // number is out of range, everything leads out of the neighbourhood.
    Neighbourhood(const CollisionWorld& world, const Vec3& radii, const Vec3& centre, double reach);

    const CollisionWorld& world() const { return *world_; }

    // For the queries below: the largest `clear` of a triangle that may be touched on the way; infinite for
    // one that leads out of the neighbourhood.
    float clear_limit(const Vec3& radii, const Vec3& from, const Vec3& move) const;
    const NearTriangles& triangles() const { return triangles_; }

  private:
    const CollisionWorld* world_;
    Vec3 centre_ = Vec3::Zero();
    Vec3 radii_ = Vec3::Zero();
    Vec3 inverse_ = Vec3::Zero();  // 1 / radii
    double least_radius_ = 0.0;    // that the filter has room for
    double reach_ = -1.0;          // below 0: everything leads out
    NearTriangles triangles_;
};

// The queries of collision_world.h.
std::optional<Contact> sweep_ellipsoid(const Neighbourhood& near, const Vec3& radii, const Vec3& from,
                                       const Vec3& move);
std::size_t find_overlaps(const Neighbourhood& near, const Vec3& radii, const Vec3& centre,
                          std::span<Overlap> out);
bool overlaps_any(const Neighbourhood& near, const Vec3& radii, const Vec3& centre);

}  // namespace slipface
