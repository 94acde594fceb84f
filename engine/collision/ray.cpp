#include "impl.h"
#include "paths.h"
#include "sphere_triangle.h"

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

// Seen along the ray, a triangle whose sides are less than this share of its size apart is as good as in line
// with it: rounding decides on which side of them the ray passes.
constexpr double in_line = 0x1p-40;

// Whether the ray passes between the ends of the longest edge. A needle's two long sides part too little to
// say where it ends. The slack is for rays through a corner, which all triangles around it must see alike.
bool between_ends(const ShearedRay& ray, const LeafTriangle& triangle, const V3& a, const V3& b,
                  const V3& c) {
    const V3 corner[3] = {a, b, c};
    double longest = -1.0;
    double place = 0.0;  // along that edge, times its length
    double away = 0.0;
    for (int k = 0; k < 3; ++k) {
        const V3& from = corner[k];
        const V3& to = corner[k == 2 ? 0 : k + 1];
        const double x = to.x - from.x;
        const double y = to.y - from.y;
        if (const double square = x * x + y * y; square > longest) {
            longest = square;
            place = -(from.x * x + from.y * y);
        }
        away = larger(away, largest(triangle.corner(k) - ray.origin));
    }
    const double slack = 4e-15 * away * std::sqrt(longest);
    return place >= -slack && place <= longest + slack;
}

bool meet(const ShearedRay& ray, const LeafTriangle& triangle, RayTouch& touch) {
    const V3 a = ray.shear(triangle.corner(0));
    const V3 b = ray.shear(triangle.corner(1));
    const V3 c = ray.shear(triangle.corner(2));
    const double products[6] = {c.x * b.y, c.y * b.x, a.x * c.y, a.y * c.x, b.x * a.y, b.y * a.x};
    const double u = products[0] - products[1];
    const double v = products[2] - products[3];
    const double w = products[4] - products[5];
    if ((u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0)) return false;
    const double determinant = u + v + w;
    // The ray lies in the triangle's plane: its neighbours or nothing stop it.
    double size = 0.0;
    for (const double product : products)
        size += std::fabs(product);
    if (!(std::fabs(determinant) > in_line * size) || !between_ends(ray, triangle, a, b, c)) return false;
    touch.weights = {u / determinant, v / determinant, w / determinant};
    touch.t = touch.weights.x * a.z + touch.weights.y * b.z + touch.weights.z * c.z;
    return touch.t >= 0.0;
}

struct Search {
    const CollisionWorld::Impl& world;
    const ShearedRay& ray;
    RayTouch touch;
    LeafTriangle triangle{{}, no_id};

    void consider(const LeafTriangle& leaf) {
        RayTouch other{};
        if (!meet(ray, leaf, other)) return;
        if (!(other.t < touch.t || (other.t == touch.t && leaf.id < triangle.id))) return;
        if (!world.rule_of(leaf.id).solid) return;
        touch = other;
        triangle = leaf;
    }
};

float consider_lane(void* context, const Leaf& leaf, std::uint32_t lane) {
    Search& search = *static_cast<Search*>(context);
    search.consider(leaf_triangle(leaf, lane));
    return time_limit(search.touch.t);
}

RayPath ray_path(const ShearedRay& ray, const V3& direction, double reach) {
    RayPath path;
    const double half = 1e-14 * reach;
    path.box = box_path(Three(ray.origin), Three(direction), Three::all(half));
    split(Three(ray.origin), Three::all(1.0), path.centre, path.rest);
    path.kx = ray.kx;
    path.ky = ray.ky;
    path.kz = ray.kz;
    path.sx = static_cast<float>(ray.sx);
    path.sy = static_cast<float>(ray.sy);
    path.usable = true;
    return path;
}

}  // namespace

std::optional<RayHit> cast_ray(const CollisionWorld& world, const Vec3& origin, const Vec3& direction,
                               double max_t) {
    const CollisionWorld::Impl& impl = world.impl();
    if (impl.bvh.nodes.empty() || !origin.allFinite() || !direction.allFinite() || direction.isZero(0.0) ||
        !(max_t >= 0.0)) {
        return std::nullopt;
    }
    // A power of two brings the direction near unit size without a rounding, whatever its length; where that
    // is far from float's ends it changes no bit and is left out.
    V3 d = v3(direction);
    int exponent = 0;
    if (const double size = largest(d); !(size > 1e-6 && size < 1e6)) {
        std::frexp(size, &exponent);
        d = {std::ldexp(d.x, -exponent), std::ldexp(d.y, -exponent), std::ldexp(d.z, -exponent)};
    }
    const V3 start = v3(origin);
    const ShearedRay ray(start, d);

    Search search{impl, ray, {exponent == 0 ? max_t : std::ldexp(max_t, exponent), {0.0, 0.0, 0.0}}};
    const double reach = larger(largest(start), impl.reach);
    if (reach <= float_range) {
        kernels().ray(impl.bvh.view(), ray_path(ray, d, reach), time_limit(search.touch.t), consider_lane,
                      &search);
    } else {
        for (TriangleId id = 0; id < impl.triangle_count(); ++id)
            search.consider(impl.bvh.triangle(id));
    }
    const double t = exponent == 0 ? search.touch.t : std::ldexp(search.touch.t, -exponent);
    if (search.triangle.id == no_id || !std::isfinite(t)) return std::nullopt;

    const LeafTriangle& leaf = search.triangle;
    const V3& weights = search.touch.weights;
    const V3 winding = winding_normal(leaf);
    const bool back_face = dot(winding, d) > 0.0;
    V3 normal = back_face ? -winding : winding;
    if (!(dot(normal, normal) > 0.0)) normal = unit(-d);
    const V3 point = weights.x * leaf.corner(0) + weights.y * leaf.corner(1) + weights.z * leaf.corner(2);
    return RayHit{t, vec(point), vec(normal), leaf.id, impl.face_of(leaf.id), back_face};
}

}  // namespace slipface
