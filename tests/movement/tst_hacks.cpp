// Each hack with its switch off, showing the artefact, and on, showing that it is gone.
#include <algorithm>
#include <cstring>
#include <random>

#include "test_geometry.h"

namespace slipface::test {

namespace {

bool same_bits(const Vec3& a, const Vec3& b) {
    return std::memcmp(a.data(), b.data(), sizeof(double) * 3) == 0;
}

}  // namespace

// --- static friction
// -------------------------------------------------------------------------------------------------

TEST(StaticFriction, IdleOn30DegreesIsBitStillForTenSeconds) {
    Lab lab;
    lab.slope(radians(30));
    lab.ready();
    const MovementSettings s = basic_settings();
    PlayerState state = standing_on_slope(lab, s, radians(30));
    ASSERT_TRUE(state.grounded);
    const Vec3 rest = state.position;
    for (int i = 0; i < 600; ++i) {
        state = step(lab.scene(), s, state, {}, tick).state;
        ASSERT_TRUE(same_bits(state.position, rest)) << "tick " << i;
        ASSERT_TRUE(state.grounded);
    }
}

TEST(StaticFriction, OffThePlayerCreepsDownByTheClosedForm) {
    // Each tick the idle player's brake takes the horizontal part of the speed u along the slope, gravity
    // adds p = g sin a dt = 1/6 m/s along it, and the slide keeps what leads along the slope: u sin^2 a + p.
    // That comes to rest at u = p / cos^2 a = 0.2222 m/s. From rest, u_k = u (1 - sin^2k a), and a tick moves
    // by the mean of two: with sin^2 a = 1/4 the start costs (1 + 1/4) / 2 / (1 - 1/4) = 5/6 of a tick of
    // 600.
    Lab lab;
    lab.slope(radians(30));
    lab.ready();
    MovementSettings s = basic_settings();
    PlayerState state = standing_on_slope(lab, s, radians(30));
    state.velocity = Vec3::Zero();  // the press on the ground is no motion
    const Vec3 rest = state.position;
    s.static_friction = false;
    state = run(lab, s, state, {}, 600);
    const double speed = s.gravity * 0.5 * tick / 0.75;
    const double motion = speed * tick * (600.0 - 5.0 / 6.0);  // 2.219 m
    EXPECT_NEAR((state.position - rest).norm(), motion, 1e-6);
    EXPECT_NEAR(state.position.x() - rest.x(), -motion * std::cos(radians(30)), 1e-6);
}

TEST(StaticFriction, HoldsUpToMaxSlopeAndNotAbove) {
    for (const double degrees : {5.0, 15.0, 25.0, 35.0, 45.0, 49.0, 51.0, 55.0, 65.0, 75.0}) {
        const double a = radians(degrees);
        Lab lab;
        lab.slope(a);
        lab.ready();
        const MovementSettings s = basic_settings();  // 50 degrees
        PlayerState state = at({0.0, centre_height(s, slope_normal(a)), 0.0});
        state = run(lab, s, state, {}, 60);
        EXPECT_EQ(state.grounded, degrees < 50.0) << degrees;
        if (degrees < 50.0) {
            EXPECT_NEAR(state.position.x(), 0.0, 1e-5) << degrees;
        } else {
            // Frictionless plane: g sin a along the slope for 1 s, down from rest: g sin a / 2 metres, cos a
            // of it along X.
            const double along = 0.5 * s.gravity * std::sin(a);
            EXPECT_NEAR(state.position.x(), -along * std::cos(a), 0.01 * along) << degrees;
            EXPECT_NEAR(state.velocity.norm(), 2.0 * along, 0.01 * along) << degrees;
        }
    }
}

TEST(StaticFriction, ItsLimitIsTheCosineOfTheMaximumSlope) {
    Lab lab;
    lab.floor();
    lab.ready();
    MovementSettings s = basic_settings();
    const PlayerState state = run(lab, s, at({0, 0.902, 0}), {}, 5);
    for (int degrees = 5; degrees <= 85; degrees += 5) {
        s.max_slope = radians(degrees);
        TraceRecorder trace;
        step(lab.scene(), s, state, {}, tick, &trace);
        const std::vector<DecisionRecord> stood = decisions_of(trace, Decision::stood);
        ASSERT_FALSE(stood.empty());
        EXPECT_NEAR(stood[0].limit, std::cos(s.max_slope), 1e-15) << degrees;
    }
}

TEST(StaticFriction, ASurfaceOverridesTheMaximumSlope) {
    Lab lab;
    lab.surfaces[plain].max_slope = radians(20);
    lab.slope(radians(30));
    lab.ready();
    const MovementSettings s = basic_settings();
    EXPECT_FALSE(run(lab, s, at({0, centre_height(s, slope_normal(radians(30))), 0}), {}, 60).grounded);
    lab.surfaces[plain].max_slope = radians(70);
    EXPECT_TRUE(run(lab, s, at({0, centre_height(s, slope_normal(radians(30))), 0}), {}, 60).grounded);
}

TEST(StaticFriction, TheVerticalPartGetsExactlyOneSweepOnGround) {
    Lab lab;
    lab.slope(radians(30));
    lab.ready();
    const MovementSettings s = basic_settings();
    const PlayerState state = standing_on_slope(lab, s, radians(30));
    TraceRecorder trace;
    EXPECT_EQ(step(lab.scene(), s, state, {}, tick, &trace).sweeps, 1);
    EXPECT_TRUE(has_decision(trace, "static_friction", true, "Flat enough to stand on"));
}

// --- steep slopes are walls
// ------------------------------------------------------------------------------------------

TEST(SteepSlope, Of60And75DegreesCannotBeClimbedByWalkingOrJumping) {
    for (const double degrees : {60.0, 75.0}) {
        Lab lab;
        lab.floor();
        lab.slope(radians(degrees));
        lab.ready();
        const MovementSettings s = basic_settings();
        PlayerState state = at({-6, 0.95, 0});
        double top = 0.0;
        for (int i = 0; i < 600; ++i) {
            state = step(lab.scene(), s, state, wish(1, 0), tick).state;
            top = std::max(top, state.position.y());
            ASSERT_FALSE(overlaps_any(lab.world(), s.radii, state.position));
        }
        EXPECT_LT(top, 0.95 + 1e-3) << degrees;
        // Jumping gains the jump's own height, 1.6 m, and nothing more however often it is repeated.
        for (int i = 0; i < 600; ++i) {
            state = step(lab.scene(), s, state, wish(1, 0, i % 2 == 0), tick).state;
            top = std::max(top, state.position.y());
        }
        EXPECT_LT(top, 0.9 + 1.6 + 0.05) << degrees;
    }
}

// A ramp and, along it, a wall that leans over the player, who runs uphill and into the wall. The move that
// the wall leaves rises on the ramp, which leads under the wall again: what is left goes along their crease.
TEST(SteepSlope, BetweenARampAndAnOverhangThePlayerGoesOn) {
    std::mt19937 random(7);
    const auto between = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random()) / 4294967295.0;
    };
    for (int i = 0; i < 200; ++i) {
        const double a = radians(between(3.0, 40.0)), lean = radians(between(2.0, 60.0));
        const double heading = radians(between(20.0, 60.0));  // from straight uphill into the wall
        Lab lab;
        lab.slope(a);
        const Vec3 foot(100.0, 100.0 * std::tan(a), 2.0), up(0.0, 6.0, -6.0 * std::tan(lean));
        const Vec3 other_foot(-foot.x(), -foot.y(), foot.z());
        lab.polygon({foot, other_foot, other_foot + up, foot + up});
        lab.ready();
        MovementSettings s = basic_settings();
        s.walk_speed = between(3.0, 20.0);
        PlayerState state = standing_on_slope(lab, s, a);
        state.position.z() = 2.0 - 1.2 / std::cos(lean) - 0.9 * std::tan(lean);
        ASSERT_FALSE(overlaps_any(lab.world(), s.radii, state.position)) << i;
        state = run(lab, s, state, wish(std::cos(heading), std::sin(heading)), 60);
        const double begin = state.position.x();
        state = run(lab, s, state, wish(std::cos(heading), std::sin(heading)), 60);
        EXPECT_GT(state.position.x() - begin, 0.5 * s.walk_speed * std::cos(heading))
            << i << ": ramp " << a << " lean " << lean << " heading " << heading;
    }
}

