#include "impl.h"
#include "leaf_filter.h"
#include "sphere_triangle.h"
#include "traverse.h"

namespace slipface {
namespace {

using namespace detail;

// Calls visit(slot) for the triangles that the ellipsoid at rest may overlap, until it returns false.
template <class Visit>
void visit_near(const CollisionWorld::Impl& world, const EllipsoidQuery& query, Visit&& visit) {
    const double reach = std::fmax(largest(query.centre), world.reach);
    const double least = std::fmin(std::fmin(query.radii.x, query.radii.y), query.radii.z);
    if (!in_float_range(least) || !in_float_range(largest(query.radii)) || reach > float_range) {
        for (std::uint32_t slot = 0; slot < world.bvh.triangles.size(); ++slot) {
            if (!visit(slot)) return;
        }
        return;
    }
    const BoxPath path(query.centre, query.move, box_half_extents(query.radii, query.move, reach));
    const LeafFilter filter(query, path, reach);
    walk_ordered(
        world.bvh, [&](const BvhNode& node, float* keys) { return path.meet(node, 1.0F, keys); },
        [] { return 1.0F; },
        [&](std::uint32_t first, std::uint32_t count) {
            std::uint32_t mask = filter.candidates(&world.bvh.triangles[first], count, 1.0F);
            for (; mask != 0; mask &= mask - 1) {
                if (!visit(first + static_cast<std::uint32_t>(std::countr_zero(mask)))) return false;
            }
            return true;
        });
}

bool refused(const CollisionWorld::Impl& world, const Vec3& radii, const Vec3& centre) {
    return world.bvh.nodes.empty() || !radii.allFinite() || !(radii.minCoeff() > 0.0) || !centre.allFinite();
}

// The rule that sweeps follow: what is not solid, or one-sided and seen from behind, is not there.
bool stands(const CollisionWorld::Impl& world, const SphereTriangle& triangle, TriangleId id) {
    const SurfaceRule& rule = world.rule_of(id);
    return rule.solid && !(rule.one_sided && is_behind(triangle));
}

}  // namespace

std::size_t find_overlaps(const CollisionWorld& world, const Vec3& radii, const Vec3& centre,
                          std::span<Overlap> out) {
    const CollisionWorld::Impl& impl = world.impl();
    if (refused(impl, radii, centre)) return 0;
    const EllipsoidQuery query(v3(centre), v3(radii), V3{0.0, 0.0, 0.0});
    const auto by_triangle = [](const Overlap& a, const Overlap& b) { return a.triangle < b.triangle; };
    std::size_t found = 0;
    std::size_t kept = 0;
    visit_near(impl, query, [&](std::uint32_t slot) {
        const LeafTriangle& leaf = impl.bvh.triangles[slot];
        const SphereTriangle triangle(leaf, query);
        const Nearest nearest = nearest_part(triangle);
        if (!(nearest.distance2 < 1.0) || !stands(impl, triangle, leaf.id)) return true;
        ++found;
        // `out` is a heap with the highest triangle on top, so that the lowest ones stay whatever the
        // visiting order.
        const auto end = out.begin() + static_cast<std::ptrdiff_t>(kept);
        if (kept == out.size()) {
            if (kept == 0 || leaf.id > out[0].triangle) return true;
            std::pop_heap(out.begin(), end, by_triangle);
            --kept;
        }
        const Touch touch = touch_of(triangle, leaf, query, nearest);
        out[kept++] = {leaf.id,
                       world.triangle_face(leaf.id),
                       impl.surface_of(leaf.id),
                       nearest.feature,
                       vec(touch.point),
                       vec(touch.normal),
                       1.0 - std::sqrt(nearest.distance2)};
        std::push_heap(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(kept), by_triangle);
        return true;
    });
    std::sort_heap(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(kept), by_triangle);
    return found;
}

bool overlaps_any(const CollisionWorld& world, const Vec3& radii, const Vec3& centre) {
    const CollisionWorld::Impl& impl = world.impl();
    if (refused(impl, radii, centre)) return false;
    const EllipsoidQuery query(v3(centre), v3(radii), V3{0.0, 0.0, 0.0});
    bool found = false;
    visit_near(impl, query, [&](std::uint32_t slot) {
        const LeafTriangle& leaf = impl.bvh.triangles[slot];
        const SphereTriangle triangle(leaf, query);
        found = nearest_part(triangle).distance2 < 1.0 && stands(impl, triangle, leaf.id);
        return !found;
    });
    return found;
}

std::vector<TriangleId> CollisionWorld::triangles_in(const Aabb& box) const {
    std::vector<TriangleId> found;
    if (impl_->bvh.nodes.empty()) return found;
    const auto meets = [&box](int axis, double low, double high) {
        return low <= box.max[axis] && high >= box.min[axis];
    };
    walk_ordered(
        impl_->bvh,
        [&](const BvhNode& node, float* keys) {
            std::uint32_t mask = 0;
            for (int k = 0; k < 8; ++k) {
                keys[k] = 0.0F;
                bool met = node.bound[0][k] <= node.bound[3][k];
                for (int axis = 0; axis < 3; ++axis)
                    met = met && meets(axis, node.bound[axis][k], node.bound[axis + 3][k]);
                mask |= static_cast<std::uint32_t>(met) << k;
            }
            return mask;
        },
        [] { return 0.0F; },
        [&](std::uint32_t first, std::uint32_t count) {
            for (std::uint32_t slot = first; slot < first + count; ++slot) {
                const LeafTriangle& leaf = impl_->bvh.triangles[slot];
                bool met = true;
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const auto [low, high] = std::minmax({leaf.v[axis], leaf.v[axis + 3], leaf.v[axis + 6]});
                    met = met && meets(static_cast<int>(axis), double{low}, double{high});
                }
                if (met) found.push_back(leaf.id);
            }
            return true;
        });
    std::sort(found.begin(), found.end());
    return found;
}

}  // namespace slipface
