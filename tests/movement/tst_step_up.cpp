// Walls that go on above a step: an attempt to step up is spared where it cannot lead further.
#include <algorithm>

#include "test_geometry.h"

namespace slipface::test {
namespace {

// Random boxes on a floor: kerbs, walls, walls that lean, lintels to walk under.
class Blocks {
  public:
    explicit Blocks(std::uint64_t seed) : random_(seed) {}

    // `strip`: the height of the strips that vertical walls are cut into, metres. Floats would bend others.
    void build(Lab& lab, double strip) {
        lab.floor();
        for (const double side : {-12.0, 12.0}) {
            lab.wall({side, -12}, {side, 12});
            lab.wall({-12, side}, {12, side});
        }
        for (int i = 0; i < 70; ++i)
            block(lab, strip);
        lab.ready();
    }

  private:
    void block(Lab& lab, double strip) {
        const Vec3 middle(random_.between(-12, 12), 0.0, random_.between(-12, 12));
        const double turn = random_.below(2) == 0 ? 0.0 : random_.between(0, pi);
        const Vec3 along(std::cos(turn), 0.0, std::sin(turn)), across(-along.z(), 0.0, along.x());
        const double length = random_.between(0.1, 2.5), width = random_.between(0.1, 1.0);
        const int kind = random_.below(5);
        const double low = kind == 0 ? random_.between(0.2, 2.2) : 0.0;
        const double high = kind == 1 ? random_.between(0.05, 0.6) : low + random_.between(0.5, 4.0);
        const double lean = kind == 2 ? random_.between(-0.3, 0.3) : 0.0;  // metres outwards per metre up
        std::array<Vec3, 4> foot;
        for (std::size_t k = 0; k < 4; ++k)
            foot[k] = along * (k == 0 || k == 3 ? -length : length) + across * (k < 2 ? -width : width);
        const auto corner = [&](std::size_t k, double height) {
            return Vec3(middle + foot[k % 4] * (1.0 + lean * (height - low)) + Vec3(0.0, height, 0.0));
        };
        // Strip by strip, so that no wall's next strip has the next numbers.
        for (double from = low, to = 0.0; from < high; from = to) {
            to = lean == 0.0 ? std::min(from + strip, high) : high;
            for (std::size_t k = 0; k < 4; ++k)
                lab.polygon({corner(k + 1, from), corner(k, from), corner(k, to), corner(k + 1, to)});
        }
        lab.polygon({corner(3, high), corner(2, high), corner(1, high), corner(0, high)});
        lab.polygon({corner(0, low), corner(1, low), corner(2, low), corner(3, low)});
    }

    Random random_;
};

// Walls in strips lower than a step never go on above in the triangle that was touched, so there every
// attempt is made.
TEST(StepUp, WhatIsSparedWouldHaveLedNoFurther) {
    int spared = 0, climbed = 0, differing = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        Lab whole, strips;
        Blocks(seed).build(whole, 1e3);
        Blocks(seed).build(strips, 0.3);
        Random random(seed + 100);
        for (int walker = 0; walker < 40; ++walker) {
            MovementSettings s = every_hack();
            s.air_jump = s.wall_slide = s.wall_jump = false;  // in the air there are no steps
            s.walk_speed = random.between(1, 20);
            const double dt = 1.0 / (30 + 90 * random.below(4));
            PlayerState state = at({random.between(-10, 10), 0.95, random.between(-10, 10)});
            if (overlaps_any(whole.world(), s.radii, state.position)) continue;
            double heading = random.between(0, 2 * pi);
            for (int i = 0; i < 150; ++i) {
                if (random.below(20) == 0) heading = random.between(0, 2 * pi);
                const PlayerInput input = wish(std::cos(heading), std::sin(heading), random.below(60) == 0);
                TraceRecorder trace;
                const StepResult every = step(strips.scene(), s, state, input, dt, &trace);
                const StepResult result = step(whole.scene(), s, state, input, dt);
                TraceRecorder reasons;
                ASSERT_TRUE(step(whole.scene(), s, state, input, dt, &reasons).state == result.state);
                spared += result.sweeps < every.sweeps ? 1 : 0;
                climbed += has_decision(trace, "step_up", true, "Stepped up") ? 1 : 0;
                if ((result.state.position - every.state.position).norm() > 1e-6) {
                    // The lifted move slid along a lintel and led around the wall, but up to nothing.
                    ++differing;
                    EXPECT_NEAR(result.state.position.y(), every.state.position.y(), s.skin)
                        << seed << ", walker " << walker << ", step " << i;
                }
                state = result.state;
            }
        }
    }
    EXPECT_GT(spared, 2500);
    EXPECT_GT(climbed, 300);
    EXPECT_LT(differing * 500, spared);
}

TEST(StepUp, IsNotTriedAtWallsThatGoOnAbove) {
    MovementSettings s = every_hack();
    MovementSettings off = s;
    off.step_up = false;
    Random random(5);
    int spared = 0, tried = 0;
    for (int i = 0; i < 400; ++i) {
        Lab lab;
        lab.floor();
        // Touched 0.9 m above the floor. The wall ends above the lifted point or below it.
        const bool tall = i % 2 == 0;
        const double height = tall ? random.between(2.5, 9) : random.between(0.95, 1.2);
        const double turn = random.between(0, 2 * pi);
        const Vec2 along(std::cos(turn), std::sin(turn)), out(-along.y(), along.x());
        lab.wall(20 * along, -60 * along, -height, height);
        lab.ready();
        const Vec2 from = out * random.between(0.42, 0.48);
        PlayerState state = run(lab, s, at({from.x(), 0.902, from.y()}), {}, 3);
        const Vec2 to = along * random.between(-0.6, 0.6) - out * random.between(0.5, 0.8);
        state = run(lab, s, state, wish(to.x(), to.y()), 4);
        const StepResult on = step(lab.scene(), s, state, wish(to.x(), to.y()), tick);
        const StepResult plain_move = step(lab.scene(), off, state, wish(to.x(), to.y()), tick);
        ASSERT_GT(plain_move.contacts, 1) << i;
        EXPECT_TRUE(!tall || on.state == plain_move.state) << i;
        spared += tall && on.sweeps == plain_move.sweeps ? 1 : 0;
        tried += !tall && on.sweeps > plain_move.sweeps ? 1 : 0;
    }
    EXPECT_EQ(spared, 200);
    EXPECT_EQ(tried, 200);
}

}  // namespace
}  // namespace slipface::test
