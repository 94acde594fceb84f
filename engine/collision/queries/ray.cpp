#include <algorithm>

#include "impl.h"
#include "queries/first_of.h"
#include "queries/near.h"
#include "queries/paths.h"
#include "queries/sight.h"
#include "slipface/collision/filter.h"
#include "slipface/collision/neighbourhood.h"

namespace slipface {
namespace {

using namespace detail;

ShearedRay sheared_ray(const V3& start, const V3& direction) {
    const double d[3] = {direction.x, direction.y, direction.z};
    int kz = 0;
    for (int axis = 1; axis < 3; ++axis) {
        if (std::fabs(d[axis]) > std::fabs(d[kz])) kz = axis;
    }
    const int kx = (kz + 1) % 3, ky = (kz + 2) % 3;
    return {kx, ky, kz, d[kx] / d[kz], d[ky] / d[kz], 1.0 / d[kz], {start.x, start.y, start.z}};
}

RayPath ray_path(const ShearedRay& ray, const V3& start, const V3& direction, double reach) {
    RayPath path;
    path.box = box_path(Three(start), Three(direction), Three::all(1e-14 * reach));
    split(Three(start), Three::all(1.0), path.centre, path.rest);
    path.kx = ray.kx;
    path.ky = ray.ky;
    path.kz = ray.kz;
    path.sx = static_cast<float>(ray.sx);
    path.sy = static_cast<float>(ray.sy);
    path.usable = true;
    return path;
}

struct Search {
    const CollisionWorld::Impl& world;
    const ShearedRay& ray;
    V3 direction;
    RayStops stops;
    const QueryFilter* filter;  // null: all triangles are seen
    RayTouch touch;
    LeafTriangle triangle = no_triangle();
    const Kernels& kernels = detail::kernels();

    // As an aggregate it would be filled with zeros first. `limit`: the largest t that counts.
    Search(const CollisionWorld::Impl& of, const ShearedRay& along, const V3& its_direction, RayStops at,
           const QueryFilter* seen, double limit)
        : world(of),
          ray(along),
          direction(its_direction),
          stops(at),
          filter(seen),
          touch{limit, {0.0, 0.0, 0.0}} {}

    bool stopped_by(const LeafTriangle& leaf) const {
        if (filter != nullptr && !filter->sees(leaf.id, world.surface_of(leaf.id))) return false;
        const SurfaceRule rule = world.rule_of(leaf.id);
        return rule.solid == (filter == nullptr || filter->solid) &&
               !(stops == RayStops::as_movement && rule.one_sided &&
                 dot(winding_normal(leaf), direction) > 0.0);
    }
    void consider(const LeafTriangle& leaf) {
        RayTouch other;
        if (!kernels.ray_triangle(leaf, ray, other)) return;
        if (!(other.t < touch.t || (other.t == touch.t && leaf.id < triangle.id))) return;
        if (!stopped_by(leaf)) return;
        touch = other;
        triangle = leaf;
    }
};

float consider_lane(void* context, const Leaf& leaf, std::uint32_t lane) {
    Search& search = *static_cast<Search*>(context);
    search.consider(leaf_triangle(leaf, lane));
    return time_limit(search.touch.t);
}

// A ray whose arguments are valid, at a scale without overflow.
struct Ray {
    V3 start, direction;
    int exponent;  // direction = the caller's times 2 to the power of minus this
    double reach;  // of the ray's start and of the world
    ShearedRay sheared;
    RayPath path;

    // False if an argument is invalid. Scaling by a power of two brings the direction near unit size without
    // rounding. For usual lengths it would change no bit and is skipped.
    bool prepare(const Sight& sight, const Vec3& origin, const Vec3& along, double max_t) {
        if (sight.world.empty() || !origin.allFinite() || !along.allFinite() || along.isZero(0.0) ||
            !(max_t >= 0.0))
            return false;
        start = v3(origin);
        direction = v3(along);
        exponent = 0;
        if (const double size = largest(direction); !(size > 1e-6 && size < 1e6)) {
            std::frexp(size, &exponent);
            direction = {std::ldexp(direction.x, -exponent), std::ldexp(direction.y, -exponent),
                         std::ldexp(direction.z, -exponent)};
        }
        reach = larger(largest(start), sight.extent->reach);
        sheared = sheared_ray(start, direction);
        path = ray_path(sheared, start, direction, reach);
        return true;
    }
    double scaled(double t) const { return exponent == 0 ? t : std::ldexp(t, exponent); }
    double unscaled(double t) const { return exponent == 0 ? t : std::ldexp(t, -exponent); }

