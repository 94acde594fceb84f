#include "sphere_triangle.h"

#include <algorithm>
#include <limits>
#include <tuple>

namespace slipface::detail {
namespace {

// a b - c d with one rounding in effect (W. Kahan): the products' own rounding errors are put back.
double difference_of_products(double a, double b, double c, double d) {
    const double cd = c * d;
    return std::fma(a, b, -cd) + std::fma(-c, d, cd);
}

V3 exact_cross(const V3& a, const V3& b) {
    return {difference_of_products(a.y, b.z, a.z, b.y), difference_of_products(a.z, b.x, a.x, b.z),
            difference_of_products(a.x, b.y, a.y, b.x)};
}

// Squared sines between two edges, free of scale: below the first the plain cross product loses too much,
// below the second the corners' own precision does not say where the plane is.
constexpr double plane_sine2 = 1e-8;
constexpr double flat_sine2 = 1e-18;

// e1 x e2 of a triangle's edges in world space, zero if the edges are parallel to within what the corners'
// own precision resolves.
V3 face_vector(const V3& e1, const V3& e2) {
    const V3 plain = cross(e1, e2);
    const double product = dot(e1, e1) * dot(e2, e2);
    if (dot(plain, plain) > plane_sine2 * product) return plain;
    const V3 careful = exact_cross(e1, e2);
    if (dot(careful, careful) > flat_sine2 * product) return careful;
    return {0.0, 0.0, 0.0};
}

// Whether x, a point of the plane, lies in the triangle. `corner_from_x` are the corners relative to x.
bool inside(const SphereTriangle& triangle, const V3 (&corner_from_x)[3]) {
    return dot(triangle.n, cross(corner_from_x[0], triangle.e[0])) >= 0.0 &&
           dot(triangle.n, cross(corner_from_x[1], triangle.e[1])) >= 0.0 &&
           dot(triangle.n, cross(corner_from_x[2], triangle.e[2])) >= 0.0;
}

// An edge seen from the centre: from its nearer end p along e. Neighbours name a shared edge in either
// direction; the choice of the end makes their arithmetic, and so their bits, the same.
struct Edge {
    V3 p;
    V3 e;
    double ee;
    int from;  // corner numbers
    int to;
};

Edge edge_of(const SphereTriangle& triangle, int k) {
    const int next = k == 2 ? 0 : k + 1;
    const V3& p = triangle.a[k];
    const V3& q = triangle.a[next];
    const V3& e = triangle.e[k];
    const double pp = dot(p, p);
    const double qq = dot(q, q);
    const auto lexicographic = [](const V3& l, const V3& r) {
        return std::tie(l.x, l.y, l.z) <= std::tie(r.x, r.y, r.z);
    };
    if (pp < qq || (pp == qq && lexicographic(p, q))) return {p, e, dot(e, e), k, next};
    return {q, -e, dot(e, e), next, k};
}

// The move against the line of an edge.
struct EdgePath {
    V3 w;      // the centre as seen from the line's foot at t = 0
    V3 dw;     // its change with t; both perpendicular to the edge
    double s;  // the foot's place on the edge at t = 0
    double ds;
};

EdgePath edge_path(const Edge& edge, const V3& d) {
    const double s = -dot(edge.p, edge.e) / edge.ee;
    const double ds = dot(d, edge.e) / edge.ee;
    return {-edge.p - s * edge.e, d - ds * edge.e, s, ds};
}

// Smallest t >= lower at which |w + t dw| falls to 1, in the form that starts from the foot point of the
// perpendicular: nothing large is subtracted. False if it never does, or if it is not approaching at t = 0.
bool first_root(const V3& w, const V3& dw, double lower, double& t) {
    const double aa = dot(dw, dw);
    if (!(aa > 0.0)) return false;
    const double foot = -dot(w, dw) / aa;
    if (!(foot > 0.0)) return false;
    const V3 closest = w + foot * dw;
    const double disc = 1.0 - dot(closest, closest);
    if (!(disc > 0.0)) return false;
    t = foot - std::sqrt(disc / aa);
    // Below `lower` only by rounding: the caller knows that nothing is touched before it.
    if (!(t >= lower)) t = lower;
    return true;
}

void keep_first(TriangleHit& best, const TriangleHit& hit) {
    if (hit.t < best.t || (hit.t == best.t && hit.feature < best.feature)) best = hit;
}

// The first touch of an edge or a corner at or after `lower`; t = 2 if there is none.
TriangleHit first_border_touch(const SphereTriangle& triangle, const EllipsoidQuery& query, double lower) {
    TriangleHit best{2.0, Feature::vertex, 0, false};
    for (int k = 0; k < 3; ++k) {
        const Edge edge = edge_of(triangle, k);
        if (!(edge.ee > 0.0)) continue;
        const EdgePath path = edge_path(edge, query.d);
        double t = 0.0;
        if (!first_root(path.w, path.dw, lower, t)) continue;
        const double s = path.s + t * path.ds;
        if (s >= 0.0 && s <= 1.0) keep_first(best, {t, Feature::edge, k, false});
    }
    for (int k = 0; k < 3; ++k) {
        double t = 0.0;
        if (first_root(-triangle.a[k], query.d, lower, t)) keep_first(best, {t, Feature::vertex, k, false});
    }
    return best;
}

Nearest nearest_border(const SphereTriangle& triangle) {
    Nearest best{0.0, Feature::vertex, -1, 0.0};
    for (int k = 0; k < 3; ++k) {
        const Edge edge = edge_of(triangle, k);
        Nearest here{dot(edge.p, edge.p), Feature::vertex, edge.from, 0.0};
        if (edge.ee > 0.0) {
            const double s = -dot(edge.p, edge.e) / edge.ee;
            if (s > 0.0 && s < 1.0) {
                const V3 q = edge.p + s * edge.e;
                here = {dot(q, q), Feature::edge, k, s};
            }
        }
        if (best.part < 0 || here.distance2 < best.distance2 ||
            (here.distance2 == best.distance2 && here.feature < best.feature)) {
            best = here;
        }
    }
    return best;
}

// The nearest point itself; not for the interior.
V3 border_point(const SphereTriangle& triangle, const Nearest& nearest) {
    if (nearest.feature == Feature::vertex) return triangle.a[nearest.part];
    const Edge edge = edge_of(triangle, nearest.part);
    return edge.p + nearest.s * edge.e;
}

// a / b for each component, times the power of two that brings the largest to about 1.
V3 scaled_quotient(const V3& a, const V3& b) {
    const double top[3] = {a.x, a.y, a.z};
    const double bottom[3] = {b.x, b.y, b.z};
    double quotient[3];
    int exponent[3];
    int largest_exponent = std::numeric_limits<int>::min();
    for (int i = 0; i < 3; ++i) {
        int above = 0;
        int below = 0;
        quotient[i] = std::frexp(top[i], &above) / std::frexp(bottom[i], &below);
        exponent[i] = above - below;
        if (quotient[i] != 0.0) largest_exponent = std::max(largest_exponent, exponent[i]);
    }
    for (int i = 0; i < 3; ++i) {
        quotient[i] = quotient[i] == 0.0 ? 0.0 : std::ldexp(quotient[i], exponent[i] - largest_exponent);
    }
    return {quotient[0], quotient[1], quotient[2]};
}

// A normal in sphere space as the unit normal of the ellipsoid in world space (inverse transpose).
V3 world_normal(const V3& sphere, const EllipsoidQuery& query) {
    const V3 world = mul(sphere, query.inverse);
    const double size = largest(world);
    // Radii at the ends of double's range overflow the plain product.
    return unit(size > 1e-100 && size < 1e100 ? world : scaled_quotient(sphere, query.radii));
}

V3 edge_point_world(const LeafTriangle& leaf, const Edge& edge, double s) {
    const V3 from = leaf.corner(edge.from);
    return from + s * (leaf.corner(edge.to) - from);
}

// Some direction away from a triangle whose border passes exactly through the centre.
V3 direction_without_distance(const SphereTriangle& triangle) {
    if (triangle.nn > 0.0) return unit(triangle.n);
    V3 longest = triangle.e[0];
    for (int k = 1; k < 3; ++k) {
        if (dot(triangle.e[k], triangle.e[k]) > dot(longest, longest)) longest = triangle.e[k];
    }
    const V3 across = unit(V3{-longest.y, longest.x, 0.0});
    return dot(across, across) > 0.0 ? across : V3{0.0, 1.0, 0.0};
}

// Sphere-space normal at the nearest part, unit, towards the centre.
V3 nearest_normal(const SphereTriangle& triangle, const Nearest& nearest) {
    if (nearest.feature == Feature::interior) return unit(triangle.h > 0.0 ? -triangle.n : triangle.n);
    const V3 away = unit(-border_point(triangle, nearest));
    return dot(away, away) > 0.0 ? away : direction_without_distance(triangle);
}

}  // namespace

SphereTriangle::SphereTriangle(const LeafTriangle& triangle, const EllipsoidQuery& query) {
    const V3 w[3] = {triangle.corner(0), triangle.corner(1), triangle.corner(2)};
    const V3 edge[3] = {w[1] - w[0], w[2] - w[1], w[0] - w[2]};
    for (int k = 0; k < 3; ++k) {
        a[k] = query.relative(w[k]);
        e[k] = mul(edge[k], query.inverse);
    }
    // (S e1) x (S e2) is proportional to S^-1 (e1 x e2) for the scaling S: the cross product is taken before
    // the radii blur the edges, so a triangle without area has exactly none in every sphere space.
    n = mul(face_vector(edge[0], -edge[2]), query.radii);
    nn = dot(n, n);
    h = dot(n, a[0]);
}

Nearest nearest_part(const SphereTriangle& triangle) {
    if (triangle.nn > 0.0 && inside(triangle, triangle.a)) {
        return {triangle.h * (triangle.h / triangle.nn), Feature::interior, 0, 0.0};
    }
    return nearest_border(triangle);
}

bool sweep_triangle(const SphereTriangle& triangle, const EllipsoidQuery& query, double t_max,
                    TriangleHit& hit) {
    double plane_t = 0.0;
    bool apart = false;  // the plane is not cut at the start, so nothing is touched before plane_t
    if (triangle.nn > 0.0) {
        // The side of the centre counts as the front.
        const double side = triangle.h > 0.0 ? -1.0 : 1.0;
        const double speed = side * dot(triangle.n, query.d);  // away from the plane, times |n|
        const double length = std::sqrt(triangle.nn);
        const double gap = -side * triangle.h - length;  // between sphere and plane, times |n|
        apart = gap >= 0.0;
        if (apart) {
            if (!(speed < 0.0)) return false;
            plane_t = gap / -speed;
            if (!(plane_t <= t_max)) return false;
        }
        const V3 path = plane_t * query.d;
        const V3 from_centre[3] = {triangle.a[0] - path, triangle.a[1] - path, triangle.a[2] - path};
        if (inside(triangle, from_centre)) {
            if (!(speed < 0.0)) return false;
            hit = {plane_t, Feature::interior, 0, !apart};
            return true;
        }
    }
    if (!apart) {
        const Nearest nearest = nearest_border(triangle);
        if (nearest.distance2 <= 1.0) {
            if (!(dot(query.d, nearest_normal(triangle, nearest)) < 0.0)) return false;
            hit = {0.0, nearest.feature, nearest.part, true};
            return true;
        }
    }
    hit = first_border_touch(triangle, query, plane_t);
    return hit.t <= t_max;
}

bool is_behind(const SphereTriangle& triangle) {
    return !(triangle.nn > 0.0) || triangle.h > 0.0;
}

bool passes_one_sided(const SphereTriangle& triangle, const EllipsoidQuery& query) {
    return is_behind(triangle) || !(dot(triangle.n, query.d) < 0.0);
}

Touch touch_of(const SphereTriangle& triangle, const LeafTriangle& leaf, const EllipsoidQuery& query,
               const Nearest& nearest) {
    Touch touch{};
    touch.normal = world_normal(nearest_normal(triangle, nearest), query);
    if (nearest.feature == Feature::interior) {
        touch.point = query.centre + mul((triangle.h / triangle.nn) * triangle.n, query.radii);
    } else if (nearest.feature == Feature::edge) {
        touch.point = edge_point_world(leaf, edge_of(triangle, nearest.part), nearest.s);
    } else {
        touch.point = leaf.corner(nearest.part);
    }
    return touch;
}

Touch touch_of(const SphereTriangle& triangle, const LeafTriangle& leaf, const EllipsoidQuery& query,
               const TriangleHit& hit) {
    if (hit.started) return touch_of(triangle, leaf, query, nearest_part(triangle));
    Touch touch{};
    if (hit.feature == Feature::interior) {
        const V3 normal = unit(triangle.h > 0.0 ? -triangle.n : triangle.n);
        touch.normal = world_normal(normal, query);
        touch.point = query.centre + mul(hit.t * query.d - normal, query.radii);
    } else if (hit.feature == Feature::edge) {
        const Edge edge = edge_of(triangle, hit.part);
        const EdgePath path = edge_path(edge, query.d);
        touch.normal = world_normal(unit(path.w + hit.t * path.dw), query);
        touch.point = edge_point_world(leaf, edge, path.s + hit.t * path.ds);
    } else {
        touch.normal = world_normal(unit(hit.t * query.d - triangle.a[hit.part]), query);
        touch.point = leaf.corner(hit.part);
    }
    return touch;
}

V3 winding_normal(const LeafTriangle& triangle) {
    const V3 a = triangle.corner(0);
    return unit(face_vector(triangle.corner(1) - a, triangle.corner(2) - a));
}

}  // namespace slipface::detail