// --- ground velocity
// -------------------------------------------------------------------------------------------------

namespace {

// Fraction of the ticks of 1.5 s in the air, running down 30 degrees at 6 m/s.
double airborne_fraction(const MovementSettings& s, double dt) {
    Lab lab;
    lab.slope(radians(30));
    lab.ready();
    PlayerState state = at({50.0, 0.0, 0.0}, {-6.0, -6.0 * std::tan(radians(30)), 0.0});
    state.position.y() = 50.0 * std::tan(radians(30)) + centre_height(s, slope_normal(radians(30)));
    state = step(lab.scene(), s, state, wish(-1, 0), dt).state;
    const int ticks = static_cast<int>(1.5 / dt);
    int airborne = 0;
    for (int i = 0; i < ticks; ++i) {
        state = step(lab.scene(), s, state, wish(-1, 0), dt).state;
        airborne += state.grounded ? 0 : 1;
    }
    return static_cast<double>(airborne) / ticks;
}

}  // namespace

TEST(GroundVelocity, OnThePlayerIsGroundedInEveryTick) {
    const MovementSettings s = basic_settings();
    for (const int rate : {30, 60, 120, 240, 360})
        EXPECT_EQ(airborne_fraction(s, 1.0 / rate), 0.0) << rate;
}

TEST(GroundVelocity, OffThePlayerHops) {
    // Off the ground with no vertical speed, g t t / 2 meets the slope's v t tan a at t = 2 v tan a / g =
    // 0.346 s, 20.8 ticks: 20 in the air, one on the ground. Four times that are 84 of the 90 ticks, and the
    // six left are the next hop's: 86.
    MovementSettings s = basic_settings();
    s.ground_velocity = false;
    EXPECT_NEAR(airborne_fraction(s, tick), 86.0 / 90.0, 1e-12);
}

