// The code of the narrow phase (sphere_triangle.h); included by one file for each instruction set. It calls
// no function that another file could share: see isa.h and lanes.h.
#pragma once

#include <climits>

#include "queries/sphere_triangle.h"

namespace slipface::detail {
namespace {

// A triangle relative to a query's centre, in sphere space.
struct SphereTriangle {
    Threes a;   // corners
    Threes e;   // edge k runs from corner k to corner (k + 1) % 3; from the world's corners, so exact up to
                // one rounding to one rounding
    V3 n;       // winding normal, any length
    double nn;  // n . n; exactly 0 if the triangle counts as its edges only
    double h;   // n . a for corner 0: the plane is n . x = h

    SphereTriangle(const LeafTriangle& triangle, const EllipsoidQuery& query)
        : SphereTriangle(Threes{Three(Four::load(triangle.at[0])), Three(Four::load(triangle.at[1])),
                                Three(Four::load(triangle.at[2]))},
                         query) {}

  private:
    SphereTriangle(const Threes& world, const EllipsoidQuery& query)
        : a(mul(world - Threes::all(query.centre), Threes::all(query.inverse))), e(world.next() - world) {
        // (S e1) x (S e2) is proportional to S^-1 (e1 x e2) for the scaling S. The cross product is taken
        // before scaling rounds the edges, so a triangle without area has exactly none in every sphere space.
        n = mul(face_vector(e.vec(0), -e.vec(2)), query.radii);
        nn = dot(n, n);
        h = dot(n, a.vec(0));
        e = mul(e, Threes::all(query.inverse));
    }
};

// True if x, a point of the plane, lies in the triangle. `corner_from_x`: the corners relative to x.
bool inside(const SphereTriangle& triangle, const Threes& corner_from_x) {
    const Three zero = Three::all(0.0);
    const Three side = dot(Threes::all(triangle.n), cross(corner_from_x, triangle.e));
    if (three_not_above(zero, side).bits() != 7) return false;
    // The two long sides of a needle are too close to parallel to show where it ends; its longest edge shows
    // it.
    const Three square = dot(triangle.e, triangle.e);
    const Three index = -dot(corner_from_x, triangle.e);  // along each edge, times its length
    const unsigned along = (three_not_above(zero, index) & three_not_above(index, square)).bits();
    return (along & three_equal(square, largest_of(square)).bits()) != 0;
}

bool lexicographic(const V3& l, const V3& r) {
    return l.x != r.x ? l.x < r.x : l.y != r.y ? l.y < r.y : l.z <= r.z;
}

// The edges relative to the centre, from their nearer ends p along e. Two neighbours may store a shared edge
// in opposite directions; starting at the nearer end makes their arithmetic, and so their bits, the same.
struct Edges {
    Threes p;
    Threes e;
    Three ee;
    unsigned forward;  // bit k: from corner k to the next one

    explicit Edges(const SphereTriangle& triangle)
        : Edges(triangle, triangle.a.next(), dot(triangle.a, triangle.a)) {}
    int from(int k) const { return (forward >> k & 1U) != 0 ? k : following(k); }
    int to(int k) const { return (forward >> k & 1U) != 0 ? following(k) : k; }

  private:
    static int following(int k) { return k == 2 ? 0 : k + 1; }

    Edges(const SphereTriangle& triangle, const Threes& end, const Three& square)
        : p(end), e(-triangle.e), ee(dot(triangle.e, triangle.e)), forward(0) {
        ThreeMask first = three_less(square, square.next());
        if (const unsigned tied = three_equal(square, square.next()).bits(); tied != 0) {
            double yes[3];
            for (int k = 0; k < 3; ++k)
                yes[k] = (tied >> k & 1U) != 0 && lexicographic(triangle.a.vec(k), end.vec(k)) ? 1.0 : 0.0;
            first = first | three_less(Three::all(0.0), Three(V3{yes[0], yes[1], yes[2]}));
        }
        forward = first.bits();
        p = three_pick(first, triangle.a, p);
        e = three_pick(first, triangle.e, e);
    }
};

// The move relative to the lines of the edges.
struct EdgePaths {
    Threes w;   // the centre relative to its foot on the line at t = 0
    Threes dw;  // change of w with t; both are perpendicular to the edge
    Three s;    // position of the foot on the edge at t = 0
    Three ds;

