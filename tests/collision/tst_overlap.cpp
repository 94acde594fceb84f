#include <gtest/gtest.h>

#include "scenes.h"

namespace slipface {
namespace {

using scenes::corner_triangle;
using scenes::Soup;

Overlap only(const CollisionWorld& world, const Vec3& radii, const Vec3& centre) {
    std::array<Overlap, 2> found;
    EXPECT_EQ(find_overlaps(world, radii, centre, found), 1U);
    return found[0];
}

TEST(Overlap, DepthAndNormalOfEachFeature) {
    const CollisionWorld world = corner_triangle().world();
    const Vec3 radii = Vec3::Constant(0.5);
    const Overlap interior = only(world, radii, {1, 0.2, 1});
    EXPECT_EQ(interior.feature, Feature::interior);
    EXPECT_NEAR(interior.depth_sphere_space, 0.6, 1e-15);  // 1 - 0.2 / 0.5
    EXPECT_EQ(interior.normal, Vec3(0, 1, 0));
    EXPECT_NEAR((interior.point - Vec3(1, 0, 1)).norm(), 0, 1e-15);

    const Overlap edge = only(world, radii, {-0.3, 0, 2});
    EXPECT_EQ(edge.feature, Feature::edge);
    EXPECT_NEAR(edge.depth_sphere_space, 0.4, 1e-15);
    EXPECT_NEAR((edge.normal - Vec3(-1, 0, 0)).norm(), 0, 1e-15);
    EXPECT_NEAR((edge.point - Vec3(0, 0, 2)).norm(), 0, 1e-15);

    const Overlap vertex = only(world, radii, {0, 0, -0.25});
    EXPECT_EQ(vertex.feature, Feature::vertex);
    EXPECT_EQ(vertex.depth_sphere_space, 0.5);
    EXPECT_EQ(vertex.point, Vec3(0, 0, 0));
}

TEST(Overlap, EllipsoidUsesItsOwnSpace) {
    const CollisionWorld world = corner_triangle().world();
    // Height 0.45 of a vertical radius of 0.9: half deep. The closest point in sphere space is straight
    // below.
    const Overlap overlap = only(world, {0.3, 0.9, 0.3}, {1, 0.45, 1});
    EXPECT_NEAR(overlap.depth_sphere_space, 0.5, 1e-15);
    EXPECT_EQ(overlap.normal, Vec3(0, 1, 0));
    // 0.35 beside the edge is outside a horizontal radius of 0.3, although inside the vertical one.
    EXPECT_FALSE(overlaps_any(world, {0.3, 0.9, 0.3}, {-0.35, 0, 2}));
    EXPECT_TRUE(overlaps_any(world, {0.3, 0.9, 0.3}, {-0.25, 0, 2}));
}

TEST(Overlap, TouchIsNoOverlap) {
    const CollisionWorld world = corner_triangle().world();
    const Vec3 radii = Vec3::Constant(0.5);
    EXPECT_FALSE(overlaps_any(world, radii, {1, 0.5, 1}));
    EXPECT_TRUE(overlaps_any(world, radii, {1, std::nextafter(0.5, 0.0), 1}));
}

TEST(Overlap, CentreInThePlaneUsesTheWindingNormal) {
    const Overlap overlap = only(corner_triangle().world(), Vec3::Constant(0.5), {1, 0, 1});
    EXPECT_EQ(overlap.depth_sphere_space, 1.0);
    EXPECT_EQ(overlap.normal, Vec3(0, 1, 0));
}

TEST(Overlap, CountsMoreThanTheListHolds) {
    Soup soup;
    for (int i = 0; i < 20; ++i)
        soup.add({-1, 0.01 * i, -1}, {-1, 0.01 * i, 1}, {2, 0.01 * i, 0});
    const CollisionWorld world = soup.world();
    std::array<Overlap, 4> few;
    EXPECT_EQ(find_overlaps(world, Vec3::Constant(0.5), {0, 0.1, 0}, few), 20U);
    for (std::size_t k = 0; k < few.size(); ++k)
        EXPECT_EQ(few[k].triangle, k);
    EXPECT_EQ(find_overlaps(world, Vec3::Constant(0.5), {0, 0.1, 0}, {}), 20U);
}

TEST(ClosestPoint, OfAPointBesideATriangle) {
    const CollisionWorld world = corner_triangle().world();
    const auto above = closest_point(world, {1, 2, 1});
    ASSERT_TRUE(above);
    EXPECT_EQ(above->distance, 2.0);
    EXPECT_NEAR((above->point - Vec3(1, 0, 1)).norm(), 0, 1e-15);
    const auto corner = closest_point(world, {-3, 4, -12});
    ASSERT_TRUE(corner);
    EXPECT_EQ(corner->distance, 13.0);
    EXPECT_EQ(corner->point, Vec3(0, 0, 0));
}

TEST(ClosestPoint, WithinItsLimit) {
    const CollisionWorld world = corner_triangle().world();
    EXPECT_TRUE(closest_point(world, {1, 2, 1}, 2.0));
    EXPECT_FALSE(closest_point(world, {1, 2, 1}, 1.999));
    EXPECT_FALSE(closest_point(world, {1, 2, 1}, -1));
    EXPECT_FALSE(closest_point(world, {1, 2, 1}, std::numeric_limits<double>::quiet_NaN()));
    EXPECT_FALSE(closest_point(CollisionWorld(), {1, 2, 1}));
    EXPECT_TRUE(closest_point(world, {1e6, 2, 1}));
}

}  // namespace
}  // namespace slipface