TEST(GroundVelocity, AStepOffALedgeFallsFromRest) {
    // The press is not a motion: after t seconds in the air the player has fallen g t t / 2, not ground_speed
    // t more.
    Lab lab;
    lab.polygon({{-20, 0, -5}, {-20, 0, 5}, {0, 0, 5}, {0, 0, -5}});
    lab.floor(-30);
    lab.ready();
    MovementSettings s = basic_settings();
    PlayerState state = run(lab, s, at({-3, 0.95, 0}), wish(1, 0), 20);
    while (state.grounded)
        state = step(lab.scene(), s, state, wish(1, 0), tick).state;
    const double y = state.position.y();
    const double v = state.velocity.y();
    EXPECT_GT(v, -1.0 - s.gravity * tick);
    state = run(lab, s, state, wish(1, 0), 30);
    EXPECT_NEAR(state.position.y(), y + v * 0.5 - 10 * 0.25, 1e-9);
}

TEST(MotionVelocity, IsTheMotionAndNotThePress) {
    Lab lab;
    lab.slope(radians(30));
    lab.ready();
    const MovementSettings s = basic_settings();
    PlayerState state = standing_on_slope(lab, s, radians(30));
    ASSERT_TRUE(state.grounded);
    ASSERT_LT(state.velocity.y(), -0.5);
    EXPECT_EQ(motion_velocity(state).norm(), 0.0);
    // Up and down the slope the motion leads along it.
    for (const double x : {1.0, -1.0}) {
        state = run(lab, s, state, wish(x, 0.0), 20);
        ASSERT_TRUE(state.grounded);
        const Vec3 motion = motion_velocity(state);
        EXPECT_NEAR(motion.dot(slope_normal(radians(30))), 0.0, 1e-6);
        EXPECT_NEAR(motion.x(), x * s.walk_speed, 1e-9);
    }
    // In the air it is the velocity.
    state = run(lab, s, state, wish(0.0, 0.0, true), 3);
    ASSERT_FALSE(state.grounded);
    EXPECT_EQ(motion_velocity(state), state.velocity);
}

// --- constant speed on slopes
// ----------------------------------------------------------------------------------------

TEST(ConstantSlopeSpeed, OnTheWayAlongTheSlopeIsTheWalkingSpeed) {
    for (const bool on : {false, true}) {
        for (const double degrees : {10.0, 30.0, 45.0}) {
            for (const int rate : {30, 60, 240}) {
                for (const double x : {1.0, -1.0}) {
                    Lab lab;
                    lab.slope(radians(degrees));
                    lab.ready();
                    MovementSettings s = basic_settings();
                    s.constant_slope_speed = on;
                    PlayerState state = standing_on_slope(lab, s, radians(degrees));
                    state = run(lab, s, state, wish(x, 0.0), rate / 2, 1.0 / rate);
                    const Vec3 from = state.position;
                    state = run(lab, s, state, wish(x, 0.0), rate, 1.0 / rate);
                    // Off: uphill the slide keeps cos a of the length, downhill the map is crossed at full
                    // speed, which is 1 / cos a along the slope.
                    const double cosine = std::cos(radians(degrees));
                    const double fraction = on ? 1.0 : x > 0.0 ? cosine : 1.0 / cosine;
                    EXPECT_NEAR((state.position - from).norm(), s.walk_speed * fraction, 0.01 * s.walk_speed)
                        << on << " " << degrees << " " << rate << " " << x;
                    EXPECT_TRUE(state.grounded);
                }
            }
        }
    }
}

