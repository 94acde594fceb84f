// Crouching: heights of passages and jumps, speed, and standing up only where there is room.
#include <algorithm>

#include "test_geometry.h"

namespace slipface::test {

namespace {

PlayerInput crouching(double x, double z, bool jump = false) {
    PlayerInput input = wish(x, z, jump);
    input.buttons.set(Button::crouch);
    return input;
}

MovementSettings croucher(Random& random) {
    MovementSettings s = basic_settings();
    s.crouch = true;
    s.radii.y() = random.between(0.7, 1.2);
    s.crouch_radius_y = random.between(0.3, 0.6);
    s.crouch_speed = random.between(1, 5);
    return s;
}

// A floor, and from x = 2 to 6 a ceiling so high above it.
struct Tunnel : Lab {
    explicit Tunnel(double height) {
        floor();
        const auto slab = [&](double y, bool up) {
            if (up)
                polygon({{2, y, -9}, {2, y, 9}, {6, y, 9}, {6, y, -9}});
            else
                polygon({{2, y, -9}, {6, y, -9}, {6, y, 9}, {2, y, 9}});
        };
        slab(height, false);
        slab(height + 4, true);
        wall({2, 9}, {2, -9}, height, height + 4);
        wall({6, -9}, {6, 9}, height, height + 4);
        ready();
    }
};

double feet(const MovementSettings& s, const PlayerState& state) {
    return state.position.y() - body_radii(s, state).y();
}

}  // namespace

TEST(Crouch, PassesUnderWhatIsHigherThanTheCrouchedBody) {
    Random random(111);
    for (int i = 0; i < 60; ++i) {
        const MovementSettings s = croucher(random);
        const double dt = 1.0 / std::array{30, 60, 144, 240}[static_cast<std::size_t>(random.below(4))];
        const double part = random.below(2) == 0 ? random.between(0.9, 0.98) : random.between(1.03, 1.3);
        const double height = std::min(2 * s.crouch_radius_y * part, 2 * s.radii.y() - 0.02);
        const Tunnel lab(height);
        PlayerState state = run(lab, s, at({0, s.radii.y() + 0.01, 0}), {}, 20, dt);
        state = run(lab, s, state, wish(1, 0), static_cast<int>(2 / dt), dt);
        EXPECT_LT(state.position.x(), 2) << "example " << i;
        state = run(lab, s, state, crouching(1, 0), static_cast<int>(8 / s.crouch_speed / dt), dt);
        EXPECT_EQ(state.position.x() > 6, height > 2 * (s.crouch_radius_y + s.skin)) << "example " << i;
        EXPECT_TRUE(state.crouched);
    }
}

TEST(Crouch, CrawlsAtItsSpeedAndKeepsTheFeet) {
    Lab lab;
    lab.floor();
    lab.ready();
    Random random(112);
    for (int i = 0; i < 50; ++i) {
        const MovementSettings s = croucher(random);
        PlayerState state = run(lab, s, at({0, s.radii.y() + 0.01, 0}), {}, 20);
        const double ground = feet(s, state);
        state = run(lab, s, state, crouching(0, 1), 60);
        EXPECT_NEAR(state.velocity.z(), std::min(s.walk_speed, s.crouch_speed), 1e-9);
        EXPECT_NEAR(feet(s, state), ground, 1e-6);
        EXPECT_NEAR(state.position.y() + s.crouch_radius_y, ground + 2 * s.crouch_radius_y, 1e-6);
        state = step(lab.scene(), s, state, {}, tick).state;
        EXPECT_FALSE(state.crouched);
        EXPECT_NEAR(feet(s, state), ground, 1e-6);
    }
}

TEST(Crouch, StandsUpOnlyWhereThereIsRoom) {
    Random random(113);
    for (int i = 0; i < 50; ++i) {
        const MovementSettings s = croucher(random);
        const Tunnel lab(random.between(2 * s.crouch_radius_y + 0.05, 2 * s.radii.y() - 0.02));
        PlayerState state = run(lab, s, at({0, s.radii.y() + 0.01, 0}), {}, 20);
        for (int k = 0; k < 600 && state.position.x() < 4; ++k)
            state = step(lab.scene(), s, state, crouching(1, 0), tick).state;
        TraceRecorder trace;
        state = step(lab.scene(), s, state, {}, tick, &trace).state;
        EXPECT_TRUE(state.crouched);
        EXPECT_TRUE(state.wants_to_stand);
        EXPECT_EQ(decisions_of(trace, Decision::crouch_no_room).size(), 1U);
        for (int k = 0; k < 600 && state.crouched; ++k)
            state = step(lab.scene(), s, state, wish(1, 0), tick).state;
        EXPECT_FALSE(state.crouched);
        EXPECT_FALSE(state.wants_to_stand);
        EXPECT_GT(state.position.x(), 6) << "example " << i;
        EXPECT_FALSE(overlaps_any(lab.scene().collision, s.radii, state.position));
    }
}

// The feet of a crouched jump rise higher by what the body lost: v*v/(2g) + 2 (tall - low).
TEST(Crouch, AJumpDrawsUpTheFeet) {
    Lab lab;
    lab.floor();
    lab.ready();
    Random random(114);
    for (int i = 0; i < 100; ++i) {
        MovementSettings s = croucher(random);
        const bool draws = random.below(4) != 0;
        s.crouch_in_air = draws ? CrouchInAir::feet_up : CrouchInAir::no;
        const double dt = 1.0 / std::array{30, 60, 144, 240}[static_cast<std::size_t>(random.below(4))];
        PlayerState state = run(lab, s, at({0, s.radii.y() + 0.01, 0}), {}, 20, dt);
        const double ground = feet(s, state);
        double top = 0;
        for (int k = 0; k < 400 && (k < 2 || !state.grounded); ++k) {
            state = step(lab.scene(), s, state, k < 2 ? wish(0, 0, true) : crouching(0, 0, true), dt).state;
            top = std::max(top, feet(s, state) - ground);
        }
        const double lost = draws ? 2 * (s.radii.y() - s.crouch_radius_y) : 0.0;
        const double height = s.jump_speed * s.jump_speed / (2 * s.gravity) + lost;
        EXPECT_LE(top, height + 1e-9) << "example " << i;
        EXPECT_GE(top, height - s.gravity * dt * dt / 8 - 1e-9) << "example " << i;
    }
}

TEST(Crouch, OffItIsSaidAndChangesNothing) {
    Lab lab;
    lab.floor();
    lab.ready();
    MovementSettings s = basic_settings();
    const PlayerState state = run(lab, s, at({0, s.radii.y() + 0.01, 0}), {}, 20);
    TraceRecorder trace;
    EXPECT_EQ(step(lab.scene(), s, state, crouching(1, 0), tick, &trace).state,
              step(lab.scene(), s, state, wish(1, 0), tick).state);
    EXPECT_TRUE(has_decision(trace, "crouch", false, "Crouch is off"));
    // A crouched radius above the standing one counts as that.
    s.crouch = true;
    s.crouch_radius_y = 3;
    const PlayerState low = run(lab, s, state, crouching(0, 0), 10);
    EXPECT_EQ(body_radii(s, low), s.radii);
    EXPECT_EQ(low.position, state.position);
}

// Random presses in a room with low and high places: no step ends inside of anything.
TEST(Crouch, NeverEndsInside) {
    Random random(115);
    for (int i = 0; i < 20; ++i) {
        MovementSettings s = croucher(random);
        s.dash = s.ledge_grab = true;
        const Tunnel lab(random.between(0.7, 2.2));
        PlayerState state = at({0, s.radii.y() + 0.01, 0});
        PlayerInput input;
        for (int k = 0; k < 600; ++k) {
            if (random.below(20) == 0) input.wish = {random.between(-1, 1), random.between(-1, 1)};
            for (const Button button : {Button::jump, Button::crouch, Button::dash})
                if (random.below(8) == 0) input.buttons.set(button, random.below(2) == 0);
            state = step(lab.scene(), s, state, input, tick).state;
            ASSERT_FALSE(overlaps_any(lab.scene().collision, body_radii(s, state), state.position))
                << "example " << i << ", tick " << k;
        }
    }
}

}  // namespace slipface::test
