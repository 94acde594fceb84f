// Input that no level should contain and no game should ask.
#include <gtest/gtest.h>

#include <algorithm>

#include "scenes.h"

namespace slipface {
namespace {

using scenes::Random;
using scenes::Soup;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

void expect_sane(const std::optional<Contact>& contact) {
    if (!contact) return;
    EXPECT_GE(contact->t, 0);
    EXPECT_LE(contact->t, 1);
    EXPECT_TRUE(contact->point.allFinite());
    EXPECT_NEAR(contact->normal.norm(), 1, 1e-12);
}

TEST(Hostile, QueriesThatAreNotFiniteTouchNothing) {
    Random random(21);
    const CollisionWorld world = scenes::random_soup(random, 100, 2, 1).world();
    const Vec3 fine(0.5, 0.5, 0.5);
    ASSERT_TRUE(sweep_ellipsoid(world, fine, {0, 9, 0}, {0, -18, 0}));
    for (const double bad : {nan, infinity, -infinity}) {
        for (int axis = 0; axis < 3; ++axis) {
            Vec3 v(0.5, 9, 0.5);
            v[axis] = bad;
            EXPECT_FALSE(sweep_ellipsoid(world, v, {0, 9, 0}, {0, -18, 0}));
            EXPECT_FALSE(sweep_ellipsoid(world, fine, v, {0, -18, 0}));
            EXPECT_FALSE(sweep_ellipsoid(world, fine, {0, 9, 0}, v));
            EXPECT_FALSE(overlaps_any(world, v, {0, 0, 0}));
            EXPECT_FALSE(overlaps_any(world, fine, v));
            EXPECT_FALSE(closest_point(world, v));
        }
    }
    for (const double bad : {0.0, -0.0, -1.0}) {
        EXPECT_FALSE(sweep_ellipsoid(world, {0.5, bad, 0.5}, {0, 9, 0}, {0, -18, 0}));
        EXPECT_EQ(find_overlaps(world, {0.5, bad, 0.5}, {0, 0, 0}, {}), 0U);
    }
    Aabb box;
    box.min = Vec3::Constant(nan);
    box.max = Vec3::Constant(nan);
    EXPECT_TRUE(world.triangles_in(box).empty());
}

TEST(Hostile, RadiiMovesAndPositionsOfEverySize) {
    Random random(22);
    for (const double size : {1e-38, 1e-20, 1e-6, 1.0, 1e7, 1e20, 1e38}) {
        Soup soup;
        for (int i = 0; i < 30; ++i)
            soup.add(random.in_box(size), random.in_box(size), random.in_box(size));
        const CollisionWorld world = soup.world();
        int hits = 0;
        for (int i = 0; i < 600; ++i) {
            const auto any = [&] { return std::pow(10.0, random.uniform(-320, 308)); };
            // Half of the queries fit the scene.
            const bool fitting = i % 2 == 0;
            const Vec3 radii =
                fitting ? Vec3(size * Vec3::Constant(random.uniform(0.1, 1))) : Vec3(any(), any(), any());
            const Vec3 from = (fitting ? 3 * size : any()) * random.direction();
            const Vec3 move = fitting ? Vec3(-2 * from) : Vec3(any() * random.direction());
            if (!(radii.minCoeff() > 0)) continue;
            const auto contact = sweep_ellipsoid(world, radii, from, move);
            expect_sane(contact);
            hits += contact.has_value();
            if (const auto hit = cast_ray(world, from, move)) {
                EXPECT_TRUE(std::isfinite(hit->t));
                EXPECT_TRUE(hit->point.allFinite());
                EXPECT_NEAR(hit->normal.norm(), 1, 1e-12);
            }
            if (const auto closest = closest_point(world, from)) {
                EXPECT_TRUE(closest->point.allFinite());
            }
            std::array<Overlap, 4> found;
            const std::size_t count = find_overlaps(world, radii, from, found);
            for (std::size_t k = 0; k < std::min<std::size_t>(count, 4); ++k) {
                EXPECT_NEAR(found[k].normal.norm(), 1, 1e-12);
            }
        }
        EXPECT_GT(hits, 250) << size;
    }
}

TEST(Hostile, BuildRefusesWithTheLocation) {
    Soup soup;
    soup.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    soup.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    {
        Soup bad = soup;
        bad.triangles[1][2] = 6;
        const auto result = CollisionWorld::build(bad.view());
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().location, "triangle 1");
        EXPECT_NE(result.error().message.find("6"), std::string::npos);
    }
    {
        Soup bad = soup;
        bad.positions[4].y() = std::numeric_limits<float>::quiet_NaN();
        const auto result = CollisionWorld::build(bad.view());
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().location, "position 4");
    }
    {
        Soup bad = soup;
        bad.positions[0].x() = std::numeric_limits<float>::infinity();
        EXPECT_FALSE(CollisionWorld::build(bad.view()));
    }
    {
        Soup bad = soup;
        bad.faces.pop_back();
        EXPECT_FALSE(CollisionWorld::build(bad.view()));
    }
}

