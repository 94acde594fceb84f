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

}  // namespace slipface
