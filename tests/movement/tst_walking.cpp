// Falling, jumping, walking, walls and corners against closed forms.
#include <algorithm>

#include "test_geometry.h"

namespace slipface::test {

TEST(Falling, FollowsTheParabolaAtEveryRate) {
    Lab lab;
    lab.floor(-1000.0);
    lab.ready();
    const MovementSettings s = basic_settings();
    for (const int rate : {30, 60, 120, 240, 360}) {
        // Half a second of g = 20 from rest: 20/2 * 0.25 = 2.5 m, 10 m/s.
        const PlayerState end = run(lab, s, at({0, 10, 0}), {}, rate / 2, 1.0 / rate);
        EXPECT_NEAR(end.position.y(), 7.5, 1e-9) << rate;
        EXPECT_NEAR(end.velocity.y(), -10.0, 1e-9) << rate;
        EXPECT_FALSE(end.grounded);
        EXPECT_EQ(end.ground_face, no_id);
    }
}

TEST(Falling, StopsAtTerminalSpeed) {
    Lab lab;
    lab.floor(-1000.0);
    lab.ready();
    MovementSettings s = basic_settings();
    s.terminal_speed = 7.0;
    EXPECT_DOUBLE_EQ(run(lab, s, at({0, 10, 0}), {}, 60).velocity.y(), -7.0);
}

TEST(Falling, LandsASkinAboveTheFloor) {
    Lab lab;
    lab.floor();
    lab.ready();
    const MovementSettings s = basic_settings();
    const PlayerState end = run(lab, s, at({0, 3, 0}), {}, 60);
    EXPECT_TRUE(end.grounded);
    EXPECT_NEAR(end.position.y(), 0.9 + s.skin, 1e-9);
    EXPECT_EQ(end.ground_face, 0u);
    EXPECT_NEAR(end.ground_normal.y(), 1.0, 1e-12);
}

TEST(Jumping, ReachesVSquaredOver2gAtEveryRate) {
    Lab lab;
    lab.floor();
    lab.ready();
    const MovementSettings s = basic_settings();
    for (const int rate : {30, 60, 120, 240, 360}) {
        const double dt = 1.0 / rate;
        PlayerState state = run(lab, s, at({0, 0.95, 0}), {}, rate, dt);
        const double ground = state.position.y();
        double top = ground;
        int airborne = 0;
        for (int i = 0; i < rate; ++i) {
            state = step(lab.scene(), s, state, wish(0, 0, true), dt).state;
            top = std::max(top, state.position.y());
            airborne += state.grounded ? 0 : 1;
        }
        // 64 / 40 = 1.6 m; the highest tick lies at most half a tick from the apex: g/2 (dt/2)^2 below it.
        EXPECT_NEAR(top - ground, 1.6, 20.0 / 8.0 * dt * dt + 1e-9) << rate;
        // 2 v / g = 0.8 s of flight.
        EXPECT_NEAR(airborne * dt, 0.8, 1.5 * dt) << rate;
        EXPECT_TRUE(state.grounded) << "holding the button does not jump again";
    }
}

TEST(Jumping, IsCutByACeiling) {
    Lab lab;
    lab.floor();
    lab.floor(2.5);
    lab.ready();
    const MovementSettings s = basic_settings();
    PlayerState state = run(lab, s, at({0, 0.95, 0}), {}, 30);
    double top = 0.0;
    for (int i = 0; i < 60; ++i) {
        state = step(lab.scene(), s, state, wish(0, 0, true), tick).state;
        top = std::max(top, state.position.y());
    }
    EXPECT_NEAR(top, 2.5 - 0.9 - s.skin, 1e-9);
    EXPECT_TRUE(state.grounded);
}

TEST(Walking, ReachesWalkSpeedAndStops) {
    Lab lab;
    lab.floor();
    lab.ready();
    const MovementSettings s = basic_settings();
    PlayerState state = run(lab, s, at({0, 0.95, 0}), {}, 30);
    const double start = state.position.x();
    // 60 m/s2 reaches 6 m/s after 6 ticks: 6*6/(2*60) = 0.3 m, then 0.9 s at 6 m/s = 5.4 m.
    state = run(lab, s, state, wish(1, 0), 60);
    EXPECT_NEAR(state.position.x() - start, 5.7, 1e-9);
    EXPECT_NEAR(state.velocity.x(), 6.0, 1e-12);
    EXPECT_NEAR(state.position.y(), 0.9 + s.skin, 1e-9);
    state = run(lab, s, state, {}, 7);
    EXPECT_EQ(state.velocity.x(), 0.0);
    // A wish longer than 1 asks for no more than walking speed.
    state = run(lab, s, state, wish(30, 40), 60);
    EXPECT_NEAR(state.velocity.x(), 3.6, 1e-9);
    EXPECT_NEAR(state.velocity.z(), 4.8, 1e-9);
}

TEST(Walls, SlidingKeepsTheParallelSpeed) {
    // A wall along the direction (cos a, sin a) in x, z; the player pushes along +X. What is left of 6 m/s is
    // 6 cos a.
    for (const double degrees : {10.0, 30.0, 45.0, 60.0, 80.0}) {
        const double a = radians(degrees);
        Lab lab;
        lab.floor();
        const Vec2 along(std::cos(a), std::sin(a));
        lab.wall(-40.0 * along, 40.0 * along);
        lab.ready();
        MovementSettings s = basic_settings();
        // So that the stick restores the speed within one tick, whatever the wall takes.
        s.ground_acceleration = 1000.0;
        const Vec3 off(-std::sin(a), 0.0, std::cos(a));  // the side from which +X pushes into the wall
        PlayerState state = run(lab, s, at(Vec3(0, 0.95, 0) + 0.5 * off), {}, 30);
        state = run(lab, s, state, wish(1, 0), 60);
        const Vec3 from = state.position;
        state = run(lab, s, state, wish(1, 0), 60);
        const Vec3 motion = state.position - from;
        const double mean = 6.0 * std::cos(a);
        // The wall takes nothing of the part along it; what the stick adds per tick is within 2 %.
        EXPECT_NEAR(motion.dot(Vec3(along.x(), 0, along.y())), mean, 0.02 * mean) << degrees;
        EXPECT_NEAR(motion.dot(off), 0.0, 1e-6) << degrees;
        EXPECT_NEAR(state.position.dot(off), 0.4 + s.skin, 1e-6) << degrees;
    }
}

TEST(Walls, ASlideMoveHasTheLengthOfTheProjection) {
    Lab lab;
    lab.wall({-40, 0}, {40, 0});
    lab.ready();
    const MovementSettings s = basic_settings();
    // 1 m at 30 degrees into a wall at distance 0.402 (radius and skin): all of it slides, cos 30 m along the
    // wall.
    const Vec3 from(0, 2, 0.402);
    const Vec3 move(std::cos(radians(30)), 0, -std::sin(radians(30)));
    const SlideResult result = slide_move(lab.scene(), s, from, move);
    EXPECT_NEAR((result.position - from - Vec3(std::cos(radians(30)), 0, 0)).norm(), 0.0, 1e-7);
    EXPECT_EQ(result.contacts, 1);
    EXPECT_EQ(result.remainder, Vec3(Vec3::Zero()));
}

TEST(Corners, NinetyDegreesHoldWithoutJitter) {
    Lab lab;
    lab.floor();
    lab.wall({2, -20}, {2, 20});
    lab.wall({-20, 2}, {20, 2});
    lab.ready();
    const MovementSettings s = basic_settings();
    PlayerState state = run(lab, s, at({0, 0.95, 0}), wish(0.8, 0.6), 120);
    const Vec3 corner(2 - 0.4 - s.skin, 0.9 + s.skin, 2 - 0.4 - s.skin);
    EXPECT_LT((state.position - corner).norm(), 1e-6);
    for (int i = 0; i < 120; ++i) {
        const PlayerState next = step(lab.scene(), s, state, wish(0.8, 0.6), tick).state;
        EXPECT_LT((next.position - state.position).norm(), 1e-9);
        EXPECT_TRUE(next.grounded);
        state = next;
    }
}

TEST(Corners, WedgesOfAllAnglesHoldWithoutJitterAndWithoutOverlap) {
    for (const double degrees : {5.0, 15.0, 30.0, 45.0, 60.0, 85.0, 120.0}) {
        const double half = radians(degrees) / 2;
        Lab lab;
        lab.floor();
        // Two walls that meet at the origin and open along +X.
        lab.wall({0, 0}, {40 * std::cos(half), 40 * std::sin(half)});
        lab.wall({0, 0}, {40 * std::cos(half), -40 * std::sin(half)});
        lab.ready();
        const MovementSettings s = basic_settings();
        const double apex = (0.4 + s.skin) / std::sin(half);  // where both walls are a skin off
        PlayerState state = at({apex + 2.0, 0.95, 0.0});
        for (int i = 0; i < 300; ++i) {
            state = step(lab.scene(), s, state, wish(-1, i % 3 == 0 ? 0.2 : -0.1), tick).state;
            ASSERT_FALSE(overlaps_any(lab.world(), s.radii, state.position)) << degrees << " tick " << i;
        }
        EXPECT_NEAR(state.position.x(), apex, 0.05) << degrees;
        state = run(lab, s, state, wish(-1, 0), 240);
        const Vec3 rest = state.position;
        state = run(lab, s, state, wish(-1, 0), 60);
        EXPECT_LT((state.position - rest).norm(), 1e-3) << degrees;
    }
}

TEST(Corners, AThirdPlaneStopsTheMove) {
    // A pit of three faces, 70 degrees steep, that meet at the origin.
    Lab lab;
    std::array<Vec3, 3> rims;
    for (int k = 0; k < 3; ++k) {
        const double a = radians(20.0 + 120.0 * k);
        rims[static_cast<std::size_t>(k)] = Vec3(std::cos(a), 1.4, std::sin(a)) * 30.0;
    }
    for (std::size_t k = 0; k < 3; ++k)
        lab.polygon({{0, 0, 0}, rims[k], rims[(k + 1) % 3]});
    lab.ready();
    const MovementSettings s = basic_settings();
    TraceRecorder trace;
    const SlideResult result = slide_move(lab.scene(), s, {0.1, 3, 0.05}, {0.05, -3, 0.02}, &trace);
    std::vector<Rule> rules;
    for (const TraceRecord& record : trace.records) {
        if (const auto* response = std::get_if<ResponseRecord>(&record)) rules.push_back(response->rule);
    }
    EXPECT_EQ(rules, (std::vector<Rule>{Rule::slide, Rule::crease, Rule::stop}));
    EXPECT_EQ(result.remainder, Vec3(Vec3::Zero()));
    EXPECT_FALSE(overlaps_any(lab.world(), s.radii, result.position));
    // Pushing on changes nothing.
    const SlideResult again = slide_move(lab.scene(), s, result.position, {0.05, -3, 0.02});
    EXPECT_LT((again.position - result.position).norm(), s.skin);
}

TEST(Corners, ACreaseIsFollowed) {
    // Two walls lean together over a groove along Z; falling into it leaves the motion along the groove.
    Lab lab;
    const double a = radians(70);
    const Vec3 left(-std::cos(a), std::sin(a), 0);
    const Vec3 right(std::cos(a), std::sin(a), 0);
    const Vec3 z(0, 0, 50);
    lab.polygon({-z, z, 50 * left + z, 50 * left - z});
    lab.polygon({-z, z, 50 * right + z, 50 * right - z});
    lab.ready();
    MovementSettings s = basic_settings();
    s.max_slides = 4;
    TraceRecorder trace;
    const double y = (s.radii.cwiseProduct(Vec3(std::sin(a), std::cos(a), 0)).norm() + s.skin) / std::cos(a);
    const SlideResult result = slide_move(lab.scene(), s, {0, y + 0.5, 0}, {0, -2, 1}, &trace);
    EXPECT_NEAR(result.position.z(), 1.0, 1e-3);
    EXPECT_NEAR(result.position.y(), y, 1e-3);
    bool creased = false;
    for (const TraceRecord& record : trace.records) {
        const auto* response = std::get_if<ResponseRecord>(&record);
        creased = creased || (response != nullptr && response->rule == Rule::crease);
    }
    EXPECT_TRUE(creased);
}

TEST(Slides, MaxSlidesBoundsTheContacts) {
    Lab lab;
    lab.half_pipe(64, 3.0, plain);
    lab.ready();
    MovementSettings s = basic_settings();
    for (const int slides : {1, 2, 3, 8}) {
        s.max_slides = slides;
        const SlideResult result = slide_move(lab.scene(), s, {0, 2, 0}, {6, -3, 0});
        EXPECT_EQ(result.contacts, slides);
        EXPECT_GT(result.remainder.norm(), 0.0);
    }
}

TEST(Ditch, TwoSteepFacesGroundAWedgedPlayer) {
    Lab lab;
    const double a = radians(65);
    const Vec3 z(0, 0, 50);
    lab.polygon({-z, z, Vec3(-50 * std::cos(a), 50 * std::sin(a), 50),
                 Vec3(-50 * std::cos(a), 50 * std::sin(a), -50)});
    lab.polygon(
        {-z, z, Vec3(50 * std::cos(a), 50 * std::sin(a), 50), Vec3(50 * std::cos(a), 50 * std::sin(a), -50)});
    lab.ready();
    const MovementSettings s = basic_settings();
    PlayerState state = run(lab, s, at({0.1, 4, 0}), {}, 180);
    EXPECT_TRUE(state.grounded);
    const double y = state.position.y();
    state = run(lab, s, state, wish(0, 0, true), 12);
    EXPECT_GT(state.position.y(), y + 0.5) << "can jump out";
}

}  // namespace slipface::test
