// What may be done to a scene without changing its answers: moving it, mirroring it, cutting its faces into
// other triangles, listing these in another order.
#include <gtest/gtest.h>

#include <algorithm>

#include "brute_force.h"
#include "exact_answer.h"

namespace slipface {
namespace {

using scenes::Random;
using scenes::Soup;

struct InvariantScene {
    const char* name;
    Soup soup;
    Vec3 middle;
    double half;  // where queries start
};

std::vector<InvariantScene> invariant_scenes() {
    Random random(31);
    std::vector<InvariantScene> list;
    list.push_back({"soup", scenes::random_soup(random, 300, 5, 1), Vec3::Zero(), 6});
    list.push_back({"terrain", scenes::terrain(random, 16, 0.7), Vec3(5, 1, 5), 5});
    list.push_back({"rooms", scenes::Rooms(random, 2, 1).soup, Vec3(6, 2, 6), 6});
    return list;
}

double on_grid(double value, double step) {
    return std::round(value / step) * step;
}
Vec3 on_grid(const Vec3& v, double step) {
    return {on_grid(v.x(), step), on_grid(v.y(), step), on_grid(v.z(), step)};
}

template <class Change>
Soup changed(const Soup& soup, Change change) {
    Soup result = soup;
    for (Vec3f& p : result.positions) {
        const Vec3 at = change(p.cast<double>());
        p = at.cast<float>();
        EXPECT_EQ(p.cast<double>(), at);
    }
    return result;
}

struct Query {
    Vec3 radii;
    Vec3 from;
    Vec3 move;
};

Query some_query(Random& random, const InvariantScene& scene) {
    // Drawn one by one: compilers evaluate the arguments of a call in different orders.
    const Vec3 from = scene.middle + random.in_box(scene.half);
    const Vec3 towards = scene.middle + random.in_box(scene.half / 2);
    const Vec3 move = random.uniform(0, 2) * (towards - from);
    Vec3 radii = Vec3::Constant(0.5);
    if (random.below(3) != 0) {
        for (const int axis : {0, 1, 2})
            radii[axis] = random.uniform(0.05, 1);
    }
    return {radii, from, move};
}

// Everything that two worlds say of a query: the same bits, but for directions that `turned` maps and places
// that `placed` maps, which may differ by `off` in each coordinate.
template <class Turned, class Placed>
void expect_the_same(const CollisionWorld& a, const Query& one, const CollisionWorld& b, const Query& other,
                     Turned turned, Placed placed, double off) {
    const auto expect_position = [&](const Vec3& p, const Vec3& q) {
        EXPECT_LE((placed(p) - q).cwiseAbs().maxCoeff(), off);
    };
    const auto hit = sweep_ellipsoid(a, one.radii, one.from, one.move);
    const auto other_hit = sweep_ellipsoid(b, other.radii, other.from, other.move);
    ASSERT_EQ(hit.has_value(), other_hit.has_value());
    if (hit) {
        EXPECT_EQ(hit->t, other_hit->t);
        EXPECT_EQ(hit->triangle, other_hit->triangle);
        EXPECT_EQ(hit->feature, other_hit->feature);
        EXPECT_EQ(turned(hit->normal), other_hit->normal);
        expect_position(hit->point, other_hit->point);
    }
    std::vector<Overlap> found(a.triangle_count());
    std::vector<Overlap> other_found(b.triangle_count());
    const std::size_t count = find_overlaps(a, one.radii, one.from, found);
    ASSERT_EQ(count, find_overlaps(b, other.radii, other.from, other_found));
    for (std::size_t k = 0; k < count; ++k) {
        EXPECT_EQ(found[k].triangle, other_found[k].triangle);
        EXPECT_EQ(found[k].depth_sphere_space, other_found[k].depth_sphere_space);
        EXPECT_EQ(turned(found[k].normal), other_found[k].normal);
        expect_position(found[k].point, other_found[k].point);
    }
    const auto near = closest_point(a, one.from);
    const auto other_near = closest_point(b, other.from);
    ASSERT_TRUE(near && other_near);
    EXPECT_EQ(near->distance, other_near->distance);
    EXPECT_EQ(near->triangle, other_near->triangle);
    expect_position(near->point, other_near->point);
    const auto ray = cast_ray(a, one.from, one.move, 1);
    const auto other_ray = cast_ray(b, other.from, other.move, 1);
    ASSERT_EQ(ray.has_value(), other_ray.has_value());
    if (!ray) return;
    EXPECT_EQ(ray->t, other_ray->t);
    EXPECT_EQ(ray->triangle, other_ray->triangle);
    EXPECT_EQ(turned(ray->normal), other_ray->normal);
    expect_position(ray->point, other_ray->point);
}

// Corners on a grid that floats also have where the scene is moved to, and starts on a finer one that doubles
// have: then the way from a start to a corner is the same number in both places, and only reported places
// round.
TEST(Invariance, AMovedSceneAnswersWithTheSameBits) {
    struct Move {
        double grid;
        Vec3 offset;
    };
    const std::array<Move, 2> moves{{{0x1p-10, Vec3(4096.5, -1024.25, 8000)},  // 8 km: floats 2^-11 apart
                                     {0x1p-3, Vec3(1048576, 131072.125, -999999.5)}}};  // 1000 km: 2^-4
    for (const InvariantScene& scene : invariant_scenes()) {
        for (const Move& move : moves) {
            SCOPED_TRACE(testing::Message() << scene.name << " moved by " << move.offset.transpose());
            const Soup snapped = changed(scene.soup, [&](const Vec3& p) { return on_grid(p, move.grid); });
            const Soup there = changed(snapped, [&](const Vec3& p) { return Vec3(p + move.offset); });
            const CollisionWorld a = snapped.world();
            const CollisionWorld b = there.world();
            // A touch rounds once when it is placed; where a ray meets is a mean of corners, whose three
            // weights, products and sums round five times; and once more when the test moves it.
            const double off = 6 * 0x1p-53 * (move.offset.cwiseAbs().maxCoeff() + 50);
            Random random(32);
            for (int i = 0; i < 300; ++i) {
                Query one = some_query(random, scene);
                one.from = on_grid(one.from, 0x1p-20);
                Query other = one;
                other.from += move.offset;
                const auto placed = [&](const Vec3& p) { return Vec3(p + move.offset); };
                expect_the_same(a, one, b, other, std::identity(), placed, off);
            }
        }
    }
}

// Products and sums round alike with either sign.
TEST(Invariance, AMirroredSceneAnswersWithTheSameBits) {
    for (const InvariantScene& scene : invariant_scenes()) {
        for (int axis = 0; axis < 3; ++axis) {
            SCOPED_TRACE(testing::Message() << scene.name << " mirrored along axis " << axis);
            const auto flip = [axis](Vec3 v) {
                v[axis] = -v[axis];
                return v;
            };
            const CollisionWorld a = scene.soup.world();
            const CollisionWorld b = changed(scene.soup, flip).world();
            Random random(33);
            for (int i = 0; i < 300; ++i) {
                const Query one = some_query(random, scene);
                expect_the_same(a, one, b, {one.radii, flip(one.from), flip(one.move)}, flip, flip, 0);
            }
        }
    }
}

// A point of a plane's lattice, origin + x u + y v.
struct Lattice {
    int x, y;
    bool operator==(const Lattice&) const = default;
};

// Twice the area of a, b, c; positive if counter-clockwise.
int area2(const Lattice& a, const Lattice& b, const Lattice& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// The corners of a convex polygon in a plane in which every lattice point is exact, and so every way to cut
// it into triangles of lattice points covers exactly the same set.
struct Polygon {
    Vec3 origin, u, v;
    std::vector<Lattice> corners;

    Vec3 at(const Lattice& p) const { return origin + p.x * u + p.y * v; }
};

// The hull of random points, by gift wrapping.
std::vector<Lattice> random_hull(Random& random) {
    constexpr std::size_t size = 16;
    std::array<Lattice, 8> points{};
    for (Lattice& p : points) {
        p.x = static_cast<int>(random.below(size));
        p.y = static_cast<int>(random.below(size));
    }
    const auto lower = [](const Lattice& a, const Lattice& b) { return a.y != b.y ? a.y < b.y : a.x < b.x; };
    const auto further = [](const Lattice& from, const Lattice& a, const Lattice& b) {
        return std::hypot(a.x - from.x, a.y - from.y) > std::hypot(b.x - from.x, b.y - from.y);
    };
    std::vector<Lattice> hull{*std::min_element(points.begin(), points.end(), lower)};
    while (true) {
        const Lattice from = hull.back();
        Lattice next = from;
        for (const Lattice& p : points) {
            const int turn = area2(from, next, p);
            if (p != from && (next == from || turn < 0 || (turn == 0 && further(from, p, next)))) next = p;
        }
        if (next == hull.front() || next == from) return hull;
        hull.push_back(next);
    }
}

Polygon random_polygon(Random& random) {
    Polygon polygon;
    do {
        polygon.origin = on_grid(random.in_box(4), 0x1p-10);
        polygon.u = on_grid(random.in_box(0.4), 0x1p-10);
        polygon.v = on_grid(random.in_box(0.4), 0x1p-10);
        polygon.corners = random_hull(random);
    } while (polygon.corners.size() < 3 || polygon.u.cross(polygon.v).norm() < 0.01);
    return polygon;
}

using Triple = std::array<Lattice, 3>;

// Cuts a triangle into three at lattice points in it or on its border, `depth` times: needles too, and
// corners in the middle of neighbours' edges.
void cut(Random& random, const Triple& t, int depth, std::vector<Triple>& out) {
    for (int attempt = 0; depth > 0 && attempt < 20; ++attempt) {
        const Lattice p{static_cast<int>(random.below(16)), static_cast<int>(random.below(16))};
        const std::array<int, 3> areas{area2(t[0], t[1], p), area2(t[1], t[2], p), area2(t[2], t[0], p)};
        if (*std::min_element(areas.begin(), areas.end()) < 0 || p == t[0] || p == t[1] || p == t[2])
            continue;
        for (std::size_t k = 0; k < 3; ++k) {
            if (areas[k] > 0) cut(random, {t[k], t[(k + 1) % 3], p}, depth - 1, out);
        }
        return;
    }
    out.push_back(t);
}

// Any diagonal, then each side's any diagonal, then points within.
void cut(Random& random, const std::vector<Lattice>& polygon, int depth, std::vector<Triple>& out) {
    const std::size_t n = polygon.size();
    if (n == 3) {
        cut(random, Triple{polygon[0], polygon[1], polygon[2]}, depth, out);
        return;
    }
    const std::size_t first = random.below(n);
    const std::size_t steps = 2 + random.below(n - 3);
    std::vector<Lattice> near;
    std::vector<Lattice> far;
    for (std::size_t k = 0; k <= n; ++k) {
        const Lattice& p = polygon[(first + k) % n];
        if (k <= steps) near.push_back(p);
        if (k >= steps) far.push_back(p);
    }
    cut(random, near, depth, out);
    cut(random, far, depth, out);
}

template <class T>
void shuffle(Random& random, std::vector<T>& list) {
    for (std::size_t k = list.size(); k > 1; --k)
        std::swap(list[k - 1], list[random.below(k)]);
}

// The polygons as triangles in any order, from any corner, wound either way; a face for each polygon.
Soup triangulated(Random& random, const std::vector<Polygon>& polygons) {
    struct Piece {
        Triple at;
        FaceId face;
    };
    std::vector<Piece> pieces;
    for (std::size_t k = 0; k < polygons.size(); ++k) {
        std::vector<Triple> cuts;
        cut(random, polygons[k].corners, static_cast<int>(random.below(3)), cuts);
        for (const Triple& t : cuts)
            pieces.push_back({t, static_cast<FaceId>(k)});
    }
    shuffle(random, pieces);
    Soup soup;
    for (const auto& [at, face] : pieces) {
        const std::size_t first = random.below(3);
        const std::size_t motion = 1 + random.below(2);
        const Polygon& polygon = polygons[face];
        soup.add(polygon.at(at[first]), polygon.at(at[(first + motion) % 3]),
                 polygon.at(at[(first + 2 * motion) % 3]));
        soup.faces.back() = face;
    }
    return soup;
}

// The exact sweep of a polygon, by its simplest triangles.
class ExactPolygon {
  public:
    ExactPolygon(const Polygon& polygon, const Query& requested) {
        for (std::size_t k = 2; k < polygon.corners.size(); ++k) {
            const oracle::Triangle t{polygon.at(polygon.corners[0]), polygon.at(polygon.corners[k - 1]),
                                     polygon.at(polygon.corners[k])};
            parts_.emplace_back(t, requested.radii, requested.from, requested.move);
        }
    }
    oracle::Quad first_touch(oracle::Quad radius) const {
        oracle::Quad first = oracle::never();
        for (const oracle::ClosedForm& part : parts_)
            first = std::min(first, part.first_touch(radius));
        return first;
    }
    oracle::QuadVec gap(oracle::Quad t) const {
        oracle::QuadVec nearest = parts_[0].gap(t);
        for (const oracle::ClosedForm& part : parts_) {
            const oracle::QuadVec other = part.gap(t);
            if (dot(other, other) < dot(nearest, nearest)) nearest = other;
        }
        return nearest;
    }
    double reach() const {
        double maximum = 0;
        for (const oracle::ClosedForm& part : parts_)
            maximum = std::max(maximum, part.reach());
        return maximum;
    }

  private:
    std::vector<oracle::ClosedForm> parts_;
};

// Straight down on a lattice point of a polygon or beside it, where many cuts have a corner or a seam: the
// point of an ellipsoid that touches a plane of normal n lies along R^2 n from its centre.
Query onto_a_lattice_point(Random& random, const Query& other, const Polygon& polygon) {
    const Lattice p{static_cast<int>(random.below(16)), static_cast<int>(random.below(16))};
    const Vec3 normal = polygon.u.cross(polygon.v);
    const Vec3 out = other.radii.cwiseProduct(other.radii).cwiseProduct(normal).normalized();
    const double height = random.uniform(-6, 6);
    return {other.radii, polygon.at(p) + height * out, -random.uniform(0.5, 1.5) * height * out};
}

struct ExactScene {
    std::vector<ExactPolygon> polygons;
    double reach = 0;
    bool apart = true;  // at the start

    ExactScene(const std::vector<Polygon>& from, const Query& requested) {
        for (const Polygon& polygon : from) {
            polygons.emplace_back(polygon, requested);
            reach = std::max(reach, polygons.back().reach());
        }
        for (const ExactPolygon& polygon : polygons)
            apart = apart && oracle::length(polygon.gap(0)) > 1 + oracle::engine_rounding(reach);
    }
    oracle::Quad first_touch(oracle::Quad radius) const {
        oracle::Quad first = oracle::never();
        for (const ExactPolygon& polygon : polygons)
            first = std::min(first, polygon.first_touch(radius));
        return first;
    }
};

// However the faces are cut, the answer is that of the faces to within rounding: of two cuts the one touches
// between where the other, larger and smaller by that, would.
TEST(Invariance, TrianglesOfTheSamePolygonsAnswerAlike) {
    Random random(34);
    int hits = 0;
    int apart = 0;
    for (int s = 0; s < 30; ++s) {
        std::vector<Polygon> polygons;
        for (int k = 0; k < 4; ++k)
            polygons.push_back(random_polygon(random));
        std::vector<CollisionWorld> worlds;
        for (int k = 0; k < 4; ++k)
            worlds.push_back(triangulated(random, polygons).world());
        const InvariantScene around{"polygons", {}, Vec3::Zero(), 8};
        for (int i = 0; i < 30; ++i) {
            Query requested = some_query(random, around);
            if (i % 2 == 0) requested = onto_a_lattice_point(random, requested, polygons[random.below(4)]);
            const ExactScene exact(polygons, requested);
            // From within, each piece has a nearest point and a way out of its own.
            if (!exact.apart) continue;
            ++apart;
            const double rounding = oracle::engine_rounding(exact.reach);
            for (const CollisionWorld& world : worlds) {
                const auto hit = sweep_ellipsoid(world, requested.radii, requested.from, requested.move);
                ASSERT_TRUE(oracle::is_answer(exact, hit, rounding)) << s << ' ' << i;
                if (!hit) continue;
                ++hits;
                const ExactPolygon& touched = exact.polygons[hit->face];
                ASSERT_LE(oracle::normal_error(touched, requested.radii, hit->normal, hit->t), rounding);
            }
        }
    }
    EXPECT_GT(hits, 300);
    EXPECT_GT(4 * apart, hits + 300);
}

// The order alone changes no bit of time, place or feature, for borders of the normal neither.
TEST(Invariance, TheOrderOfTrianglesChangesNoBit) {
    Random random(35);
    int hits = 0;
    for (int s = 0; s < 10; ++s) {
        std::vector<Polygon> polygons;
        for (int k = 0; k < 12; ++k)
            polygons.push_back(random_polygon(random));
        const Soup soup = triangulated(random, polygons);
        std::vector<std::size_t> order(soup.triangles.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        shuffle(random, order);
        Soup shuffled;
        shuffled.positions = soup.positions;
        for (const std::size_t k : order) {
            shuffled.triangles.push_back(soup.triangles[k]);
            shuffled.faces.push_back(soup.faces[k]);
        }
        const CollisionWorld a = soup.world();
        const CollisionWorld b = shuffled.world();
        const InvariantScene around{"polygons", {}, Vec3::Zero(), 8};
        for (int i = 0; i < 300; ++i) {
            const Query requested = some_query(random, around);
            const auto one = sweep_ellipsoid(a, requested.radii, requested.from, requested.move);
            const auto other = sweep_ellipsoid(b, requested.radii, requested.from, requested.move);
            ASSERT_EQ(one.has_value(), other.has_value());
            if (!one) continue;
            ++hits;
            ASSERT_EQ(one->t, other->t);
            ASSERT_EQ(one->feature, other->feature);
            // Of triangles that are touched at the same time the lowest answers.
            if (one->triangle != order[other->triangle]) continue;
            ASSERT_EQ(one->point, other->point);
            ASSERT_EQ(one->normal, other->normal);
        }
    }
    EXPECT_GT(hits, 500);
}

}  // namespace
}  // namespace slipface
