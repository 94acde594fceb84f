// Jumps in the air against closed forms: heights, numbers, what gives them back, and frames.
#include <algorithm>

#include "test_geometry.h"

namespace slipface::test {

namespace {

struct Ground : Lab {
    Ground() {
        floor();
        ready();
    }
};

PlayerState standing(const Lab& lab, const MovementSettings& s, double dt) {
    return run(lab, s, at({0, s.radii.y() + 2 * s.skin, 0}), {}, 20, dt);
}

MovementSettings random_jumper(Random& random) {
    MovementSettings s = basic_settings();
    s.gravity = random.between(9, 35);
    s.jump_speed = random.between(5, 12);
    s.air_jump = true;
    s.air_jumps = 1 + random.below(3);
    s.air_jump_speed = random.between(3, 12);
    return s;
}

}  // namespace

// A jump of speed v that is followed after t seconds, and again each t seconds, by one of speed w rises
// v t - g t*t/2, then for each but the last w t - g t*t/2, and at last w*w/(2g).
TEST(AirJump, HeightsAreThoseOfTheParabolas) {
    const Ground lab;
    Random random(81);
    for (int i = 0; i < 200; ++i) {
        const MovementSettings s = random_jumper(random);
        const int rate = std::array{30, 60, 144, 240}[static_cast<std::size_t>(random.below(4))];
        const double dt = 1.0 / rate;
        const int between =
            std::max(2, static_cast<int>(random.between(0.05, 0.9) * s.jump_speed / s.gravity * rate));
        PlayerState state = standing(lab, s, dt);
        const double ground = state.position.y();
        double top = ground;
        for (int k = 0; k < 4 * rate && (k == 0 || !state.grounded); ++k) {
            const bool presses = k % between == 0 && k / between <= s.air_jumps;
            state = step(lab.scene(), s, state, wish(0, 0, presses), dt).state;
            top = std::max(top, state.position.y());
        }
        const double t = between * dt, g = s.gravity;
        const double first = s.jump_speed * t - g * t * t / 2, other = s.air_jump_speed * t - g * t * t / 2;
        double here = first, expected = std::max(
                                 first, t >= s.jump_speed / g ? s.jump_speed * s.jump_speed / (2 * g) : 0.0);
        for (int jump = 1; jump <= s.air_jumps; ++jump) {
            const bool passes_top = jump == s.air_jumps || t >= s.air_jump_speed / g;
            expected = std::max(expected,
                                here + (passes_top ? s.air_jump_speed * s.air_jump_speed / (2 * g) : other));
            here += other;
        }
        if (here - other < 0.05) continue;  // it landed before the last press
        // The highest tick lies at most half a tick from the top.
        EXPECT_LE(top - ground, expected + 1e-9) << "example " << i;
        EXPECT_GE(top - ground, expected - g * dt * dt / 8 - 1e-9) << "example " << i;
    }
}

TEST(AirJump, OffAPressInTheAirDoesNothing) {
    const Ground lab;
    MovementSettings s = basic_settings();
    const PlayerState falling = at({0, 20, 0}, {1, -3, 2});
    TraceRecorder trace;
    const PlayerState pressed = step(lab.scene(), s, falling, wish(0, 0, true), tick, &trace).state;
    PlayerState other = step(lab.scene(), s, falling, wish(0, 0), tick).state;
    EXPECT_TRUE(has_decision(trace, "air_jump", false, "Air jump is off"));
    other.jump_held = true;
    EXPECT_EQ(pressed, other);
}

TEST(AirJump, StartsAnewHoweverFastTheFall) {
    const Ground lab;
    Random random(82);
    for (int i = 0; i < 100; ++i) {
        const MovementSettings s = random_jumper(random);
        PlayerState state =
            at({0, 30, 0}, {random.between(-9, 9), random.between(-40, 8), random.between(-9, 9)});
        // The ground that was left moved: the jump is as high seen from there.
        state.carrier = Carrier::level;
        state.air_frame = {random.between(-4, 4), random.between(-4, 4), 0};
        TraceRecorder trace;
        const PlayerState after = step(lab.scene(), s, state, wish(0, 0, true), tick, &trace).state;
        ASSERT_EQ(decisions_of(trace, Decision::air_jumped).size(), 1U);
        EXPECT_NEAR(after.velocity.y(), s.air_jump_speed + state.air_frame.y() - s.gravity * tick, 1e-9);
        EXPECT_EQ(after.velocity.x(), state.velocity.x());
        EXPECT_EQ(after.velocity.z(), state.velocity.z());
        EXPECT_EQ(after.air_jumps, 1);
        EXPECT_TRUE(after.jumping);
    }
}

TEST(AirJump, IsGivenBackByWhatTheSettingNames) {
    Lab lab;
    lab.floor();
    lab.wall({5, 10}, {5, -10}, -5, 20, ladder);
    lab.wall({-5, -10}, {-5, 10}, -5, 20);
    lab.ready();
    for (const AirJumpReset reset : {AirJumpReset::ground, AirJumpReset::holds, AirJumpReset::walls}) {
        MovementSettings s = basic_settings();
        s.air_jump = s.wall_slide = true;
        s.air_jump_reset = reset;
        const auto after_press = [&](PlayerState state) {
            return step(lab.scene(), s, state, wish(0, 0, true), tick).state.air_jumps;
        };
        const auto let_go = [&](PlayerState state, double x, int ticks) {
            return run(lab, s, state, wish(x, 0), ticks);
        };
        PlayerState used = at({0, 8, 0});
        used.air_jumps = 1;
        EXPECT_EQ(after_press(used), 1) << "none is left, and none is counted";
        EXPECT_EQ(let_go(used, 0, 120).air_jumps, 0) << "ground";
        used.position.x() = 5 - s.radii.x() - 0.05;
        const PlayerState climbing = let_go(used, 1, 20);
        ASSERT_TRUE(climbing.climbing);
        EXPECT_EQ(climbing.air_jumps, reset == AirJumpReset::ground ? 1 : 0);
        used.position.x() = -used.position.x();
        const PlayerState sliding = let_go(used, -1, 40);
        ASSERT_FALSE(sliding.grounded);
        EXPECT_EQ(sliding.air_jumps, reset == AirJumpReset::walls ? 0 : 1);
    }
}

TEST(AirJump, ButtonsThatNoAbilityReadsChangeNothing) {
    const Ground lab;
    Random random(83);
    const MovementSettings s = every_hack();
    PlayerState plain = at({0, 3, 0}), other = plain;
    for (int i = 0; i < 600; ++i) {
        PlayerInput input = wish(random.between(-1, 1), random.between(-1, 1), random.below(4) == 0);
        plain = step(lab.scene(), s, plain, input, tick).state;
        input.buttons.bits |= static_cast<std::uint32_t>(random.below(1 << 16)) << ButtonSet::first_own;
        other = step(lab.scene(), s, other, input, tick).state;
        ASSERT_EQ(plain, other) << i;
    }
}

}  // namespace slipface::test