TEST(Hostile, FaceIdsOfAnySize) {
    Soup soup;
    soup.add({0, 0, 0}, {0, 0, 4}, {4, 0, 0});
    soup.add({0, 3, 0}, {0, 3, 4}, {4, 3, 0});
    soup.faces = {4000000000U, 0U};
    CollisionWorld world = soup.world();
    world.set_face_surface(4000000000U, 9);
    EXPECT_EQ(world.face_surface(4000000000U), 9);
    EXPECT_EQ(world.triangle_face(0), 4000000000U);
    EXPECT_EQ(sweep_ellipsoid(world, Vec3::Constant(0.5), {1, 2, 1}, {0, -5, 0})->surface, 9);
    EXPECT_LT(world.statistics().bytes, 1000U);
}

// Each split by cost takes one triangle off: the depth bound must hold, and so must the traversal's stack.
TEST(Hostile, GeometricSeriesOfTrianglesStaysShallow) {
    Soup soup;
    for (int repeat = 0; repeat < 40; ++repeat) {
        for (int i = -120; i < 120; ++i) {
            const double s = std::pow(2.0, i);
            soup.add({s, 0, 0}, {s, s, 0}, {s, 0, s});
        }
    }
    const CollisionWorld world = soup.world();
    EXPECT_EQ(world.statistics().triangles, soup.triangles.size());
    EXPECT_LE(world.statistics().depth, 64);
    EXPECT_TRUE(sweep_ellipsoid(world, Vec3::Constant(0.5), {-5, 0.25, 0.25}, {1000, 0, 0}));
    EXPECT_EQ(world.triangles_in(world.bounds()).size(), soup.triangles.size());
    EXPECT_TRUE(cast_ray(world, {-1, 0.25, 0.25}, {1, 0, 0}));
}

TEST(World, KeepsItsTrianglesAndCounts) {
    Random random(23);
    const Soup soup = scenes::random_soup(random, 2000, 10, 1);
    const CollisionWorld world = soup.world();
    EXPECT_EQ(world.triangle_count(), 2000U);
    Aabb bounds;
    for (TriangleId i = 0; i < 2000; ++i) {
        const auto corners = world.triangle(i);
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_EQ(corners[k], soup.positions[soup.triangles[i][k]].cast<double>());
            bounds.add(corners[k]);
        }
        EXPECT_EQ(world.triangle_face(i), soup.faces[i]);
        const Vec3 expected = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
        EXPECT_NEAR((world.triangle_normal(i) - expected).norm(), 0, 1e-12);
    }
    EXPECT_EQ(world.bounds().min, bounds.min);
    EXPECT_EQ(world.bounds().max, bounds.max);
    const BvhStatistics statistics = world.statistics();
    EXPECT_EQ(statistics.triangles, 2000U);
    EXPECT_GT(statistics.nodes, 2000U / 64);
    EXPECT_GT(statistics.bytes, 2000U * 40);
    EXPECT_LT(statistics.bytes, 2000U * 80);
    EXPECT_TRUE(CollisionWorld().bounds().empty());
    EXPECT_EQ(CollisionWorld().triangle_count(), 0U);
    EXPECT_EQ(CollisionWorld().face_surface(3), default_surface);
    EXPECT_STREQ(feature_name(Feature::edge), "edge");
}

}  // namespace
}  // namespace slipface
