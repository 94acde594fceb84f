// Jumps in the air and off walls: what only they reach is found, and nothing that they cannot reach.
#include <gtest/gtest.h>

#include <cmath>

#include "reach/known_scenes.h"
#include "slipface/reach/grades.h"

namespace slipface::test {
namespace {

// Heights of jumps of these speeds, m: v*v/(2g).
double height_of(double speed, const MovementSettings& s) {
    return speed * speed / (2.0 * s.gravity);
}

MovementSettings jumper(std::mt19937_64& random) {
    MovementSettings settings = random_settings(random);
    settings.jump_speed = std::uniform_real_distribution<double>(7.0, 9.0)(random);
    return settings;
}

bool reaches(const ReachScene& scene, std::uint64_t seed, std::uint64_t rounds) {
    ReachSearch search = search_of(scene, 0, seed);
    const bool found = rounds_until(search, face_at(scene.level, scene.target), rounds).has_value();
    EXPECT_EQ(false_claims(search), "");
    return found;
}

TEST(ReachAbilities, ALedgeThatOnlyADoubleJumpReaches) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937_64 random(seed);
        MovementSettings s = jumper(random);
        s.air_jump_speed = std::uniform_real_distribution<double>(0.8, 1.0)(random) * s.jump_speed;
        const double one = height_of(s.jump_speed, s), two = one + height_of(s.air_jump_speed, s);
        const double yaw = std::uniform_real_distribution<double>(0.0, 6.28)(random);
        EXPECT_FALSE(reaches(gap_scene(s, 0.5, 0.9 * two, yaw), seed, 12)) << "one jump: " << one << " m";
        s.air_jump = true;
        EXPECT_TRUE(reaches(gap_scene(s, 0.5, 0.9 * two, yaw), seed, 100)) << two << " m";
        // The body's round foot is lifted over a rim by less than its height.
        EXPECT_FALSE(reaches(gap_scene(s, 0.5, two + s.radii.y() + s.step_height, yaw), seed, 12));
    }
}

TEST(ReachAbilities, AGapThatOnlyADoubleJumpCrosses) {
    for (std::uint64_t seed = 5; seed <= 6; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937_64 random(seed);
        MovementSettings s = jumper(random);
        s.air_jump_speed = s.jump_speed;
        // Where the second press comes when the first jump is back at its height: twice the way of one.
        const double one = max_possible(s, false, 4),
                     twice = 2.0 * s.walk_speed * 2.0 * s.jump_speed / s.gravity;
        ASSERT_GT(0.85 * twice, one + 0.3);
        EXPECT_FALSE(reaches(gap_scene(s, 0.85 * twice, 0.0, 0.0), seed, 12));
        s.air_jump = true;
        EXPECT_TRUE(reaches(gap_scene(s, 0.85 * twice, 0.0, 0.0), seed, 100)) << twice << " m";
    }
}

// A floor between two towers of which the lower one is the target.
ReachScene shaft_scene(const MovementSettings& s, double way, double height, double yaw) {
    const double half = 0.5 * way + s.radii.x() + s.skin;
    Shapes shapes;
    turned_box(shapes, {-half, -1, -2}, {half, 0, 2}, yaw);
    turned_box(shapes, {-half - 4, 0, -2}, {-half, height, 2}, yaw);
    turned_box(shapes, {half, 0, -2}, {half + 2, height + 6, 2}, yaw);
    ReachScene scene{shapes.level(), turned({0, s.radii.y() + s.skin, 0}, yaw),
                     turned({-half - 2, height, 0}, yaw)};
    scene.level.movement = s;
    scene.level.spawn = scene.start;
    return scene;
}

TEST(ReachAbilities, AShaftThatOnlyWallJumpsLeadOutOf) {
    for (std::uint64_t seed = 7; seed <= 9; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937_64 random(seed);
        const auto in = [&](double low, double high) {
            return std::uniform_real_distribution<double>(low, high)(random);
        };
        MovementSettings s;
        s.wall_jump_away = in(5.0, 7.0);
        s.wall_jump_up = in(7.0, 9.0);
        const double way = in(1.5, 2.5), t = way / s.wall_jump_away;
        const double gain = s.wall_jump_up * t - 0.5 * s.gravity * t * t;
        const double height = height_of(s.jump_speed, s) + 2.0 * gain, yaw = in(0.0, 6.28);
        const ReachScene without = shaft_scene(s, way, height, yaw);
        EXPECT_FALSE(reaches(without, seed, 12)) << height << " m";
        s.wall_jump = true;
        const ReachScene with = shaft_scene(s, way, height, yaw);
        EXPECT_TRUE(reaches(with, seed, 150)) << height << " m, " << gain << " m with each jump";
    }
}

// The limits of a second jump that is as high as the first: the same height more, and twice the way.
TEST(ReachAbilities, GradesKnowTheDoubleJump) {
    for (std::uint64_t seed = 21; seed <= 23; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937_64 random(seed);
        MovementSettings s = jumper(random);
        s.coyote = false;
        s.air_jump_speed = s.jump_speed;
        const JumpLimits one = measure_limits(s, tick_s);
        s.air_jump = true;
        const JumpLimits two = measure_limits(s, tick_s);
        const double tick_height = s.jump_speed * tick_s, tick_way = s.walk_speed * tick_s;
        EXPECT_EQ(one.step_m, two.step_m);
        EXPECT_NEAR(two.ledge_m - one.ledge_m, height_of(s.jump_speed, s), tick_height);
        EXPECT_NEAR(two.gap_m - one.gap_m, s.walk_speed * 2.0 * s.jump_speed / s.gravity, 4.0 * tick_way);
    }
}

}  // namespace
}  // namespace slipface::test
