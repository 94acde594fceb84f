#include <algorithm>

#include "impl.h"
#include "queries/first_of.h"
#include "queries/near.h"
#include "queries/paths.h"
#include "queries/sphere_triangle.h"
#include "slipface/collision/filter.h"
#include "slipface/collision/neighbourhood.h"

namespace slipface {
namespace {

using namespace detail;

// A ray whose direction is sheared onto one axis (S. Woop, C. Benthin, I. Wald, "Watertight Ray/Triangle
// Intersection", 2013). The sheared coordinates of a corner depend on the corner alone, and an edge function
// changes exactly its sign with the direction of the edge. So neighbours agree about a ray through their
// border; zero counts as inside for both.
struct ShearedRay {
    int kx, ky, kz;
    double sx, sy, sz;
    double origin[3];

    ShearedRay(const V3& start, const V3& direction) : origin{start.x, start.y, start.z} {
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

    // The corners relative to the origin, along an axis of the world.
    Three along(int axis, const LeafTriangle& triangle) const {
        return Three(Four::load(triangle.at[axis])) - Three::all(origin[axis]);
    }
    Threes shear(const LeafTriangle& triangle) const {
        const Three z = along(kz, triangle);
        return {along(kx, triangle) - Three::all(sx) * z, along(ky, triangle) - Three::all(sy) * z,
                Three::all(sz) * z};
    }
};

struct RayTouch {
    double t;
    V3 weights;  // barycentric
};

// A triangle whose sides, seen along the ray, are less than this fraction of its size apart counts as in line
// with the ray: rounding would decide on which side the ray passes.
constexpr double in_line = 0x1p-40;

// True if the ray passes between the ends of the longest edge. The two long sides of a needle are too close
// to parallel to show where it ends. The slack is for rays through a corner, on which all triangles around it
// must agree.
bool between_ends(const ShearedRay& ray, const LeafTriangle& triangle, const Threes& sheared) {
    const Threes edge = sheared.next() - sheared;
    double square[4], index[4];  // per edge: squared length; position along it, times the squared length
    (edge.x * edge.x + edge.y * edge.y).store(square);
    (-(sheared.x * edge.x + sheared.y * edge.y)).store(index);
    int longest = square[1] > square[0] ? 1 : 0;
    if (square[2] > square[longest]) longest = 2;
    if (index[longest] >= 0.0 && index[longest] <= square[longest]) return true;
    double away = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        away = larger(away, largest(ray.along(axis, triangle).vec()));
    const double slack = 4e-15 * away * std::sqrt(square[longest]);
    return index[longest] >= -slack && index[longest] <= square[longest] + slack;
}

bool intersect(const ShearedRay& ray, const LeafTriangle& triangle, RayTouch& touch) {
    const Threes corners = ray.shear(triangle);
    const Threes second = corners.next(), third = second.next();
    // The edge functions of the sides opposite to each corner.
    const Three left = third.x * second.y, right = third.y * second.x;
    const Three side = left - right;
    const Three zero = Three::all(0.0);
    if (any_less(side, zero) && any_less(zero, side)) return false;
    const double determinant = side.sum();
    // The ray lies in the triangle's plane: only the triangle's neighbours can stop it.
    const double size = (left.abs() + right.abs()).sum();
    if (!(std::fabs(determinant) > in_line * size) || !between_ends(ray, triangle, corners)) return false;
    const Three weights = side / Three::all(determinant);
    touch.weights = weights.vec();
    touch.t = (weights * corners.z).sum();
    return touch.t >= 0.0;
}

struct Search {
    const CollisionWorld::Impl& world;
    const ShearedRay& ray;
    V3 direction;
    RayStops stops;
    const QueryFilter* filter;  // null: all triangles are seen
    RayTouch touch;
    LeafTriangle triangle = no_triangle();

