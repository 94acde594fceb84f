// Sweeps whose answer follows from a line of geometry.
#include <gtest/gtest.h>

#include <numbers>

#include "scenes.h"

namespace slipface {
namespace {

using scenes::corner_triangle;
using scenes::Soup;

constexpr double tight = 1e-14;

Soup floor_at(double y, double half = 10.0) {
    Soup soup;
    // Winding normal +Y.
    soup.add_quad({-half, y, -half}, {-half, y, half}, {half, y, half}, {half, y, -half});
    return soup;
}

Vec3 ball(double r) {
    return Vec3::Constant(r);
}

TEST(SweepClosedForm, SphereFallsOnPlane) {
    // Centre 3 up, radius 0.5, 5 down: touches after 2.5 of 5.
    const auto contact = sweep_ellipsoid(floor_at(0).world(), ball(0.5), {1, 3, 2}, {0, -5, 0});
    ASSERT_TRUE(contact);
    EXPECT_NEAR(contact->t, 0.5, tight);
    EXPECT_EQ(contact->feature, Feature::interior);
    EXPECT_NEAR((contact->normal - Vec3(0, 1, 0)).norm(), 0, tight);
    EXPECT_NEAR((contact->point - Vec3(1, 0, 2)).norm(), 0, tight);
}

TEST(SweepClosedForm, FromBelowTheNormalPointsDown) {
    const auto contact = sweep_ellipsoid(floor_at(0).world(), ball(0.5), {1, -3, 2}, {0, 5, 0});
    ASSERT_TRUE(contact);
    EXPECT_NEAR(contact->t, 0.5, tight);
    EXPECT_NEAR((contact->normal - Vec3(0, -1, 0)).norm(), 0, tight);
}

TEST(SweepClosedForm, StopsShortOfThePlane) {
    // Reaches y = 0.5 + 1e-9 only.
    EXPECT_FALSE(sweep_ellipsoid(floor_at(0).world(), ball(0.5), {1, 3, 2}, {0, -2.5 + 1e-9, 0}));
    EXPECT_TRUE(sweep_ellipsoid(floor_at(0).world(), ball(0.5), {1, 3, 2}, {0, -2.5 - 1e-9, 0}));
}

TEST(SweepClosedForm, SphereMeetsAnEdge) {
    // The edge lies on the z axis. The centre moves along +x at height 0.3, radius 0.5: it touches at x =
    // -0.4 (3-4-5).
    const auto contact = sweep_ellipsoid(corner_triangle().world(), ball(0.5), {-2, 0.3, 1.5}, {4, 0, 0});
    ASSERT_TRUE(contact);
    EXPECT_NEAR(contact->t, 1.6 / 4, tight);
    EXPECT_EQ(contact->feature, Feature::edge);
    EXPECT_NEAR((contact->normal - Vec3(-0.8, 0.6, 0)).norm(), 0, tight);
    EXPECT_NEAR((contact->point - Vec3(0, 0, 1.5)).norm(), 0, tight);
}

TEST(SweepClosedForm, SphereMeetsAVertex) {
    // Along +x, 0.3 above and 0.3 before the corner at the origin; radius 0.5: x = -sqrt(0.25 - 0.18).
    const auto contact = sweep_ellipsoid(corner_triangle().world(), ball(0.5), {-2, 0.3, -0.3}, {4, 0, 0});
    ASSERT_TRUE(contact);
    const double x = -std::sqrt(0.25 - 0.18);
    EXPECT_NEAR(contact->t, (x + 2) / 4, tight);
    EXPECT_EQ(contact->feature, Feature::vertex);
    EXPECT_EQ(contact->point, Vec3(0, 0, 0));
    EXPECT_NEAR((contact->normal - Vec3(x, 0.3, -0.3) / 0.5).norm(), 0, tight);
}

TEST(SweepClosedForm, EllipsoidMeetsATiltedPlane) {
    // An ellipsoid touches a plane of unit normal n when its centre is sqrt(sum (n_i r_i)^2) away: the
    // support distance.
    const Vec3 radii(0.3, 0.9, 0.3);
    for (const double degrees : {10.0, 30.0, 45.0, 60.0, 80.0}) {
        const double angle = degrees * std::numbers::pi / 180;
        Soup soup;
        // A plane through the z axis that rises along +x. Its corners are rounded to float: take the normal
        // from them.
        const Vec3 along(std::cos(angle), std::sin(angle), 0);
        soup.add(-50 * along - Vec3(0, 0, 50), -50 * along + Vec3(0, 0, 50), 50 * along);
        const CollisionWorld world = soup.world();
        const Vec3 n = world.triangle_normal(0);
        ASSERT_GT(n.y(), 0);
        const double support = n.cwiseProduct(radii).norm();
        const Vec3 from(0.5, 20, 0.1);
        const Vec3 move(0, -40, 0);
        const auto contact = sweep_ellipsoid(world, radii, from, move);
        ASSERT_TRUE(contact);
        const double distance = n.dot(from - world.triangle(0)[0]);
        EXPECT_NEAR(contact->t, (distance - support) / (40 * n.y()), 1e-13) << degrees;
        EXPECT_NEAR((contact->normal - n).norm(), 0, 1e-13) << degrees;
        // The support point: centre - R^2 n / |R n|.
        const Vec3 centre = from + contact->t * move;
        const Vec3 point = centre - radii.cwiseProduct(radii).cwiseProduct(n) / support;
        EXPECT_NEAR((contact->point - point).norm(), 0, 1e-12) << degrees;
    }
}

TEST(SweepClosedForm, EllipsoidNormalIsTheGradient) {
    // Radii (1, 2, 1) against the edge on the z axis at height 1 below the centre: (x/1)^2 + (1/2)^2 = 1 at
    // x = -sqrt(3)/2, and the gradient there is (x/1, y/4) before normalising, not the direction to the
    // centre.
    const auto contact = sweep_ellipsoid(corner_triangle().world(), {1, 2, 1}, {-3, 1, 1.5}, {6, 0, 0});
    ASSERT_TRUE(contact);
    const double x = -std::sqrt(3.0) / 2;
    EXPECT_NEAR(contact->t, (x + 3) / 6, tight);
    EXPECT_NEAR((contact->normal - Vec3(x, 0.25, 0).normalized()).norm(), 0, tight);
}

TEST(SweepClosedForm, LongCastOntoAWideTriangle) {
    // Radius 0.2 from 15 in front of the plane, 30 long: touches after 15 - 0.2.
    Soup soup;
    soup.add({50, 25, 0}, {-50, 25, 0}, {0, -25, 0});
    const CollisionWorld world = soup.world();
    for (const double side : {1.0, -1.0}) {
        const auto contact = sweep_ellipsoid(world, ball(0.2), {0, 0, 15 * side}, {0, 0, -30 * side});
        ASSERT_TRUE(contact);
        EXPECT_NEAR(contact->t, (15 - 0.2) / 30, tight);
        EXPECT_NEAR((contact->normal - Vec3(0, 0, side)).norm(), 0, tight);
        EXPECT_EQ(contact->feature, Feature::interior);
    }
}

TEST(SweepClosedForm, NearestOfTwoFloors) {
    Soup soup = floor_at(0);
    const Soup upper = floor_at(1);
    soup.add_quad({-10, 1, -10}, {-10, 1, 10}, {10, 1, 10}, {10, 1, -10});
    const auto contact = sweep_ellipsoid(soup.world(), ball(0.5), {1, 3, 2}, {0, -5, 0});
    ASSERT_TRUE(contact);
    EXPECT_NEAR(contact->t, 1.5 / 5, tight);
    EXPECT_EQ(contact->face, soup.faces[2]);
}

TEST(SweepClosedForm, TieGoesToTheLowestTriangle) {
    // Straight down on the diagonal shared by both halves of the floor: the same touch in the interior of
    // each.
    const auto contact = sweep_ellipsoid(floor_at(0).world(), ball(0.5), {1, 3, 1}, {0, -5, 0});
    ASSERT_TRUE(contact);
    EXPECT_EQ(contact->triangle, 0U);
    // The same triangle three times.
    Soup soup;
    for (int i = 0; i < 3; ++i)
        soup.add({0, 0, 0}, {0, 0, 4}, {4, 0, 0});
    for (const Vec3& from : {Vec3(1, 3, 1), Vec3(-0.2, 3, 1), Vec3(-0.1, 3, -0.1)}) {
        const auto tie = sweep_ellipsoid(soup.world(), ball(0.5), from, {0, -5, 0});
        ASSERT_TRUE(tie);
        EXPECT_EQ(tie->triangle, 0U);
    }
}

TEST(SweepClosedForm, TiePrefersInteriorToEdgeToVertex) {
    // Three touches at the same height: a vertex, an edge and an interior, one triangle each, worst first.
    Soup soup;
    soup.add({0, 0, 0}, {-1, -3, 1}, {-1, -3, -1});  // apex up: vertex
    soup.add({0, 0, -1}, {0, 0, 1}, {0, -3, 0});     // standing on edge, ridge up
    soup.add({-1, 0, -1}, {-1, 0, 1}, {2, 0, 0});    // lying flat: interior
    const Vec3 from(0, 2, 0);
    const Vec3 move(0, -4, 0);
    for (std::size_t i = 0; i < 3; ++i) {
        const auto alone = sweep_ellipsoid(soup.single(i), ball(0.5), from, move);
        ASSERT_TRUE(alone);
        EXPECT_EQ(alone->t, 0.375) << i;
        EXPECT_EQ(static_cast<std::size_t>(alone->feature), 2 - i);
    }
    EXPECT_EQ(sweep_ellipsoid(soup.world(), ball(0.5), from, move)->triangle, 2U);
}

TEST(SweepClosedForm, ZeroMoveTouchesNothing) {
    EXPECT_FALSE(sweep_ellipsoid(floor_at(0).world(), ball(0.5), {1, 0.2, 2}, {0, 0, 0}));
}

TEST(SweepClosedForm, EmptyWorldTouchesNothing) {
    EXPECT_FALSE(sweep_ellipsoid(CollisionWorld(), ball(0.5), {0, 0, 0}, {0, -5, 0}));
    EXPECT_FALSE(sweep_ellipsoid(Soup().world(), ball(0.5), {0, 0, 0}, {0, -5, 0}));
}

}  // namespace
}  // namespace slipface
