// The triangles around a body, collected from a world once for the many queries of one step. A character
// makes about six queries per step, all near its position; without this, each would walk the whole tree.
#pragma once

#include "slipface/collision/filter.h"
#include "slipface/collision/near_triangles.h"

namespace slipface {

// The results are those of the world, bit for bit. A query that leaves the neighbourhood or has other radii
// goes to the world itself: a neighbourhood that is too small costs time but is never wrong. It refers to the
// world, which must not change while it lives. It allocates nothing, but it is large for a stack: 19,192
// bytes, and each query uses another kilobyte for its list of candidates.
class Neighbourhood {
  public:
    // Collects all triangles that an ellipsoid with radii `radii` can touch while its centre is at most
    // `reach` from `centre` along each axis (world space, metres; `reach`: 0 to 1000 radii). If these are
    // more than near_capacity, or an argument is out of range, every query goes to the world. Queries see
    // what `filter` sees, which must outlive the neighbourhood and be for what is solid; null: everything.
    Neighbourhood(const CollisionWorld& world, const Vec3& radii, const Vec3& centre, const Vec3& reach,
                  const QueryFilter* filter = nullptr);

    const CollisionWorld& world() const { return *world_; }
    // True if the sweep stays in the neighbourhood, so that the world is not needed.
    bool holds(const Vec3& radii, const Vec3& from, const Vec3& move) const;
    const NearTriangles& triangles() const { return triangles_; }
    const QueryFilter* filter() const { return filter_; }

  private:
    void leave_out_unseen();

    const CollisionWorld* world_;
    const QueryFilter* filter_;
    NearTriangles triangles_;
};

// The queries of collision_world.h, with the same arguments and results.
std::optional<Contact> sweep_ellipsoid(const Neighbourhood& near, const Vec3& radii, const Vec3& from,
                                       const Vec3& move);
std::size_t find_overlaps(const Neighbourhood& near, const Vec3& radii, const Vec3& centre,
                          std::span<Overlap> out);
bool overlaps_any(const Neighbourhood& near, const Vec3& radii, const Vec3& centre);
std::optional<RayHit> cast_ray(const Neighbourhood& near, const Vec3& origin, const Vec3& direction,
                               double max_t = std::numeric_limits<double>::infinity(),
                               RayStops stops = RayStops::solid);

// No vertical line through the way from `from` to `to` meets a triangle between this height and from.y,
// metres; the rise of the way itself does not count, nor do triangles whose normal has an |y| below `cosine`.
// A bound, not the exact height: infinity if the way leads out of the neighbourhood.
double highest_below(const Neighbourhood& near, const Vec3& from, const Vec3& to, double cosine);

}  // namespace slipface
