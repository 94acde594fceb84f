// Families of sweeps against one triangle, each hard in its own way, and the comparison of the engine's
// answer with the oracle's. Shared by the accuracy test and by the program that prints the accuracy table.
#pragma once

#include <algorithm>
#include <cctype>
#include <optional>
#include <string>

#include "oracle.h"
#include "scenes.h"

namespace slipface::families {

struct Case {
    oracle::Triangle triangle;  // exactly representable as float
    Vec3 radii;
    Vec3 from;
    Vec3 move;
};

struct Family {
    const char* name;
    Case (*make)(scenes::Random&);
};

// The nearest floats. By way of volatile because GCC 12 drops a pair of conversions that it has vectorised.
inline Vec3 to_float(const Vec3& v) {
    const auto nearest = [](double value) {
        const volatile auto rounded = static_cast<float>(value);
        return double{rounded};
    };
    return {nearest(v.x()), nearest(v.y()), nearest(v.z())};
}

inline Vec3 point_on(scenes::Random& random, const oracle::Triangle& t) {
    double u = random.uniform(0, 1);
    double v = random.uniform(0, 1);
    if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
    }
    return t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
}

// A path of `length` metres that passes the triangle closely enough to touch it, starting anywhere before or
// after.
inline Case aimed(scenes::Random& random, const oracle::Triangle& triangle, const Vec3& radii,
                  double length) {
    const Vec3 target = point_on(random, triangle) + 1.1 * random.direction().cwiseProduct(radii);
    const Vec3 move = length * random.direction();
    return {triangle, radii, target - random.uniform(0, 1) * move, move};
}

inline Vec3 some_radii(scenes::Random& random) {
    if (random.below(2) == 0) return Vec3::Constant(random.uniform(0.2, 0.6));
    return {random.uniform(0.2, 0.6), random.uniform(0.4, 1.0), random.uniform(0.2, 0.6)};
}

inline oracle::Triangle triangle_around(scenes::Random& random, const Vec3& at, double size) {
    return {to_float(at + random.in_box(size)), to_float(at + random.in_box(size)),
            to_float(at + random.in_box(size))};
}

inline Case generic(scenes::Random& random) {
    return aimed(random, triangle_around(random, random.in_box(10), 2), some_radii(random),
                 random.uniform(1, 15));
}
inline Case kilometre(scenes::Random& random) {
    return aimed(random, triangle_around(random, random.in_box(10), 2), some_radii(random),
                 random.uniform(500, 1500));
}
inline Case ten_kilometres_out(scenes::Random& random) {
    return aimed(random, triangle_around(random, 10000 * random.direction(), 2), some_radii(random),
                 random.uniform(1, 15));
}
inline Case ten_thousand_kilometres_out(scenes::Random& random) {
    return aimed(random, triangle_around(random, 1e7 * random.direction(), 20), some_radii(random),
                 random.uniform(1, 15));
}
// The centre is in the plane, and moves in it.
inline Case in_plane(scenes::Random& random) {
    const oracle::Triangle t = triangle_around(random, random.in_box(10), 2);
    const Vec3 e1 = t[1] - t[0];
    const Vec3 e2 = t[2] - t[0];
    const double angle = random.uniform(0, 6.2831853);
    const Vec3 move = random.uniform(1, 15) * (std::cos(angle) * e1 + std::sin(angle) * e2).normalized();
    return {t, some_radii(random), point_on(random, t) - random.uniform(0, 1) * move, move};
}
inline Case sliver(scenes::Random& random) {
    const Vec3 at = random.in_box(10);
    const Vec3 along = random.direction();
    const Vec3 across = along.cross(random.direction()).normalized();
    const oracle::Triangle t{to_float(at), to_float(at + 100 * along),
                             to_float(at + random.uniform(0, 100) * along + 0.001 * across)};
    return aimed(random, t, some_radii(random), random.uniform(1, 15));
}
inline Case tiny_triangle(scenes::Random& random) {
    return aimed(random, triangle_around(random, random.in_box(10), 0.001), some_radii(random),
                 random.uniform(1, 15));
}
inline Case short_move(scenes::Random& random) {
    return aimed(random, triangle_around(random, random.in_box(10), 2), some_radii(random),
                 random.uniform(1e-5, 0.02));
}
// Passes an edge or a corner at a radius give or take 1e-9.
inline Case grazing(scenes::Random& random) {
    const oracle::Triangle t = triangle_around(random, random.in_box(10), 2);
    const Vec3 radii = some_radii(random);
    const auto k = random.below(3);
    const Vec3 edge = (t[(k + 1) % 3] - t[k]).cwiseQuotient(radii);
    const Vec3 opposite = (t[(k + 2) % 3] - t[k]).cwiseQuotient(radii);
    // Outward: away from the opposite corner and perpendicular to the edge, then tilted at random out of the
    // plane.
    const Vec3 u = edge.normalized();
    const Vec3 out = -(opposite - opposite.dot(u) * u).normalized();
    const Vec3 tilt = u.cross(out);
    const double angle = random.uniform(-1.4, 1.4);
    const Vec3 normal = std::cos(angle) * out + std::sin(angle) * tilt;
    const bool at_corner = random.below(2) == 0;
    const Vec3 touched = t[k] + (at_corner ? 0.0 : random.uniform(0.05, 0.95)) * (t[(k + 1) % 3] - t[k]);
    const Vec3 d = (normal.cross(random.direction())).normalized() * random.uniform(2, 20);
    const Vec3 middle = touched + ((1 + random.uniform(-1e-9, 1e-9)) * normal).cwiseProduct(radii);
    const Vec3 move = d.cwiseProduct(radii);
    return {t, radii, middle - random.uniform(0.2, 0.8) * move, move};
}
inline Case twenty_to_one(scenes::Random& random) {
    Vec3 radii(0.05, 1.0, random.uniform(0.05, 1.0));
    std::swap(radii[0], radii[static_cast<Eigen::Index>(random.below(3))]);
    return aimed(random, triangle_around(random, random.in_box(10), 2), radii, random.uniform(1, 15));
}
// Overlapping from the start.
inline Case overlapping(scenes::Random& random) {
    const oracle::Triangle t = triangle_around(random, random.in_box(10), 2);
    const Vec3 radii = some_radii(random);
    return {t, radii, point_on(random, t) + random.uniform(0, 1) * random.direction().cwiseProduct(radii),
            random.uniform(0.01, 5) * random.direction()};
}
// A bullet or a marble: radii much smaller than the triangle.
inline Case tiny_radius(scenes::Random& random) {
    return aimed(random, triangle_around(random, random.in_box(10), 2),
                 Vec3::Constant(random.uniform(1e-4, 1e-3)), random.uniform(1, 15));
}

