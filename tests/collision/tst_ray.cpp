#include <gtest/gtest.h>

#include <numbers>

#include "scenes.h"

namespace slipface {
namespace {

using scenes::Random;
using scenes::Soup;

constexpr double inf = std::numeric_limits<double>::infinity();

TEST(Ray, HitsAFloorFromBothSides) {
    Soup soup;
    soup.add({-10, 0, -10}, {-10, 0, 10}, {20, 0, 0});
    const CollisionWorld world = soup.world();
    const auto above = cast_ray(world, {1, 3, 1}, {0, -2, 0});
    ASSERT_TRUE(above);
    EXPECT_NEAR(above->t, 1.5, 1e-15);
    EXPECT_NEAR((above->point - Vec3(1, 0, 1)).norm(), 0, 1e-14);
    EXPECT_EQ(above->normal, Vec3(0, 1, 0));
    EXPECT_FALSE(above->back_face);
    const auto below = cast_ray(world, {1, -3, 1}, {0, 2, 0});
    ASSERT_TRUE(below);
    EXPECT_EQ(below->normal, Vec3(0, -1, 0));
    EXPECT_TRUE(below->back_face);
}

TEST(Ray, EndsAtItsLimit) {
    Soup soup;
    soup.add({-10, 0, -10}, {-10, 0, 10}, {20, 0, 0});
    const CollisionWorld world = soup.world();
    EXPECT_TRUE(cast_ray(world, {1, 3, 1}, {0, -1, 0}, 3.0));
    EXPECT_FALSE(cast_ray(world, {1, 3, 1}, {0, -1, 0}, 2.999999));
    EXPECT_FALSE(cast_ray(world, {1, 3, 1}, {0, 1, 0}));
    EXPECT_FALSE(cast_ray(world, {1, 3, 1}, {0, -1, 0}, -1.0));
    // Starts on the triangle.
    EXPECT_EQ(cast_ray(world, {1, 0, 1}, {0, -1, 0}, 0.0)->t, 0.0);
}

TEST(Ray, LengthOfTheDirectionOnlyScalesT) {
    Random random(5);
    const CollisionWorld world = scenes::random_soup(random, 200, 5, 1).world();
    for (int i = 0; i < 300; ++i) {
        const Vec3 origin = random.in_box(6);
        const Vec3 direction = random.direction();
        const auto hit = cast_ray(world, origin, direction);
        for (const double scale : {0x1p-300, 0x1p-20, 0x1p40, 0x1p300}) {
            const auto scaled = cast_ray(world, origin, scale * direction);
            ASSERT_EQ(hit.has_value(), scaled.has_value());
            if (!hit) continue;
            EXPECT_EQ(hit->triangle, scaled->triangle);
            EXPECT_EQ(hit->t, scaled->t * scale);
        }
    }
}

// A closed surface cannot be left: rays from inside through every corner and through points of every edge all
// hit.
TEST(Ray, NeverSlipsThroughSharedEdgesAndCorners) {
    for (const Vec3f& shift : {Vec3f(0, 0, 0), Vec3f(1000, -2000, 3000)}) {
        Soup soup = scenes::ball(2, 4);
        for (Vec3f& p : soup.positions)
            p += shift;
        const CollisionWorld world = soup.world();
        Random random(6);
        const Vec3 middle = shift.cast<double>();
        std::size_t rays = 0;
        for (std::size_t i = 0; i < soup.triangles.size(); ++i) {
            const auto corners = world.triangle(static_cast<TriangleId>(i));
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3 origin = middle + (random.below(2) == 0 ? Vec3::Zero() : Vec3(random.in_box(0.5)));
                const Vec3& a = corners[k];
                const Vec3& b = corners[(k + 1) % 3];
                for (const Vec3& target :
                     {a, Vec3(0.5 * (a + b)), Vec3(a + random.uniform(0, 1) * (b - a))}) {
                    const auto hit = cast_ray(world, origin, target - origin);
                    ASSERT_TRUE(hit) << i;
                    EXPECT_NEAR(hit->t, 1, 1e-12);
                    ++rays;
                    // And none sneaks in from outside.
                    EXPECT_TRUE(cast_ray(world, origin + 3 * (target - origin), origin - target, 3.0));
                }
            }
        }
        EXPECT_EQ(rays, 9 * soup.triangles.size());
    }
}

TEST(Ray, AlongAnAxisThroughAGridOfSharedEdges) {
    Soup soup;
    for (int i = -3; i < 3; ++i) {
        for (int j = -3; j < 3; ++j) {
            const double x = i;
            const double z = j;
            soup.add_quad({x, 0, z}, {x, 0, z + 1}, {x + 1, 0, z + 1}, {x + 1, 0, z});
        }
    }
    const CollisionWorld world = soup.world();
    for (int i = -12; i <= 12; ++i) {
        for (int j = -12; j <= 12; ++j) {
            const auto hit = cast_ray(world, {0.25 * i, 2, 0.25 * j}, {0, -1, 0});
            ASSERT_TRUE(hit) << i << ' ' << j;
            EXPECT_EQ(hit->t, 2.0);
        }
    }
}

TEST(Ray, TheNearestOfManyIsTheBallsOwnSurface) {
    // A ray from the middle of a faceted ball leaves between the inscribed and the circumscribed radius.
    const CollisionWorld world = scenes::ball(2, 4).world();
    Random random(8);
    for (int i = 0; i < 1000; ++i) {
        const auto hit = cast_ray(world, {0, 0, 0}, random.direction());
        ASSERT_TRUE(hit);
        EXPECT_LE(hit->t, 2.0000002);
        EXPECT_GE(hit->t, 1.98);
        EXPECT_TRUE(hit->back_face);
    }
}

TEST(Ray, InThePlaneOfATriangleOrAcrossADegenerateOneMisses) {
    Soup soup;
    soup.add({0, 0, 0}, {0, 0, 1}, {1, 0, 0});
    soup.add({5, 0, 0}, {5, 0, 1}, {5, 0, 2});
    const CollisionWorld world = soup.world();
    EXPECT_FALSE(cast_ray(world, {-1, 0, 0.2}, {1, 0, 0}));
    EXPECT_FALSE(cast_ray(world, {5, 1, 0.5}, {0, -1, 0}));
}

// A triangle so far out that boxes say nothing about the others any more.
void add_far_out(Soup& soup) {
    soup.add(Vec3(8e14, 8e14, 8e14), Vec3(9e14, 8e14, 8e14), Vec3(8e14, 9e14, 8e14));
}

TEST(Ray, StartingInLineWithADegenerateTriangleMissesIt) {
    // All sheared corners lie on a line through the ray, so rounding alone says on which side it passes. The
    // triangle is 17 m away where the ray would be beside it.
    Soup soup;
    soup.add({8.375F, 8.375F, 8.875F}, {8.375F, 8.375F, 8.375F}, {8.375F, 8.375F, 195.264633F});
    add_far_out(soup);
    const CollisionWorld world = soup.world();
    const Vec3 from(8.375, 8.375, 0);
    scenes::Random random(5);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 motion(random.uniform(-20, 20), random.uniform(-20, 20), 195.26274108886719);
        EXPECT_FALSE(cast_ray(world, from, motion, 10.0)) << motion.transpose();
    }
}