// --- straight ahead
// --------------------------------------------------------------------------------------------------

namespace {

// Direction of the horizontal way made over a 30 degree ramp with the stick at 45 degrees to it.
double heading_on_ramp(const MovementSettings& s) {
    Lab lab;
    lab.slope(radians(30));
    lab.ready();
    PlayerState state = standing_on_slope(lab, s, radians(30));
    const Vec3 from = state.position;
    state = run(lab, s, state, wish(std::sqrt(0.5), std::sqrt(0.5)), 90);
    const Vec3 motion = state.position - from;
    return std::atan2(motion.z(), motion.x());
}

}  // namespace

TEST(StraightAhead, KeepsTheHeading) {
    const MovementSettings s = basic_settings();
    EXPECT_NEAR(heading_on_ramp(s), pi / 4, 1e-4);
}

TEST(StraightAhead, IsTheRuleOfItsResponse) {
    Lab lab;
    lab.slope(radians(30));
    lab.ready();
    MovementSettings s = basic_settings();
    const PlayerState state = standing_on_slope(lab, s, radians(30));
    for (const bool on : {true, false}) {
        s.straight_ahead = on;
        TraceRecorder trace;
        step(lab.scene(), s, state, wish(1, 0), tick, &trace);
        const auto is = [](Rule rule) {
            return [rule](const TraceRecord& record) {
                const auto* response = std::get_if<ResponseRecord>(&record);
                return response != nullptr && response->rule == rule;
            };
        };
        EXPECT_EQ(std::any_of(trace.records.begin(), trace.records.end(), is(Rule::straight_ahead)), on);
    }
}

TEST(StraightAhead, OffTheRampTurnsTheHeading) {
    MovementSettings s = basic_settings();
    s.straight_ahead = false;
    // V = (1,0,1)/sqrt 2, N = (-1/2, cos 30, 0): V - N (V.N) = (0.7071 (1 - 1/4), .., 0.7071), a heading of
    // atan(1 / 0.75) = 0.9273.
    EXPECT_NEAR(heading_on_ramp(s), std::atan2(1.0, 0.75), 1e-3);
}

TEST(StraightAhead, KeepsTheLengthOfTheSlide) {
    Lab lab;
    lab.slope(radians(30));
    lab.ready();
    MovementSettings s = basic_settings();
    const Vec3 n = slope_normal(radians(30));
    const Vec3 from(0.0, centre_height(s, n), 0.0);
    for (const double heading : {0.0, 20.0, 45.0, 80.0}) {
        const Vec3 v = 0.7 * Vec3(std::cos(radians(heading)), 0, std::sin(radians(heading)));
        const SlideResult ahead = slide_move(lab.scene(), s, from, v);
        const double length = (v - n * v.dot(n)).norm();
        EXPECT_NEAR((ahead.position - from).norm(), length, 1e-6 * length) << heading;
        // Direction V - (0, 1/N.y, 0) (N.V).
        const Vec3 direction = (v - Vec3(0, v.dot(n) / n.y(), 0)).normalized();
        EXPECT_NEAR(((ahead.position - from).normalized() - direction).norm(), 0.0, 1e-6) << heading;
    }
}

TEST(StraightAhead, LeavesVerticalWallsToPlainSliding) {
    Lab lab;
    lab.wall({0, -40}, {0, 40});
    lab.ready();
    const MovementSettings s = basic_settings();
    TraceRecorder trace;
    const SlideResult result = slide_move(lab.scene(), s, {-0.402, 5, 0}, {0.6, 0, 0.8}, &trace);
    EXPECT_LT((result.position - Vec3(-0.402, 5, 0.8)).norm(), 1e-6);
    EXPECT_TRUE(has_decision(trace, "max_slope", true, "Too steep to walk up"));
}

