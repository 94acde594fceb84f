// Hands on ledges: where a player hangs, how long it climbs, and what is not grabbed.
#include <algorithm>

#include "test_geometry.h"

namespace slipface::test {

namespace {

constexpr SurfaceId smooth = hazard;  // here: a type that hands slip off

// A floor and a block whose face stands at x = 0, turned about the vertical axis.
struct Block : Lab {
    Vec3 ahead;
    Block(double height, double angle, double depth = 4, double lean = 0, SurfaceId of_wall = plain,
          SurfaceId of_top = plain)
        : ahead(std::cos(angle), 0, std::sin(angle)) {
        surfaces[smooth] = SurfaceType{.name = "smooth", .grabbable = false};
        const Vec3 side(-ahead.z(), 0, ahead.x()), up = Vec3::UnitY();
        const auto corner = [&](double along, double y, double aside) -> Vec3 {
            return along * ahead + y * up + aside * side;
        };
        floor(0);
        // `lean`: how far the wall's foot stands out.
        polygon({corner(-lean, 0, -9), corner(-lean, 0, 9), corner(0, height, 9), corner(0, height, -9)},
                of_wall);
        polygon({corner(0, height, -9), corner(0, height, 9), corner(depth, height, 9),
                 corner(depth, height, -9)},
                of_top);
        polygon(
            {corner(depth, height, -9), corner(depth, height, 9), corner(depth, 0, 9), corner(depth, 0, -9)});
        ready();
    }
};

PlayerInput towards(const Vec3& way, std::initializer_list<Button> buttons = {}) {
    PlayerInput input{.wish = {way.x(), way.z()}};
    for (const Button button : buttons)
        input.buttons.set(button);
    return input;
}

MovementSettings climber() {
    MovementSettings s = basic_settings();
    s.ledge_grab = true;
    return s;
}

// Falls beside the wall from well above the edge, but below it with its feet, with the stick at it.
PlayerState falls_at(const Block& lab, const MovementSettings& s, double height, double gap, double dt,
                     int ticks = 600) {
    PlayerState state = at(-lab.ahead * (s.radii.x() + gap) + Vec3(0, height - s.ledge_hands + 0.25, 0));
    for (int k = 0; k < ticks && !state.hanging && !state.grounded; ++k)
        state = step(lab.scene(), s, state, towards(0.05 * lab.ahead), dt).state;
    return state;
}

}  // namespace

// Below an edge whose wall leans out, the wall stops the body before the hands are down; it hangs on there.
TEST(Ledge, HoldsOnWhereTheWallLeans) {
    Random random(125);
    for (int i = 0; i < 40; ++i) {
        MovementSettings s = climber();
        s.ledge_reach = 0.4;
        s.ledge_climb = LedgeClimb::jump;
        const double dt = 1.0 / std::array{30, 60, 144, 240}[static_cast<std::size_t>(random.below(4))];
        const Block lab(5, random.between(0, 2 * pi), 40, random.between(0, 1.3));
        PlayerState state = at(-lab.ahead * (s.radii.x() + 0.05) + Vec3(0, 5.3, 0));
        int grabs = 0;
        for (int k = 0; k < static_cast<int>(2 / dt); ++k) {
            TraceRecorder trace;
            state = step(lab.scene(), s, state, towards(0.3 * lab.ahead), dt, &trace).state;
            grabs += static_cast<int>(decisions_of(trace, Decision::ledge_grabbed).size());
        }
        EXPECT_EQ(grabs, 1) << "example " << i;
        EXPECT_TRUE(state.hanging) << "example " << i;
        const PlayerInput jumps = towards(lab.ahead, {Button::jump});
        EXPECT_GT(run(lab, s, state, jumps, static_cast<int>(1 / dt), dt).position.y(), 5) << "example " << i;
    }
}

// The hands are at the edge, whatever the rate and the speed.
TEST(Ledge, ThePlayerHangsWithItsHandsAtTheEdge) {
    Random random(121);
    for (int i = 0; i < 200; ++i) {
        MovementSettings s = climber();
        s.gravity = random.between(9, 35);
        s.ledge_hands = random.between(0.2, 1.2);
        s.ledge_time = 100;
        const double height = random.between(3, 8), angle = random.between(0, 2 * pi);
        const Block lab(height, angle);
        const double dt = 1.0 / std::array{30, 60, 144, 240}[static_cast<std::size_t>(random.below(4))];
        const PlayerState state = falls_at(lab, s, height, random.between(0.01, 0.9) * s.ledge_reach, dt);
        ASSERT_TRUE(state.hanging) << "example " << i;
        EXPECT_NEAR(state.position.y() + s.ledge_hands, height, 1e-6) << "example " << i;
        EXPECT_EQ(state.velocity, Vec3(Vec3::Zero()));
        EXPECT_NEAR((state.ground_normal + lab.ahead).norm(), 0, 1e-6);
        EXPECT_NEAR(state.ground_rise, s.ledge_hands + s.radii.y(), 1e-6);
        EXPECT_EQ(state, run(lab, s, state, {}, 30, dt));
    }
}

// After the climb's time the player stands on the ledge, and not before.
TEST(Ledge, TheClimbTakesItsTime) {
    Random random(122);
    for (int i = 0; i < 200; ++i) {
        MovementSettings s = climber();
        s.ledge_time = random.between(0.1, 1.5);
        const double height = random.between(3, 8);
        const Block lab(height, random.between(0, 2 * pi));
        const double dt = 1.0 / std::array{30, 60, 144, 240}[static_cast<std::size_t>(random.below(4))];
        PlayerState state = falls_at(lab, s, height, 0.5 * s.ledge_reach, dt);
        ASSERT_TRUE(state.hanging);
        int ticks = 0;
        for (; ticks < 1000 && !state.grounded; ++ticks)
            state = step(lab.scene(), s, state, ticks == 0 ? towards(lab.ahead) : PlayerInput{}, dt).state;
        EXPECT_EQ(ticks, static_cast<int>(std::ceil(s.ledge_time / dt - 1e-6))) << "example " << i;
        EXPECT_NEAR(state.position.y(), height + s.radii.y() + s.skin, 2 * s.skin);
        EXPECT_GT(state.position.dot(lab.ahead), 0);
        EXPECT_FALSE(state.hanging);
    }
}

// From the ground a jump of v*v/(2g) reaches edges up to that and the reach of the hands.
TEST(Ledge, AJumpReachesTheEdgeOrNot) {
    Random random(123);
    for (int i = 0; i < 60; ++i) {
        MovementSettings s = climber();
        s.ledge_hands = random.between(0.3, 1.0);
        s.jump_speed = random.between(6, 10);
        const double dt = 1.0 / std::array{30, 60, 144, 240}[static_cast<std::size_t>(random.below(4))];
        const double reach = s.jump_speed * s.jump_speed / (2 * s.gravity) + s.radii.y() + s.ledge_hands;
        const bool possible = random.below(2) == 0;
        const double height = reach + (possible ? -random.between(0.02, 0.3) : random.between(0.02, 0.3));
        const Block lab(height, random.between(0, 2 * pi), 40);
        PlayerState state =
            run(lab, s, at(-lab.ahead * (s.radii.x() + 0.05) + Vec3(0, s.radii.y() + 0.01, 0)), {}, 20, dt);
        for (int k = 0; k < static_cast<int>(3 / dt); ++k)
            state = step(lab.scene(), s, state, towards(lab.ahead, {Button::jump}), dt).state;
        EXPECT_EQ(state.position.y() > height, possible)
            << "example " << i << ": " << height << " of " << reach;
    }
}

TEST(Ledge, IsLeftByAJumpByDropAndByTheStick) {
    MovementSettings s = climber();
    const Block lab(5, 0.7);
    const PlayerState hanging = falls_at(lab, s, 5, 0.05, tick);
    ASSERT_TRUE(hanging.hanging);
    PlayerState state = step(lab.scene(), s, hanging, towards(Vec3::Zero(), {Button::jump}), tick).state;
    EXPECT_FALSE(state.hanging);
    EXPECT_NEAR(state.velocity.y(), s.jump_speed - s.gravity * tick, 1e-9);
    for (const PlayerInput& input : {towards(lab.ahead, {Button::drop}), towards(-lab.ahead)}) {
        state = run(lab, s, hanging, input, 10);
        EXPECT_FALSE(state.hanging);
        EXPECT_LT(state.velocity.y(), -1);
    }
    s.ledge_climb = LedgeClimb::jump;
    state = run(lab, s, hanging, towards(lab.ahead), 60);
    EXPECT_TRUE(state.hanging);
    state = run(lab, s, state, towards(lab.ahead, {Button::jump}), 60);
    EXPECT_TRUE(state.grounded);
    EXPECT_GT(state.position.y(), 5);
}

TEST(Ledge, TheGrabButtonHoldsWhereTheSettingsAskForIt) {
    MovementSettings s = climber();
    s.ledge_form = LedgeForm::button;
    s.ledge_climb = LedgeClimb::jump;
    const Block lab(5, 2.1);
    PlayerState state = at(-lab.ahead * (s.radii.x() + 0.05) + Vec3(0, 5, 0));
    const PlayerState past = run(lab, s, state, towards(0.1 * lab.ahead), 60);
    EXPECT_FALSE(past.hanging);
    state = run(lab, s, state, towards(0.1 * lab.ahead, {Button::grab}), 60);
    EXPECT_TRUE(state.hanging);
    state = run(lab, s, state, towards(Vec3::Zero()), 5);
    EXPECT_FALSE(state.hanging);
}

// A wall that leans back, a type that forbids it, a top too narrow to be met, and no room above.
TEST(Ledge, WhatIsNotGrabbedIsSaid) {
    Random random(124);
    const auto fallen = [](const Block& lab, const MovementSettings& s, Decision why) {
        PlayerState state = at(-lab.ahead * (s.radii.x() + 0.05) + Vec3(0, 5, 0));
        bool said = false;
        for (int k = 0; k < 120 && !state.hanging; ++k) {
            TraceRecorder trace;
            state = step(lab.scene(), s, state, towards(0.3 * lab.ahead), tick, &trace).state;
            said = said || !decisions_of(trace, why).empty();
        }
        return said && !state.hanging;
    };
    MovementSettings s = climber();
    s.ledge_reach = 0.4;
    for (int i = 0; i < 10; ++i) {
        const double angle = random.between(0, 2 * pi);
        EXPECT_TRUE(fallen(Block(5, angle, 4, 0, smooth), s, Decision::ledge_forbidden));
        EXPECT_TRUE(fallen(Block(5, angle, 4, 0, plain, smooth), s, Decision::ledge_forbidden));
        // 5 high and 1.34 deep: 75 degrees.
        MovementSettings steep = s;
        EXPECT_FALSE(fallen(Block(5, angle, 4, 1.34), steep, Decision::ledge_not_steep));
        steep.ledge_wall = radians(80);
        EXPECT_TRUE(fallen(Block(5, angle, 4, 1.34), steep, Decision::ledge_not_steep));
        MovementSettings off = s;
        off.ledge_grab = false;
        EXPECT_TRUE(fallen(Block(5, angle), off, Decision::ledge_grab_off));
    }
}

TEST(Ledge, DoesNotClimbWhereThereIsNoRoom) {
    MovementSettings s = climber();
    Lab lab;
    lab.floor();
    lab.polygon({{0, 0, -9}, {0, 0, 9}, {0, 5, 9}, {0, 5, -9}});
    lab.polygon({{0, 5, -9}, {0, 5, 9}, {4, 5, 9}, {4, 5, -9}});
    // A ceiling 1 m above the ledge.
    lab.polygon({{0.1, 6, -9}, {4, 6, -9}, {4, 6, 9}, {0.1, 6, 9}});
    lab.polygon({{0.1, 6, -9}, {0.1, 6, 9}, {0.1, 12, 9}, {0.1, 12, -9}});
    lab.ready();
    PlayerState state = at({-s.radii.x() - 0.02, 4.6, 0});
    bool said = false;
    for (int k = 0; k < 60; ++k) {
        TraceRecorder trace;
        state = step(lab.scene(), s, state, wish(1, 0), tick, &trace).state;
        said = said || !decisions_of(trace, Decision::ledge_no_room).empty();
    }
    EXPECT_TRUE(state.hanging);
    EXPECT_TRUE(said);
}

// A ledge that moves carries the player that hangs from it.
TEST(Ledge, CarriesWhoHangsFromIt) {
    Lab lab;
    lab.floor(-20);
    lab.ready();
    Lab block;
    block.polygon({{0, 0, -3}, {0, 0, 3}, {0, 5, 3}, {0, 5, -3}});
    block.polygon({{0, 5, -3}, {0, 5, 3}, {4, 5, 3}, {4, 5, -3}});
    block.ready();
    MovementSettings s = climber();
    s.ledge_time = 100;
    PlayerState state = at({-s.radii.x() - 0.05, 4.6, 0});
    const Vec3 speed(0, 0.5, 1);
    std::vector<MovingPart> parts(1);
    parts[0].rest = &block.world();
    parts[0].velocity = speed;
    for (int k = 0; k < 90; ++k) {
        parts[0].begin.offset = speed * (k * tick);
        parts[0].end.offset = speed * ((k + 1) * tick);
        MovementScene scene = lab.scene();
        scene.platforms = parts;
        state = step(scene, s, state, wish(state.hanging ? 0.0 : 0.2, 0), tick).state;
    }
    ASSERT_TRUE(state.hanging);
    EXPECT_NEAR(state.position.y() + s.ledge_hands, 5 + 0.5 * 90 * tick, 1e-6);
    EXPECT_EQ(state.carrier, Carrier::platform);
}

}  // namespace slipface::test
