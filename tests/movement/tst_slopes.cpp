// Running down steep ground, and along walls beside steps: on the ground in every tick, and what happens with
// the hack off.
#include <algorithm>

#include "test_geometry.h"

namespace slipface::test {
namespace {

struct Descent {
    int airborne = 0;          // ticks
    double highest_gap = 0.0;  // metres between the player's skin and the slope
};

// Running down 45 degrees at 10 m/s for `ticks` ticks, from the ground.
Descent run_down_45(MovementSettings s, int ticks, double dt) {
    s.walk_speed = 10.0;
    Lab lab;
    lab.slope(radians(45));
    lab.ready();
    const Vec3 n = slope_normal(radians(45));
    PlayerState state = at({50.0, 50.0 + centre_height(s, n), 0.0}, {-10.0, 0.0, 0.0});
    state.grounded = true;
    state.ground_normal = n;
    state.ground_face = 0;
    Descent descent;
    for (int i = 0; i < ticks; ++i) {
        state = step(lab.scene(), s, state, wish(-1, 0), dt).state;
        descent.airborne += state.grounded ? 0 : 1;
        const double gap = state.position.dot(n) - s.radii.cwiseProduct(n).norm() - s.skin;
        descent.highest_gap = std::max(descent.highest_gap, std::abs(gap));
    }
    return descent;
}

TEST(StickToFloor, At45DegreesAnd10MPerSIsGroundedInEveryTick) {
    // Each tick the slope falls away by 10 / rate metres, 0.333 m at 30 Hz, of the 0.35 m that are snapped.
    for (const int rate : {30, 60, 120, 240, 360}) {
        for (const bool pressed : {false, true}) {
            MovementSettings s = basic_settings();
            s.ground_velocity = pressed;
            s.snap_down = true;
            const Descent descent = run_down_45(s, 4 * rate, 1.0 / rate);
            EXPECT_EQ(descent.airborne, 0) << rate;
            EXPECT_LT(descent.highest_gap, 1e-6) << rate;
        }
    }
}

TEST(StickToFloor, OffThePlayerFliesByTheParabola) {
    // Off the ground with no vertical speed, g t t / 2 meets the slope's v t tan a at t = 2 v tan a / g. With
    // g = 19 that is 1.0526 s, 63.2 ticks at 60 Hz: 63 ticks in the air, one on the ground, again and again.
    // In between the gap is v t tan a - g t t / 2, greatest at half the time: (v tan a)^2 / (2 g) = 2.632 m
    // upwards, cos 45 of it off the slope.
    MovementSettings s = basic_settings();
    s.gravity = 19.0;
    s.ground_velocity = false;
    const Descent descent = run_down_45(s, 3 * 64, tick);
    EXPECT_EQ(descent.airborne, 3 * 63);
    // The highest tick lies at most half a tick from the middle: g / 2 (dt / 2)^2 = 0.7 mm lower.
    EXPECT_NEAR(descent.highest_gap, 100.0 / (2 * s.gravity) * std::cos(radians(45)), 1e-3);
}

// --- walking along a wall

struct Along {
    double motion = 0.0;                // metres along the wall
    double least = 1e9, maximum = 0.0;  // in one tick
    int airborne = 0;
    PlayerState end;
};

// `seconds` with the stick `degrees` into the wall z = 0 and along +X.
Along push_along(const Lab& lab, const MovementSettings& s, PlayerState state, double degrees, int ticks,
                 double dt) {
    Along along;
    const PlayerInput input = wish(std::cos(radians(degrees)), -std::sin(radians(degrees)));
    for (int i = 0; i < ticks; ++i) {
        const double x = state.position.x();
        state = step(lab.scene(), s, state, input, dt).state;
        const double motion = state.position.x() - x;
        along.motion += motion;
        along.least = std::min(along.least, motion);
        along.maximum = std::max(along.maximum, motion);
        along.airborne += state.grounded ? 0 : 1;
    }
    along.end = state;
    return along;
}

TEST(StairWalk, AlongAWallMakesTheTangentialPartInEveryTick) {
    // Pushing by `degrees` into the wall leaves the cosine of the walking speed. What the stick gives back of
    // the part into the wall points into the wall, so it adds nothing along it; a second before the
    // measurement lets the speed settle to 2e-5.
    for (const bool on : {false, true}) {
        for (const int rate : {30, 60, 120, 240}) {
            for (const double degrees : {10.0, 30.0, 45.0, 70.0}) {
                MovementSettings s = basic_settings();
                s.step_up = s.snap_down = on;
                Lab lab;
                lab.floor();
                lab.wall({-50, 0}, {50, 0});
                lab.ready();
                const double dt = 1.0 / rate, fraction = 6.0 * std::cos(radians(degrees)) * dt;
                const PlayerState start_of_wall = at({-10, 0.902, s.radii.z() + s.skin});
                const PlayerState walking = push_along(lab, s, start_of_wall, degrees, rate, dt).end;
                const Along along = push_along(lab, s, walking, degrees, rate, dt);
                EXPECT_NEAR(along.least, fraction, 1e-4 * fraction) << rate << " Hz, " << degrees;
                EXPECT_NEAR(along.maximum, fraction, 1e-9 * fraction) << rate << " Hz, " << degrees;
                EXPECT_EQ(along.airborne, 0) << rate << " Hz, " << degrees;
            }
        }
    }
}

// Ten steps of 0.3 m by 0.4 m up along +X from x = 2, a wall z = 0 beside them.
Lab stairs_beside_a_wall() {
    Lab lab;
    lab.floor();
    lab.wall({-50, 0}, {50, 0});
    for (int i = 0; i < 10; ++i) {
        const double x = 2.0 + 0.4 * i, low = 0.3 * i, high = low + 0.3;
        const double far = i == 9 ? x + 30 : x + 0.4;
        lab.polygon({{x, low, 3}, {x, low, -3}, {x, high, -3}, {x, high, 3}});
        lab.polygon({{x, high, -3}, {x, high, 3}, {far, high, 3}, {far, high, -3}});
    }
    lab.ready();
    return lab;
}

// Three seconds at 4 m/s from beside the wall, 2 m before the stairs.
Along walk_up(bool on, int rate, double degrees) {
    MovementSettings s = basic_settings();
    s.walk_speed = 4.0;
    s.step_up = s.snap_down = on;
    const Lab lab = stairs_beside_a_wall();
    const double dt = 1.0 / rate;
    // No riser is met in the last thousandth of a tick, where a tick's way is worth no step.
    const PlayerState foot = at({0.003, 0.902, s.radii.z() + s.skin});
    const PlayerState walking = push_along(lab, s, foot, degrees, rate / 4, dt).end;
    return push_along(lab, s, walking, degrees, 3 * rate, dt);
}

TEST(StairWalk, UpStairsAlongAWallGainsNothingAndStaysOnTheGround) {
    for (const double degrees : {10.0, 30.0, 45.0}) {
        for (const int rate : {60, 120, 240, 360}) {
            const Along along = walk_up(true, rate, degrees);
            const double fraction = 4.0 * std::cos(radians(degrees)) / rate;
            EXPECT_EQ(along.airborne, 0) << rate << " Hz, " << degrees;
            EXPECT_LT(along.maximum, fraction * (1.0 + 1e-9)) << rate << " Hz, " << degrees;
            // 4 cos 45 * 3 s = 8.5 m are ample for 5.6 m of way: on top of ten steps.
            EXPECT_NEAR(along.end.position.y(), 3.0 + 0.902, 1e-6) << rate << " Hz, " << degrees;
            // At 60 Hz a tick's way is worth a step at once. In shorter ticks the lift lands on the rim of a
            // step, and the round foot must come over it first.
            const double least_mean = rate == 60 ? 0.9999 : 0.94;
            EXPECT_GT(along.motion, least_mean * fraction * 3 * rate) << rate << " Hz, " << degrees;
            EXPECT_GT(along.least, (rate == 60 ? 0.997 : 0.4) * fraction) << rate << " Hz, " << degrees;
        }
    }
}

TEST(StairWalk, UpStairsAlongAWallEndsAtTheFirstStepWithoutStepUp) {
    // The rim, 0.3 m up, is 0.602 m below the centre, where the ellipsoid is 0.4 sqrt(1 - (0.602 / 0.9)^2) =
    // 0.29734 m wide. Its normal there, (x / 0.16, y / 0.81) made unit, has 0.9286 along X: a skin off it is
    // 0.002 / 0.9286 = 0.00215 m along X.
    for (const double degrees : {10.0, 30.0, 45.0}) {
        for (const int rate : {60, 120, 240, 360}) {
            const Along along = walk_up(false, rate, degrees);
            EXPECT_NEAR(along.end.position.x(), 2.0 - 0.29734 - 0.00215, 1e-4) << rate << " Hz, " << degrees;
            EXPECT_NEAR(along.end.position.y(), 0.902, 1e-6) << rate << " Hz, " << degrees;
        }
    }
}

// A ramp deflects the move of a walking player and leaves its velocity to the stick, beside a wall too.
TEST(RampWalk, AlongAWallKeepsTheVelocityOfTheStick) {
    for (const double degrees : {10.0, 45.0, 70.0}) {
        const MovementSettings s = basic_settings();
        Lab lab;
        lab.slope(radians(30));
        lab.wall({-50, 0}, {50, 0}, -50, 50);
        lab.ready();
        const PlayerState foot = at({0, centre_height(s, slope_normal(radians(30))), s.radii.z() + s.skin});
        const PlayerState walking = push_along(lab, s, foot, degrees, 60, tick).end;
        EXPECT_TRUE(walking.grounded);
        EXPECT_NEAR(walking.velocity.x(), s.walk_speed * std::cos(radians(degrees)), 1e-4) << degrees;
    }
}

}  // namespace
}  // namespace slipface::test