// --- keep energy
// -----------------------------------------------------------------------------------------------------

namespace {

// Speed at the right rim of a half-pipe of ice entered down the left rim at 10 m/s without gravity, and with.
PlayerState ride(const MovementSettings& s, int segments, double entry_speed) {
    Lab lab;
    lab.half_pipe(segments, 5.0, ice);
    lab.ready();
    // At the height of the axis beside the first face, moving along it.
    const double first = pi / segments;  // the first face leans this much over two from the vertical
    const Vec3 along = Vec3(std::sin(first / 2), -std::cos(first / 2), 0.0);
    const Vec3 normal(std::cos(first / 2), std::sin(first / 2), 0.0);
    const Vec3 on_face(-5.0 * std::cos(first / 2) * std::cos(first / 2),
                       5.0 - 5.0 * std::cos(first / 2) * std::sin(first / 2), 0.0);
    PlayerState state =
        at(on_face + normal * (s.radii.cwiseProduct(normal).norm() + s.skin), along * entry_speed);
    for (int i = 0; i < 600; ++i) {
        state = step(lab.scene(), s, state, {}, tick).state;
        // On the last face: the velocity leads along it, mirrored from the first.
        if (state.velocity.y() > 0.0 && std::abs(state.velocity.normalized().x() - along.x()) < 1e-6)
            return state;
    }
    return state;
}

}  // namespace

TEST(KeepEnergy, OffAHalfPipeTakesTheProductOfTheCosines) {
    for (const int segments : {8, 16, 32, 64}) {
        MovementSettings s = basic_settings();
        s.gravity = 0.0;
        s.keep_energy = false;
        s.radii = Vec3(0.4, 0.4, 0.4);
        const PlayerState out = ride(s, segments, 10.0);
        // segments - 1 turns by pi / segments, each of which projects the velocity on the next face.
        const double product = std::pow(std::cos(pi / segments), segments - 1);
        EXPECT_NEAR(out.velocity.norm(), 10.0 * product, 1e-5) << segments;
    }
}

TEST(KeepEnergy, OnTheExitSpeedIsTheEntrySpeed) {
    for (const int segments : {8, 16, 32, 64}) {
        MovementSettings s = basic_settings();
        s.gravity = 0.0;
        s.radii = Vec3(0.4, 0.4, 0.4);
        EXPECT_NEAR(ride(s, segments, 10.0).velocity.norm(), 10.0, 1e-6) << segments;
    }
}

TEST(KeepEnergy, APipeOfSixFacesTurnsByTheDefaultLimitExactlyAndKeepsTheSpeed) {
    // Each turn is 30 degrees: N.V / |V| = -sin 30 = -0.5 but for rounding.
    MovementSettings s = basic_settings();
    s.gravity = 0.0;
    s.radii = Vec3(0.4, 0.4, 0.4);
    EXPECT_NEAR(ride(s, 6, 10.0).velocity.norm(), 10.0, 1e-5);
}

TEST(KeepEnergy, OnTheExitSpeedIsTheEntrySpeedAndGravitysWork) {
    for (const int segments : {8, 16, 32, 64}) {
        MovementSettings s = basic_settings();
        Lab lab;
        lab.half_pipe(segments, 5.0, ice);
        lab.ready();
        const double first = pi / segments / 2;
        const Vec3 along(std::sin(first), -std::cos(first), 0.0);
        const Vec3 normal(std::cos(first), std::sin(first), 0.0);
        const Vec3 on_face(-5.0 * std::cos(first) * std::cos(first),
                           5.0 - 5.0 * std::cos(first) * std::sin(first), 0.0);
        PlayerState state =
            at(on_face + normal * (s.radii.cwiseProduct(normal).norm() + s.skin), along * 12.0);
        const double energy = 0.5 * 144.0 + s.gravity * state.position.y();
        bool far_side = false;
        for (int i = 0; i < 120 && !far_side; ++i) {
            state = step(lab.scene(), s, state, {}, tick).state;
            const double speed = std::sqrt(2.0 * (energy - s.gravity * state.position.y()));
            ASSERT_NEAR(state.velocity.norm(), speed, 1e-3 * speed) << segments << " tick " << i;
            far_side = state.position.x() > 3.5 && state.position.y() > 4.0;
        }
        EXPECT_TRUE(far_side) << segments;
    }
}

