// A neighbourhood answers as its world does, also as far out as it reaches and where floats cannot tell.
#include <gtest/gtest.h>

#include <algorithm>

#include "brute_force.h"
#include "every_simd_path.h"
#include "slipface/collision/neighbourhood.h"

namespace slipface {
namespace {

using scenes::Random;
using scenes::same;
using scenes::Soup;

using Neighbourhoods = EverySimdPath;

// A vector of -1, 0 and 1, mostly not 0.
Vec3 towards_an_end(Random& random) {
    Vec3 motion = Vec3::Zero();
    for (const int axis : {0, 1, 2})
        motion[axis] = random.below(4) == 0 ? 0.0 : random.below(2) == 0 ? 1.0 : -1.0;
    return motion;
}

// One triangle that an ellipsoid at the very end of its reach overlaps by a hair, or misses by one.
TEST_F(Neighbourhoods, TellAsMuchAtTheirEndsAsTheirWorld) {
    Random random(31);
    int overlaps = 0;
    int misses = 0;
    int hits = 0;
    int stayed = 0;
    for (int i = 0; i < 4000; ++i) {
        SCOPED_TRACE(i);
        const double far = random.below(4) == 0 ? 3000.0 : 10.0;
        const Vec3 centre = random.in_box(far);
        const Vec3 radii(random.uniform(0.2, 1), random.uniform(0.2, 2), random.uniform(0.2, 1));
        const Vec3 reach(random.uniform(0, 1), random.uniform(0, 3), random.uniform(0, 1));
        const Vec3 outwards = towards_an_end(random);
        const Vec3 end = centre + outwards.cwiseProduct(reach);
        const Vec3 from = centre + random.in_box(1).cwiseProduct(reach);

        // Across the way outwards, at the ellipsoid's surface but for a hair.
        const bool straight = outwards.squaredNorm() > 0 && random.below(2) == 0;
        const Vec3 normal = straight ? Vec3(outwards.normalized()) : random.direction();
        const double hair = std::pow(10.0, random.uniform(-9, -4));
        const double inside = random.below(2) == 0 ? 1.0 - hair : 1.0 + hair;
        const Vec3 beside = normal.cross(random.direction()).normalized();
        const double size = std::pow(10.0, random.uniform(-1, 1.5));
        const Vec3 other = size * random.uniform(0.3, 1) * normal.cross(beside);
        const auto corner = [&](const Vec3& at) { return Vec3(end + radii.cwiseProduct(at)); };
        const Vec3 touch = inside * normal;
        Soup soup;
        soup.add(corner(touch - size * beside - other), corner(touch + size * beside - other),
                 corner(touch + 2 * other));
        const CollisionWorld world = soup.world();

        const bool overlap = overlaps_any(world, radii, end);
        const auto contact = sweep_ellipsoid(world, radii, from, end - from);
        ++(overlap ? overlaps : misses);
        hits += contact.has_value();
        for (const std::string_view path : simd_paths()) {
            ASSERT_TRUE(set_simd_path(path));
            const Neighbourhood near(world, radii, centre, reach);
            stayed += near.holds(radii, from, end - from);
            EXPECT_EQ(overlaps_any(near, radii, end), overlap) << path;
            EXPECT_EQ(overlaps_any(Neighbourhood(world, radii, end, reach), radii, end), overlap) << path;
            EXPECT_TRUE(same(sweep_ellipsoid(near, radii, from, end - from), contact)) << path;
        }
    }
    EXPECT_GT(overlaps, 500);
    EXPECT_GT(misses, 500);
    EXPECT_GT(hits, 500);
    EXPECT_GT(stayed, 1200 * static_cast<int>(simd_paths().size()));
}

// Further away, and for other bodies, the world is asked.
TEST_F(Neighbourhoods, SendAwayWhatLeadsOut) {
    Random random(32);
    const CollisionWorld world = scenes::terrain(random, 12, 0.7).world();
    const Vec3 centre(4, 1.5, 4);
    const Vec3 radii(0.4, 0.9, 0.4);
    const Vec3 reach(0.5, 1, 0.25);
    const Neighbourhood near(world, radii, centre, reach);
    ASSERT_GT(near.triangles().count, 0U);
    EXPECT_TRUE(near.holds(radii, centre, reach));
    EXPECT_TRUE(near.holds(radii, centre - reach, 2 * reach));
    for (const int axis : {0, 1, 2}) {
        const Vec3 out = 1.001 * reach[axis] * Vec3::Unit(axis);
        EXPECT_FALSE(near.holds(radii, centre, out)) << axis;
        EXPECT_FALSE(near.holds(radii, centre - out, out)) << axis;
        EXPECT_FALSE(near.holds(radii + 1e-9 * Vec3::Unit(axis), centre, Vec3::Zero())) << axis;
    }
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(near.holds(radii, Vec3(4, nan, 4), Vec3::Zero()));
    EXPECT_FALSE(near.holds(Vec3(nan, nan, nan), centre, Vec3::Zero()));
    const Vec3 far(0, -3, 0);
    EXPECT_TRUE(same(sweep_ellipsoid(near, radii, centre, far), sweep_ellipsoid(world, radii, centre, far)));

    const auto holds_something = [&](const Vec3& its_radii, const Vec3& at, const Vec3& its_reach) {
        return Neighbourhood(world, its_radii, at, its_reach).holds(its_radii, at, Vec3::Zero());
    };
    EXPECT_TRUE(holds_something(radii, centre, Vec3::Zero()));
    EXPECT_FALSE(holds_something(radii, centre, Vec3(-1, 0, 0)));
    EXPECT_FALSE(holds_something(radii, centre, Vec3(0, nan, 0)));
    EXPECT_FALSE(holds_something(radii, centre, Vec3(0, 0, 500)));
    EXPECT_FALSE(holds_something(Vec3(0, 1, 1), centre, reach));
    EXPECT_FALSE(holds_something(radii, Vec3(0, 1e300, 0), reach));
    // More than it has room for.
    EXPECT_FALSE(holds_something(radii, centre, Vec3(10, 10, 10)));
    EXPECT_FALSE(Neighbourhood(CollisionWorld(), radii, centre, reach).holds(radii, centre, reach));
}

// Rays that begin or end in it, pass through it or lie beside it.
TEST_F(Neighbourhoods, RaysHitWhatTheyHitInTheWorld) {
    Random random(33);
    int hits = 0;
    int inside = 0;
    for (int i = 0; i < 300; ++i) {
        SCOPED_TRACE(i);
        const double far = random.below(4) == 0 ? 5000.0 : 0.0;
        const Vec3 at = far * random.direction();
        Soup soup = random_soup(random, 100, 1.5, 1);
        for (Vec3f& position : soup.positions)
            position += at.cast<float>();
        const CollisionWorld world = soup.world();
        const Vec3 radii(random.uniform(0.2, 1), random.uniform(0.2, 1), random.uniform(0.2, 1));
        const Vec3 reach(random.uniform(0, 0.5), random.uniform(0, 1), random.uniform(0, 0.5));
        for (const std::string_view path : simd_paths()) {
            ASSERT_TRUE(set_simd_path(path));
            const Neighbourhood near(world, radii, at, reach);
            for (int k = 0; k < 40; ++k) {
                const Vec3 from = at + random.in_box(random.below(3) == 0 ? 2 : 0.5);
                const Vec3 ray = random.below(2) == 0 ? Vec3(0, -random.uniform(0, 3), 0)
                                                      : Vec3(random.uniform(0, 3) * random.direction());
                const double most = random.below(4) == 0 ? std::numeric_limits<double>::infinity() : 1.0;
                const auto expected = cast_ray(world, from, ray, most);
                EXPECT_TRUE(same(cast_ray(near, from, ray, most), expected)) << path;
                hits += expected.has_value();
                inside += expected && (expected->point - at).norm() < 0.4;
            }
        }
    }
    EXPECT_GT(hits, 2000 * static_cast<int>(simd_paths().size()));
    EXPECT_GT(inside, 200);
}

// What a vertical ray from the way hits lies no higher, but for triangles that are too steep.
TEST_F(Neighbourhoods, BoundTheHeightBelowAWay) {
    Random random(34);
    int below = 0;
    int tight = 0;
    for (int i = 0; i < 400; ++i) {
        SCOPED_TRACE(i);
        const double far = random.below(4) == 0 ? 5000.0 : 0.0;
        const Vec3 at = far * random.direction();
        Soup soup = random_soup(random, 60, 1.5, 1);
        for (Vec3f& position : soup.positions)
            position += at.cast<float>();
        const CollisionWorld world = soup.world();
        const double cosine = random.below(2) == 0 ? 0.0 : random.uniform(0, 1);
        const Vec3 from = at + random.in_box(0.5);
        const Vec3 to = random.below(8) == 0 ? from : Vec3(at + random.in_box(0.5));
        for (const std::string_view path : simd_paths()) {
            ASSERT_TRUE(set_simd_path(path));
            const Neighbourhood near(world, Vec3(0.5, 0.5, 0.5), at, Vec3(0.2, 1, 0.2));
            const double bound = highest_below(near, from, to, cosine);
            ASSERT_LT(bound, 1e9);
            EXPECT_EQ(highest_below(near, from, to + Vec3(3, 0, 0), cosine),
                      std::numeric_limits<double>::infinity());
            double highest = -1e9;
            for (int k = 0; k <= 64; ++k) {
                Vec3 sample = from + (to - from) * (k / 64.0);
                sample.y() = from.y();
                for (int left = 20; left > 0; --left) {
                    const auto hit = cast_ray(world, sample, Vec3(0, -1, 0));
                    if (!hit) break;
                    // The first one that counts, also below steep ones.
                    if (std::abs(hit->normal.y()) >= cosine) highest = std::max(highest, hit->point.y());
                    sample.y() = hit->point.y() - 1e-6;
                }
            }
            EXPECT_LE(highest, bound + 1e-6 + 1e-9 * far) << path;
            below += highest > -1e9;
            tight += highest > bound - 0.3;
        }
    }
    EXPECT_GT(below, 200 * static_cast<int>(simd_paths().size()));
    EXPECT_GT(tight, 20 * static_cast<int>(simd_paths().size()));
}

}  // namespace
}  // namespace slipface
