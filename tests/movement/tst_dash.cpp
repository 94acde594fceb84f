// Dashes against closed forms: length, time, what remains, what gives them back and what ends them.
#include <algorithm>

#include "test_geometry.h"

namespace slipface::test {

namespace {

constexpr std::array rates{30, 60, 72, 144, 240};

PlayerInput push(const Vec3& way, std::initializer_list<Button> buttons) {
    PlayerInput input{.wish = {way.x(), way.z()}};
    for (const Button button : buttons)
        input.buttons.set(button);
    return input;
}

MovementSettings dasher() {
    MovementSettings s = basic_settings();
    s.dash = true;
    s.terminal_speed = 500;
    return s;
}

Vec3 heading(double angle) {
    return {std::cos(angle), 0, std::sin(angle)};
}

}  // namespace

// A dash of speed v for T seconds is v T long and level in the air; then the player falls with what remains.
// After t seconds more it is w t further and g t*t/2 lower.
TEST(Dash, IsSpeedTimesTimeLongAtEveryRate) {
    Lab lab;
    lab.floor(-500);
    lab.ready();
    Random random(101);
    for (int i = 0; i < 300; ++i) {
        MovementSettings s = dasher();
        s.gravity = random.between(9, 35);
        s.dash_speed = random.between(4, 40);
        s.dash_time = random.between(0.03, 0.6);
        s.dash_end_speed = random.between(0, 1.2) * s.dash_speed;
        const int rate = rates[static_cast<std::size_t>(random.below(5))];
        const double dt = 1.0 / rate;
        const Vec3 way = heading(random.between(0, 2 * pi));
        PlayerState state = at({0, 0, 0}, {random.between(-9, 9), random.between(-20, 9), 3});
        const int ticks = static_cast<int>(std::ceil(s.dash_time * rate - 1e-6)) + random.below(5);
        for (int k = 0; k < ticks; ++k) {
            const PlayerInput input = k == 0 ? push(way, {Button::dash}) : PlayerInput{};
            state = step(lab.scene(), s, state, input, dt).state;
        }
        const double w = std::min(s.dash_speed, s.dash_end_speed), t = ticks * dt - s.dash_time;
        EXPECT_NEAR(state.position.dot(way), s.dash_speed * s.dash_time + w * t, 1e-9) << "example " << i;
        EXPECT_NEAR(state.position.y(), -s.gravity * t * t / 2, 1e-9) << "example " << i;
        EXPECT_NEAR((Vec3(state.velocity.x(), 0, state.velocity.z()) - w * way).norm(), 0, 1e-9)
            << "example " << i;
        EXPECT_EQ(state.move_s, 0.0);
    }
}

// On the ground, too, and up and down slopes: the horizontal way is the same, and the player stays on it.
TEST(Dash, FollowsTheGround) {
    Random random(102);
    for (int i = 0; i < 100; ++i) {
        MovementSettings s = dasher();
        s.dash_end_speed = s.dash_speed;
        s.ground_acceleration = 0;
        s.snap_down = true;
        const double angle = radians(random.between(-35, 35));
        Lab lab;
        lab.slope(angle);
        lab.ready();
        PlayerState state = standing_on_slope(lab, s, angle);
        const Vec3 begin = state.position;
        const int rate = rates[static_cast<std::size_t>(random.below(5))];
        const int ticks = static_cast<int>(std::lround(s.dash_time * rate));
        for (int k = 0; k < ticks; ++k) {
            state = step(lab.scene(), s, state, push({1, 0, 0}, {Button::dash}), 1.0 / rate).state;
            EXPECT_TRUE(state.grounded) << "example " << i << ", tick " << k;
        }
        // Uphill it is projected onto the slope, as a walk is.
        const double slower = angle > 0 ? std::cos(angle) * std::cos(angle) : 1.0;
        const double way = s.dash_speed * ticks / rate * slower;
        EXPECT_NEAR(state.position.x() - begin.x(), way, 1e-6) << "example " << i;
        EXPECT_NEAR(state.position.y() - begin.y(), std::tan(angle) * (state.position.x() - begin.x()),
                    8 * s.skin);
        EXPECT_EQ(state.dashes, 0);
    }
}

TEST(Dash, TheAirGivesSoManyAndTheGroundGivesThemBack) {
    Lab lab;
    lab.floor();
    lab.ready();
    for (int most = 0; most <= 3; ++most) {
        MovementSettings s = dasher();
        s.dashes = most;
        s.dash_time = 0.05;
        PlayerState state = at({0, 30, 0});
        int made = 0;
        for (int k = 0; k < 60; ++k) {
            TraceRecorder trace;
            state = step(lab.scene(), s, state,
                         push({1, 0, 0}, k % 6 == 0 ? std::initializer_list<Button>{Button::dash}
                                                    : std::initializer_list<Button>{}),
                         tick, &trace)
                        .state;
            made += static_cast<int>(decisions_of(trace, Decision::dashed).size());
            EXPECT_EQ(!decisions_of(trace, Decision::dashes_used).empty(), k % 6 == 0 && k / 6 >= most);
        }
        EXPECT_EQ(made, most);
        EXPECT_EQ(state.dashes, most);
        state = run(lab, s, state, {}, 200);
        ASSERT_TRUE(state.grounded);
        EXPECT_EQ(state.dashes, 0);
        state = step(lab.scene(), s, state, push({1, 0, 0}, {Button::dash}), tick).state;
        EXPECT_NEAR(state.velocity.x(), s.dash_speed, 1e-9);
    }
}

// Head-on a wall ends it, and the player falls at once; beside a wall it goes on along it.
TEST(Dash, WallsEndOrDeflectIt) {
    Random random(103);
    for (int i = 0; i < 100; ++i) {
        const MovementSettings s = dasher();
        Lab lab;
        lab.wall({5, -50}, {5, 50}, -50, 150);
        lab.ready();
        const double aside = radians(random.between(0, 85));
        const Vec3 way(std::cos(aside), 0, std::sin(aside));
        PlayerState state = at({5 - s.radii.x() - 0.3, 0, 0});
        for (int k = 0; k < 12; ++k)
            state = step(lab.scene(), s, state, push(way, {Button::dash}), tick).state;
        EXPECT_LE(state.position.x(), 5 - s.radii.x());
        if (std::sin(aside) < 0.49) {
            EXPECT_EQ(state.move_s, 0) << i;
            EXPECT_LT(state.velocity.y(), -1) << i;
        } else if (std::sin(aside) > 0.51) {
            EXPECT_GT(state.position.z(), 0.9 * s.dash_speed * s.dash_time * std::sin(aside)) << i;
            EXPECT_EQ(state.position.y(), 0.0) << i;
        }
    }
}

TEST(Dash, GoesWhereItsSettingSays) {
    Lab lab;
    lab.floor(-100);
    lab.ready();
    MovementSettings s = dasher();
    const PlayerState moving = at({0, 0, 0}, {0, 0, 4});
    const auto led = [&](const PlayerState& from, const PlayerInput& input) {
        return Vec3(step(lab.scene(), s, from, input, tick).state.position / tick);
    };
    EXPECT_NEAR((led(moving, push({1, 0, 0}, {Button::dash})) - Vec3(s.dash_speed, 0, 0)).norm(), 0, 1e-9);
    EXPECT_NEAR((led(moving, push({0, 0, 0}, {Button::dash})) - Vec3(0, 0, s.dash_speed)).norm(), 0, 1e-9);
    s.dash_toward = DashToward::motion;
    EXPECT_NEAR((led(moving, push({1, 0, 0}, {Button::dash})) - Vec3(0, 0, s.dash_speed)).norm(), 0, 1e-9);
    TraceRecorder trace;
    const PlayerState still = at({0, 0, 0});
    const PlayerState end = step(lab.scene(), s, still, push({0, 0, 0}, {Button::dash}), tick, &trace).state;
    EXPECT_EQ(decisions_of(trace, Decision::dash_no_way).size(), 1U);
    EXPECT_LT(end.velocity.y(), 0);
}

TEST(Dash, AJumpEndsItAndKeepsItsSpeed) {
    Lab lab;
    lab.floor();
    lab.ready();
    MovementSettings s = dasher();
    s.keep_speed = true;
    PlayerState state = run(lab, s, at({0, s.radii.y() + 0.01, 0}), {}, 20);
    state = step(lab.scene(), s, state, push({1, 0, 0}, {Button::dash}), tick).state;
    TraceRecorder trace;
    state = step(lab.scene(), s, state, push({1, 0, 0}, {Button::dash, Button::jump}), tick, &trace).state;
    EXPECT_EQ(decisions_of(trace, Decision::dash_jumped).size(), 1U);
    EXPECT_NEAR(state.velocity.x(), s.dash_speed, 1e-9);
    EXPECT_NEAR(state.velocity.y(), s.jump_speed - s.gravity * tick, 1e-9);
    EXPECT_EQ(state.move_s, 0);
}

TEST(Dash, OffThePressIsSaidAndChangesNothing) {
    Lab lab;
    lab.floor();
    lab.ready();
    MovementSettings s = dasher();
    s.dash = false;
    const PlayerState falling = at({0, 20, 0}, {1, -3, 2});
    TraceRecorder trace;
    const PlayerState pressed =
        step(lab.scene(), s, falling, push({1, 0, 0}, {Button::dash}), tick, &trace).state;
    EXPECT_EQ(pressed, step(lab.scene(), s, falling, push({1, 0, 0}, {}), tick).state);
    EXPECT_TRUE(has_decision(trace, "dash", false, "Dash is off"));
    s.dash = true;
    s.dash_time = 0;
    TraceRecorder short_one;
    (void)step(lab.scene(), s, falling, push({1, 0, 0}, {Button::dash}), tick, &short_one);
    EXPECT_TRUE(has_decision(short_one, "dash", true, "counts as"));
}

// A ferry's dash is the same seen from the ferry: in the air relative to the ground that was left.
TEST(Dash, IsRelativeToTheGroundThatWasLeft) {
    Lab lab;
    lab.floor(-100);
    lab.ready();
    const MovementSettings s = dasher();
    PlayerState state = at({0, 0, 0}, {3, 0, 0});
    state.air_frame = {3, 0, 1};
    for (int k = 0; k < 12; ++k)
        state = step(lab.scene(), s, state, push({0, 0, 1}, {Button::dash}), tick).state;
    EXPECT_NEAR((state.position - Vec3(3, 0, 1 + s.dash_speed) * 0.2).norm(), 0, 1e-9);
}

}  // namespace slipface::test