TEST(KeepEnergy, OffWithGravitySpeedIsLost) {
    // The centre goes round a polygon of its own: eight faces, a skin and a radius further in. Each of its
    // seven corners turns the way by 22.5 degrees and keeps cos^2 of the kinetic energy that is left there;
    // in between gravity takes nothing. The corners lie at apothem / cos(pi / 16) from the axis.
    MovementSettings s = basic_settings();
    s.keep_energy = false;
    s.radii = Vec3(0.4, 0.4, 0.4);
    Lab lab;
    lab.half_pipe(8, 5.0, ice);
    lab.ready();
    const double half = pi / 16;
    const double apothem = 5.0 * std::cos(half) - s.radii.x() - s.skin;
    const Vec3 normal(std::cos(half), std::sin(half), 0.0), along(std::sin(half), -std::cos(half), 0.0);
    PlayerState state = at(Vec3(0, 5, 0) - apothem * normal, 12.0 * along);
    double energy = 0.5 * 144.0 + s.gravity * state.position.y();
    for (int corner = 1; corner < 6; ++corner) {
        const double height = 5.0 - apothem / std::cos(half) * std::sin(2 * half * corner);
        const double kinetic = energy - s.gravity * height;
        energy -= kinetic * std::pow(std::sin(2 * half), 2);
    }
    // Past the fifth corner, on the face that begins at x = 1.76 and ends at x = 3.2.
    while (state.position.x() < 2.5)
        state = step(lab.scene(), s, state, {}, 1.0 / 720).state;
    const double speed = std::sqrt(2.0 * (energy - s.gravity * state.position.y()));
    // A face is met once the skin is used up and not at the corner, which shifts the corners a little.
    EXPECT_NEAR(state.velocity.norm(), speed, 0.005 * speed);
}

TEST(KeepEnergy, AHeadOnHitIsNotRedirected) {
    Lab lab;
    lab.wall({0, -40}, {0, 40}, -5, 20, ice);
    lab.ready();
    MovementSettings s = basic_settings();
    s.gravity = 0.0;
    // Into the wall at 35 degrees from its normal: N.V / |V| = -cos 35 = -0.82, below -0.5.
    TraceRecorder head_on;
    const Vec3 v = 10.0 * Vec3(std::cos(radians(35)), 0, std::sin(radians(35)));
    PlayerState state = at({-1, 5, 0}, v);
    for (int i = 0; i < 30; ++i)
        state = step(lab.scene(), s, state, {}, tick, &head_on).state;
    EXPECT_NEAR(state.velocity.norm(), 10.0 * std::sin(radians(35)), 1e-9);
    EXPECT_TRUE(has_decision(head_on, "keep_energy", false, "head-on"));
    for (const DecisionRecord& record : decisions_of(head_on, Decision::energy_head_on)) {
        EXPECT_NEAR(record.value, std::cos(radians(35)), 1e-9);
        EXPECT_EQ(record.limit, 0.5);
    }
    // At 65 degrees from the normal, -0.42: turned with all its speed.
    state = run(lab, s, at({-1, 5, 0}, 10.0 * Vec3(std::cos(radians(65)), 0, std::sin(radians(65)))), {}, 30);
    EXPECT_NEAR(state.velocity.norm(), 10.0, 1e-9);
    // The limit is a setting.
    s.keep_energy_limit = -0.3;
    state = run(lab, s, at({-1, 5, 0}, 10.0 * Vec3(std::cos(radians(65)), 0, std::sin(radians(65)))), {}, 30);
    EXPECT_NEAR(state.velocity.norm(), 10.0 * std::sin(radians(65)), 1e-9);
}

TEST(KeepEnergy, GlidingOverFlatIceNeitherGainsNorLoses) {
    Lab lab;
    lab.floor(0, ice, 500);
    lab.ready();
    const MovementSettings s = basic_settings();
    for (const int rate : {30, 60, 120, 360}) {
        PlayerState state = at({0, 0.9 + s.skin, 0}, {6, 0, 0});
        state = run(lab, s, state, {}, 10 * rate, 1.0 / rate);
        EXPECT_NEAR(state.velocity.norm(), 6.0, 1e-3) << rate;
        EXPECT_NEAR(state.position.x(), 60.0, 0.06) << rate;
        EXPECT_TRUE(state.grounded) << rate;
    }
}

