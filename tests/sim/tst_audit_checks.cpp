// Each check of the audit against a state that must trip it and one that must not. The scene is a floor at y
// = 0 and a wall in the plane x = 1 from z = -2 to 2, 3 m high.
#include <gtest/gtest.h>

#include "audit_checks.h"

namespace slipface::test {
namespace {

struct Wall {
    Wall() {
        const std::vector<Vec3f> positions{Vec3f(-9, 0, -9), Vec3f(-9, 0, 9), Vec3f(9, 0, 9),
                                           Vec3f(9, 0, -9),  Vec3f(1, 0, -2), Vec3f(1, 0, 2),
                                           Vec3f(1, 3, 2),   Vec3f(1, 3, -2)};
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
    MovementSettings settings;
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

TEST(AuditChecks, AStepBesideTheWallOrOverItIsFine) {
    const Wall wall;
    const PlayerInput input;
    const auto beside = passed_through(wall.scene(), {}, wall.settings, Wall::standing_at(0.5, 2.1), input,
                                       1.0 / 60, Vec3(1.5, 0.902, 2.1));
    EXPECT_FALSE(beside);
    // The straight line from the foot of the wall to its top's other side cuts it; the way over the top does
    // not.
    PlayerState low = Wall::standing_at(0.9, 0.0);
    low.position.y() = 2.6;
    EXPECT_FALSE(passed_through(wall.scene(), {}, wall.settings, low, input, 1.0 / 60, Vec3(1.1, 3.2, 0.0)));
}

TEST(AuditChecks, AFaceThatDoesNotBlockIsNoWall) {
    Wall wall;
    wall.world.set_face_surface(1, 2);
    wall.world.set_surface_rule(2, {.solid = true, .one_sided = true});
    EXPECT_FALSE(passed_through(wall.scene(), {}, wall.settings, Wall::standing_at(0.5, 0.0), {}, 1.0 / 60,
                                Vec3(1.5, 0.902, 0.0)));
    EXPECT_FALSE(overlaps_deeply(wall.scene(), wall.settings, Vec3(0.9, 1.5, 0.0)));
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
    EXPECT_FALSE(way_is_free(wall.scene(), wall.settings, at_wall, {1.0, 0.0}));
    EXPECT_TRUE(way_is_free(wall.scene(), wall.settings, at_wall, {-1.0, 0.0}));
    EXPECT_FALSE(level_is_closed(wall.world, at_wall));
}

// The wall of Wall goes 2 m to the left, past a player at rest.
struct MovingWall : Wall {
    MovingWall() {
        const std::vector<Vec3f> positions{Vec3f(-1, 0, -2), Vec3f(-1, 0, 2), Vec3f(-1, 3, 2),
                                           Vec3f(-1, 3, -2)};
        const std::vector<std::array<std::uint32_t, 3>> triangles{{0, 1, 2}, {0, 2, 3}};
        const std::vector<FaceId> faces{7, 7};
        moved = std::move(CollisionWorld::build({positions, triangles, faces}).value());
        part = {.collision = &moved, .begin = {}, .end = {.offset = {-2, 0, 0}}};
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
    EXPECT_FALSE(way_is_free(wall.moving_scene(), wall.settings, at_wall, {1.0, 0.0}));
    EXPECT_TRUE(way_is_free(wall.moving_scene(), wall.settings, at_wall, {-1.0, 0.0}));
}

}  // namespace
}  // namespace slipface::test