    Search search(const CollisionWorld::Impl& world, double max_t, RayStops stops,
                  const QueryFilter* filter) const {
        return {world, sheared, direction, stops, filter, scaled(max_t)};
    }
    std::optional<RayHit> hit(const Search& search) const {
        if (search.triangle.id == no_id || !std::isfinite(unscaled(search.touch.t))) return std::nullopt;
        return hit(search.world, search.triangle, search.touch);
    }
    RayHit hit(const CollisionWorld::Impl& world, const LeafTriangle& leaf, const RayTouch& touch) const {
        const V3& weights = touch.weights;
        const V3 winding = winding_normal(leaf);
        const bool back_face = dot(winding, direction) > 0.0;
        V3 normal = (back_face ? -1.0 : 1.0) * winding;
        if (!(dot(normal, normal) > 0.0)) normal = unit(-direction);
        const V3 point =
            weights.x * corner(leaf, 0) + weights.y * corner(leaf, 1) + weights.z * corner(leaf, 2);
        return {unscaled(touch.t), vec(point), vec(normal), leaf.id, world.face_of(leaf.id), back_face};
    }
};

// The first hit in the world; `search` may have found one already.
std::optional<RayHit> first_hit(const Ray& ray, const Sight& sight, Search& search) {
    if (ray.reach <= float_range && sight.has_tree) {
        kernels().ray(sight.view, ray.start, ray.direction, ray.path, time_limit(search.touch.t),
                      consider_lane, &search);
    } else {
        for (TriangleId id = 0; id < sight.world.triangle_count(); ++id)
            search.consider(sight.triangle(id));
    }
    return ray.hit(search);
}

std::optional<RayHit> first_hit(const Sight& sight, const Vec3& origin, const Vec3& direction, double max_t,
                                RayStops stops, const QueryFilter* filter) {
    Ray ray;
    if (!ray.prepare(sight, origin, direction, max_t)) return std::nullopt;
    Search search = ray.search(sight.world, max_t, stops, filter);
    return first_hit(ray, sight, search);
}

}  // namespace

std::optional<RayHit> cast_ray(const CollisionWorld& world, const Vec3& origin, const Vec3& direction,
                               double max_t, RayStops stops) {
    return first_hit(Sight(world.impl()), origin, direction, max_t, stops, nullptr);
}

std::optional<RayHit> cast_ray(const Neighbourhood& near, const Vec3& origin, const Vec3& direction,
                               double max_t, RayStops stops) {
    const CollisionWorld::Impl& impl = near.world().impl();
    const Sight sight(impl);
    Ray ray;
    if (!ray.prepare(sight, origin, direction, max_t)) return std::nullopt;
    Search search = ray.search(impl, max_t, stops, near.filter());
    const NearTriangles& triangles = near.triangles();
    if (covers(triangles, origin)) {
        std::uint32_t list[near_capacity];
        const std::uint32_t count = kernels().near_ray(triangles, ray.path, list);
        for (std::uint32_t i = 0; i < count; ++i)
            search.consider(near_triangle(triangles, list[i]));
        // All triangles are known up to there.
        if (covers(triangles, origin + search.touch.t * vec(ray.direction))) return ray.hit(search);
    }
    return first_hit(ray, sight, search);
}

std::optional<RayHit> cast_ray(const CollisionWorld& world, const Vec3& origin, const Vec3& direction,
                               double max_t, RayStops stops, const QueryFilter& filter) {
    return first_hit(Sight(world.impl()), origin, direction, max_t, stops, &filter);
}

namespace {

std::size_t all_hits(const Sight& sight, const Vec3& origin, const Vec3& direction, double max_t,
                     RayStops stops, std::span<RayHit> out, const QueryFilter& filter) {
    const CollisionWorld::Impl& impl = sight.world;
    Ray ray;
    if (!ray.prepare(sight, origin, direction, max_t)) return 0;
    struct All {
        const Ray& ray;
        Search rule;
        FirstOf<RayHit> hits;
        double limit;

        void consider(const LeafTriangle& leaf) {
            RayTouch touch{};
            if (!rule.kernels.ray_triangle(leaf, ray.sheared, touch) || touch.t > limit ||
                !rule.stopped_by(leaf))
                return;
            if (std::isfinite(ray.unscaled(touch.t))) hits.add(ray.hit(rule.world, leaf, touch));
        }
        static float consider_lane(void* context, const Leaf& leaf, std::uint32_t lane) {
            All& all = *static_cast<All*>(context);
            all.consider(leaf_triangle(leaf, lane));
            return time_limit(all.limit);
        }
    };
    const auto before = [](const RayHit& a, const RayHit& b) {
        return a.t != b.t ? a.t < b.t : a.triangle < b.triangle;
    };
    All all{ray, {impl, ray.sheared, ray.direction, stops, &filter, 0.0}, {out, before}, ray.scaled(max_t)};
    if (ray.reach <= float_range && sight.has_tree) {
        kernels().ray(sight.view, ray.start, ray.direction, ray.path, time_limit(all.limit),
                      All::consider_lane, &all);
    } else {
        for (TriangleId id = 0; id < impl.triangle_count(); ++id)
            all.consider(sight.triangle(id));
    }
    return all.hits.finish();
}

}  // namespace

std::size_t find_ray_hits(const CollisionWorld& world, const Vec3& origin, const Vec3& direction,
                          double max_t, RayStops stops, std::span<RayHit> out, const QueryFilter& filter) {
    return all_hits(Sight(world.impl()), origin, direction, max_t, stops, out, filter);
}

std::optional<RayHit> cast_ray(const PosedWorld& world, const Vec3& origin, const Vec3& direction,
                               double max_t, RayStops stops, const QueryFilter& filter) {
    auto hit = first_hit(PosedSight(world), origin - world.origin(), direction, max_t, stops, &filter);
    if (hit) hit->point += world.origin();
    return hit;
}

std::size_t find_ray_hits(const PosedWorld& world, const Vec3& origin, const Vec3& direction, double max_t,
                          RayStops stops, std::span<RayHit> out, const QueryFilter& filter) {
    const std::size_t found =
        all_hits(PosedSight(world), origin - world.origin(), direction, max_t, stops, out, filter);
    for (RayHit& hit : out.first(std::min(found, out.size())))
        hit.point += world.origin();
    return found;
}

}  // namespace slipface
