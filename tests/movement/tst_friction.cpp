// How well the ground holds: slides at 0, plain ground at 1, larger holds; and nothing jumps in between.
#include <algorithm>
#include <cmath>
#include <limits>

#include "test_geometry.h"

namespace slipface::test {

namespace {

constexpr SurfaceId rough = plain;  // the default type is the one that these tests change

// A player who stands on a slope through the origin whose ground has this friction.
struct Slope {
    Lab lab;
    double angle;

    Slope(double degrees, double friction) : angle(radians(degrees)) {
        lab.surfaces[rough].friction = friction;
        lab.slope(angle, rough, 400.0);
        lab.ready();
    }
};

double speed_along(const PlayerState& state) {
    return motion_velocity(state).norm();
}

double horizontal_square(const Vec3& v) {
    return v.x() * v.x() + v.z() * v.z();
}

PlayerState after_on_flat(double friction, const PlayerInput& input, double speed, int ticks) {
    Lab lab;
    lab.surfaces[rough].friction = friction;
    lab.floor();
    lab.ready();
    const MovementSettings s = basic_settings();
    PlayerState state = run(lab, s, at({0, 0.9 + s.skin, 0}), {}, 5);
    state.velocity.x() = speed;
    return run(lab, s, state, input, ticks);
}

}  // namespace

TEST(Friction, MultipliesAccelerationAndBrakingOnTheGround) {
    const MovementSettings s = basic_settings();
    for (const double friction : {0.0, 0.1, 0.25, 1.0, 2.0}) {
        const double per_tick = friction * s.ground_acceleration * tick;
        EXPECT_NEAR(after_on_flat(friction, wish(1, 0), 0.0, 2).velocity.x(), std::min(6.0, 2 * per_tick),
                    1e-12);
        EXPECT_NEAR(after_on_flat(friction, {}, 6.0, 2).velocity.x(), std::max(0.0, 6.0 - 2 * per_tick),
                    1e-12);
    }
}

TEST(Friction, NothingIsMultipliedInTheAirOrWithoutSurfaceTypes) {
    for (const double friction : {0.0, 5.0}) {
        Lab lab;
        lab.surfaces[rough].friction = friction;
        lab.floor();
        lab.ready();
        MovementSettings s = basic_settings();
        const PlayerState flying = step(lab.scene(), s, at({0, 5, 0}), wish(1, 0), tick).state;
        EXPECT_NEAR(flying.velocity.x(), s.air_acceleration * tick, 1e-12);
        s.surface_types = false;
        const PlayerState state = run(lab, s, at({0, 0.9 + s.skin, 0}), {}, 5);
        EXPECT_NEAR(step(lab.scene(), s, state, wish(1, 0), tick).state.velocity.x(),
                    s.ground_acceleration * tick, 1e-12);
    }
}

// The law of the file's head: from rest, (1 - f) g sin a - f acceleration / cos a along the slope, where that
// is more than nothing; the acceleration is one across the map.
TEST(Friction, BelowOneASlopePullsAsFarAsFrictionDoesNotHold) {
    Random random(5);
    int slid = 0, held = 0;
    for (int trial = 0; trial < 300; ++trial) {
        const double degrees = random.between(2, 48), friction = random.between(0, 1.2);
        MovementSettings s = basic_settings();
        s.ground_acceleration = random.between(1, 60);
        s.snap_down = true;
        Slope slope(degrees, trial % 3 == 0 ? random.between(0, 0.2) : friction);
        const double f = slope.lab.surfaces[rough].friction;
        PlayerState state = standing_on_slope(slope.lab, s, slope.angle);
        const double hz = trial % 2 == 0 ? 60.0 : 240.0;
        // Brought to rest by hand: what slides has slid since it landed.
        state.velocity = Vec3(0, -s.ground_speed, 0);
        const Vec3 from = state.position;
        const double seconds = 0.5;
        const int ticks = static_cast<int>(seconds * hz);
        const PlayerState end = run(slope.lab, s, state, {}, ticks, 1.0 / hz);
        const double across =
            std::max(0.0, 1.0 - f) * s.gravity * std::sin(slope.angle) * std::cos(slope.angle) -
            f * s.ground_acceleration;
        ASSERT_TRUE(end.grounded) << degrees << " " << f;
        if (across <= 0.0) {
            ++held;
            EXPECT_EQ((end.position - from).norm(), 0.0) << degrees << " " << f;
            continue;
        }
        ++slid;
        const double along = across / std::cos(slope.angle);
        EXPECT_NEAR(speed_along(end), along * seconds, 1e-6 + 1e-3 * along) << degrees << " " << f;
        EXPECT_NEAR((from - end.position).norm(), 0.5 * along * seconds * seconds, 2e-3 + 1e-3 * along)
            << degrees << " " << f;
    }
    EXPECT_GT(slid, 50);
    EXPECT_GT(held, 50);
}

TEST(Friction, NothingJumpsWhereFrictionChangesALittle) {
    // Random slopes, sticks and speeds; the way of a second changes with friction as little as friction does,
    // and not at all at 1.
    Random random(9);
    for (int trial = 0; trial < 200; ++trial) {
        const double degrees = random.between(0, 45);
        MovementSettings s = basic_settings();
        s.snap_down = true;
        const Vec3 speed(random.between(-6, 6), 0, random.between(-6, 6));
        const PlayerInput input =
            trial % 2 == 0 ? PlayerInput{} : wish(random.between(-1, 1), random.between(-1, 1));
        const auto end = [&](double friction) {
            Slope slope(degrees, friction);
            PlayerState state = standing_on_slope(slope.lab, s, slope.angle);
            state.position = Vec3(0.0, centre_height(s, slope_normal(slope.angle)), 0.0);
            state.velocity = speed;
            return run(slope.lab, s, state, input, 60).position;
        };
        const double f = trial % 4 == 0 ? 1.0 : random.between(0.0, 1.5);
        const Vec3 here = end(f);
        EXPECT_LT((end(f + 1e-6) - here).norm(), 1e-3) << degrees << " " << f;
        const double less = std::max(0.0, f - 1e-6);
        EXPECT_LT((end(less) - here).norm(), 1e-3) << degrees << " " << f;
    }
}

TEST(Friction, WithoutInputEnergyNeverGrows) {
    // A random valley of ramps: motion along the ground counts whole, down and up.
    Random random(21);
    for (int trial = 0; trial < 120; ++trial) {
        Lab lab;
        const double friction = random.between(0, 1.2);
        lab.surfaces[rough].friction = friction;
        double x = -30.0, y = 12.0;
        while (x < 30.0) {
            const double length = random.between(1.5, 5), rise = length * random.between(-0.8, 0.8);
            lab.polygon({{x, y, -20}, {x, y, 20}, {x + length, y + rise, 20}, {x + length, y + rise, -20}},
                        rough);
            x += length;
            y += rise;
        }
        lab.ready();
        MovementSettings s = basic_settings();
        s.snap_down = trial % 2 == 0;
        s.ground_acceleration = random.between(1, 60);
        PlayerState state = run(lab, s, at({random.between(-25, 25), 60, random.between(-5, 5)}), {}, 240);
        if (!state.grounded) continue;
        state.velocity += Vec3(random.between(-8, 8), 0, random.between(-3, 3));
        const auto energy = [&](const PlayerState& p) {
            // As Energy.NeverGrowsWithoutInput: of motion on the ground the descent counts; the rise as
            // far as friction is missing, for what friction holds a climb is no motion that goes on.
            Vec3 v = p.velocity;
            if (p.grounded) v.y() = motion_velocity(p).y();
            const double counted = p.grounded && v.y() > 0.0 ? std::max(0.0, 1.0 - friction) : 1.0;
            return 0.5 * (horizontal_square(v) + counted * v.y() * v.y()) + s.gravity * p.position.y();
        };
        double least = energy(state);
        for (int i = 0; i < 240; ++i) {
            state = step(lab.scene(), s, state, {}, tick).state;
            ASSERT_LE(energy(state), least + 2.0 * s.gravity * s.skin + 1e-9)
                << "trial " << trial << " friction " << friction << " tick " << i;
            least = std::min(least, energy(state));
        }
    }
}

TEST(Friction, IceOfFrictionZeroIsNotSteered) {
    Lab lab;
    lab.surfaces[ice].friction = 0.0;
    lab.floor(0, ice);
    lab.ready();
    const MovementSettings s = basic_settings();
    const PlayerState state = run(lab, s, run(lab, s, at({0, 0.95, 0}), {}, 30), wish(1, 0), 60);
    EXPECT_EQ(state.velocity.x(), 0.0);
    lab.surfaces[ice].friction = 1.0;
    EXPECT_NEAR(run(lab, s, state, wish(1, 0), 60).velocity.x() - state.velocity.x(), s.slippery_acceleration,
                0.01);
}

// --- bounces

namespace {

Vec3 off_a_wall(double restitution, double friction, const Vec3& velocity, int ticks = 30) {
    Lab lab;
    lab.surfaces[bouncy].restitution = restitution;
    lab.surfaces[bouncy].friction = friction;
    lab.wall({2, -90}, {2, 90}, -50, 50, bouncy);
    lab.ready();
    MovementSettings s = basic_settings();
    s.gravity = 0.0;
    return run(lab, s, at({0, 0, 0}, velocity), {}, ticks).velocity;
}

}  // namespace

TEST(Friction, TakesFromABounceWhatTheReboundCanAndNoMoreThanItsFraction) {
    Random random(3);
    for (int trial = 0; trial < 200; ++trial) {
        const double e = random.between(0.01, 1), f = random.between(0, 10);
        const double into = random.between(5, 12), along = random.between(-6, 6);
        const Vec3 end = off_a_wall(e, f, Vec3(into, 0, along));
        const double lost = f > 1.0 ? std::min((1.0 - 1.0 / f) * std::abs(along), (f - 1.0) * e * into) : 0.0;
        EXPECT_LT((end - Vec3(-e * into, 0, along - std::copysign(lost, along))).norm(), 1e-6)
            << "e " << e << " f " << f;
    }
}

TEST(Friction, ABounceGoesOverIntoASlideWithoutAJump) {
    for (const double f : {0.0, 0.5, 1.0, 3.0, 10.0}) {
        const Vec3 slide = off_a_wall(0.0, f, {8, 0, 4});
        for (const double e : {1e-9, 1e-6, 1e-4}) {
            // Of the rebound e 8 each metre per second takes f - 1 at most.
            const Vec3 bounce = off_a_wall(e, f, {8, 0, 4});
            EXPECT_LE((bounce - slide).norm(), 8.0 * e * (1.0 + std::max(0.0, f - 1.0)) + 1e-12)
                << f << " " << e;
        }
    }
    // On a floor with gravity the rebound begins at gravity's change of a tick: from e with no bounce to e
    // with one, as little changes.
    for (const double f : {0.3, 2.0, 6.0}) {
        const auto landed = [&](double e) {
            Lab lab;
            lab.surfaces[bouncy].restitution = e;
            lab.surfaces[bouncy].friction = f;
            lab.floor(0, bouncy);
            lab.ready();
            const MovementSettings s = basic_settings();
            PlayerState state = at({0, 2.9, 0}, {4, 0, 0});
            // Until it was on the ground once, so to the tick after the first touch.
            for (int i = 0; i < 40; ++i) {
                const PlayerState next = step(lab.scene(), s, state, {}, tick).state;
                if (next.velocity.y() > state.velocity.y()) return next.velocity.x();
                state = next;
            }
            return state.velocity.x();
        };
        const double still = landed(0.0);
        for (double e = 0.0; e < 0.2; e += 0.001) {
            // A rebound of e 8.9 m/s at most.
            EXPECT_LE(std::abs(landed(e) - still), std::max(0.0, f - 1.0) * e * 9.0 + 1e-9) << f << " " << e;
        }
    }
}

TEST(Friction, ItsDecisionsAreTold) {
    for (const bool slides : {false, true}) {
        Slope slope(30, slides ? 0.05 : 0.5);
        const MovementSettings s = basic_settings();
        const PlayerState state = standing_on_slope(slope.lab, s, slope.angle);
        TraceRecorder trace;
        step(slope.lab.scene(), s, state, {}, tick, &trace);
        EXPECT_EQ(has_decision(trace, "surface_types", true, "Slid down"), slides);
        EXPECT_EQ(has_decision(trace, "surface_types", true, "Held on the slope"), !slides);
    }
}

TEST(Friction, WhateverAGameWritesThereNothingBreaks) {
    for (const double friction : {-1.0, 1e300, std::nan(""), -std::numeric_limits<double>::infinity()}) {
        Slope slope(20, friction);
        const MovementSettings s = basic_settings();
        const PlayerState state = run(slope.lab, s, at({0, 3, 0}), wish(1, 0), 120);
        EXPECT_TRUE(state.position.allFinite() && state.velocity.allFinite()) << friction;
        EXPECT_LE(motion_velocity(state).norm(), 40.0);
    }
}

// A sledge that slides up a slope without friction pays for its height with its velocity: v v / 2g, no more
// and no less.
TEST(Friction, ASledgeRisesAsFarAsItsEnergyAllows) {
    Lab lab;
    lab.surfaces[plain].friction = 0.0;
    lab.slope(radians(30));
    lab.ready();
    const MovementSettings s = basic_settings();
    PlayerState state = at({0, centre_height(s, slope_normal(radians(30))), 0}, {5, 0, 0});
    state.grounded = true;
    state.ground_normal = slope_normal(radians(30));
    state.ground_face = 0;
    const double from = state.position.y();
    double highest = from;
    for (int i = 0; i < 240; ++i) {
        state = step(lab.scene(), s, state, {}, tick / 4).state;
        highest = std::max(highest, state.position.y());
    }
    const double expected = 25.0 / (2.0 * s.gravity);
    EXPECT_NEAR(highest - from, expected, 0.01 * expected);
}

}  // namespace slipface::test
