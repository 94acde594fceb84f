// The tree must not change any answer: worlds of many triangles against worlds of one, bit for bit.
#include <gtest/gtest.h>

#include <algorithm>

#include "brute_force.h"
#include "every_simd_path.h"
#include "slipface/collision/neighbourhood.h"

namespace slipface {
namespace {

using scenes::BruteForce;
using scenes::Random;
using scenes::same;
using scenes::Soup;

struct Scene {
    const char* name;
    Soup soup;
    Vec3 middle;
    double half;           // where queries start
    bool crowded = false;  // boxes of triangles are everywhere: no neighbourhood is empty
};

std::vector<Scene> scenes_to_try() {
    Random random(11);
    std::vector<Scene> list;
    list.push_back({"soup", scenes::random_soup(random, 300, 5, 1), Vec3::Zero(), 6});
    list.push_back({"dust", scenes::random_soup(random, 300, 5, 0.01), Vec3::Zero(), 6});
    list.push_back({"terrain", scenes::terrain(random, 12, 0.7), Vec3(4, 0.5, 4), 4});
    list.push_back({"ball", scenes::ball(2, 2), Vec3::Zero(), 3});
    // Everything at one height with shared edges: ties in plenty.
    Soup flat;
    for (int i = 0; i < 12; ++i) {
        for (int j = 0; j < 12; ++j) {
            const double x = i - 6;
            const double z = j - 6;
            flat.add_quad({x, 0, z}, {x, 0, z + 1}, {x + 1, 0, z + 1}, {x + 1, 0, z});
        }
    }
    list.push_back({"flat", flat, Vec3(0, 0.8, 0), 5});
    Soup same_position;
    for (int i = 0; i < 40; ++i)
        same_position.add({0, 0, 0}, {0, 0, 1}, {1, 0, 0});
    list.push_back({"one triangle forty times", same_position, Vec3::Zero(), 2});
    Soup far_out = scenes::random_soup(random, 200, 5, 1);
    for (Vec3f& p : far_out.positions)
        p += Vec3f(20000, -30000, 10000);
    list.push_back({"far out", far_out, Vec3(20000, -30000, 10000), 6});
    // One float apart is a metre here: everything hangs on what the float tests allow for.
    Soup very_far_out = scenes::random_soup(random, 200, 50, 20);
    for (Vec3f& p : very_far_out.positions)
        p += Vec3f(1e7F, 0, -1e7F);
    list.push_back({"very far out", very_far_out, Vec3(1e7 + 0.3, 0.3, -1e7 - 0.4), 60});
    // Fans of slivers, whose normals and short edges are all but lost in float.
    Soup needles;
    for (int i = 0; i < 200; ++i) {
        const Vec3 tip = random.in_box(4);
        const Vec3 far = tip + random.uniform(1, 60) * random.direction();
        needles.add(tip, far, far + random.uniform(1e-4, 2e-2) * random.direction());
    }
    list.push_back({"needles", needles, Vec3::Zero(), 6, true});
    return list;
}

using BruteForceAgreement = EverySimdPath;

// On every path, with the answers of single sweeps in their places whatever was there before. Returns how
// many touch something.
std::ptrdiff_t expect_same_in_a_batch(const CollisionWorld& world, std::span<const Sweep> sweeps) {
    std::vector<std::optional<Contact>> contacts;
    for (const Sweep& sweep : sweeps)
        contacts.push_back(sweep_ellipsoid(world, sweep.radii, sweep.from, sweep.move));
    for (const std::string_view path : simd_paths()) {
        SCOPED_TRACE(path);
        EXPECT_TRUE(set_simd_path(path));
        std::vector<std::optional<Contact>> out(sweeps.size(), Contact{});
        sweep_ellipsoids(world, sweeps, out);
        for (std::size_t i = 0; i < sweeps.size(); ++i)
            EXPECT_TRUE(same(out[i], contacts[i])) << i;
    }
    return std::ranges::count_if(contacts, [](const auto& contact) { return contact.has_value(); });
}

TEST_F(BruteForceAgreement, SweepsRaysPointsAndOverlaps) {
    for (const Scene& scene : scenes_to_try()) {
        SCOPED_TRACE(scene.name);
        const CollisionWorld world = scene.soup.world();
        const BruteForce brute(scene.soup);
        Random random(12);
        int hits = 0;
        int stayed = 0;
        int empty = 0;
        std::vector<Sweep> sweeps;
        for (int i = 0; i < 400; ++i) {
            Vec3 from = scene.middle + random.in_box(scene.half);
            // Drawn one by one: compilers evaluate the arguments of a call in different orders.
            const Vec3 direction = random.direction();
            Vec3 move = std::pow(10.0, random.uniform(-3, 2)) * direction;
            // Often exactly on the grid and along an axis, where ties and grazing contacts are.
            if (random.below(3) == 0) from = (2 * from).array().round() / 2;
            if (random.below(3) == 0) move = move.cwiseProduct(Vec3::Unit(static_cast<int>(random.below(3))));
            Vec3 radii(0.5, 0.5, 0.5);
            if (random.below(3) != 0)
                for (const int axis : {2, 1, 0})
                    radii[axis] = random.uniform(0.05, 1);
            const double max_t = random.below(2) == 0 ? 1.0 : std::numeric_limits<double>::infinity();
            const double limit = random.below(2) == 0 ? 0.5 : std::numeric_limits<double>::infinity();
            // A body nearby, now larger and now smaller than the one that asks.
            const Vec3 near_from = from + 0.2 * random.in_box(1);
            const Vec3 body = random.below(2) == 0 ? radii : Vec3(random.uniform(0.3, 3) * radii);
            const double reach = random.uniform(0, 2);
            const auto contact = brute.sweep(radii, from, move);
            const auto ray = brute.ray(from, move, max_t);
            const auto closest = brute.closest(from, limit);
            const auto overlaps = brute.overlaps(radii, from);
            hits += contact.has_value();
            sweeps.push_back({radii, from, move});
            for (const std::string_view path : simd_paths()) {
                SCOPED_TRACE(path);
                ASSERT_TRUE(set_simd_path(path));
                ASSERT_TRUE(same(sweep_ellipsoid(world, radii, from, move), contact)) << i;
                ASSERT_TRUE(same(cast_ray(world, from, move, max_t), ray)) << i;
                ASSERT_TRUE(same(closest_point(world, from, limit), closest)) << i;

                std::vector<Overlap> found(scene.soup.triangles.size());
                const std::size_t count = find_overlaps(world, radii, from, found);
                ASSERT_EQ(count, overlaps.size()) << i;
                for (std::size_t k = 0; k < count; ++k)
                    ASSERT_TRUE(same(found[k], overlaps[k])) << i;
                ASSERT_EQ(overlaps_any(world, radii, from), count > 0) << i;
                // A short list holds the lowest triangles.
                std::array<Overlap, 3> few;
                ASSERT_EQ(find_overlaps(world, radii, from, few), count);
                for (std::size_t k = 0; k < std::min(count, few.size()); ++k)
                    ASSERT_TRUE(same(few[k], overlaps[k])) << i;

                const Neighbourhood near(world, body, near_from, reach * body);
                if (near.holds(radii, from, move)) ++(near.triangles().count > 0 ? stayed : empty);
                ASSERT_TRUE(same(sweep_ellipsoid(near, radii, from, move), contact)) << i;
                ASSERT_EQ(find_overlaps(near, radii, from, found), count) << i;
                for (std::size_t k = 0; k < count; ++k)
                    ASSERT_TRUE(same(found[k], overlaps[k])) << i;
                ASSERT_EQ(overlaps_any(near, radii, from), count > 0) << i;
            }
        }
        EXPECT_GT(hits, 20);
        EXPECT_GT(stayed, 50);
        EXPECT_TRUE(scene.crowded || empty > 10) << empty;
        EXPECT_LT(hits, 400);
        EXPECT_EQ(expect_same_in_a_batch(world, sweeps), hits);
    }
}

// Found by a fuzzer: nearer to the corner of one triangle than a double can tell apart from another's plane.
TEST_F(BruteForceAgreement, PointsNearerThanRounding) {
    const double hair = double{-4.40823822e-18F};
    Soup soup;
    soup.add({0.375, -15.5, 2.375}, {0, 0, 0}, {8, 0.125, 0});
    soup.add({2.875, 0, 0}, {0.25, 0, 15.625}, {hair, hair, hair});
    // So many that the two are in leaves of their own.
    Random random(20);
    for (int i = 0; i < 60; ++i) {
        const double side = i % 2 == 0 ? 1.0 : -1.0;
        const Vec3 at(2 + random.uniform(0, 4), side * random.uniform(1, 12), random.uniform(0, 12));
        soup.add(at, at + Vec3(0.1, 0, 0), at + Vec3(0, 0, 0.1));
    }
    const CollisionWorld world = soup.world();
    const BruteForce brute(soup);
    const double everywhere = std::numeric_limits<double>::infinity();
    for (const double at : {hair, -4.40824e-18, 1e-17, -1e-17, 0.0, 3e-19}) {
        const Vec3 point(at, at, at);
        for (const std::string_view path : simd_paths()) {
            ASSERT_TRUE(set_simd_path(path));
            EXPECT_TRUE(same(closest_point(world, point), brute.closest(point, everywhere))) << at;
        }
    }
}

// Those that cannot go side by side with others must not disturb them.
TEST_F(BruteForceAgreement, BatchesWithQueriesOfEveryKind) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    Random random(19);
    Soup soup = scenes::terrain(random, 30, 0.7);
    const CollisionWorld world = soup.world();
    std::vector<Sweep> sweeps;
    for (int i = 0; i < 300; ++i) {
        const Vec3 from(random.uniform(2, 19), random.uniform(1.5, 3), random.uniform(2, 19));
        const Vec3 direction = random.direction();
        Sweep sweep{Vec3(0.4, 0.9, 0.4), from, random.uniform(0.1, 30) * direction};
        switch (i % 12) {
            case 0: sweep.move = Vec3::Zero(); break;
            case 1: sweep.move.x() = nan; break;
            case 2: sweep.from.y() = std::numeric_limits<double>::infinity(); break;
            case 3: sweep.radii.z() = 0.0; break;
            case 4: sweep.radii = Vec3(1e-16, 1e-16, 1e-16); break;
            case 5:
                sweep.from.y() = 1e17;
                sweep.move = Vec3(0, -2e17, 0);
                break;
            case 6: sweep.radii = Vec3(1e-9, 1e-9, 1e-9); break;
            case 7:
                sweep.from.y() = 1e6;
                sweep.move = Vec3(0, -2e6, 0);
                break;
            default: break;
        }
        sweeps.push_back(sweep);
    }
    EXPECT_GT(expect_same_in_a_batch(world, sweeps), 100);
    // More than a wave has room for: every sweep visits nearly every leaf.
    for (Sweep& sweep : sweeps)
        sweep.radii = Vec3(9, 2, 9);
    expect_same_in_a_batch(world, sweeps);
}

TEST_F(BruteForceAgreement, RefusesAnUnknownPath) {
    EXPECT_FALSE(set_simd_path("mmx"));
    EXPECT_EQ(simd_paths().front(), "baseline");
}

TEST_F(BruteForceAgreement, TrianglesInBoxes) {
    Random random(13);
    const Soup soup = scenes::random_soup(random, 500, 5, 1);
    const CollisionWorld world = soup.world();
    for (int i = 0; i < 200; ++i) {
        Aabb box;
        const Vec3 at = random.in_box(6);
        box.add(at);
        box.add(at + random.in_box(2));
        std::vector<TriangleId> expected;
        for (std::size_t k = 0; k < soup.triangles.size(); ++k) {
            Aabb own;
            for (const Vec3& corner : world.triangle(static_cast<TriangleId>(k)))
                own.add(corner);
            if ((own.min.array() <= box.max.array()).all() && (own.max.array() >= box.min.array()).all()) {
                expected.push_back(static_cast<TriangleId>(k));
            }
        }
        EXPECT_EQ(world.triangles_in(box), expected);
        // Leaves hold others, too.
        const std::size_t crowd = world.crowd_in(box);
        EXPECT_GE(crowd, expected.size());
        EXPECT_LE(crowd, soup.triangles.size());
    }
    EXPECT_EQ(world.crowd_in({Vec3(50, 50, 50), Vec3(51, 51, 51)}), 0u);
    EXPECT_EQ(world.crowd_in(Aabb()), 0u);
    const Vec3 everywhere = Vec3::Constant(std::numeric_limits<double>::infinity());
    EXPECT_EQ(world.crowd_in({-everywhere, everywhere}), soup.triangles.size());
    EXPECT_TRUE(world.triangles_in(Aabb()).empty());
    EXPECT_EQ(world.triangles_in(world.bounds()).size(), soup.triangles.size());
}

TEST(TriangleOrder, DoesNotChangeTheAnswer) {
    for (const Scene& scene : scenes_to_try()) {
        SCOPED_TRACE(scene.name);
        Random random(14);
        // order[k]: which triangle of the original is the k-th of the shuffled soup.
        std::vector<std::size_t> order(scene.soup.triangles.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        for (std::size_t k = order.size(); k > 1; --k)
            std::swap(order[k - 1], order[random.below(k)]);
        Soup shuffled;
        shuffled.positions = scene.soup.positions;
        for (const std::size_t k : order) {
            // Any corner may come first.
            auto corners = scene.soup.triangles[k];
            std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(random.below(3)),
                        corners.end());
            shuffled.triangles.push_back(corners);
            shuffled.faces.push_back(scene.soup.faces[k]);
        }
        const CollisionWorld a = scene.soup.world();
        const CollisionWorld b = shuffled.world();
        for (int i = 0; i < 1000; ++i) {
            const Vec3 from = scene.middle + random.in_box(scene.half);
            const Vec3 move = random.uniform(0, 10) * random.direction();
            const Vec3 radii(random.uniform(0.05, 1), random.uniform(0.05, 1), random.uniform(0.05, 1));
            const auto one = sweep_ellipsoid(a, radii, from, move);
            const auto other = sweep_ellipsoid(b, radii, from, move);
            ASSERT_EQ(one.has_value(), other.has_value());
            if (!one) continue;
            // The first corner anchors the plane, so another first corner may round differently.
            EXPECT_NEAR(one->t * move.norm(), other->t * move.norm(), 1e-9);
            // At t = 0 several triangles are overlapped alike and the lowest number decides.
            if (one->t == 0) continue;
            EXPECT_NEAR((one->normal - other->normal).norm(), 0, 1e-6);
        }
    }
}

TEST(TriangleOrder, PermutationAloneGivesTheSameBits) {
    for (const Scene& scene : scenes_to_try()) {
        SCOPED_TRACE(scene.name);
        Soup reversed = scene.soup;
        std::reverse(reversed.triangles.begin(), reversed.triangles.end());
        std::reverse(reversed.faces.begin(), reversed.faces.end());
        const CollisionWorld a = scene.soup.world();
        const CollisionWorld b = reversed.world();
        Random random(15);
        for (int i = 0; i < 1000; ++i) {
            const Vec3 from = scene.middle + random.in_box(scene.half);
            const Vec3 move = random.uniform(0, 10) * random.direction();
            const Vec3 radii(random.uniform(0.05, 1), random.uniform(0.05, 1), random.uniform(0.05, 1));
            const auto one = sweep_ellipsoid(a, radii, from, move);
            const auto other = sweep_ellipsoid(b, radii, from, move);
            ASSERT_EQ(one.has_value(), other.has_value());
            if (!one) continue;
            EXPECT_EQ(one->t, other->t);
            EXPECT_EQ(one->feature, other->feature);
            // A border between two triangles is the same border for both.
            if (one->t > 0 && one->feature != Feature::interior) {
                EXPECT_EQ(one->point, other->point);
                EXPECT_EQ(one->normal, other->normal);
            }
        }
    }
}

}  // namespace
}  // namespace slipface
