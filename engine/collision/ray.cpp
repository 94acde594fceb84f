#include "impl.h"
#include "sphere_triangle.h"
#include "traverse.h"

namespace slipface {
namespace {

using namespace detail;

// A ray whose direction is sheared onto one axis (S. Woop, C. Benthin, I. Wald, "Watertight Ray/Triangle
// Intersection", 2013). A corner's sheared coordinates depend on the corner alone and an edge function
// changes exactly its sign with the edge's direction, so neighbours agree about a ray through their border;
// zero counts as inside for both.
struct ShearedRay {
    V3 origin;
    int kx, ky, kz;
    double sx, sy, sz;

    ShearedRay(const V3& start, const V3& direction) : origin(start) {
        const double d[3] = {direction.x, direction.y, direction.z};
        kz = 0;
        for (int axis = 1; axis < 3; ++axis) {
            if (std::fabs(d[axis]) > std::fabs(d[kz])) kz = axis;
        }
        kx = (kz + 1) % 3;
        ky = (kz + 2) % 3;
        sx = d[kx] / d[kz];
        sy = d[ky] / d[kz];
        sz = 1.0 / d[kz];
    }

    V3 shear(const V3& world) const {
        const V3 r = world - origin;
        const double c[3] = {r.x, r.y, r.z};
        return {c[kx] - sx * c[kz], c[ky] - sy * c[kz], sz * c[kz]};
    }
};

struct RayTouch {
    double t;
    V3 weights;  // barycentric
};

bool meet(const ShearedRay& ray, const LeafTriangle& triangle, RayTouch& touch) {
    const V3 a = ray.shear(triangle.corner(0));
    const V3 b = ray.shear(triangle.corner(1));
    const V3 c = ray.shear(triangle.corner(2));
    const double u = c.x * b.y - c.y * b.x;
    const double v = a.x * c.y - a.y * c.x;
    const double w = b.x * a.y - b.y * a.x;
    if ((u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0)) return false;
    const double determinant = u + v + w;
    // The ray lies in the triangle's plane: its neighbours or nothing stop it.
    if (!(std::fabs(determinant) > 0.0)) return false;
    touch.weights = {u / determinant, v / determinant, w / determinant};
    touch.t = touch.weights.x * a.z + touch.weights.y * b.z + touch.weights.z * c.z;
    return touch.t >= 0.0;
}

}  // namespace

std::optional<RayHit> cast_ray(const CollisionWorld& world, const Vec3& origin, const Vec3& direction,
                               double max_t) {
    const CollisionWorld::Impl& impl = world.impl();
    if (impl.bvh.nodes.empty() || !origin.allFinite() || !direction.allFinite() || direction.isZero(0.0) ||
        !(max_t >= 0.0)) {
        return std::nullopt;
    }
    // A power of two brings the direction near unit size without a rounding, whatever its length.
    int exponent = 0;
    std::frexp(largest(v3(direction)), &exponent);
    const V3 d{std::ldexp(direction.x(), -exponent), std::ldexp(direction.y(), -exponent),
               std::ldexp(direction.z(), -exponent)};
    const V3 start = v3(origin);
    const ShearedRay ray(start, d);

    RayTouch best{std::ldexp(max_t, exponent), {0.0, 0.0, 0.0}};
    std::uint32_t best_slot = no_id;
    TriangleId best_triangle = no_id;
    const auto consider = [&](std::uint32_t slot) {
        const LeafTriangle& leaf = impl.bvh.triangles[slot];
        RayTouch touch{};
        if (!meet(ray, leaf, touch)) return;
        if (!(touch.t < best.t || (touch.t == best.t && leaf.id < best_triangle))) return;
        if (!impl.rule_of(leaf.id).solid) return;
        best = touch;
        best_slot = slot;
        best_triangle = leaf.id;
    };
    const double reach = std::fmax(largest(start), impl.reach);
    if (reach <= float_range) {
        const double half = 1e-14 * reach;
        const BoxPath path(start, d, {half, half, half});
        float limit = time_limit(best.t);
        walk_ordered(
            impl.bvh, [&](const BvhNode& node, float* keys) { return path.meet(node, limit, keys); },
            [&] { return limit; },
            [&](std::uint32_t first, std::uint32_t count) {
                const LeafLanes leaf(&impl.bvh.triangles[first], count);
                Lanes enter;
                std::uint32_t mask = path.meet(leaf, limit, enter) & leaf.present;
                for (; mask != 0; mask &= mask - 1)
                    consider(first + static_cast<std::uint32_t>(std::countr_zero(mask)));
                limit = time_limit(best.t);
                return true;
            });
    } else {
        for (std::uint32_t slot = 0; slot < impl.bvh.triangles.size(); ++slot)
            consider(slot);
    }
    const double t = std::ldexp(best.t, -exponent);
    if (best_triangle == no_id || !std::isfinite(t)) return std::nullopt;

    const LeafTriangle& leaf = impl.bvh.triangles[best_slot];
    const V3 winding = winding_normal(leaf);
    const bool back_face = dot(winding, d) > 0.0;
    V3 normal = back_face ? -winding : winding;
    if (!(dot(normal, normal) > 0.0)) normal = unit(-d);
    const V3 point =
        best.weights.x * leaf.corner(0) + best.weights.y * leaf.corner(1) + best.weights.z * leaf.corner(2);
    return RayHit{t, vec(point), vec(normal), best_triangle, world.triangle_face(best_triangle), back_face};
}

}  // namespace slipface
