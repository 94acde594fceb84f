// Falling through one-sided floors, and falling slowly.
#include <algorithm>

#include "test_geometry.h"

namespace slipface::test {

namespace {

constexpr SurfaceId lattice = hazard;  // here: one-sided

struct Floors : Lab {
    Floors() {
        surfaces[lattice] = SurfaceType{.name = "lattice", .one_sided = true};
        floor(0);
        floor(4, lattice, 9);
        floor(8, lattice, 9);
        ready();
    }
};

PlayerInput drop(bool held = true) {
    PlayerInput input;
    input.buttons.set(Button::drop, held);
    return input;
}

double lowest(const MovementSettings& s, const PlayerState& state) {
    return state.position.y() - s.radii.y();
}

}  // namespace

// A press of any length leads through one floor and lands on the next; held, through all one-sided ones.
TEST(DropThrough, APressLeadsThroughOneFloor) {
    const Floors lab;
    MovementSettings s = basic_settings();
    s.drop_through = true;
    Random random(131);
    for (int i = 0; i < 60; ++i) {
        const double dt = 1.0 / std::array{30, 60, 144, 240}[static_cast<std::size_t>(random.below(4))];
        const double x = random.between(-5, 5);
        PlayerState state = run(lab, s, at({x, 8 + s.radii.y() + 0.01, 0}), {}, 20, dt);
        ASSERT_TRUE(state.grounded);
        const double press = random.between(0.03, 0.4);
        state = run(lab, s, state, drop(), static_cast<int>(std::ceil(press / dt)), dt);
        EXPECT_FALSE(state.grounded);
        state = run(lab, s, state, {}, static_cast<int>(2 / dt), dt);
        EXPECT_TRUE(state.grounded);
        EXPECT_NEAR(lowest(s, state), 4, 0.01) << "example " << i;
        EXPECT_FALSE(state.dropping);
        state = run(lab, s, state, drop(), static_cast<int>(2 / dt), dt);
        EXPECT_NEAR(lowest(s, state), 0, 0.01) << "example " << i;
    }
}

TEST(DropThrough, OffTheFloorHolds) {
    const Floors lab;
    MovementSettings s = basic_settings();
    PlayerState state = run(lab, s, at({0, 8 + s.radii.y() + 0.01, 0}), {}, 20);
    TraceRecorder trace;
    EXPECT_EQ(step(lab.scene(), s, state, drop(), tick, &trace).state,
              step(lab.scene(), s, state, {}, tick).state);
    EXPECT_TRUE(has_decision(trace, "drop_through", false, "Drop through is off"));
}

// From v upwards: after t seconds more than v/g + w/g the fall has the speed w.
TEST(Glide, FallsAtItsSpeedWhileJumpIsHeld) {
    Lab lab;
    lab.floor(-500);
    lab.ready();
    Random random(132);
    for (int i = 0; i < 100; ++i) {
        MovementSettings s = basic_settings();
        s.glide = random.below(4) != 0;
        s.glide_speed = random.between(0.5, 5);
        const int rate = std::array{30, 60, 144, 240}[static_cast<std::size_t>(random.below(4))];
        PlayerState state = at({0, 0, 0}, {0, random.between(-10, 8), 0});
        state.jump_held = true;
        state = run(lab, s, state, wish(0, 0, true), rate, 1.0 / rate);
        const double height = state.position.y();
        state = run(lab, s, state, wish(0, 0, true), rate, 1.0 / rate);
        if (s.glide)
            EXPECT_NEAR(height - state.position.y(), s.glide_speed, 1e-9) << "example " << i;
        else
            EXPECT_GT(height - state.position.y(), 9) << "example " << i;
        const PlayerState let_go = step(lab.scene(), s, state, {}, tick).state;
        EXPECT_NEAR(let_go.velocity.y(), state.velocity.y() - s.gravity * tick, 1e-9);
    }
}

}  // namespace slipface::test
