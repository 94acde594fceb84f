// Each check of the audit against a state that must trip it and one that must not. The scene is a floor at y
// = 0 and a wall in the plane x = 1 from z = -2 to 2, as a rule 3 m high.
#include <gtest/gtest.h>

#include <cmath>

#include "audit_checks.h"
#include "audit_run.h"

namespace slipface::test {
namespace {

struct Wall {
    explicit Wall(float height = 3.0F) {
        const std::vector<Vec3f> positions{Vec3f(-9, 0, -9),    Vec3f(-9, 0, 9),     Vec3f(9, 0, 9),
                                           Vec3f(9, 0, -9),     Vec3f(1, 0, -2),     Vec3f(1, 0, 2),
                                           Vec3f(1, height, 2), Vec3f(1, height, -2)};
        const std::vector<std::array<std::uint32_t, 3>> triangles{{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
        const std::vector<FaceId> faces{0, 0, 1, 1};
        world = std::move(CollisionWorld::build({positions, triangles, faces}).value());
    }
    MovementScene scene() const { return {world, surfaces}; }
    static PlayerState standing_at(double x, double z) {
        PlayerState state;
        state.position = {x, 0.902, z};
        state.grounded = true;
        return state;
    }

    std::vector<SurfaceType> surfaces = preset_surface_types();
    MovementSettings settings = basic_settings();
    CollisionWorld world;
};

TEST(AuditChecks, ACentreOnTheOtherSideOfAWallPassedThroughIt) {
    const Wall wall;
    const PlayerInput input{.wish = {1.0, 0.0}};
    const auto passed = passed_through(wall.scene(), {}, wall.settings, Wall::standing_at(0.5, 0.0), input,
                                       1.0 / 60, Vec3(1.5, 0.902, 0.0));
    ASSERT_TRUE(passed);
    EXPECT_EQ(passed->face, 1u);
    EXPECT_DOUBLE_EQ(passed->amount, 1.0);
}

TEST(AuditChecks, AStepBesideTheWallIsFine) {
    const Wall wall;
    EXPECT_FALSE(passed_through(wall.scene(), {}, wall.settings, Wall::standing_at(0.5, 2.1), {}, 1.0 / 60,
                                Vec3(1.5, 0.902, 2.1)));
}

// Nobody is taken to have gone over it: only sweeps of the step itself lead around a face.
TEST(AuditChecks, AWallJustAboveTheCentreCountsLikeAnyOther) {
    for (const float height : {0.92F, 1.2F, 1.5F, 1.75F, 1.85F}) {
        const Wall wall(height);
        EXPECT_TRUE(passed_through(wall.scene(), {}, wall.settings, Wall::standing_at(0.5, 0.0), {}, 1.0 / 60,
                                   Vec3(1.5, 0.902, 0.0)))
            << height;
    }
    const Wall low(0.85F);
    EXPECT_FALSE(passed_through(low.scene(), {}, low.settings, Wall::standing_at(0.5, 0.0), {}, 1.0 / 60,
                                Vec3(1.5, 0.902, 0.0)));
}

// On the way up onto a shelf the centre passes over its edge; the straight way would lead through it.
TEST(AuditChecks, TheWayThatASweepTookIsFine) {
    Wall wall(1.0F);
    wall.settings.step_up = true;
    wall.settings.step_height = 1.5;
    wall.settings.walk_speed = 60.0;
    wall.settings.ground_acceleration = 1000.0;
    const PlayerInput input{.wish = {1.0, 0.0}};
    PlayerState before = Wall::standing_at(0.55, 0.0);
    before.velocity = {60.0, 0.0, 0.0};
    const PlayerState after = step(wall.scene(), wall.settings, before, input, 1.0 / 60, nullptr).state;
    ASSERT_GT(after.position.x(), 1.0);
    ASSERT_LT(after.position.y(), 0.91);
    EXPECT_FALSE(passed_through(wall.scene(), {}, wall.settings, before, input, 1.0 / 60, after.position));
}

TEST(AuditChecks, AFaceThatDoesNotBlockIsNoWall) {
    Wall wall;
    wall.world.set_face_surface(1, 2);
    wall.world.set_surface_rule(2, {.solid = true, .one_sided = true});
    const auto passed = [&](double from, double to) {
        return passed_through(wall.scene(), {}, wall.settings, Wall::standing_at(from, 0.0), {}, 1.0 / 60,
                              Vec3(to, 0.902, 0.0));
    };
    ASSERT_LT(wall.world.triangle_normal(2).x(), 0.0);
    EXPECT_TRUE(passed(0.5, 1.5)) << "against its front";
    EXPECT_FALSE(passed(1.5, 0.5)) << "from behind";
    EXPECT_FALSE(overlaps_deeply(wall.scene(), wall.settings, Vec3(0.9, 1.5, 0.0)));
}

// From the front a one-sided wall is a wall, and behind one from behind there may be one that holds.
TEST(AuditChecks, AOneSidedFaceHidesNoSolidOne) {
    const auto walls = [](std::initializer_list<std::pair<float, bool>> planes) {
        std::vector<Vec3f> positions;
        std::vector<std::array<std::uint32_t, 3>> triangles;
        std::vector<FaceId> faces;
        FaceId face = 0;
        for (const auto& [x, one_sided] : planes) {
            const auto first = static_cast<std::uint32_t>(positions.size());
            for (const auto& [y, z] : {std::pair(0.0F, -9.0F), {0.0F, 9.0F}, {9.0F, 0.0F}})
                positions.emplace_back(x, y, z);
            triangles.push_back({first, first + 1, first + 2});
            faces.push_back(face++);
        }
        CollisionWorld world = std::move(CollisionWorld::build({positions, triangles, faces}).value());
        world.set_surface_rule(1, {.solid = true, .one_sided = true});
        face = 0;
        for (const auto& plane : planes)
            world.set_face_surface(face++, plane.second ? 1 : 0);
        return world;
    };
    const std::vector<SurfaceType> surfaces = preset_surface_types();
    const MovementSettings settings;
    const auto passed = [&](const CollisionWorld& world, double from, double to) {
        return passed_through({world, surfaces}, {}, settings, Wall::standing_at(from, 0.0), {}, 1.0 / 60,
                              Vec3(to, 0.902, 0.0));
    };
    // All fronts look towards -x.
    const CollisionWorld hidden = walls({{1.0F, true}, {1.2F, false}, {1.4F, true}});
    ASSERT_LT(hidden.triangle_normal(0).x(), 0.0);
    const auto backwards = passed(hidden, 1.6, 0.5);
    ASSERT_TRUE(backwards);
    EXPECT_EQ(backwards->face, 1u);
    EXPECT_FALSE(passed(walls({{1.0F, true}, {1.4F, true}}), 1.6, 0.5)) << "from behind";
    EXPECT_TRUE(passed(walls({{1.0F, true}}), 0.5, 1.6)) << "from the front";
    // In one plane, in any order.
    EXPECT_TRUE(passed(walls({{1.0F, true}, {1.0F, false}}), 1.6, 0.5));
    EXPECT_TRUE(passed(walls({{1.0F, false}, {1.0F, true}}), 1.6, 0.5));
}

// Pressing against a wall for 2 s and then turning away is no trap, whenever the turn comes.
TEST(AuditChecks, AWalkerThatTurnsAwayIsNotStuck) {
    const Wall wall;
    const Vec3 at_wall(1.0 - wall.settings.radii.x() - wall.settings.skin, 0.902, 0.0);
    for (const double dt : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
        const auto second = static_cast<int>(std::lround(1.0 / dt));
        for (int turn = second; turn < 4 * second; turn += second / 15) {
            StuckWatch watch(dt);
            watch.begin(at_wall);
            for (int tick = 0; tick < turn; ++tick)
                ASSERT_FALSE(watch.tick(wall.scene(), wall.settings, at_wall, false, {.wish = {1.0, 0.0}}));
            // The tick in which it turns, and one in which it is gone.
            EXPECT_FALSE(watch.tick(wall.scene(), wall.settings, at_wall, false, {.wish = {-1.0, 0.0}}));
            EXPECT_FALSE(watch.tick(wall.scene(), wall.settings, at_wall - Vec3(0.05, 0, 0), false,
                                    {.wish = {-1.0, 0.0}}));
        }
        // One that stays though nothing is in its way is stuck, a quarter of a second later.
        StuckWatch watch(dt);
        watch.begin(at_wall);
        std::optional<double> stuck;
        for (int tick = 0; tick < 3 * second && !stuck; ++tick)
            stuck = watch.tick(wall.scene(), wall.settings, at_wall, false,
                               {.wish = {tick < 2 * second ? 1.0 : -1.0, 0.0}});
        ASSERT_TRUE(stuck);
        EXPECT_NEAR(*stuck, 2.25, 2.5 * dt);
    }
}

TEST(AuditChecks, OverlapsCountOnlyBeyondTheSkin) {
    const Wall wall;
    const double touching = 1.0 - wall.settings.radii.x();
    EXPECT_FALSE(overlaps_deeply(wall.scene(), wall.settings, Vec3(touching, 1.5, 0.0)));
    EXPECT_FALSE(
        overlaps_deeply(wall.scene(), wall.settings, Vec3(touching + 0.5 * wall.settings.skin, 1.5, 0.0)));
    const auto deep =
        overlaps_deeply(wall.scene(), wall.settings, Vec3(touching + 3.0 * wall.settings.skin, 1.5, 0.0));
    ASSERT_TRUE(deep);
    EXPECT_EQ(deep->face, 1u);
}

TEST(AuditChecks, AWallBlocksTheWayAndOpenFloorDoesNot) {
    const Wall wall;
    const Vec3 at_wall(1.0 - wall.settings.radii.x() - wall.settings.skin, 0.902, 0.0);
    EXPECT_FALSE(path_is_free(wall.scene(), wall.settings, at_wall, {1.0, 0.0}));
    EXPECT_TRUE(path_is_free(wall.scene(), wall.settings, at_wall, {-1.0, 0.0}));
    EXPECT_FALSE(level_is_closed(wall.world, at_wall));
}

// The wall of Wall goes 2 m to the left, past a player at rest.
struct MovingWall : Wall {
    MovingWall() {
        const std::vector<Vec3f> positions{Vec3f(1, 0, -2), Vec3f(1, 0, 2), Vec3f(1, 3, 2), Vec3f(1, 3, -2)};
        const std::vector<std::array<std::uint32_t, 3>> triangles{{0, 1, 2}, {0, 2, 3}};
        const std::vector<FaceId> faces{7, 7};
        moved = std::move(CollisionWorld::build({positions, triangles, faces}).value());
        part = {.rest = &moved, .begin = {}, .end = {.offset = {-2, 0, 0}}};
        floor = std::move(CollisionWorld::build(
                              {std::vector<Vec3f>{Vec3f(-9, 0, -9), Vec3f(-9, 0, 9), Vec3f(9, 0, 9)},
                               std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}}, std::vector<FaceId>{0}})
                              .value());
    }
    MovementScene moving_scene() const {
        return {.collision = floor, .surfaces = surfaces, .platforms = {&part, 1}};
    }
    CollisionWorld moved, floor;
    MovingPart part;
};

TEST(AuditChecks, AWallThatMovedPastAPlayerPassedThroughHim) {
    const MovingWall wall;
    const auto check = [&](double from, double to, double z) {
        return passed_through(wall.moving_scene(), rides_of(wall.moving_scene().platforms), wall.settings,
                              Wall::standing_at(from, z), {}, 1.0 / 60, Vec3(to, 0.902, z));
    };
    const auto passed = check(0.0, 0.0, 0.0);
    ASSERT_TRUE(passed);
    EXPECT_EQ(passed->face, 7u);
    EXPECT_DOUBLE_EQ(passed->amount, 2.0) << "in the wall's frame";
    EXPECT_FALSE(check(0.0, -1.5, 0.0)) << "pushed along in front of it";
    EXPECT_FALSE(check(0.0, 0.0, 2.5)) << "beside it";
    EXPECT_FALSE(check(1.5, 1.5, 0.0)) << "behind it";
}

TEST(AuditChecks, PlatformsAreOverlappedAndBlockTheWay) {
    const MovingWall wall;
    const auto deep = overlaps_deeply(wall.moving_scene(), wall.settings, Vec3(-0.9, 1.5, 0.0));
    ASSERT_TRUE(deep);
    EXPECT_EQ(deep->face, 7u);
    const Vec3 at_wall(-1.0 - wall.settings.radii.x() - wall.settings.skin, 0.902, 0.0);
    EXPECT_FALSE(path_is_free(wall.moving_scene(), wall.settings, at_wall, {1.0, 0.0}));
    EXPECT_TRUE(path_is_free(wall.moving_scene(), wall.settings, at_wall, {-1.0, 0.0}));
}

}  // namespace
}  // namespace slipface::test