TEST(KeepEnergy, IceDoesNotHoldAnIdlePlayer) {
    Lab lab;
    lab.slope(radians(20), ice);
    lab.ready();
    const MovementSettings s = basic_settings();
    const PlayerState state = run(lab, s, at({0, centre_height(s, slope_normal(radians(20))), 0}), {}, 60);
    // g sin 20 / 2 = 3.42 m along the slope in the first second.
    EXPECT_NEAR(state.position.x(), -3.42 * std::cos(radians(20)), 0.1);
}

// --- push-out
// --------------------------------------------------------------------------------------------------------

TEST(PushOut, OffAnOverlappingPlayerStaysInside) {
    Lab lab;
    lab.floor();
    lab.ready();
    const MovementSettings s = basic_settings();
    EXPECT_LT(step(lab.scene(), s, at({0, 0.4, 0}), {}, tick).state.position.y(), 0.5);
}

TEST(PushOut, FreesFromAPlaneAWedgeAndACorner) {
    for (const PushOut kind : {PushOut::iterative, PushOut::analytic}) {
        for (const double degrees : {5.0, 20.0, 45.0, 85.0}) {
            for (const bool corner : {false, true}) {
                const double half = radians(degrees) / 2;
                Lab lab;
                lab.wall({0, 0}, {60 * std::cos(half), 60 * std::sin(half)});
                lab.wall({0, 0}, {60 * std::cos(half), -60 * std::sin(half)});
                if (corner) lab.floor();
                lab.ready();
                MovementSettings s = basic_settings();
                s.gravity = 0.0;
                s.push_out = kind;
                const double apex = (0.4 + s.skin) / std::sin(half);
                // Overlaps both walls, and the floor where there is one.
                const PlayerState inside = at({apex - 0.05 / std::sin(half), 0.8, 0.003});
                ASSERT_TRUE(overlaps_any(lab.world(), s.radii, inside.position));
                TraceRecorder trace;
                const PlayerState out = step(lab.scene(), s, inside, {}, tick, &trace).state;
                EXPECT_FALSE(overlaps_any(lab.world(), s.radii, out.position))
                    << degrees << (corner ? " corner " : " wedge ")
                    << push_out_choices[static_cast<std::size_t>(kind)].name;
                ASSERT_FALSE(trace.records.empty());
                const auto* record = std::get_if<PushOutRecord>(&trace.records.front());
                ASSERT_NE(record, nullptr);
                EXPECT_TRUE(record->free);
                if (kind == PushOut::analytic) {
                    EXPECT_EQ(record->planes, corner ? 3 : 2);
                    // The common line, or point, of the planes a radius and a skin off.
                    const double height = corner ? 0.9 + s.skin : 0.8;
                    EXPECT_LT((record->to - Vec3(apex, height, 0)).norm(), 1e-5) << degrees;
                }
            }
        }
    }
}

TEST(PushOut, ParallelPlanesAreRefusedWithoutADivisionByZero) {
    // A slot narrower than the player: nowhere to go.
    Lab lab;
    lab.wall({-20, 0.3}, {20, 0.3}, -50, 50);
    lab.wall({-20, -0.3}, {20, -0.3}, -50, 50);
    lab.ready();
    MovementSettings s = basic_settings();
    s.gravity = 0.0;
    for (const PushOut kind : {PushOut::iterative, PushOut::analytic}) {
        s.push_out = kind;
        TraceRecorder trace;
        const PlayerState out = step(lab.scene(), s, at({0, 0, 0}), {}, tick, &trace).state;
        EXPECT_EQ(out.position, Vec3(0, 0, 0));
        ASSERT_FALSE(trace.records.empty());
        EXPECT_FALSE(std::get<PushOutRecord>(trace.records.front()).free);
    }
}

TEST(StartingInside, MovesThatLeadOutAreFree) {
    Lab lab;
    lab.wall({0, -40}, {0, 40});
    lab.ready();
    const MovementSettings s = basic_settings();
    const SlideResult out = slide_move(lab.scene(), s, {-0.1, 5, 0}, {-1, 0, 0});
    EXPECT_LT((out.position - Vec3(-1.1, 5, 0)).norm(), 1e-12);
    const SlideResult in = slide_move(lab.scene(), s, {-0.1, 5, 0}, {1, 0, 0});
    EXPECT_LE(in.position.x(), -0.1 + 1e-12);
}

}  // namespace slipface::test
