// Overlaps and closest points against the 113-bit oracle, family by family.
#include <gtest/gtest.h>

#include "exact_answer.h"
#include "families.h"

namespace slipface {
namespace {

using families::Case;

class OverlapAccuracy : public testing::TestWithParam<families::Family> {};

CollisionWorld world_of_one(const oracle::Triangle& triangle) {
    scenes::Soup soup;
    soup.add(triangle[0], triangle[1], triangle[2]);
    return soup.world();
}

// The triangle as an ellipsoid at rest sees it: exact, and how far off the engine may be, in radii. As for a
// sweep without a move: every number is relative to the way to the corners. Measured: 1.2 roundings of 2^-53
// for distances, 1.4 for points and normals, of 67,000 centres.
struct Seen {
    oracle::QuadVec gap;
    double distance;
    double rounding;

    Seen(const oracle::Triangle& triangle, const Vec3& radii, const Vec3& centre)
        : gap(oracle::Sweep(triangle, radii, centre, Vec3::Zero()).gap(0)),
          distance(static_cast<double>(oracle::length(gap))),
          rounding(
              oracle::engine_rounding(oracle::ClosedForm(triangle, radii, centre, Vec3::Zero()).reach())) {}

    // In radii, of a point that should be the nearest; what the place in the world rounds away is its own.
    double point_error(const Vec3& point, const Vec3& centre, const Vec3& radii) const {
        const double of_place = 4 * 0x1p-53 * centre.cwiseQuotient(radii).norm();
        const Vec3 exact = centre - oracle::vec(gap).cwiseProduct(radii);
        return std::max(0.0, (point - exact).cwiseQuotient(radii).norm() - of_place);
    }
};

// Where the family's sweep starts, some place on its way, and where it touches: there too 8 roundings to
// either side, so that what the margin excuses is all that it excuses.
std::vector<Vec3> centres_of(const Case& c, const CollisionWorld& world, scenes::Random& random) {
    std::vector<Vec3> list{c.from, c.from + random.uniform(0, 1) * c.move};
    const auto contact = sweep_ellipsoid(world, c.radii, c.from, c.move);
    if (!contact) return list;
    const Vec3 touch = c.from + contact->t * c.move;
    const Seen seen(c.triangle, c.radii, touch);
    const Vec3 out = 2 * seen.rounding * oracle::vec(seen.gap).cwiseProduct(c.radii);
    for (const int side : {-1, 0, 1})
        list.push_back(touch + side * out);
    return list;
}

TEST_P(OverlapAccuracy, NoWrongOverlap) {
    scenes::Random random(5);
    int inside = 0;
    int outside = 0;
    for (int i = 0; i < 500; ++i) {
        const Case c = GetParam().make(random);
        const CollisionWorld world = world_of_one(c.triangle);
        for (const Vec3& centre : centres_of(c, world, random)) {
            const Seen seen(c.triangle, c.radii, centre);
            Overlap overlap;
            const bool found = find_overlaps(world, c.radii, centre, {&overlap, 1}) == 1;
            ASSERT_EQ(overlaps_any(world, c.radii, centre), found) << i;
            ++(found ? inside : outside);
            if (std::abs(seen.distance - 1) > seen.rounding) {
                ASSERT_EQ(found, seen.distance < 1) << i;
            }
            if (!found) continue;
            ASSERT_NEAR(overlap.depth_sphere_space, 1 - seen.distance, seen.rounding) << i;
            ASSERT_LE(seen.point_error(overlap.point, centre, c.radii), seen.rounding) << i;
            // A centre within rounding of the triangle has no direction from it.
            if (seen.distance < 1e-9) continue;
            const Vec3 normal = overlap.normal.cwiseProduct(c.radii).normalized();
            const Vec3 exact = oracle::vec(seen.gap) / seen.distance;
            ASSERT_LE((normal - exact).norm() * seen.distance, seen.rounding) << i;
        }
    }
    EXPECT_GT(inside, 100);
    EXPECT_GT(outside, 100);
}

TEST_P(OverlapAccuracy, ClosestPointWithinRounding) {
    scenes::Random random(6);
    const Vec3 metre = Vec3::Ones();
    for (int i = 0; i < 500; ++i) {
        const Case c = GetParam().make(random);
        const CollisionWorld world = world_of_one(c.triangle);
        for (const Vec3& point : centres_of(c, world, random)) {
            const Seen seen(c.triangle, metre, point);
            const auto closest = closest_point(world, point);
            ASSERT_TRUE(closest) << i;
            ASSERT_NEAR(closest->distance, seen.distance, seen.rounding) << i;
            ASSERT_LE(seen.point_error(closest->point, point, metre), seen.rounding) << i;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Families, OverlapAccuracy, testing::ValuesIn(families::all), families::test_name);

}  // namespace
}  // namespace slipface
