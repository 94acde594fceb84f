// Worlds so large that the construction takes triangles by the cells of a grid (8192 and more), of every
// shape that grids are bad at.
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include "scenes.h"
#include "sound_tree.h"

namespace slipface {
namespace {

using scenes::Random;
using scenes::Soup;

// Every triangle is where a query for its box finds it, and a ray at its middle finds nothing behind it.
// Returns the nodes for each thousand triangles.
double expect_complete(const Soup& soup, std::span<const std::uint32_t> bodies = {}) {
    TriangleSoup view = soup.view();
    view.bodies = bodies;
    const auto built = CollisionWorld::build(view);
    if (!built) {
        ADD_FAILURE() << built.error().text();
        return 0;
    }
    const CollisionWorld& world = *built;
    EXPECT_EQ(scenes::SoundTree(world.impl().bvh, view).fault(), "");
    EXPECT_EQ(world.triangles_in(world.bounds()).size(), soup.triangles.size());
    Random random(31);
    for (int i = 0; i < 300; ++i) {
        const auto id = static_cast<TriangleId>(random.below(soup.triangles.size()));
        const auto corners = world.triangle(id);
        Aabb box;
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_EQ(corners[k], soup.positions[soup.triangles[id][k]].cast<double>());
            box.add(corners[k]);
        }
        const auto found = world.triangles_in(box);
        EXPECT_TRUE(std::binary_search(found.begin(), found.end(), id));
        const Vec3 middle = (corners[0] + corners[1] + corners[2]) / 3;
        const Vec3 normal = world.triangle_normal(id);
        const double length = (corners[1] - corners[0]).norm();
        if (normal.isZero() || !(length > 1e-30 && length < 1e30)) continue;
        const auto hit = cast_ray(world, middle + length * normal, -2 * length * normal, 1.0);
        EXPECT_LE(hit ? hit->t : 1.0, 0.5 + 1e-6);
    }
    const BvhStatistics statistics = world.statistics();
    EXPECT_EQ(statistics.triangles, soup.triangles.size());
    return 1000.0 * static_cast<double>(statistics.nodes) / static_cast<double>(statistics.triangles);
}

// A few metres of clutter at `at`, `scale` times as large.
void add_clutter(Soup& soup, Random& random, std::size_t count, const Vec3& at, double scale) {
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 corner = at + scale * random.in_box(10);
        soup.add(corner, corner + scale * random.in_box(0.3), corner + scale * random.in_box(0.3));
    }
}

TEST(Construction, RoomsGroundAndClutter) {
    Random random(32);
    const double ground = expect_complete(scenes::terrain(random, 100, 1));
    const double rooms = expect_complete(scenes::Rooms(random, 6, 2).soup);
    const double clutter = expect_complete(scenes::random_soup(random, 20000, 20, 0.3));
    // Full nodes of full leaves would be 1000 / 64 = 16, and their parents 2 more; half full ones 62.
    for (const double nodes : {ground, rooms, clutter})
        EXPECT_LT(nodes, 62);
}

TEST(Construction, AFlatField) {
    Soup soup;
    for (double i = 0; i < 100; ++i) {
        for (double j = 0; j < 100; ++j)
            soup.add_quad({i, 3, j}, {i, 3, j + 1}, {i + 1, 3, j + 1}, {i + 1, 3, j});
    }
    EXPECT_LT(expect_complete(soup), 62);
}

TEST(Construction, ALineOfPoints) {
    Soup soup;
    for (int i = 0; i < 10000; ++i)
        soup.add(Vec3::Constant(i), Vec3::Constant(i), Vec3::Constant(i));
    EXPECT_LT(expect_complete(soup), 62);
}

// No plane parts them: they are halved.
TEST(Construction, AllAtOnePosition) {
    Soup soup;
    for (int i = 0; i < 20000; ++i)
        soup.add({1, 2, 3}, {2, 2, 3}, {1, 2, 4});
    expect_complete(soup);
}

// A grid over everything has all of the clutter in one cell; each has to be parted by a grid of its own.
TEST(Construction, ClutterInAStadium) {
    Random random(33);
    Soup soup;
    add_clutter(soup, random, 15000, {0, 0, 0}, 1);
    add_clutter(soup, random, 15000, {5000, 0, 0}, 1e-3);
    const double near = expect_complete(soup);
    for (int i = 0; i < 100; ++i)
        soup.add(1e6 * random.direction(), 1e6 * random.direction(), 1e6 * random.direction());
    EXPECT_LT(expect_complete(soup), near + 2);
}