    bool stopped_by(const LeafTriangle& leaf) const {
        if (filter != nullptr && !filter->sees(leaf.id, world.surface_of(leaf.id))) return false;
        const SurfaceRule rule = world.rule_of(leaf.id);
        return rule.solid && !(stops == RayStops::as_movement && rule.one_sided &&
                               dot(winding_normal(leaf), direction) > 0.0);
    }
    void consider(const LeafTriangle& leaf) {
        RayTouch other{};
        if (!intersect(ray, leaf, other)) return;
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
    ShearedRay sheared;
    double reach;  // of the ray's start and of the world

    // Scaling by a power of two brings the direction near unit size without rounding. For usual lengths it
    // would change no bit and is skipped.
    static std::optional<Ray> of(const CollisionWorld::Impl& world, const Vec3& origin, const Vec3& direction,
                                 double max_t) {
        if (world.empty() || !origin.allFinite() || !direction.allFinite() || direction.isZero(0.0) ||
            !(max_t >= 0.0))
            return std::nullopt;
        V3 d = v3(direction);
        int exponent = 0;
        if (const double size = largest(d); !(size > 1e-6 && size < 1e6)) {
            std::frexp(size, &exponent);
            d = {std::ldexp(d.x, -exponent), std::ldexp(d.y, -exponent), std::ldexp(d.z, -exponent)};
        }
        const V3 start = v3(origin);
        return Ray{start, d, exponent, ShearedRay(start, d), larger(largest(start), world.extent.reach)};
    }
    double scaled(double t) const { return exponent == 0 ? t : std::ldexp(t, exponent); }
    double unscaled(double t) const { return exponent == 0 ? t : std::ldexp(t, -exponent); }

    Search search(const CollisionWorld::Impl& world, double max_t, RayStops stops,
                  const QueryFilter* filter) const {
        return {world, sheared, direction, stops, filter, {scaled(max_t), {0.0, 0.0, 0.0}}};
    }
    std::optional<RayHit> hit(const Search& search) const {
        if (search.triangle.id == no_id || !std::isfinite(unscaled(search.touch.t))) return std::nullopt;
        return hit(search.world, search.triangle, search.touch);
    }
    RayHit hit(const CollisionWorld::Impl& world, const LeafTriangle& leaf, const RayTouch& touch) const {
        const V3& weights = touch.weights;
        const V3 winding = winding_normal(leaf);
        const bool back_face = dot(winding, direction) > 0.0;
        V3 normal = back_face ? -winding : winding;
        if (!(dot(normal, normal) > 0.0)) normal = unit(-direction);
        const V3 point =
            weights.x * corner(leaf, 0) + weights.y * corner(leaf, 1) + weights.z * corner(leaf, 2);
        return {unscaled(touch.t), vec(point), vec(normal), leaf.id, world.face_of(leaf.id), back_face};
    }
};

RayPath ray_path(const Ray& ray) {
    RayPath path;
    const double half = 1e-14 * ray.reach;
    path.box = box_path(Three(ray.start), Three(ray.direction), Three::all(half));
    split(Three(ray.start), Three::all(1.0), path.centre, path.rest);
    path.kx = ray.sheared.kx;
    path.ky = ray.sheared.ky;
    path.kz = ray.sheared.kz;
    path.sx = static_cast<float>(ray.sheared.sx);
    path.sy = static_cast<float>(ray.sheared.sy);
    path.usable = true;
    return path;
}

// The first hit in the world; `search` may have found one already.
std::optional<RayHit> first_hit(const Ray& ray, const RayPath& path, Search& search) {
    const CollisionWorld::Impl& impl = search.world;
    if (ray.reach <= float_range) {
        kernels().ray(impl.view(), ray.start, ray.direction, path, time_limit(search.touch.t), consider_lane,
                      &search);
    } else {
        for (TriangleId id = 0; id < impl.triangle_count(); ++id)
            search.consider(impl.triangle(id));
    }
    return ray.hit(search);
}

std::optional<RayHit> first_hit(const CollisionWorld& world, const Vec3& origin, const Vec3& direction,
                                double max_t, RayStops stops, const QueryFilter* filter) {
    const std::optional<Ray> ray = Ray::of(world.impl(), origin, direction, max_t);
    if (!ray) return std::nullopt;
    Search search = ray->search(world.impl(), max_t, stops, filter);
    return first_hit(*ray, ray_path(*ray), search);
}

}  // namespace

std::optional<RayHit> cast_ray(const CollisionWorld& world, const Vec3& origin, const Vec3& direction,
                               double max_t, RayStops stops) {
    return first_hit(world, origin, direction, max_t, stops, nullptr);
}

std::optional<RayHit> cast_ray(const Neighbourhood& near, const Vec3& origin, const Vec3& direction,
                               double max_t, RayStops stops) {
    const CollisionWorld::Impl& impl = near.world().impl();
    const std::optional<Ray> ray = Ray::of(impl, origin, direction, max_t);
    if (!ray) return std::nullopt;
    const RayPath path = ray_path(*ray);
    Search search = ray->search(impl, max_t, stops, nullptr);
    const NearTriangles& triangles = near.triangles();
    if (covers(triangles, origin)) {
        std::uint32_t list[near_capacity];
        const std::uint32_t count = kernels().near_ray(triangles, path, list);
        for (std::uint32_t i = 0; i < count; ++i)
            search.consider(near_triangle(triangles, list[i]));
        // All triangles are known up to there.
        if (covers(triangles, origin + search.touch.t * vec(ray->direction))) return ray->hit(search);
    }
    return first_hit(*ray, path, search);
}

std::optional<RayHit> cast_ray(const CollisionWorld& world, const Vec3& origin, const Vec3& direction,
                               double max_t, RayStops stops, const QueryFilter& filter) {
    return first_hit(world, origin, direction, max_t, stops, &filter);
}

std::size_t find_ray_hits(const CollisionWorld& world, const Vec3& origin, const Vec3& direction,
                          double max_t, RayStops stops, std::span<RayHit> out, const QueryFilter& filter) {
    const CollisionWorld::Impl& impl = world.impl();
    const std::optional<Ray> ray = Ray::of(impl, origin, direction, max_t);
    if (!ray) return 0;
    struct All {
        const Ray& ray;
        Search rule;
        FirstOf<RayHit> hits;
        double limit;

        void consider(const LeafTriangle& leaf) {
            RayTouch touch{};
            if (!intersect(ray.sheared, leaf, touch) || touch.t > limit || !rule.stopped_by(leaf)) return;
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
    All all{
        *ray, {impl, ray->sheared, ray->direction, stops, &filter, {}}, {out, before}, ray->scaled(max_t)};
    if (ray->reach <= float_range) {
        kernels().ray(impl.view(), ray->start, ray->direction, ray_path(*ray), time_limit(all.limit),
                      All::consider_lane, &all);
    } else {
        for (TriangleId id = 0; id < impl.triangle_count(); ++id)
            all.consider(impl.triangle(id));
    }
    return all.hits.finish();
}

}  // namespace slipface