inline constexpr std::array<Family, 12> all{{
    {"generic, 1 to 15 m", generic},
    {"1 km moves", kilometre},
    {"10 km out", ten_kilometres_out},
    {"10,000 km out", ten_thousand_kilometres_out},
    {"motion in the plane", in_plane},
    {"slivers 1 mm x 100 m", sliver},
    {"2 mm triangles", tiny_triangle},
    {"moves under 2 cm", short_move},
    {"grazing within 1e-9", grazing},
    {"ellipsoids 20:1", twenty_to_one},
    {"overlapping at the start", overlapping},
    {"radius under 1 mm", tiny_radius},
}};

// Of a testing::TestParamInfo<Family>: as much of the name as a test may be called.
inline constexpr auto test_name = [](const auto& family) {
    std::string name;
    for (const char* c = family.param.name; *c != '\0'; ++c) {
        if (std::isalnum(static_cast<unsigned char>(*c)) != 0) name += *c;
    }
    return name;
};

// Worst of a family. Depths are in radii (sphere space).
struct Worst {
    std::size_t queries = 0;
    std::size_t hits = 0;
    double missed_depth = 0.0;  // how deep the deepest missed contact would have gone
    double false_gap = 0.0;     // how far from contact the worst false hit stays
    double path_error = 0.0;    // |t - t exact| x length, metres
    double touch_error = 0.0;   // |distance - 1| at the reported t
    double normal_error = 0.0;  // radians
    double point_error = 0.0;   // metres from the exact closest point at the reported t
};

inline void compare(const Case& c, const std::optional<Contact>& contact, Worst& worst) {
    const oracle::Sweep sweep(c.triangle, c.radii, c.from, c.move);
    ++worst.queries;
    if (contact) ++worst.hits;
    const bool starts_apart = sweep.clearance(0) > 0;
    const oracle::Quad lowest = sweep.nearest_time();
    if (!starts_apart) {
        // A hit at once if the move goes further in; how far in, or how far out, a wrong answer would lead.
        const double deeper = sweep.clearance(0) - sweep.clearance(lowest);
        if (!contact) {
            worst.missed_depth = std::max(worst.missed_depth, deeper);
            return;
        }
        if (lowest == 0) worst.false_gap = std::max(worst.false_gap, static_cast<double>(sweep.slope(0)));
        worst.path_error = std::max(worst.path_error, contact->t * c.move.norm());
        // A centre in the plane has no side that the normal could be checked against.
        if (sweep.clearance(0) > -1 + 1e-9) {
            worst.normal_error = std::max(worst.normal_error, (contact->normal - sweep.normal(0)).norm());
        }
        return;
    }
    const double clearance = sweep.clearance(lowest);
    if (!contact) {
        worst.missed_depth = std::max(worst.missed_depth, -clearance);
        return;
    }
    worst.touch_error = std::max(worst.touch_error, std::abs(sweep.clearance(contact->t)));
    if (clearance >= 0) {
        worst.false_gap = std::max(worst.false_gap, clearance);
        return;
    }
    const oracle::Quad t = sweep.first_touch(lowest);
    worst.path_error =
        std::max(worst.path_error, std::abs(static_cast<double>(contact->t - t)) * c.move.norm());
    worst.normal_error = std::max(worst.normal_error, (contact->normal - sweep.normal(t)).norm());
    const Vec3 centre = c.from + contact->t * c.move;
    const Vec3 point = centre - oracle::vec(sweep.gap(contact->t)).cwiseProduct(c.radii);
    worst.point_error = std::max(worst.point_error, (contact->point - point).norm());
}

inline Worst run(const Family& family, std::size_t queries, std::uint64_t seed) {
    Worst worst;
    scenes::Random random(seed);
    for (std::size_t i = 0; i < queries; ++i) {
        const Case c = family.make(random);
        scenes::Soup soup;
        soup.add(c.triangle[0], c.triangle[1], c.triangle[2]);
        compare(c, sweep_ellipsoid(soup.world(), c.radii, c.from, c.move), worst);
    }
    return worst;
}

}  // namespace slipface::families