// Any clutter anywhere, some of it in few cells while the rest still lies in cells.
TEST(Construction, ClutterHereAndThere) {
    Random random(36);
    for (int i = 0; i < 12; ++i) {
        Soup soup;
        for (std::size_t parts = 2 + random.below(4); parts > 0; --parts) {
            const std::size_t count = 2000 + random.below(14000);
            add_clutter(soup, random, count, random.in_box(std::pow(10.0, random.uniform(1, 5))),
                        std::pow(10.0, random.uniform(-3, 2)));
        }
        expect_complete(soup);
    }
}

TEST(Construction, TheWholeRangeOfFloats) {
    Random random(34);
    Soup soup;
    for (int i = 0; i < 20000; ++i) {
        const double size = std::pow(10.0, random.uniform(-44, 38));
        soup.add(size * random.direction(), size * random.direction(), size * random.direction());
    }
    for (const double x : {-3.4e38, 3.4e38})
        soup.add({x, 3.4e38, x}, {x, -3.4e38, x}, {-x, x, x});
    expect_complete(soup);
}

// Each half is parted from the rest by a plane of its own, deeper than splits by cost may go; at scales from
// the smallest floats to the largest, where areas overflow or vanish.
TEST(Construction, SeriesWithoutEnd) {
    for (const double grow : {1.01, 1.5, 2.0, 8.0}) {
        for (const int axes : {1, 2, 3}) {
            Soup soup;
            for (double r = 1e-44; soup.triangles.size() < 12000; r = r * grow < 3e38 ? r * grow : 1e-44) {
                const Vec3 at(r, axes > 1 ? r : 0, axes > 2 ? r : 0);
                soup.add(at, 0.9 * at, Vec3(at.y(), at.x(), at.z()));
            }
            expect_complete(soup);
        }
    }
}

// As many bodies as triangles, or one body in all the others' way, all at one position or not.
TEST(Construction, BodiesOfOneTriangle) {
    Random random(38);
    for (const double half : {0.0, 10.0}) {
        Soup soup = scenes::random_soup(random, 10000, half, 1);
        std::vector<std::uint32_t> bodies(soup.triangles.size());
        for (std::uint32_t& body : bodies)
            body = static_cast<std::uint32_t>(random.next());
        expect_complete(soup, bodies);
        for (std::size_t i = 0; i < bodies.size(); i += 2)
            bodies[i] = 7;
        expect_complete(soup, bodies);
    }
}

// Bodies lie mixed in the list and in space, one of them large enough for cells. Moving one's triangles must
// not move another's: no leaf has both.
TEST(Construction, BodiesApart) {
    Random random(35);
    Soup soup;
    add_clutter(soup, random, 24000, {0, 0, 0}, 1);
    std::vector<std::uint32_t> bodies;
    for (std::size_t i = 0; i < soup.triangles.size(); ++i)
        bodies.push_back(random.below(10) < 7 ? 4U : static_cast<std::uint32_t>(random.below(3)));
    EXPECT_LT(expect_complete(soup, bodies), 62);
}

// The tree's shape is not to be seen from outside but by its statistics and the order of equal work.
TEST(Construction, AnyNumberOfThreadsBuildsTheSameTree) {
    Random random(16);
    const Soup soup = scenes::terrain(random, 90, 1);
    const BvhStatistics all = soup.world().statistics();
    const BvhStatistics one = tbb::task_arena(1).execute([&] { return soup.world().statistics(); });
    EXPECT_EQ(all.nodes, one.nodes);
    EXPECT_EQ(all.depth, one.depth);
    EXPECT_EQ(all.bytes, one.bytes);
    EXPECT_LE(static_cast<double>(all.bytes) / static_cast<double>(all.triangles), 31.0);
}

// Faces of one to forty triangles: in ascending order, which takes a bit per triangle, with numbers left out,
// and in any order, which takes a list.
TEST(Construction, EveryTriangleKnowsItsFace) {
    Random random(37);
    for (int round = 0; round < 30; ++round) {
        Soup soup = scenes::random_soup(random, 1 + random.below(300), 10, 1);
        FaceId face = random.below(2) == 0 ? 0 : 7;
        const std::size_t longest = 1 + random.below(40), gap = 1 + random.below(3);
        for (FaceId& of : soup.faces) {
            if (random.below(longest) == 0) face += static_cast<FaceId>(1 + random.below(gap));
            of = face;
        }
        if (round % 3 == 0) {
            for (std::size_t i = soup.faces.size(); i > 1; --i)
                std::swap(soup.faces[i - 1], soup.faces[random.below(i)]);
        }
        CollisionWorld world = soup.world();
        for (const FaceId each : soup.faces)
            world.set_face_surface(each, static_cast<SurfaceId>(each % 200));
        for (TriangleId t = 0; t < soup.faces.size(); ++t) {
            ASSERT_EQ(world.triangle_face(t), soup.faces[t]) << t;
            ASSERT_EQ(world.face_surface(soup.faces[t]), soup.faces[t] % 200) << t;
        }
    }
}

}  // namespace
}  // namespace slipface
