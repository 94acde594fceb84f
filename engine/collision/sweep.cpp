#include "impl.h"
#include "leaf_filter.h"
#include "sphere_triangle.h"
#include "traverse.h"

namespace slipface {
namespace {

using namespace detail;

struct Best {
    TriangleHit hit{1.0, Feature::vertex, 0, false};
    std::uint32_t slot = no_id;
    TriangleId triangle = no_id;

    bool beaten_by(const TriangleHit& other, TriangleId id) const {
        if (triangle == no_id || other.t != hit.t) return triangle == no_id || other.t < hit.t;
        if (other.feature != hit.feature) return other.feature < hit.feature;
        return id < triangle;
    }
};

void consider(const CollisionWorld::Impl& world, const EllipsoidQuery& query, std::uint32_t slot,
              Best& best) {
    const LeafTriangle& leaf = world.bvh.triangles[slot];
    const SphereTriangle triangle(leaf, query);
    TriangleHit hit{};
    if (!sweep_triangle(triangle, query, best.hit.t, hit) || !best.beaten_by(hit, leaf.id)) return;
    const SurfaceRule& rule = world.rule_of(leaf.id);
    if (!rule.solid || (rule.one_sided && passes_one_sided(triangle, query))) return;
    best = {hit, slot, leaf.id};
}

}  // namespace

std::optional<Contact> sweep_ellipsoid(const CollisionWorld& world, const Vec3& radii, const Vec3& from,
                                       const Vec3& move) {
    const CollisionWorld::Impl& impl = world.impl();
    if (impl.bvh.nodes.empty() || !radii.allFinite() || !(radii.minCoeff() > 0.0) || !from.allFinite() ||
        !move.allFinite() || move.isZero(0.0)) {
        return std::nullopt;
    }
    const EllipsoidQuery query(v3(from), v3(radii), v3(move));
    Best best;
    const double reach = std::fmax(std::fmax(largest(query.centre), largest(query.move)), impl.reach);
    if (in_float_range(radii.minCoeff()) && in_float_range(radii.maxCoeff()) && reach <= float_range) {
        const BoxPath path(query.centre, query.move, box_half_extents(query.radii, query.move, reach));
        const LeafFilter filter(query, path, reach);
        float limit = time_limit(best.hit.t);
        walk_ordered(
            impl.bvh, [&](const BvhNode& node, float* keys) { return path.meet(node, limit, keys); },
            [&] { return limit; },
            [&](std::uint32_t first, std::uint32_t count) {
                std::uint32_t mask = filter.candidates(&impl.bvh.triangles[first], count, limit);
                for (; mask != 0; mask &= mask - 1) {
                    consider(impl, query, first + static_cast<std::uint32_t>(std::countr_zero(mask)), best);
                }
                limit = time_limit(best.hit.t);
                return true;
            });
    } else {
        for (std::uint32_t slot = 0; slot < impl.bvh.triangles.size(); ++slot)
            consider(impl, query, slot, best);
    }
    if (best.triangle == no_id) return std::nullopt;

    const LeafTriangle& leaf = impl.bvh.triangles[best.slot];
    const Touch touch = touch_of(SphereTriangle(leaf, query), leaf, query, best.hit);
    // Sphere space can overflow for radii and coordinates at the ends of double's range.
    if (!finite(touch.point) || !(dot(touch.normal, touch.normal) > 0.0)) return std::nullopt;
    return Contact{best.hit.t,
                   vec(touch.normal),
                   vec(touch.point),
                   leaf.id,
                   world.triangle_face(leaf.id),
                   impl.surface_of(leaf.id),
                   best.hit.feature};
}

}  // namespace slipface
