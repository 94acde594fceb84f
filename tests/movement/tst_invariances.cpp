// What must not change a run: the frame rate, the triangulation, the order of triangles, where and how the
// scene lies. And what no run may do: come inside, gain energy.
#include <algorithm>

#include "test_geometry.h"

namespace slipface::test {
namespace {

// A floor, stairs, a ramp, pillars: a yard of 40 m. `place` moves each corner, `order` decides the order of
// faces.
template <class Mapping>
Lab yard(const Mapping& position, bool backwards = false, int cuts = 1) {
    std::vector<std::vector<Vec3>> faces;
    const auto quad = [&](Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
        for (int i = 0; i < cuts; ++i) {
            const double s = static_cast<double>(i) / cuts, t = static_cast<double>(i + 1) / cuts;
            faces.push_back({a + (d - a) * s, b + (c - b) * s, b + (c - b) * t, a + (d - a) * t});
        }
    };
    quad({-20, 0, -20}, {-20, 0, 20}, {20, 0, 20}, {20, 0, -20});
    for (int i = 0; i < 5; ++i) {
        const double z = -4.0 - 0.5 * i, low = 0.25 * i, high = low + 0.25;
        quad({-3, low, z}, {3, low, z}, {3, high, z}, {-3, high, z});
        quad({-3, high, z}, {3, high, z}, {3, high, z - 0.5}, {-3, high, z - 0.5});
    }
    quad({-3, 1.25, -6.5}, {3, 1.25, -6.5}, {3, 0, -10}, {-3, 0, -10});
    for (const Vec2& p : {Vec2(5, 2), Vec2(-6, -1), Vec2(2, 9)}) {
        const std::array<Vec2, 4> c{Vec2(-1, -1), Vec2(-1, 1), Vec2(1, 1), Vec2(1, -1)};
        for (std::size_t i = 0; i < 4; ++i) {
            const Vec2 a = p + c[i], b = p + c[(i + 1) % 4];
            quad({a.x(), 0, a.y()}, {b.x(), 0, b.y()}, {b.x(), 3, b.y()}, {a.x(), 3, a.y()});
        }
    }
    if (backwards) std::reverse(faces.begin(), faces.end());
    Lab lab;
    for (std::vector<Vec3> face : faces) {
        for (Vec3& corner : face)
            corner = position(corner);
        lab.polygon(face);
    }
    lab.ready();
    return lab;
}

// 12 s: straight at the stairs, over them and down the ramp, then past pillars, with jumps.
template <class Deflection>
Vec3 route(const Lab& lab, const MovementSettings& s, const Vec3& start, int rate, const Deflection& turn) {
    PlayerState state = at(start);
    const std::array<Vec2, 6> legs{Vec2(0, -1), Vec2(0, -1), Vec2(1, 0), Vec2(0, 1), Vec2(-1, 0), Vec2(0, 0)};
    for (int i = 0; i < 12 * rate; ++i) {
        const std::size_t leg = static_cast<std::size_t>(i / (2 * rate));
        const bool jump = (i / (rate / 10)) % 25 == 3;
        const Vec2 motion = turn(legs[leg]);
        state =
            step(lab.scene(), s, state, {.wish = motion, .buttons = {Button::jump, jump}}, 1.0 / rate).state;
    }
    return state.position;
}

const auto as_it_is = [](const auto& v) { return v; };
const Vec3 start{0.2, 0.902, 6};

TEST(Invariance, OfTheFrameRateWithSubSteps) {
    // 1/720 s divides 1/30, 1/60, 1/120, 1/240 and 1/360 s, so every rate runs through the same parts.
    const Lab lab = yard(as_it_is);
    MovementSettings s = every_hack();
    s.sub_step = 1.0 / 720;
    const Vec3 reference = route(lab, s, start, 60, as_it_is);
    for (const int rate : {30, 120, 240, 360})
        EXPECT_LT((route(lab, s, start, rate, as_it_is) - reference).norm(), 0.01) << rate;
}

TEST(Invariance, OfTheOrderAndCutOfTriangles) {
    const MovementSettings s = every_hack();
    const Vec3 reference = route(yard(as_it_is), s, start, 60, as_it_is);
    EXPECT_EQ(route(yard(as_it_is, true), s, start, 60, as_it_is), reference);
    for (const int cuts : {2, 3, 7})
        EXPECT_LT((route(yard(as_it_is, false, cuts), s, start, 60, as_it_is) - reference).norm(), 1e-4)
            << cuts;
}

TEST(Invariance, OfRigidMotions) {
    const MovementSettings s = every_hack();
    const Vec3 reference = route(yard(as_it_is), s, start, 60, as_it_is);
    // Mirrored in x: every operation is the same but for signs.
    const auto mirrored = [](const Vec3& v) { return Vec3(-v.x(), v.y(), v.z()); };
    const Vec3 mirror =
        route(yard(mirrored), s, mirrored(start), 60, [](const Vec2& v) { return Vec2(-v.x(), v.y()); });
    EXPECT_LT((mirrored(mirror) - reference).norm(), 1e-4);
    // A quarter turn about y: x to -z, z to x.
    const auto turned = [](const Vec3& v) { return Vec3(v.z(), v.y(), -v.x()); };
    const Vec3 turn =
        route(yard(turned), s, turned(start), 60, [](const Vec2& v) { return Vec2(v.y(), -v.x()); });
    EXPECT_LT((turn - turned(reference)).norm(), 1e-4);
    // Moved by what floats hold exactly.
    const Vec3 offset(1024, 256, -512);
    const Vec3 moved =
        route(yard([&](const Vec3& v) { return Vec3(v + offset); }), s, start + offset, 60, as_it_is);
    EXPECT_LT((moved - offset - reference).norm(), 1e-3);
}

TEST(Invariance, OfATurnAboutYByAnyAngle) {
    // A turned corner, up to 28 m out, is rounded to float by up to 1e-6 m, and so are the places at which
    // steps, rims and pillars turn the player; 12 s make less than a hundred times that of it.
    const MovementSettings s = every_hack();
    const Vec3 reference = route(yard(as_it_is), s, start, 60, as_it_is);
    for (const double degrees : {1.0, 17.0, 30.0, 45.0, 61.3, 100.0, 123.4, 200.0, 271.0, 333.3}) {
        const double c = std::cos(radians(degrees)), sn = std::sin(radians(degrees));
        const auto turned = [&](const Vec3& v) {
            return Vec3(c * v.x() + sn * v.z(), v.y(), c * v.z() - sn * v.x());
        };
        const auto turned_stick = [&](const Vec2& v) {
            return Vec2(c * v.x() + sn * v.y(), c * v.y() - sn * v.x());
        };
        const Vec3 end = route(yard(turned), s, turned(start), 60, turned_stick);
        EXPECT_LT((end - turned(reference)).norm(), 1e-4) << degrees;
    }
}

TEST(NeverInside, WithEveryHackInAHostileYard) {
    // Random triangles, slivers among them, over the yard's floor, and random steps of any length and rate.
    Random random(11);
    Lab lab;
    lab.floor(0.0, plain, 15.0);
    for (int i = 0; i < 160; ++i) {
        const Vec3 at_place(random.between(-12, 12), random.between(0, 4), random.between(-12, 12));
        const double size = random.below(4) == 0 ? 0.05 : 2.5;
        const auto corner = [&] {
            return Vec3(at_place +
                        Vec3(random.between(-size, size), random.between(-1, 1), random.between(-2.5, 2.5)));
        };
        lab.polygon({corner(), corner(), corner()}, static_cast<SurfaceId>(random.below(7)));
    }
    lab.ready();
    MovementSettings s = every_hack();
    int walked = 0;
    for (int walker = 0; walker < 60; ++walker) {
        PlayerState state = at({random.between(-10, 10), random.between(1, 8), random.between(-10, 10)});
        if (overlaps_any(lab.world(), s.radii, state.position)) continue;
        s.sub_step = random.below(4) == 0 ? 1.0 / 240 : 0.0;
        for (int i = 0; i < 300; ++i) {
            const PlayerInput input =
                wish(random.between(-1, 1), random.between(-1, 1), random.below(5) == 0);
            state = step(lab.scene(), s, state, input, random.between(1.0 / 360, 1.0 / 15)).state;
            ASSERT_FALSE(overlaps_any(lab.world(), s.radii, state.position)) << walker << ", step " << i;
            ++walked;
        }
    }
    EXPECT_GT(walked, 5000);
}

TEST(StepUp, ClimbsStairsAtEveryRateAndGainsNothingAlongAWall) {
    // 10 steps of 0.3 m by 0.4 m at 4 m/s: 4 m of way, 1 s at best, 1.5 s allowed.
    for (const int rate : {60, 120, 240, 360}) {
        MovementSettings s = every_hack();
        s.walk_speed = 4.0;
        Lab lab;
        lab.floor();
        for (int i = 0; i < 10; ++i) {
            const double x = 2.0 + 0.4 * i, low = 0.3 * i, high = low + 0.3;
            lab.polygon({{x, low, 3}, {x, low, -3}, {x, high, -3}, {x, high, 3}});
            const double far = i == 9 ? x + 10 : x + 0.4;
            lab.polygon({{x, high, -3}, {x, high, 3}, {far, high, 3}, {far, high, -3}});
        }
        lab.ready();
        PlayerState state = run(lab, s, at({1.5, 0.902, 0}), {}, rate / 6, 1.0 / rate);
        MovementSettings off = s;
        off.step_up = off.snap_down = false;
        // The first rim is 0.602 m below the centre, where the ellipsoid is 0.4 sqrt(1 - (0.602 / 0.9)^2) =
        // 0.2973 m wide, and a skin off its normal is 0.0021 m along X.
        const PlayerState stopped = run(lab, off, state, wish(1, 0), 3 * rate, 1.0 / rate);
        EXPECT_NEAR(stopped.position.x(), 2.0 - 0.2973 - 0.0021, 1e-3) << rate;
        EXPECT_NEAR(stopped.position.y(), 0.902, 1e-6) << rate;
        double x = state.position.x();
        int ticks = 0;
        while (state.position.y() < 3.9 && ticks < 3 * rate) {
            state = step(lab.scene(), s, state, wish(1, 0), 1.0 / rate).state;
            EXPECT_TRUE(state.grounded) << rate << " Hz, tick " << ticks;
            EXPECT_GT(state.position.x(), x);
            x = state.position.x();
            ++ticks;
        }
        EXPECT_LT(ticks, 1.5 * 1.1 * rate) << rate;

        // Along a wall the speed is the wall's fraction of the stick's, 5 / sqrt(26) of the walking speed.
        Lab street;
        street.floor();
        street.wall({-50, 0}, {50, 0});
        street.ready();
        PlayerState walker = run(street, s, at({0, 0.902, s.radii.z() + s.skin}), {}, 10, 1.0 / rate);
        const double from = walker.position.x();
        walker = run(street, s, walker, wish(5 / std::sqrt(26.0), -1 / std::sqrt(26.0)), rate, 1.0 / rate);
        EXPECT_LE(walker.position.x() - from, 4.0 * 5 / std::sqrt(26.0) + 1e-6) << rate;
        EXPECT_NEAR(walker.position.y(), 0.902, 1e-4);
    }
}

TEST(StepUp, RespectsLowCeilings) {
    // A step of 0.3 m under a ceiling that leaves 1.9 m above the floor: standing on the step needs 2.1 m.
    MovementSettings s = every_hack();
    Lab lab;
    lab.floor();
    lab.polygon({{2, 0, 3}, {2, 0, -3}, {2, 0.3, -3}, {2, 0.3, 3}});
    lab.polygon({{2, 0.3, -3}, {2, 0.3, 3}, {9, 0.3, 3}, {9, 0.3, -3}});
    lab.polygon({{-9, 1.9, -9}, {9, 1.9, -9}, {9, 1.9, 9}, {-9, 1.9, 9}});
    lab.ready();
    const PlayerState state = run(lab, s, at({0, 0.902, 0}), wish(1, 0), 120);
    EXPECT_LT(state.position.x(), 2.0);
    EXPECT_FALSE(overlaps_any(lab.world(), s.radii, state.position));
}

TEST(SnapDown, KeepsToTheGroundOverACrest) {
    // From level ground onto a slope of 40 degrees down at 6 m/s: without it the player flies. Six ticks to 6
    // m/s make 0.3 m of the 4 m to the crest, 37 more the rest, so the ground is left over the crest itself,
    // where the next 0.1 m take the rim 0.9 (1 - sqrt(1 - (0.1 / 0.4)^2)) = 0.029 m away, more than the press
    // of 1 m/s reaches in a tick, 0.0167 m. That is 0.0139 m more than g dt dt / 2; from there on y = 0.902 -
    // 0.0139 - 10 t t. The slope holds a centre at (|R n| + skin) / cos 40 - 6 t tan 40 = 0.9631 - 5.0346 t.
    // They meet at 10 t t - 5.0346 t + 0.0750 = 0, t = 0.488 s = 29.3 ticks: the 30th lands.
    for (const bool on : {false, true}) {
        MovementSettings s = basic_settings();
        s.snap_down = on;
        Lab lab;
        const double drop = 20 * std::tan(radians(40));
        lab.polygon({{-20, 0, -5}, {-20, 0, 5}, {0, 0, 5}, {0, 0, -5}});
        lab.polygon({{0, 0, -5}, {0, 0, 5}, {20, -drop, 5}, {20, -drop, -5}});
        lab.ready();
        PlayerState state = run(lab, s, at({-4, 0.902, 0}), {}, 5);
        int airborne = 0, flights = 0;
        double left_at = 0.0;  // x where the ground was left
        for (int i = 0; i < 120; ++i) {
            const PlayerState before = state;
            state = step(lab.scene(), s, state, wish(1, 0), tick).state;
            airborne += state.grounded ? 0 : 1;
            if (before.grounded && !state.grounded) {
                ++flights;
                left_at = before.position.x();
            }
        }
        if (on) {
            EXPECT_EQ(airborne, 0);
        } else {
            EXPECT_EQ(flights, 1);
            EXPECT_NEAR(left_at, 0.0, 1e-9);
            EXPECT_EQ(airborne, 29);
        }
    }
}

}  // namespace
}  // namespace slipface::test
