// Sweeps that start in touch or overlapping: out is free, further in is a hit at once.
#include <gtest/gtest.h>

#include "scenes.h"

namespace slipface {
namespace {

using scenes::Soup;

Soup slab() {
    Soup soup;
    soup.add({-10, 0, -10}, {-10, 0, 10}, {20, 0, 0});
    return soup;
}

const Vec3 half_radii = Vec3::Constant(0.5);

TEST(SweepStart, TouchingAndMovingInIsAHitAtZero) {
    const auto contact = sweep_ellipsoid(slab().world(), half_radii, {0, 0.5, 0}, {0.3, -1, 0});
    ASSERT_TRUE(contact);
    EXPECT_EQ(contact->t, 0.0);
    EXPECT_EQ(contact->normal, Vec3(0, 1, 0));
    EXPECT_NEAR((contact->point - Vec3(0, 0, 0)).norm(), 0, 1e-15);
}

TEST(SweepStart, TouchingAndMovingAlongOrOutIsFree) {
    const CollisionWorld world = slab().world();
    EXPECT_FALSE(sweep_ellipsoid(world, half_radii, {0, 0.5, 0}, {3, 0, 0}));
    EXPECT_FALSE(sweep_ellipsoid(world, half_radii, {0, 0.5, 0}, {3, 1e-9, 0}));
    EXPECT_TRUE(sweep_ellipsoid(world, half_radii, {0, 0.5, 0}, {3, -1e-9, 0}));
}

TEST(SweepStart, OverlappingInteriorEdgeAndVertex) {
    Soup soup;
    soup.add({0, 0, 0}, {0, 0, 4}, {4, 0, 0});
    const CollisionWorld world = soup.world();
    struct Start {
        Vec3 from, normal;
        Feature feature;
    };
    const Start starts[] = {
        {{1, 0.2, 1}, {0, 1, 0}, Feature::interior},
        {{1, -0.2, 1}, {0, -1, 0}, Feature::interior},
        {{-0.3, 0, 2}, {-1, 0, 0}, Feature::edge},
        {{-0.3, 0.3, 2}, Vec3(-1, 1, 0).normalized(), Feature::edge},
        {{-0.2, 0.2, -0.2}, Vec3(-1, 1, -1).normalized(), Feature::vertex},
    };
    for (const Start& start : starts) {
        // Further in, but not head-on.
        const Vec3 sideways = start.normal.unitOrthogonal();
        const auto contact = sweep_ellipsoid(world, half_radii, start.from, -start.normal + sideways);
        ASSERT_TRUE(contact);
        EXPECT_EQ(contact->t, 0.0);
        EXPECT_EQ(contact->feature, start.feature);
        EXPECT_NEAR((contact->normal - start.normal).norm(), 0, 1e-15);
        EXPECT_FALSE(sweep_ellipsoid(world, half_radii, start.from, start.normal + sideways));
        EXPECT_FALSE(sweep_ellipsoid(world, half_radii, start.from, 100 * start.normal));
    }
}

TEST(SweepStart, FreeOfOneTriangleButNotOfTheNext) {
    // Overlapping the floor and leaving it upwards still meets the ceiling: 0.2 + 0.5 + t 4 = 3.
    Soup soup = slab();
    soup.add({-10, 3, -10}, {-10, 3, 10}, {20, 3, 0});
    const auto contact = sweep_ellipsoid(soup.world(), half_radii, {0, 0.2, 0}, {0, 4, 0});
    ASSERT_TRUE(contact);
    EXPECT_EQ(contact->triangle, 1U);
    EXPECT_NEAR(contact->t, 2.3 / 4, 1e-15);
}

TEST(SweepStart, CentreInThePlane) {
    // The winding normal is the way out; the other way is further in.
    const CollisionWorld world = slab().world();
    EXPECT_FALSE(sweep_ellipsoid(world, half_radii, {0, 0, 0}, {0, 1, 0}));
    const auto contact = sweep_ellipsoid(world, half_radii, {0, 0, 0}, {0, -1, 0});
    ASSERT_TRUE(contact);
    EXPECT_EQ(contact->t, 0.0);
    EXPECT_EQ(contact->normal, Vec3(0, 1, 0));
}

TEST(SweepStart, CentreOnAnEdgeAndOnACornerHasAUnitNormal) {
    Soup soup;
    soup.add({0, 0, 0}, {0, 0, 4}, {4, 0, 0});
    soup.add({0, 9, 0}, {0, 9, 4}, {0, 9, 2});     // collinear
    soup.add({0, 18, 0}, {0, 18, 0}, {0, 18, 0});  // a point
    for (std::size_t i = 0; i < 3; ++i) {
        const CollisionWorld world = soup.single(i);
        for (const double z : {0.0, 2.0}) {
            const Vec3 from(0, 9.0 * static_cast<double>(i), i == 2 ? 0.0 : z);
            int hits = 0;
            for (const Vec3& move : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)}) {
                const auto contact = sweep_ellipsoid(world, half_radii, from, move);
                if (!contact) continue;
                ++hits;
                EXPECT_EQ(contact->t, 0.0);
                EXPECT_NEAR(contact->normal.norm(), 1, 1e-15);
                EXPECT_LT(contact->normal.dot(move), 0);
            }
            // One way in, the opposite way out, along is free.
            EXPECT_EQ(hits, 1);
        }
    }
}

TEST(SweepStart, LandingAndGoingOnNeverSinks) {
    // Moves exactly to the contact, then tries to go on: whatever side of 1 the distance was rounded to, it
    // is stopped.
    scenes::Random random(7);
    for (int i = 0; i < 2000; ++i) {
        Soup soup;
        const Vec3 normal = random.direction();
        const Vec3 u = normal.unitOrthogonal();
        const Vec3 v = normal.cross(u);
        soup.add(-50 * u - 50 * v, 50 * u - 50 * v, 50 * v);
        const CollisionWorld world = soup.world();
        const Vec3 radii(random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 1));
        const Vec3 from = 5 * normal + random.in_box(0.5);
        const Vec3 move = -8 * normal + random.in_box(1);
        const auto first = sweep_ellipsoid(world, radii, from, move);
        ASSERT_TRUE(first);
        const Vec3 landed = from + first->t * move;
        const auto second = sweep_ellipsoid(world, radii, landed, (1 - first->t) * move);
        ASSERT_TRUE(second);
        EXPECT_NEAR(second->t, 0, 1e-12);
        EXPECT_NEAR((second->normal - first->normal).norm(), 0, 1e-13);
    }
}

}  // namespace
}  // namespace slipface
