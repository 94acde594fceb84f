#include "impl.h"
#include "paths.h"
#include "slipface/base/parallel.h"
#include "sphere_triangle.h"

namespace slipface {
namespace {

using namespace detail;

// Sphere space can overflow for radii and coordinates at the ends of double's range. A triangle without an
// answer there must not hide one that has.
bool well_formed(const Touch& touch) {
    return finite(touch.point) && dot(touch.normal, touch.normal) > 0.0;
}

// A sweep under way: the first touch so far.
struct Search {
    const CollisionWorld::Impl& world;
    const EllipsoidQuery& query;
    bool in_range;  // of the floats, where every answer is finite
    TriangleHit hit{1.0, Feature::vertex, 0, false};
    LeafTriangle triangle{{}, no_id};

    bool beaten_by(const TriangleHit& other, TriangleId id) const {
        if (triangle.id == no_id || other.t != hit.t) return triangle.id == no_id || other.t < hit.t;
        if (other.feature != hit.feature) return other.feature < hit.feature;
        return id < triangle.id;
    }
    void consider(const LeafTriangle& leaf) {
        const SphereTriangle sphere(leaf, query);
        TriangleHit other{};
        if (!sweep_triangle(sphere, query, hit.t, other) || !beaten_by(other, leaf.id)) return;
        const SurfaceRule& rule = world.rule_of(leaf.id);
        if (!rule.solid || (rule.one_sided && passes_one_sided(sphere, query))) return;
        if (!in_range && !well_formed(touch_of(sphere, leaf, query, other))) return;
        hit = other;
        triangle = leaf;
    }
};

float consider_lane(void* context, const Leaf& leaf, std::uint32_t lane) {
    Search& search = *static_cast<Search*>(context);
    search.consider(leaf_triangle(leaf, lane));
    return time_limit(search.hit.t);
}

bool refused(const CollisionWorld::Impl& world, const V3& radii, const V3& from, const V3& move) {
    return world.bvh.nodes.empty() || !(radii.x > 0.0 && radii.y > 0.0 && radii.z > 0.0) || !finite(radii) ||
           !finite(from) || !finite(move) || (move.x == 0.0 && move.y == 0.0 && move.z == 0.0);
}

}  // namespace

std::optional<Contact> sweep_ellipsoid(const CollisionWorld& world, const Vec3& radii, const Vec3& from,
                                       const Vec3& move) {
    const CollisionWorld::Impl& impl = world.impl();
    if (refused(impl, v3(radii), v3(from), v3(move))) return std::nullopt;
    const double reach = larger(larger(largest(v3(from)), largest(v3(move))), impl.reach);
    if (passes_beside(impl.bvh, v3(from), v3(move), v3(radii), reach)) return std::nullopt;
    const EllipsoidQuery query(v3(from), v3(radii), v3(move));
    SweepPath path;
    const bool in_range = make_sweep_path(query, reach, path);
    Search search{impl, query, in_range};
    if (in_range) {
        kernels().sweep(impl.bvh.view(), path, time_limit(1.0), consider_lane, &search);
    } else {
        for (TriangleId id = 0; id < impl.triangle_count(); ++id)
            search.consider(impl.bvh.triangle(id));
    }
    if (search.triangle.id == no_id) return std::nullopt;

    const LeafTriangle& leaf = search.triangle;
    const Touch touch = touch_of(SphereTriangle(leaf, query), leaf, query, search.hit);
    return Contact{search.hit.t,          vec(touch.normal),        vec(touch.point),  leaf.id,
                   impl.face_of(leaf.id), impl.surface_of(leaf.id), search.hit.feature};
}

void sweep_ellipsoids(const CollisionWorld& world, std::span<const Sweep> sweeps,
                      std::span<std::optional<Contact>> out) {
    parallel_for(std::min(sweeps.size(), out.size()), 128, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            out[i] = sweep_ellipsoid(world, sweeps[i].radii, sweeps[i].from, sweeps[i].move);
    });
}

}  // namespace slipface
