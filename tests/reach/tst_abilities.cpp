// Jumps in the air and off walls: what only they reach is found, and nothing that they cannot reach.
#include <gtest/gtest.h>

#include <cmath>

#include "reach/known_scenes.h"
#include "slipface/reach/grades.h"
#include "slipface/reach/report.h"

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

TEST(ReachAbilities, GoalsSayWithoutWhichAbilityTheyHold) {
    std::mt19937_64 random(1);
    MovementSettings s = jumper(random);
    s.air_jump_speed = s.jump_speed;
    s.air_jump = true;
    ReachScene scene = gap_scene(s, 0.5, 1.8 * height_of(s.jump_speed, s), 0.0);
    Goal up{.name = "up", .position = scene.target + Vec3(0, s.radii.y(), 0), .within_s = {}, .from = {}};
    Goal only{up};
    only.name = "only by it";
    only.kind = GoalKind::never;
    only.settings = {"air_jump=off"};
    Goal without{up};
    without.name = "without it";
    without.settings = only.settings;
    scene.level.goals = {up, only, without};
    ReachLimits limits;
    limits.rounds = 60;
    const auto answers = check_goals(scene.level, scene.start, {}, limits);
    ASSERT_TRUE(answers.ok()) << answers.error().text();
    EXPECT_TRUE((*answers)[0].holds) << (*answers)[0].text;
    EXPECT_TRUE((*answers)[1].holds) << (*answers)[1].text;
    EXPECT_FALSE((*answers)[2].holds) << (*answers)[2].text;
    EXPECT_NE((*answers)[2].text.find("without it (air_jump=off)"), std::string::npos) << (*answers)[2].text;
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

// The way of a running jump with a dash of t seconds at its top: w*2v/g and d*t more.
TEST(ReachAbilities, AGapThatOnlyADashCrosses) {
    for (std::uint64_t seed = 31; seed <= 33; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937_64 random(seed);
        MovementSettings s = jumper(random);
        s.dash_speed = std::uniform_real_distribution<double>(12.0, 18.0)(random);
        const double one = max_possible(s, false, 4);
        const double way = s.walk_speed * 2.0 * s.jump_speed / s.gravity + s.dash_speed * s.dash_time;
        ASSERT_GT(0.85 * way, one + 0.3);
        EXPECT_FALSE(reaches(gap_scene(s, 0.85 * way, 0.0, 0.0), seed, 12));
        s.dash = true;
        EXPECT_TRUE(reaches(gap_scene(s, 0.85 * way, 0.0, 0.0), seed, 150)) << way << " m";
        const double farthest =
            (s.dash_speed + s.walk_speed) * 2.0 * s.jump_speed / s.gravity + s.dash_speed * s.dash_time + 2.0;
        EXPECT_FALSE(reaches(gap_scene(s, farthest, 0.0, 0.0), seed, 12));
    }
}

// A jump and hands: v*v/(2g) + the half height + the hands above the centre.
TEST(ReachAbilities, ALedgeThatOnlyHandsReach) {
    for (std::uint64_t seed = 41; seed <= 44; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937_64 random(seed);
        MovementSettings s = jumper(random);
        const double high = height_of(s.jump_speed, s) + s.radii.y() + s.ledge_hands;
        const double yaw = std::uniform_real_distribution<double>(0.0, 6.28)(random);
        EXPECT_FALSE(reaches(gap_scene(s, 0.5, 0.97 * high, yaw), seed, 12));
        s.ledge_grab = true;
        EXPECT_TRUE(reaches(gap_scene(s, 0.5, 0.97 * high, yaw), seed, 100)) << high << " m";
        EXPECT_FALSE(reaches(gap_scene(s, 0.5, 1.03 * high, yaw), seed, 12)) << high << " m";
        s.ledge_form = LedgeForm::button;
        EXPECT_TRUE(reaches(gap_scene(s, 0.5, 0.97 * high, yaw), seed, 200)) << high << " m, by a button";
    }
}

// A passage, and behind it the target.
TEST(ReachAbilities, APassageThatOnlyACrouchedBodyFits) {
    for (std::uint64_t seed = 51; seed <= 53; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937_64 random(seed);
        MovementSettings s = jumper(random);
        const double low = 2.0 * std::min(s.crouch_radius_y, 0.6 * s.radii.y());
        s.crouch_radius_y = 0.5 * low;
        const auto scene_with = [&](double height) {
            Shapes shapes;
            shapes.box({-2, -1, -1}, {2, 0, 4})
                .box({-2, -1, -4}, {2, 0, -1})
                .box({-2, height, -0.5}, {2, height + 8, 0.5});
            shapes.box({-3, 0, -4}, {-2, 9, 4}).box({2, 0, -4}, {3, 9, 4});
            ReachScene scene{shapes.level(), Vec3(0, s.radii.y() + 0.01, 3), Vec3(0, 0, -3)};
            scene.level.movement = s;
            scene.level.spawn = scene.start;
            return scene;
        };
        const auto behind = [&](double height) { return reaches(scene_with(height), seed, 60); };
        EXPECT_FALSE(behind(1.1 * low));
        s.crouch = true;
        EXPECT_TRUE(behind(1.1 * low));
        EXPECT_FALSE(behind(0.9 * low));
    }
}

// A one-sided floor that is the only way down.
TEST(ReachAbilities, AFloorThatOnlyDropLeadsThrough) {
    Shapes shapes;
    shapes.box({-4, -4, -4}, {4, -3, 4}).box({-5, -3, -4}, {-4, 4, 4}).box({4, -3, -4}, {5, 4, 4});
    shapes.box({-5, -3, -5}, {5, 4, -4}).box({-5, -3, 4}, {5, 4, 5});
    shapes.material("metal__grate").polygon({{-4, 0, -4}, {-4, 0, 4}, {4, 0, 4}, {4, 0, -4}});
    MovementSettings s = basic_settings();
    ReachScene scene{shapes.level(), Vec3(0, s.radii.y() + 0.01, 0), Vec3(1, -3, 1)};
    SurfaceType grate{.name = "grate"};
    grate.one_sided = true;
    scene.level.surfaces.push_back(grate);
    for (const bool on : {false, true}) {
        s.drop_through = on;
        scene.level.movement = s;
        scene.level.spawn = scene.start;
        EXPECT_EQ(reaches(scene, 61, 30), on);
    }
}

TEST(ReachAbilities, GradesKnowDashWallJumpAndHands) {
    for (std::uint64_t seed = 71; seed <= 72; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937_64 random(seed);
        MovementSettings s = jumper(random);
        s.coyote = false;
        s.keep_speed = true;
        const JumpLimits one = measure_limits(s, tick_s);
        MovementSettings dasher = s;
        dasher.dash = true;
        // Farthest: a jump in the last tick of a dash on the ground keeps its speed, and another dash
        // follows.
        const double longest =
            dasher.dash_speed * (2.0 * s.jump_speed / s.gravity) + dasher.dash_speed * dasher.dash_time;
        const JumpLimits dashed = measure_limits(dasher, tick_s);
        EXPECT_GT(dashed.gap_m, one.gap_m + 0.9 * dasher.dash_speed * dasher.dash_time);
        EXPECT_LT(dashed.gap_m, longest + 1.0);
        EXPECT_NEAR(dashed.ledge_m, one.ledge_m, 0.15);
        MovementSettings hands = s;
        hands.ledge_grab = true;
        EXPECT_NEAR(measure_limits(hands, tick_s).ledge_m,
                    height_of(s.jump_speed, s) + s.radii.y() + s.ledge_hands, s.jump_speed * tick_s);
        MovementSettings walls = s;
        walls.wall_jump = true;
        walls.wall_jump_away = 2.0;
        walls.wall_jump_up = s.jump_speed;
        EXPECT_GT(measure_limits(walls, tick_s).ledge_m, one.ledge_m + 0.3);
    }
}

}  // namespace
}  // namespace slipface::test
