// Push-out held against the exact answer, and jump windows counted in ticks.
#include <algorithm>

#include "test_geometry.h"

namespace slipface::test {
namespace {

// A wedge of two walls with the given angle between them, its edge along Y at the origin, open towards +Z.
Lab wedge(double angle) {
    Lab lab;
    const double half = 0.5 * angle;
    const Vec2 left(-30 * std::sin(half), 30 * std::cos(half)),
        right(30 * std::sin(half), 30 * std::cos(half));
    lab.wall({0, 0}, left, -20, 20);
    lab.wall({0, 0}, right, -20, 20);
    lab.ready();
    return lab;
}

// Where push-out puts a centre that began at `from` between the walls. Projection on the cone of the planes
// that count: a centre that is out of either alone, or else on the line of both, where the ellipsoid with rx
// = rz = r is a skin off both at (r + skin) / sin(half) in front of the edge. A plane counts if it is
// overlapped at first, or becomes so on the way out of the other; one that then is less than a skin away does
// not, because push-out looks at overlaps, and a skin is what the next move restores.
Vec3 exact_answer(const MovementSettings& s, double angle, const Vec3& from) {
    const double half = 0.5 * angle, need = s.radii.x() + s.skin;
    const Vec3 n[2] = {{std::cos(half), 0, std::sin(half)}, {-std::cos(half), 0, std::sin(half)}};
    const auto overlaps = [&](const Vec3& m, const Vec3& p) { return m.dot(p) < s.radii.x(); };
    for (int k = 0; k < 2; ++k) {
        const Vec3 out = from + n[k] * (need - n[k].dot(from));
        const bool other_counts = overlaps(n[1 - k], from) || overlaps(n[1 - k], out);
        const double other_needs = other_counts ? need : 0.0;
        if (overlaps(n[k], from) && n[1 - k].dot(out) >= other_needs) return out;
    }
    return {0, from.y(), need / std::sin(half)};
}

TEST(PushOut, IsTheProjectionOnTheConeInWedgesOf5To85Degrees) {
    Random random(7);
    MovementSettings s = basic_settings();
    s.gravity = 0.0;
    s.push_out = PushOut::analytic;
    for (int degrees = 5; degrees <= 85; degrees += 5) {
        const double angle = radians(degrees), half = 0.5 * angle;
        const Lab lab = wedge(angle);
        for (int i = 0; i < 60; ++i) {
            // Between the walls, inside both.
            const double along = random.between(0.3, 0.9) * (s.radii.x() / std::sin(half));
            const double aside = random.between(-0.8, 0.8) * along * std::tan(half);
            const Vec3 from(aside, random.between(-3, 3), along);
            Lab& mutable_lab = const_cast<Lab&>(lab);
            ASSERT_TRUE(overlaps_any(mutable_lab.world(), s.radii, from));
            const Vec3 to = step(lab.scene(), s, at(from), {}, tick).state.position;
            EXPECT_FALSE(overlaps_any(mutable_lab.world(), s.radii, to)) << degrees;
            EXPECT_LT((to - exact_answer(s, angle, from)).norm(), 1e-6) << degrees << " degrees";
        }
    }
}

TEST(PushOut, IteratesOutOfTheSameWedges) {
    Random random(8);
    MovementSettings s = basic_settings();
    s.gravity = 0.0;
    s.push_out = PushOut::iterative;
    for (int degrees = 5; degrees <= 85; degrees += 5) {
        const double half = 0.5 * radians(degrees);
        Lab lab = wedge(radians(degrees));
        for (int i = 0; i < 20; ++i) {
            const double along = random.between(0.3, 0.9) * (s.radii.x() / std::sin(half));
            const Vec3 from(random.between(-0.8, 0.8) * along * std::tan(half), 0, along);
            const Vec3 to = step(lab.scene(), s, at(from), {}, tick).state.position;
            EXPECT_FALSE(overlaps_any(lab.world(), s.radii, to)) << degrees;
        }
    }
}

TEST(PushOut, OffLeavesThePlayerInside) {
    MovementSettings s = basic_settings();
    s.gravity = 0.0;
    Lab lab = wedge(radians(20));
    const Vec3 from(0, 0, 1.0);
    const Vec3 to = step(lab.scene(), s, at(from), {}, tick).state.position;
    EXPECT_TRUE(overlaps_any(lab.world(), s.radii, to));
}

TEST(PushOut, ThreePlanesAreLeftAtTheirPoint) {
    // A corner of three perpendicular faces: the point is need away from each, exactly (r + skin) for each
    // axis.
    MovementSettings s = basic_settings();
    s.gravity = 0.0;
    s.push_out = PushOut::analytic;
    Lab lab;
    lab.floor(0.0);
    lab.wall({0, -50}, {0, 50});
    lab.wall({-50, 0}, {50, 0});
    lab.ready();
    const Vec3 to = step(lab.scene(), s, at({0.1, 0.3, 0.2}), {}, tick).state.position;
    EXPECT_LT((to - (s.radii + Vec3::Constant(s.skin))).norm(), 1e-9);
}

// Ticks after `event` in which a press of jump still leads to a jump.
int window(MovementSettings s, double dt, bool late) {
    Lab lab;
    lab.polygon({{-50, 0, -5}, {-50, 0, 5}, {0, 0, 5}, {0, 0, -5}});
    lab.floor(late ? -100.0 : -1.5, plain, 200);
    lab.ready();
    int works = 0;
    for (int delay = 0; delay < 40; ++delay) {
        PlayerState state = at({late ? -2.0 : 30.0, late ? 0.9 + s.skin : 3.0, 0.0});
        state = run(lab, s, state, {}, late ? 5 : 1, dt);
        bool jumped = false;
        if (late) {
            while (state.grounded)
                state = step(lab.scene(), s, state, wish(1, 0), dt).state;
            for (int i = 0; i < delay; ++i)
                state = step(lab.scene(), s, state, wish(1, 0), dt).state;
            state = step(lab.scene(), s, state, wish(1, 0, true), dt).state;
            jumped = state.velocity.y() > 1.0;
        } else {
            // When does it land without a press?
            PlayerState probe = state;
            int landing = 0;
            while (!probe.grounded) {
                probe = step(lab.scene(), s, probe, {}, dt).state;
                ++landing;
            }
            // Pressed so that `delay` ticks lie between the press and the first tick that begins on the
            // ground.
            for (int i = 0; i < landing + 3; ++i) {
                state = step(lab.scene(), s, state, wish(0, 0, i == landing - 1 - delay), dt).state;
                jumped = jumped || state.velocity.y() > 1.0;
            }
        }
        works += jumped ? 1 : 0;
    }
    return works;
}

TEST(JumpFeel, WindowsAreExactToTheTick) {
    // 0.1 s is 6 ticks at 60 Hz, 12 at 120 and 3 at 30.
    for (const int rate : {30, 60, 120}) {
        MovementSettings s = basic_settings();
        EXPECT_EQ(window(s, 1.0 / rate, true), 0);
        s.coyote = true;
        EXPECT_EQ(window(s, 1.0 / rate, true), rate / 10) << rate;
        MovementSettings b = basic_settings();
        EXPECT_EQ(window(b, 1.0 / rate, false), 0);
        b.jump_buffer = true;
        EXPECT_EQ(window(b, 1.0 / rate, false), rate / 10) << rate;
    }
}

TEST(JumpFeel, ACutJumpHasTheHeightOfItsSpeed) {
    // Let go after 5 ticks: the speed is then 8 - 20 * 5 / 60 = 6.333, cut to 0.4 of that, 2.533, which rises
    // by 2.533 * 2.533 / 40 = 0.160 m more on top of 5 ticks of 8 t - 10 t t = 0.597 m.
    MovementSettings s = basic_settings();
    s.variable_jump = true;
    Lab lab;
    lab.floor();
    lab.ready();
    PlayerState state = run(lab, s, at({0, 0.9 + s.skin, 0}), {}, 10);
    const double ground = state.position.y();
    state = run(lab, s, state, wish(0, 0, true), 5);
    double top = 0.0;
    for (int i = 0; i < 60; ++i) {
        state = step(lab.scene(), s, state, {}, tick).state;
        top = std::max(top, state.position.y() - ground);
    }
    // The top lies within a tick: at most g dt dt / 8 = 0.7 mm above the highest sample.
    EXPECT_NEAR(top, 0.597 + 0.160, 0.002);
}

TEST(Nudge, FreesWithinItsDistanceAndSaysSoWhereItCannot) {
    MovementSettings s = basic_settings();
    s.gravity = 0.0;
    s.nudge = true;
    Lab lab;
    lab.wall({0, -50}, {0, 50});
    lab.ready();
    // 0.35 m in front of a wall with a radius of 0.4: 0.05 m inside.
    const PlayerState freed = step(lab.scene(), s, at({0.35, 5, 0}), {}, tick).state;
    EXPECT_FALSE(freed.trapped);
    EXPECT_FALSE(overlaps_any(lab.world(), s.radii, freed.position));
    EXPECT_LE((freed.position - Vec3(0.35, 5, 0)).norm(), s.nudge_distance + 1e-12);
    // 0.25 m inside is more than 0.1 m of nudging.
    TraceRecorder trace;
    const PlayerState trapped = step(lab.scene(), s, at({0.15, 5, 0}), {}, tick, &trace).state;
    EXPECT_TRUE(trapped.trapped);
    EXPECT_TRUE(has_decision(trace, "nudge", false, "Trapped"));
}

// Specks of geometry lie at the player and a metre away in all directions but one; the next ring, at two
// metres, is free.
TEST(Nudge, TriesEachOfItsDirections) {
    MovementSettings s = basic_settings();
    s.gravity = 0.0;
    s.nudge = true;
    s.nudge_distance = 8.0;
    s.radii = Vec3::Constant(0.3);
    std::vector<Vec3> directions;
    for (int i = 0; i < 27; ++i)
        if (i != 13) directions.push_back(Vec3(i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1).normalized());
    for (const Vec3& free : directions) {
        Lab lab;
        const auto speck = [&](const Vec3& position) {
            lab.polygon({position, position + Vec3(0.01, 0, 0), position + Vec3(0, 0.01, 0)});
        };
        speck({0.11, 0.07, 0.03});
        for (const Vec3& other : directions)
            if (other != free) speck(other);
        lab.ready();
        TraceRecorder trace;
        const PlayerState freed = step(lab.scene(), s, at(Vec3::Zero()), {}, tick, &trace).state;
        EXPECT_LT((freed.position - free).norm(), 1e-9) << free.transpose();
        EXPECT_EQ(decisions_of(trace, Decision::push_out_off).size(), 1u);
        EXPECT_EQ(decisions_of(trace, Decision::nudged).size(), 1u);
    }
}

}  // namespace
}  // namespace slipface::test
