// Triangles without area collide as the segments and points that they are.
#include <gtest/gtest.h>

#include <algorithm>

#include "scenes.h"

namespace slipface {
namespace {

using scenes::Soup;

const Vec3 half = Vec3::Constant(0.5);

void expect_contact(const CollisionWorld& world, const Vec3& radii, const Vec3& from, const Vec3& move,
                    double t, Feature feature, const Vec3& point) {
    const auto contact = sweep_ellipsoid(world, radii, from, move);
    ASSERT_TRUE(contact);
    EXPECT_NEAR(contact->t, t, 1e-14);
    EXPECT_EQ(contact->feature, feature);
    EXPECT_NEAR((contact->point - point).norm(), 0, 1e-14);
    EXPECT_NEAR(contact->normal.norm(), 1, 1e-15);
}

TEST(Degenerate, APointIsAVertex) {
    Soup soup;
    soup.add({1, 2, 3}, {1, 2, 3}, {1, 2, 3});
    // Down onto the point: 5 - 0.5 - 2 of 10.
    expect_contact(soup.world(), half, {1, 5, 3}, {0, -10, 0}, 0.25, Feature::vertex, {1, 2, 3});
    EXPECT_FALSE(sweep_ellipsoid(soup.world(), half, {1.6, 5, 3}, {0, -10, 0}));
    EXPECT_EQ(soup.world().triangle_normal(0), Vec3::Zero());
}

TEST(Degenerate, TwoEqualCornersAreASegment) {
    for (int shift = 0; shift < 3; ++shift) {
        std::array<Vec3, 3> corners{Vec3(-2, 0, 0), Vec3(-2, 0, 0), Vec3(2, 0, 0)};
        std::rotate(corners.begin(), corners.begin() + shift, corners.end());
        Soup soup;
        soup.add(corners[0], corners[1], corners[2]);
        expect_contact(soup.world(), half, {1, 3, 0}, {0, -5, 0}, 0.5, Feature::edge, {1, 0, 0});
        // Past its end: (0.3, 0.4) from the corner.
        expect_contact(soup.world(), half, {2.3, 3, 0}, {0, -5, 0}, 2.6 / 5, Feature::vertex, {2, 0, 0});
        EXPECT_FALSE(sweep_ellipsoid(soup.world(), half, {2.6, 3, 0}, {0, -5, 0}));
    }
}

TEST(Degenerate, CollinearCornersAreASegmentInEverySphereSpace) {
    // Corners on a line that no axis follows; radii that no float divides evenly.
    Soup soup;
    soup.add({0, 0, 0}, {1, 1, 1}, {3, 3, 3});
    const CollisionWorld world = soup.world();
    EXPECT_EQ(world.triangle_normal(0), Vec3::Zero());
    const Vec3 radii(0.3, 0.9, 0.7);
    // Sphere space: the line's direction is u = (1,1,1)/R; the centre comes down at (2, y, 2) and touches
    // where its distance from the line is 1. Solve |w|^2 - (w.u)^2 = 1 for w = ((0, y - 2, 0))/R.
    const Vec3 u = Vec3(1, 1, 1).cwiseQuotient(radii).normalized();
    const double w = 1 / std::sqrt(1 - u.y() * u.y());
    const double y = 2 + w * radii.y();
    const double foot = 2 + (w * u.y()) * u.y() * radii.y();  // along the line from (2,2,2): s u with s = w.u
    const auto contact = sweep_ellipsoid(world, radii, {2, 8, 2}, {0, -10, 0});
    ASSERT_TRUE(contact);
    EXPECT_EQ(contact->feature, Feature::edge);
    EXPECT_NEAR(contact->t, (8 - y) / 10, 1e-14);
    EXPECT_NEAR(contact->point.y(), foot, 1e-13);
    EXPECT_NEAR(contact->point.x(), contact->point.y(), 1e-15);
}

TEST(Degenerate, ANeedleNeverTilts) {
    // Height 2e-6 over a base of 100 m: the float corners give its plane only vaguely, so it must not be
    // trusted further than the needle is wide.
    scenes::Random random(3);
    for (int i = 0; i < 500; ++i) {
        const Vec3 at = random.in_box(100);
        const Vec3 along = random.direction();
        Soup soup;
        soup.add(at, at + 50 * along, at + 100 * along);
        const CollisionWorld world = soup.world();
        const auto corners = world.triangle(0);
        const Vec3 middle = corners[0] + random.uniform(0.1, 0.9) * (corners[2] - corners[0]);
        const Vec3 side = along.cross(random.direction()).normalized();
        const auto contact = sweep_ellipsoid(world, half, middle + 2 * side, -4 * side);
        ASSERT_TRUE(contact);
        // The middle corner is off the line by its rounding to float, at most 1e-5.
        EXPECT_NEAR(contact->t, 1.5 / 4, 1e-5);
        EXPECT_NEAR((contact->normal - side).norm(), 0, 1e-4);
    }
}

TEST(Degenerate, ANeedleEndsAtItsTip) {
    // So thin that the tests for its two long sides round to zero wherever they are asked.
    for (const float width : {2.5e-29F, 1e-20F, 1e-16F, 1e-14F}) {
        Soup soup;
        soup.add({0, 0, 0}, {0, width, 0}, {3.25, 3.25, 3.25});
        const CollisionWorld world = soup.world();
        const Vec3 beyond(6, 6, 6);
        const auto closest = closest_point(world, beyond);
        ASSERT_TRUE(closest);
        EXPECT_NEAR(closest->distance, 2.75 * std::sqrt(3.0), 1e-14);
        EXPECT_FALSE(overlaps_any(world, half, beyond));
        EXPECT_FALSE(sweep_ellipsoid(world, half, beyond + Vec3(2, 0, 0), {-4, 0, 0}));
        EXPECT_FALSE(sweep_ellipsoid(world, half, {-2, -2, -2}, {0.5, 0.5, -2}));
    }
}

TEST(Degenerate, ARadiusBelowTheRoundingOfTheWayHasANormal) {
    Soup soup;
    soup.add({5.125F, 5.125F, 0}, {5.125F, 5.125F, 5.125F}, {5.125F, 5.125F, 5.125F});
    const CollisionWorld world = soup.world();
    const Vec3 thin(1.1563734029980703e-15, 10, 10);
    for (const double z : {5.125, 9.0}) {
        const auto contact = sweep_ellipsoid(world, thin, {10, 5.125, z}, {-6.375, 0, 0});
        ASSERT_TRUE(contact);
        EXPECT_NEAR(contact->t, 4.875 / 6.375, 1e-15);
        EXPECT_NEAR(contact->normal.norm(), 1.0, 1e-15);
    }
}

TEST(Degenerate, OverlapAndDistance) {
    Soup soup;
    soup.add({-2, 0, 0}, {0, 0, 0}, {2, 0, 0});
    soup.add({0, 5, 0}, {0, 5, 0}, {0, 5, 0});
    const CollisionWorld world = soup.world();
    std::array<Overlap, 2> found;
    ASSERT_EQ(find_overlaps(world, half, {1, 0.3, 0}, found), 1U);
    EXPECT_EQ(found[0].feature, Feature::edge);
    EXPECT_NEAR(found[0].depth_sphere_space, 0.4, 1e-15);
    const auto closest = closest_point(world, {3, 4, 0});
    ASSERT_TRUE(closest);
    EXPECT_NEAR(closest->distance, std::sqrt(10.0), 1e-15);
    EXPECT_EQ(closest->triangle, 1U);
    // Centre exactly on them: unit normals all the same.
    for (const Vec3& centre : {Vec3(1, 0, 0), Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 5, 0)}) {
        ASSERT_EQ(find_overlaps(world, half, centre, found), 1U);
        EXPECT_NEAR(found[0].normal.norm(), 1, 1e-15);
        EXPECT_EQ(found[0].depth_sphere_space, 1.0);
    }
}

TEST(Degenerate, AWorldOfNothingElse) {
    Soup soup;
    for (int i = 0; i < 1000; ++i)
        soup.add({1, 1, 1}, {1, 1, 1}, {1, 1, 1});
    const CollisionWorld world = soup.world();
    const auto contact = sweep_ellipsoid(world, half, {1, 5, 1}, {0, -10, 0});
    ASSERT_TRUE(contact);
    EXPECT_EQ(contact->triangle, 0U);
    EXPECT_LE(world.statistics().depth, 12);
}

}  // namespace
}  // namespace slipface
