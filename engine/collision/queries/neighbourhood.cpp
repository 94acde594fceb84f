#include "slipface/collision/neighbourhood.h"

#include "queries/near.h"

namespace slipface {

using namespace detail;

Neighbourhood::Neighbourhood(const CollisionWorld& world, const Vec3& radii, const Vec3& centre,
                             const Vec3& reach, const QueryFilter* filter)
    : world_(&world), filter_(filter) {
    const CollisionWorld::Impl& impl = world.impl();
    if (impl.empty()) return;
    kernels().near(impl.view(), impl.extent, v3(radii), v3(centre), v3(reach), triangles_);
    if (filter != nullptr) leave_out_unseen();
}

// Once for all queries; so those of a filter cost nothing.
void Neighbourhood::leave_out_unseen() {
    NearTriangles& near = triangles_;
    const CollisionWorld::Impl& impl = world_->impl();
    std::uint32_t kept = 0;
    for (std::uint32_t i = 0; i < near.count; ++i) {
        if (!filter_->sees(near.id[i], impl.surface_of(near.id[i]))) continue;
        const auto keep = [&](auto& row) { row[kept] = row[i]; };
        for (std::size_t k = 0; k < 9; ++k)
            keep(near.corner[k]), keep(near.seen[k]), keep(near.edge[k]);
        for (std::size_t axis = 0; axis < 3; ++axis)
            keep(near.normal[axis]);
        keep(near.offset), keep(near.slack), keep(near.slack_per_length), keep(near.clearance), keep(near.id);
        ++kept;
    }
    near.count = kept;
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
