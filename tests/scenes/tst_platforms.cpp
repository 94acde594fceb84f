// Riding, being pushed, being crushed and leaving: what moving geometry does to a player.
#include <gtest/gtest.h>

#include <cmath>

#include "slipface/level/level_scene.h"
#include "slipface/mesh/build.h"

namespace slipface {
namespace {

constexpr double dt = 1.0 / 60.0;
constexpr double pi = 3.141592653589793;

// A floor 10 m down, and a box of the group "part".
Level level_with(const Vec3& low, const Vec3& high, Platform platform) {
    PolygonSoup soup;
    soup.groups = {"level", "part"};
    soup.face_first_corner = {0};
    const auto quad = [&](std::uint32_t group, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
        for (const Vec3& corner : {a, b, c, d})
            soup.corner_position.push_back(corner.cast<float>());
        soup.face_first_corner.push_back(static_cast<std::uint32_t>(soup.corner_position.size()));
        soup.face_group.push_back(group);
    };
    quad(0, {-50, -10, -50}, {-50, -10, 50}, {50, -10, 50}, {50, -10, -50});
    const Vec3 &a = low, &b = high;
    quad(1, {a.x(), b.y(), a.z()}, {a.x(), b.y(), b.z()}, {b.x(), b.y(), b.z()}, {b.x(), b.y(), a.z()});
    quad(1, {a.x(), a.y(), a.z()}, {b.x(), a.y(), a.z()}, {b.x(), a.y(), b.z()}, {a.x(), a.y(), b.z()});
    quad(1, {b.x(), a.y(), b.z()}, {b.x(), a.y(), a.z()}, {b.x(), b.y(), a.z()}, {b.x(), b.y(), b.z()});
    quad(1, {a.x(), a.y(), a.z()}, {a.x(), a.y(), b.z()}, {a.x(), b.y(), b.z()}, {a.x(), b.y(), a.z()});
    Level level;
    level.mesh = build_mesh(soup).value();
    level.overrides.resize(level.mesh->face_count());
    platform.name = platform.group = "part";
    level.platforms = {platform};
    return level;
}

struct Ride {
    Level level;
    LevelScene scene;
    PlayerState state;
    int tick = 0;

    Ride(Level of, const Vec3& start)
        : level(std::move(of)), scene(LevelScene::build(level).value()), state(scene.player_at(start)) {}
    void go(int ticks, const PlayerInput& input = {}) {
        for (int i = 0; i < ticks; ++i, ++tick)
            state = step(scene.at(tick * dt, dt), level.movement, state, input, dt).state;
    }
    bool overlaps() {
        const MovementScene now = scene.at(tick * dt);
        return overlaps_any(now.platforms[0].at_end(), level.movement.radii, state.position);
    }
};

TEST(Platforms, ATurningOneCarriesOnItsCircle) {
    // 9 m out at one turn a second, 56.5 m/s: a full circle in 60 ticks, within 1e-4 m at each of them.
    Platform plate;
    plate.spin_rate = 2.0 * pi;
    Ride ride(level_with({-12, -1, -12}, {12, 0, 12}, plate), {9, 0.902, 0});
    ride.level.movement.terminal_speed = 100.0;
    ride.go(1);
    ASSERT_TRUE(ride.state.grounded);
    const Vec3 begin = ride.state.position;
    const double from = std::atan2(-begin.z(), begin.x());
    for (int i = 1; i <= 60; ++i) {
        ride.go(1);
        const double angle = from + 2.0 * pi * i / 60;
        EXPECT_TRUE(ride.state.grounded) << i;
        EXPECT_LT((ride.state.position - Vec3(9 * std::cos(angle), begin.y(), -9 * std::sin(angle))).norm(),
                  1e-4)
            << i;
    }
    // A jump takes the rim's velocity along, 2 pi times 9 m.
    ride.go(1, {.wish = Vec2::Zero(), .buttons = Button::jump});
    const double speed = Vec2(ride.state.velocity.x(), ride.state.velocity.z()).norm();
    EXPECT_NEAR(speed, 2 * pi * 9, 0.1);
}

TEST(Platforms, ALiftKeepsThePlayerGroundedUpAndDown) {
    Platform lift;
    lift.path = {{.offset = {0, 0, 0}, .speed = 3.0, .pause_s = 0.5},
                 {.offset = {0, 3, 0}, .speed = 3.0, .pause_s = 0.5}};
    Ride ride(level_with({-2, -1, -2}, {2, 0, 2}, lift), {0, 0.902, 0});
    ride.go(1);
    for (int i = 0; i < 180; ++i) {
        ride.go(1);
        const double height = platform_pose(ride.level.platforms[0], ride.tick * dt).offset.y();
        EXPECT_TRUE(ride.state.grounded) << i;
        EXPECT_NEAR(ride.state.position.y(), height + 0.902, 1e-3) << i;
    }
}

TEST(Platforms, AWallPushesAndAPressCrushes) {
    // A wall comes along +X at 2 m/s; the player stands in its way and is pushed along, skin before it.
    Platform wall;
    wall.repeat = PathRepeat::once;
    wall.path = {{.offset = {0, 0, 0}, .speed = 2.0}, {.offset = {6, 0, 0}, .speed = 2.0}};
    Ride ride(level_with({-3, -10, -3}, {-2, -6, 3}, wall), {0, -9.098, 0});
    ride.go(150);
    EXPECT_FALSE(ride.overlaps());
    EXPECT_FALSE(ride.state.trapped);
    EXPECT_NEAR(ride.state.position.x(), -2 + 2 * 150 * dt + 0.402, 5e-3);

    // Down onto the player at 2 m/s, with the floor below: no room to give way to.
    Platform press;
    press.repeat = PathRepeat::once;
    press.path = {{.offset = {0, 0, 0}, .speed = 2.0}, {.offset = {0, -6, 0}, .speed = 2.0}};
    Ride under(level_with({-3, -6, -3}, {3, -5, 3}, press), {0, -9.098, 0});
    under.go(30);
    EXPECT_FALSE(under.state.trapped);
    under.go(80);
    EXPECT_TRUE(under.state.trapped);
}

TEST(Platforms, OffTheySlideAwayUnderTheFeet) {
    Platform raft;
    raft.repeat = PathRepeat::once;
    raft.path = {{.offset = {0, 0, 0}, .speed = 2.0}, {.offset = {20, 0, 0}, .speed = 2.0}};
    for (const bool on : {true, false}) {
        Level level = level_with({-2, -1, -2}, {2, 0, 2}, raft);
        level.movement.platforms = on;
        Ride ride(std::move(level), {0, 0.902, 0});
        ride.go(180);
        EXPECT_EQ(ride.state.grounded && ride.state.position.y() > 0.5, on);
        if (on) {
            EXPECT_NEAR(ride.state.position.x(), 2.0 * 180 * dt, 1e-3);
        }
    }
}

}  // namespace
}  // namespace slipface
