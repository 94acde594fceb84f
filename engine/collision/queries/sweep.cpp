#include "queries/near.h"
#include "queries/paths.h"
#include "queries/search.h"

namespace slipface {
namespace {

using namespace detail;

float consider_lane(void* context, const Leaf& leaf, std::uint32_t lane) {
    Search& search = *static_cast<Search*>(context);
    search.consider(leaf_triangle(leaf, lane));
    return time_limit(search.hit.t);
}

}  // namespace

std::optional<Contact> sweep_ellipsoid(const CollisionWorld& world, const Vec3& radii, const Vec3& from,
                                       const Vec3& move) {
    const CollisionWorld::Impl& impl = world.impl();
    const V3 start = v3(from), motion = v3(move), axes = v3(radii);
    if (impl.bvh.nodes.empty() || is_zero(motion)) return std::nullopt;
    EllipsoidQuery query;
    SweepPath path;
    const Prepared prepared = kernels().prepare_sweep(impl.extent, axes, start, motion, query, path);
    if (prepared == Prepared::beside) return std::nullopt;
    const bool in_floats = prepared == Prepared::in_floats;
    if (!in_floats && refused(axes, start, motion)) return std::nullopt;
    Search search{impl, query, in_floats};
    if (in_floats) {
        kernels().sweep(impl.bvh.view(), path, time_limit(1.0), consider_lane, &search);
    } else {
        for (TriangleId id = 0; id < impl.triangle_count(); ++id)
            search.consider(impl.bvh.triangle(id));
    }
    return search.contact();
}

std::optional<Contact> sweep_ellipsoid(const Neighbourhood& near, const Vec3& radii, const Vec3& from,
                                       const Vec3& move) {
    NearCandidates candidates(near, radii, from, move);
    if (candidates.lead_out()) return sweep_ellipsoid(near.world(), radii, from, move);
    if (is_zero(v3(move))) return std::nullopt;
    Search search{near.world().impl(), candidates.query(), true};
    for (; const NearCandidate* next = candidates.take(time_limit(search.hit.t));)
        search.consider(near_triangle(near.triangles(), next->index));
    return search.contact();
}

}  // namespace slipface
