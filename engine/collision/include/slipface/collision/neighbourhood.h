// The triangles around a body, taken out of a world once for the many queries of one step. A character asks
// half a dozen times a step, never far from where it stands; each of those would walk the whole tree.
#pragma once

#include "slipface/collision/collision_world.h"
#include "slipface/collision/near_triangles.h"

namespace slipface {

// Answers as its world does, bit for bit. It refers to the world, which must not change meanwhile. A query
// that leads out of the neighbourhood, or is for other radii, is asked of the world itself: one too small is
// slower, never wrong. Allocates nothing, but is large for a stack: 18,640 bytes, and a query of it takes
// another kilobyte for its list of candidates.
class Neighbourhood {
  public:
    // What an ellipsoid `radii` can touch while its centre is no further than `reach` from `centre` along any
    // axis, metres (0 to 1000 radii). Where that are more than near_capacity triangles, or a number is out of
    // range, everything leads out of the neighbourhood.
    Neighbourhood(const CollisionWorld& world, const Vec3& radii, const Vec3& centre, const Vec3& reach);

    const CollisionWorld& world() const { return *world_; }
    // Whether a sweep stays in it.
    bool holds(const Vec3& radii, const Vec3& from, const Vec3& move) const;
    const NearTriangles& triangles() const { return triangles_; }

  private:
    const CollisionWorld* world_;
    NearTriangles triangles_;
};

// The queries of collision_world.h.
std::optional<Contact> sweep_ellipsoid(const Neighbourhood& near, const Vec3& radii, const Vec3& from,
                                       const Vec3& move);
std::size_t find_overlaps(const Neighbourhood& near, const Vec3& radii, const Vec3& centre,
                          std::span<Overlap> out);
bool overlaps_any(const Neighbourhood& near, const Vec3& radii, const Vec3& centre);

}  // namespace slipface
