// Sliding down walls and jumping off them, against closed forms.
#include <algorithm>

#include "test_geometry.h"

namespace slipface::test {

namespace {

// Two walls that face each other along a horizontal direction, and leave the body `way` metres between them.
struct Shaft : Lab {
    Vec3 ahead;  // from the first wall to the second, unit
    double half;

    Shaft(const MovementSettings& s, double way, double angle)
        : ahead(std::cos(angle), 0, std::sin(angle)), half(0.5 * way + s.radii.x() + s.skin) {
        const Vec3 side(-ahead.z(), 0, ahead.x());
        const auto wall_at = [&](const Vec3& middle, double turn) {
            const Vec3 a = middle + 20 * turn * side, b = middle - 20 * turn * side;
            wall({a.x(), a.z()}, {b.x(), b.z()}, -50, 250);
        };
        wall_at(half * ahead, 1);
        wall_at(-half * ahead, -1);
        ready();
    }
    // A skin off the first wall.
    Vec3 at_first(const MovementSettings& s) const { return ahead * (s.radii.x() + s.skin - half); }
};

MovementSettings jumper() {
    MovementSettings s = basic_settings();
    s.wall_jump = true;
    s.coyote = s.jump_buffer = false;
    s.terminal_speed = 500;
    return s;
}

PlayerInput stick(const Vec3& direction, bool jump = false) {
    return wish(direction.x(), direction.z(), jump);
}

}  // namespace

// A jump off one wall meets the other after w/a seconds, at the end of a tick, and gains u t - g t*t/2.
TEST(WallJump, AChainGainsTheClosedForm) {
    Random random(91);
    for (int i = 0; i < 200; ++i) {
        MovementSettings s = jumper();
        s.gravity = random.between(9, 35);
        s.wall_jump_up = random.between(4, 14);
        s.wall_jump_lock = 1.0;
        const double way = random.between(0.3, 4),
                     dt = 1.0 / std::array{30, 60, 144, 240}[static_cast<std::size_t>(random.below(4))];
        // The lock holds all the way.
        s.wall_jump_away = random.between(std::max(3.0, way / 0.95), 12);
        const Shaft lab(s, way, random.between(0, 2 * pi));
        PlayerState state = at(lab.at_first(s), {0, -1, 0});
        // The stick points back into the wall that is left: the lock ignores it.
        for (int jump = 0; jump < 6; ++jump) {
            const Vec3 away = jump % 2 == 0 ? lab.ahead : Vec3(-lab.ahead);
            const Vec3 begin = state.position;
            TraceRecorder trace;
            state = step(lab.scene(), s, state, stick(-away, true), dt, &trace).state;
            ASSERT_EQ(decisions_of(trace, Decision::wall_jumped).size(), 1U)
                << "example " << i << ", jump " << jump;
            int ticks = 1;
            for (; (state.position - begin).dot(away) < way - 1e-5 && ticks < 1000; ++ticks)
                state = step(lab.scene(), s, state, stick(-away), dt).state;
            const double t = ticks * dt, u = s.wall_jump_up;
            EXPECT_NEAR(t, way / s.wall_jump_away + 0.5 * dt, 0.5 * dt + 1e-5) << "example " << i;
            EXPECT_NEAR(state.position.y() - begin.y(), u * t - s.gravity * t * t / 2, 1e-9)
                << "example " << i;
        }
    }
}

TEST(WallJump, KeepsWhatThePlayerHasAlongTheWall) {
    Random random(92);
    const MovementSettings s = jumper();
    for (int i = 0; i < 100; ++i) {
        const Shaft lab(s, 6, random.between(0, 2 * pi));
        const Vec3 along(-lab.ahead.z(), 0, lab.ahead.x());
        const double speed = random.between(-9, 9);
        const PlayerState begin =
            at(lab.at_first(s), along * speed - lab.ahead + Vec3(0, random.between(-9, 5), 0));
        const PlayerState end = step(lab.scene(), s, begin, stick(along, true), tick).state;
        EXPECT_NEAR(end.velocity.dot(along), speed, 1e-6);
        EXPECT_NEAR(end.velocity.dot(lab.ahead), s.wall_jump_away, 1e-6);
        EXPECT_NEAR(end.velocity.y(), s.wall_jump_up - s.gravity * tick, 1e-9);
    }
}

TEST(WallJump, OffOrOutOfReachNothingIsJumpedFrom) {
    MovementSettings s = jumper();
    const Shaft lab(s, 6, 0.3);
    for (const double reach : {0.05, 0.3, 0.8}) {
        s.wall_jump_reach = reach;
        for (const double part : {0.9, 1.1}) {
            const PlayerState begin = at(lab.at_first(s) + lab.ahead * (part * reach - s.skin), {0, -2, 0});
            TraceRecorder trace;
            const PlayerState end =
                step(lab.scene(), s, begin, stick(Vec3::Zero(), true), tick, &trace).state;
            EXPECT_EQ(end.velocity.y() > 0, part < 1) << reach;
            EXPECT_EQ(decisions_of(trace, Decision::wall_jump_no_wall).size(), part < 1 ? 0U : 1U);
        }
    }
    s.wall_jump = false;
    const PlayerState touching = run(lab, s, at(lab.at_first(s), {0, -1, 0}), stick(-lab.ahead), 3);
    TraceRecorder trace;
    const PlayerState end = step(lab.scene(), s, touching, stick(-lab.ahead, true), tick, &trace).state;
    EXPECT_LT(end.velocity.y(), 0);
    EXPECT_TRUE(has_decision(trace, "wall_jump", false, "Wall jump is off"));
}

// Of one wall alone, and of two that face alike, only one jump; the opposite wall counts as another.
TEST(WallJump, OneWallIsNotClimbedWhereAnotherIsAsked) {
    for (const WallJumpWalls walls : {WallJumpWalls::another, WallJumpWalls::any}) {
        MovementSettings s = jumper();
        s.wall_jump_walls = walls;
        s.wall_jump_lock = 0;
        const Shaft lab(s, 3, 1.1);
        PlayerState state = at(lab.at_first(s), {0, -1, 0});
        double highest = 0;
        int jumps = 0;
        for (int i = 0; i < 240; ++i) {
            const bool press = i % 2 == 0 && state.velocity.y() < 0;
            TraceRecorder trace;
            state = step(lab.scene(), s, state, stick(-lab.ahead, press), tick, &trace).state;
            jumps += static_cast<int>(decisions_of(trace, Decision::wall_jumped).size());
            highest = std::max(highest, state.position.y());
        }
        if (walls == WallJumpWalls::another) {
            EXPECT_EQ(jumps, 1);
            EXPECT_LE(highest, s.wall_jump_up * s.wall_jump_up / (2 * s.gravity) + 1e-9);
        } else {
            EXPECT_GT(jumps, 3);
        }
        EXPECT_EQ(state.wall_x != 0 || state.wall_z != 0, true);
    }
}

TEST(WallJump, ABufferedPressStartsAtTheWall) {
    MovementSettings s = jumper();
    s.jump_buffer = true;
    s.wall_jump_reach = 0.01;
    const Shaft lab(s, 3, 0.7);
    PlayerState state = at(lab.at_first(s) + lab.ahead * 0.25, -6 * lab.ahead);
    int jumped = -1;
    for (int i = 0; i < 10 && jumped < 0; ++i) {
        TraceRecorder trace;
        state = step(lab.scene(), s, state, stick(-lab.ahead, i == 0), tick, &trace).state;
        if (!decisions_of(trace, Decision::wall_jumped).empty()) jumped = i;
    }
    EXPECT_GE(jumped, 3);
    EXPECT_LE(jumped, 5);
}

TEST(WallSlide, FallsAtItsSpeedWhateverTheWallAndTheRate) {
    Random random(93);
    for (int i = 0; i < 200; ++i) {
        MovementSettings s = basic_settings();
        s.wall_slide = true;
        s.wall_slide_speed = random.between(0, 6);
        const bool pushes = random.below(2) == 0;
        s.wall_slide_form = pushes ? WallSlideForm::pushing : WallSlideForm::touching;
        const int rate = std::array{30, 60, 144, 240}[static_cast<std::size_t>(random.below(4))];
        const Shaft lab(s, 4, random.between(0, 2 * pi));
        const Vec3 along(-lab.ahead.z(), 0, lab.ahead.x());
        const double aside = radians(random.between(-55, 55));
        const Vec3 push =
            pushes ? Vec3(-std::cos(aside) * lab.ahead + std::sin(aside) * along) : Vec3(Vec3::Zero());
        PlayerState state = run(lab, s, at(lab.at_first(s), {0, -1, 0}), stick(push), rate, 1.0 / rate);
        const double height = state.position.y();
        state = run(lab, s, state, stick(push), rate, 1.0 / rate);
        EXPECT_NEAR(height - state.position.y(), s.wall_slide_speed, 1e-9) << "example " << i;
        EXPECT_FALSE(state.grounded);
    }
}

TEST(WallSlide, IsRefusedWithTheStickAsideAndToldWhenOff) {
    MovementSettings s = basic_settings();
    s.wall_slide = true;
    const Shaft lab(s, 4, 2.1);
    const PlayerState touching = run(lab, s, at(lab.at_first(s), {0, -4, 0}), stick(-lab.ahead), 3);
    EXPECT_NEAR(touching.velocity.y(), -s.wall_slide_speed, 1e-6);
    TraceRecorder aside, off;
    EXPECT_LT(step(lab.scene(), s, touching, stick(lab.ahead), tick, &aside).state.velocity.y(),
              -s.wall_slide_speed);
    EXPECT_EQ(decisions_of(aside, Decision::wall_slide_not_pushed).size(), 1U);
    s.wall_slide = false;
    EXPECT_LT(step(lab.scene(), s, touching, stick(-lab.ahead), tick, &off).state.velocity.y(),
              -s.wall_slide_speed);
    EXPECT_TRUE(has_decision(off, "wall_slide", false, "Wall slide is off"));
}

// A wall that moves up is a belt for the player beside it: slide and jump are relative to it.
TEST(WallSlide, AndWallJumpAreRelativeToTheWall) {
    Random random(94);
    for (int i = 0; i < 50; ++i) {
        MovementSettings s = jumper();
        s.wall_slide = true;
        Lab lab;
        const Vec3 belt(0, random.between(-3, 3), random.between(-3, 3));
        lab.surfaces[conveyor].velocity = belt;
        lab.wall({-1, -40}, {-1, 40}, -50, 150, conveyor);
        lab.ready();
        const PlayerState begin = at({s.radii.x() + s.skin - 1, 0, 0}, {0, belt.y() - 4, belt.z()});
        PlayerState state = run(lab, s, begin, wish(-1, 0), 10);
        EXPECT_NEAR(state.velocity.y(), belt.y() - s.wall_slide_speed, 1e-6);
        state = step(lab.scene(), s, state, wish(-1, 0, true), tick).state;
        EXPECT_NEAR(state.velocity.y(), belt.y() + s.wall_jump_up - s.gravity * tick, 1e-9);
        EXPECT_NEAR(state.velocity.x(), s.wall_jump_away, 1e-9);
        EXPECT_NEAR((state.air_frame - belt).norm(), 0, 1e-9);
    }
}

}  // namespace slipface::test
