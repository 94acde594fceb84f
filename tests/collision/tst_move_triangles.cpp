// A world whose triangles have moved answers as one built anew.
#include <gtest/gtest.h>

#include "brute_force.h"

namespace slipface {
namespace {

using scenes::Random;
using scenes::same;
using scenes::Soup;

struct Moving {
    Soup soup;
    std::vector<std::uint32_t> bodies;  // 0 stands still
    CollisionWorld world;

    explicit Moving(Soup s) : soup(std::move(s)), bodies(soup.triangles.size()) {
        for (std::size_t i = 0; i < bodies.size(); ++i)
            bodies[i] = static_cast<std::uint32_t>(i % 7 < 4 ? 0 : i % 3);
        auto built = CollisionWorld::build({soup.positions, soup.triangles, soup.faces, bodies});
        if (!built) throw std::runtime_error(built.error().text());
        world = std::move(built).value();
    }
    static constexpr std::uint32_t everything = 3;

    // Every corner of a body's triangles, or of all, goes through `map`.
    template <class Map>
    Status move(std::uint32_t body, Map&& map) {
        std::vector<TriangleId> ids;
        std::vector<std::array<Vec3f, 3>> corners;
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            if (body != everything && bodies[i] != body) continue;
            ids.push_back(static_cast<TriangleId>(i));
            auto& c = corners.emplace_back();
            for (std::size_t k = 0; k < 3; ++k) {
                // Corners may be shared with a body that stands still.
                c[k] = map(soup.positions[soup.triangles[i][k]]);
                soup.positions.push_back(c[k]);
                soup.triangles[i][k] = static_cast<std::uint32_t>(soup.positions.size() - 1);
            }
        }
        return world.move_triangles(ids, corners);
    }
};

void expect_same_answers(const Moving& moving, Random& random, int queries) {
    const CollisionWorld fresh = moving.soup.world();
    for (std::size_t i = 0; i < moving.soup.triangles.size(); ++i) {
        ASSERT_EQ(moving.world.triangle(static_cast<TriangleId>(i)),
                  fresh.triangle(static_cast<TriangleId>(i)));
    }
    for (int i = 0; i < queries; ++i) {
        const Vec3 radii(random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 1));
        const Vec3 from = random.in_box(8);
        const Vec3 move = random.uniform(0, 12) * random.direction();
        ASSERT_TRUE(same(sweep_ellipsoid(moving.world, radii, from, move),
                         sweep_ellipsoid(fresh, radii, from, move)));
        ASSERT_TRUE(same(cast_ray(moving.world, from, move), cast_ray(fresh, from, move)));
        ASSERT_TRUE(same(closest_point(moving.world, from), closest_point(fresh, from)));
        ASSERT_EQ(overlaps_any(moving.world, radii, from), overlaps_any(fresh, radii, from));
    }
}

TEST(MoveTriangles, AnswersAsAWorldBuiltAnew) {
    Random random(21);
    Moving moving(scenes::random_soup(random, 400, 6, 1));
    expect_same_answers(moving, random, 200);
    for (int tick = 0; tick < 12; ++tick) {
        const double angle = random.uniform(-1, 1);
        const Vec3f offset = random.in_box(1).cast<float>();
        const Eigen::Matrix3f turn =
            Eigen::AngleAxisd(angle, random.direction()).toRotationMatrix().cast<float>();
        const auto body = static_cast<std::uint32_t>(1 + random.below(2));
        ASSERT_TRUE(moving.move(body, [&](const Vec3f& p) { return Vec3f(turn * p + offset); }));
        expect_same_answers(moving, random, 60);
    }
}

// As platforms do. At the end no triangle keeps a corner in common with its neighbours.
TEST(MoveTriangles, WholeWorldsMoveAndTearApart) {
    Random random(25);
    Moving moving(scenes::ball(2, 3));
    for (int tick = 0; tick < 5; ++tick) {
        const Vec3f offset = random.in_box(1).cast<float>();
        ASSERT_TRUE(moving.move(Moving::everything, [&](const Vec3f& p) { return Vec3f(p + offset); }));
        expect_same_answers(moving, random, 60);
    }
    ASSERT_TRUE(moving.move(Moving::everything,
                            [&](const Vec3f& p) { return Vec3f(p + random.in_box(0.5).cast<float>()); }));
    expect_same_answers(moving, random, 200);
    ASSERT_TRUE(moving.move(Moving::everything, [&](const Vec3f& p) { return Vec3f(2.0F * p); }));
    expect_same_answers(moving, random, 100);
}

// Neighbours share corners; one of them leaves.
TEST(MoveTriangles, TearsATriangleOutOfItsNeighbours) {
    Random random(22);
    Moving moving(scenes::ball(2, 3));
    for (const std::uint32_t body : {1U, 2U, 0U}) {
        ASSERT_TRUE(moving.move(body, [&](const Vec3f& p) { return Vec3f(1.5F * p + Vec3f(0, 1, 0)); }));
        expect_same_answers(moving, random, 100);
    }
    std::array<Vec3f, 3> corners{Vec3f(1, 2, 3), Vec3f(2, 2, 3), Vec3f(1, 2, 5)};
    const TriangleId one = 17;
    ASSERT_TRUE(moving.world.move_triangles({&one, 1}, {&corners, 1}));
    EXPECT_EQ(moving.world.triangle(17)[2], Vec3(1, 2, 5));
}

TEST(MoveTriangles, RefusesAndMovesNothing) {
    Random random(23);
    Moving moving(scenes::random_soup(random, 30, 6, 1));
    const std::array<TriangleId, 2> ids{3, 30};
    std::array<std::array<Vec3f, 3>, 2> corners{};
    for (auto& triangle : corners)
        triangle.fill(Vec3f(0, 0, 0));
    EXPECT_FALSE(moving.world.move_triangles(ids, corners));
    EXPECT_FALSE(moving.world.move_triangles(std::span(ids).first(1), corners));
    corners[0][1].y() = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(moving.world.move_triangles(std::span(ids).first(1), std::span(corners).first(1)));
    expect_same_answers(moving, random, 20);
    EXPECT_FALSE(CollisionWorld::build({moving.soup.positions, moving.soup.triangles, moving.soup.faces,
                                        std::span(moving.bodies).first(3)}));
}

TEST(SweepBatch, GivesEachQueryTheAnswerOfASingleSweep) {
    Random random(24);
    const CollisionWorld world = scenes::random_soup(random, 500, 6, 1).world();
    std::vector<Sweep> sweeps;
    for (int i = 0; i < 3000; ++i)
        sweeps.push_back({Vec3(0.4, 0.9, 0.4), random.in_box(8), 5 * random.direction()});
    std::vector<std::optional<Contact>> out(sweeps.size() + 1);
    sweep_ellipsoids(world, sweeps, out);
    for (std::size_t i = 0; i < sweeps.size(); ++i) {
        ASSERT_TRUE(same(out[i], sweep_ellipsoid(world, sweeps[i].radii, sweeps[i].from, sweeps[i].move)));
    }
    EXPECT_FALSE(out.back());
}

}  // namespace
}  // namespace slipface