    EdgePaths(const Edges& edges, const V3& move) : EdgePaths(edges, Threes::all(move)) {}

  private:
    EdgePaths(const Edges& edges, const Threes& d)
        : w(-edges.p), dw(d), s(-dot(edges.p, edges.e) / edges.ee), ds(dot(d, edges.e) / edges.ee) {
        w = w - s * edges.e;
        dw = dw - ds * edges.e;
    }
};

// Smallest t >= lower at which |w + t dw| falls to 1, computed from the foot of the perpendicular, so that no
// large numbers are subtracted. The mask is false where this never happens, or where w does not approach at t
// = 0.
ThreeMask first_root(const Threes& w, const Threes& dw, double lower, Three& t) {
    const Three zero = Three::all(0.0);
    const Three aa = dot(dw, dw);
    const Three foot = -dot(w, dw) / aa;
    const Threes closest = w + foot * dw;
    const Three disc = Three::all(1.0) - dot(closest, closest);
    t = foot - (disc / aa).sqrt();
    // It is below `lower` only by rounding: the caller has shown that nothing is touched earlier.
    t = three_max(t, Three::all(lower));
    return three_less(zero, aa) & three_less(zero, foot) & three_less(zero, disc);
}

// The first touch of an edge or corner at or after `lower`; t = 2 if there is none.
TriangleHit first_border_touch(const SphereTriangle& triangle, const EllipsoidQuery& query, double lower) {
    const Three zero = Three::all(0.0);
    const Edges edges(triangle);
    const EdgePaths path(edges, query.d);
    Three edge_t = zero;
    Three corner_t = zero;
    ThreeMask on_edge = first_root(path.w, path.dw, lower, edge_t) & three_less(zero, edges.ee);
    const Three s = path.s + edge_t * path.ds;
    on_edge = on_edge & three_not_above(zero, s) & three_not_above(s, Three::all(1.0));
    const ThreeMask on_corner = first_root(-triangle.a, Threes::all(query.d), lower, corner_t);

    // The earliest; of several an edge goes before a corner, then the lower number. No time is NaN. Without
    // branches, which would be hard to predict.
    const Three never = Three::all(2.0);
    edge_t = three_pick(on_edge, edge_t, never);
    corner_t = three_pick(on_corner, corner_t, never);
    const Three first = least_of(three_min(edge_t, corner_t));
    const int which = first_bit(three_equal(edge_t, first).bits() | three_equal(corner_t, first).bits() << 3);
    const bool is_edge = which < 3;
    return {first.vec().x, is_edge ? Feature::edge : Feature::vertex, is_edge ? which : which - 3, false};
}

Nearest nearest_border(const SphereTriangle& triangle) {
    const Three zero = Three::all(0.0);
    const Edges edges(triangle);
    const Three index = -dot(edges.p, edges.e) / edges.ee;
    const Threes point = edges.p + index * edges.e;
    const ThreeMask beside =
        three_less(zero, edges.ee) & three_less(zero, index) & three_less(index, Three::all(1.0));
    const Three distance2 = three_pick(beside, dot(point, point), dot(edges.p, edges.p));
    const Three least = least_of(distance2);
    // Of several nearest the first edge, else the first corner; the first of all if a distance is NaN.
    const unsigned nearest = three_equal(distance2, least).bits();
    const unsigned nearest_edges = nearest & beside.bits();
    const bool is_edge = nearest_edges != 0;
    const int k = first_bit(is_edge ? nearest_edges : nearest != 0 ? nearest : 1U);
    double s[4];
    index.store(s);
    return {least.vec().x, is_edge ? Feature::edge : Feature::vertex, is_edge ? k : edges.from(k),
            is_edge ? s[k] : 0.0};
}

// The nearest point itself; not valid for the interior.
V3 border_point(const SphereTriangle& triangle, const Nearest& nearest) {
    if (nearest.feature == Feature::vertex) return triangle.a.vec(nearest.part);
    const Edges edges(triangle);
    return edges.p.vec(nearest.part) + nearest.s * edges.e.vec(nearest.part);
}

// a / b for each component, scaled by the power of two that brings the largest to about 1.
V3 scaled_quotient(const V3& a, const V3& b) {
    const double top[3] = {a.x, a.y, a.z};
    const double bottom[3] = {b.x, b.y, b.z};
    double quotient[3];
    int exponent[3];
    int largest_exponent = INT_MIN;
    for (int i = 0; i < 3; ++i) {
        int above = 0;
        int below = 0;
        quotient[i] = std::frexp(top[i], &above) / std::frexp(bottom[i], &below);
        exponent[i] = above - below;
        if (quotient[i] != 0.0 && exponent[i] > largest_exponent) largest_exponent = exponent[i];
    }
    for (int i = 0; i < 3; ++i) {
        quotient[i] = quotient[i] == 0.0 ? 0.0 : std::ldexp(quotient[i], exponent[i] - largest_exponent);
    }
    return {quotient[0], quotient[1], quotient[2]};
}

// Converts a normal from sphere space to the unit normal of the ellipsoid in world space (inverse transpose).
V3 world_normal(const V3& sphere, const EllipsoidQuery& query) {
    const V3 world = mul(sphere, query.inverse);
    const double size = largest(world);
    // Radii at the ends of double's range overflow the plain product.
    return unit(size > 1e-100 && size < 1e100 ? world : scaled_quotient(sphere, query.radii));
}

V3 edge_point_world(const LeafTriangle& leaf, const Edges& edges, int k, double s) {
    const V3 from = corner(leaf, edges.from(k));
    return from + s * (corner(leaf, edges.to(k)) - from);
}

// A direction away from a triangle whose border passes exactly through the centre.
V3 direction_without_distance(const SphereTriangle& triangle) {
    if (triangle.nn > 0.0) return unit(triangle.n);
    V3 longest = triangle.e.vec(0);
    for (int k = 1; k < 3; ++k) {
        const V3 edge = triangle.e.vec(k);
        if (dot(edge, edge) > dot(longest, longest)) longest = edge;
    }
    const V3 across = unit(V3{-longest.y, longest.x, 0.0});
    return dot(across, across) > 0.0 ? across : V3{0.0, 1.0, 0.0};
}

// With a radius no larger than the rounding of the path, the computed distance at the touch can be zero.
V3 direction_or(const V3& away, const V3& otherwise) {
    const V3 direction = unit(away);
    return dot(direction, direction) > 0.0 ? direction : unit(otherwise);
}

// Sphere-space normal at the nearest part; unit, towards the centre.
V3 nearest_normal(const SphereTriangle& triangle, const Nearest& nearest) {
    if (nearest.feature == Feature::interior) return unit(triangle.h > 0.0 ? -triangle.n : triangle.n);
    const V3 away = unit(-border_point(triangle, nearest));
    return dot(away, away) > 0.0 ? away : direction_without_distance(triangle);
}

Nearest nearest_part(const SphereTriangle& triangle) {
    if (triangle.nn > 0.0 && inside(triangle, triangle.a)) {
        return {triangle.h * (triangle.h / triangle.nn), Feature::interior, 0, 0.0};
    }
    return nearest_border(triangle);
}

// Finds the first touch; false if there is none with t <= t_max.
bool sweep_triangle(const SphereTriangle& triangle, const EllipsoidQuery& query, double t_max,
                    TriangleHit& hit) {
    double plane_t = 0.0;
    bool apart = false;  // the sphere starts clear of the plane, so nothing is touched before plane_t
    if (triangle.nn > 0.0) {
        // The side of the centre counts as the front.
        const double side = 1.0 - 2.0 * static_cast<double>(triangle.h > 0.0);
        const double speed = side * dot(triangle.n, query.d);  // speed away from the plane, times |n|
        const double length = std::sqrt(triangle.nn);
        const double gap = -side * triangle.h - length;  // between sphere and plane, times |n|
        apart = gap >= 0.0;
        if (apart) {
            if (!(speed < 0.0)) return false;
            plane_t = gap / -speed;
            if (!(plane_t <= t_max)) return false;
        }
        if (inside(triangle, triangle.a - Threes::all(plane_t * query.d))) {
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

// True if the centre is behind the plane of the winding, or there is no plane.
bool is_behind(const SphereTriangle& triangle) {
    return !(triangle.nn > 0.0) || triangle.h > 0.0;
}

// True if a one-sided triangle ignores a query that touches it at `hit`: the move does not go against the
// winding normal, there is none, or the body does not come from the front. From the front comes what the
// triangle does not cut deeper than rounding and pushes do, and of what touches a border on its way at least
// three quarters of the body still in front: the borders of a ridge hold, a rim beside the body does not.
bool passes_one_sided(const SphereTriangle& triangle, const EllipsoidQuery& query, const TriangleHit& hit) {
    constexpr double deepest = 0.02, least_in_front = 0.5;
    const double speed = dot(triangle.n, query.d);
    if (is_behind(triangle) || !(speed < 0.0)) return true;
    if (hit.started && nearest_part(triangle).distance2 < (1.0 - deepest) * (1.0 - deepest)) return true;
    return -(triangle.h - hit.t * speed) < least_in_front * std::sqrt(triangle.nn);
}

Touch touch_of(const SphereTriangle& triangle, const LeafTriangle& leaf, const EllipsoidQuery& query,
               const Nearest& nearest) {
    Touch touch{};
    touch.normal = world_normal(nearest_normal(triangle, nearest), query);
    if (nearest.feature == Feature::interior) {
        touch.point = query.centre + mul((triangle.h / triangle.nn) * triangle.n, query.radii);
    } else if (nearest.feature == Feature::edge) {
        touch.point = edge_point_world(leaf, Edges(triangle), nearest.part, nearest.s);
    } else {
        touch.point = corner(leaf, nearest.part);
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
        const Edges edges(triangle);
        const EdgePaths path(edges, query.d);
        double index[4];
        (path.s + Three::all(hit.t) * path.ds).store(index);
        const V3 motion = path.dw.vec(hit.part);
        touch.normal = world_normal(direction_or(path.w.vec(hit.part) + hit.t * motion, -motion), query);
        touch.point = edge_point_world(leaf, edges, hit.part, index[hit.part]);
    } else {
        touch.normal =
            world_normal(direction_or(hit.t * query.d - triangle.a.vec(hit.part), -query.d), query);
        touch.point = corner(leaf, hit.part);
    }
    return touch;
}

bool sweep_triangle_kernel(const LeafTriangle& leaf, const EllipsoidQuery& query, double t_max,
                           TriangleHit& hit) {
    return sweep_triangle(SphereTriangle(leaf, query), query, t_max, hit);
}
Nearest nearest_part_kernel(const LeafTriangle& leaf, const EllipsoidQuery& query) {
    return nearest_part(SphereTriangle(leaf, query));
}
bool is_behind_kernel(const LeafTriangle& leaf, const EllipsoidQuery& query) {
    return is_behind(SphereTriangle(leaf, query));
}
bool passes_one_sided_kernel(const LeafTriangle& leaf, const EllipsoidQuery& query, const TriangleHit& hit) {
    return passes_one_sided(SphereTriangle(leaf, query), query, hit);
}
Touch touch_of_hit_kernel(const LeafTriangle& leaf, const EllipsoidQuery& query, const TriangleHit& hit) {
    return touch_of(SphereTriangle(leaf, query), leaf, query, hit);
}
Touch touch_of_nearest_kernel(const LeafTriangle& leaf, const EllipsoidQuery& query, const Nearest& nearest) {
    return touch_of(SphereTriangle(leaf, query), leaf, query, nearest);
}

}  // namespace
}  // namespace slipface::detail
