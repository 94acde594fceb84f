#include "slipface/collision/neighbourhood.h"

#include "queries/near.h"

namespace slipface {

using namespace detail;

Neighbourhood::Neighbourhood(const CollisionWorld& world, const Vec3& radii, const Vec3& centre,
                             const Vec3& reach)
    : world_(&world) {
    const CollisionWorld::Impl& impl = world.impl();
    if (impl.empty()) return;
    kernels().near(impl.view(), impl.extent, v3(radii), v3(centre), v3(reach), triangles_);
}

bool Neighbourhood::holds(const Vec3& radii, const Vec3& from, const Vec3& move) const {
    return !NearCandidates(*this, radii, from, move).lead_out();
}

double highest_below(const Neighbourhood& near, const Vec3& from, const Vec3& to, double cosine) {
    const NearTriangles& triangles = near.triangles();
    if (!covers(triangles, from) || !covers(triangles, Vec3(to.x(), from.y(), to.z())))
        return std::numeric_limits<double>::infinity();
    const double bottom = triangles.centre[1] - triangles.reach[1] - triangles.radii[1];
    return std::max(bottom, double{kernels().near_highest(triangles, v3(from), v3(to), cosine)});
}

}  // namespace slipface