TEST(Ray, ANeedleEndsAtItsTip) {
    // So thin that the tests for its two long sides round to zero beyond it, too.
    scenes::Random random(6);
    for (const double width : {1e-12, 1e-14, 1e-16}) {
        Soup soup;
        soup.add(Vec3(0, 0, 0), Vec3(0, width, 0), Vec3(3, 3, 0));
        add_far_out(soup);
        const CollisionWorld world = soup.world();
        for (int i = 0; i < 1000; ++i) {
            const double position =
                random.below(2) == 0 ? random.uniform(1.001, 3) : random.uniform(-3, -0.001);
            const Vec3 beyond(3 * position, 3 * position, 0);
            const Vec3 above(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.5, 4));
            EXPECT_FALSE(cast_ray(world, beyond + above, -above, 10.0)) << position;
        }
    }
}

TEST(Ray, RefusesWhatIsNoRay) {
    Random random(9);
    const CollisionWorld world = scenes::random_soup(random, 50, 2, 1).world();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(cast_ray(world, {nan, 0, 0}, {0, 0, 1}));
    EXPECT_FALSE(cast_ray(world, {0, inf, 0}, {0, 0, 1}));
    EXPECT_FALSE(cast_ray(world, {0, 0, 0}, {0, 0, nan}));
    EXPECT_FALSE(cast_ray(world, {0, 0, 0}, {inf, 0, 0}));
    EXPECT_FALSE(cast_ray(world, {0, 0, 0}, {0, 0, 0}));
    EXPECT_FALSE(cast_ray(world, {0, 0, 0}, {0, 0, 1}, nan));
    EXPECT_FALSE(cast_ray(CollisionWorld(), {0, 0, 0}, {0, 0, 1}));
}

}  // namespace
}  // namespace slipface
