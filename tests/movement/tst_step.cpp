// Guarantees of the step as a whole: never inside, no energy from nothing, the same bits, refusal of bad
// input.
#include <algorithm>
#include <cstring>
#include <limits>

#include "test_geometry.h"

namespace slipface::test {

namespace {

// A small room that is hostile on purpose: acute wedges, needles, a pit, a thin blade, a leaning ceiling,
// degenerate triangles.
void build_hostile(Lab& lab, SurfaceId surface = plain) {
    lab.polygon({{-4, 0, -4}, {-4, 0, 4}, {4, 0, 4}, {4, 0, -4}}, surface);
    lab.wall({-4, -4}, {4, -4}, 0, 5, surface);
    lab.wall({4, -4}, {4, 4}, 0, 5, surface);
    lab.wall({4, 4}, {-4, 4}, 0, 5, surface);
    lab.wall({-4, 4}, {-4, -4}, 0, 5, surface);
    lab.polygon({{-4, 5, -4}, {4, 5, -4}, {4, 3, 4}, {-4, 3, 4}}, surface);  // ceiling, leaning
    lab.wall({-4, -4}, {2, -3}, 0, 5, surface);  // wedge of 9 degrees with the wall behind
    lab.wall({4, 4}, {1, 2.5}, 0, 5, surface);   // wedge of 27 degrees
    lab.polygon({{-4, 0, 0}, {-4, 0, 4}, {-1, 1.2, 4}, {-1, 1.2, 0}}, surface);  // ramp of 22 degrees
    lab.polygon({{4, 0, -2}, {4, 3, -2}, {2, 0, -2}}, surface);                  // a blade
    lab.polygon({{0, 0, 0}, {0.001, 2, 0}, {-0.001, 2, 0}}, surface);            // a needle
    lab.polygon({{1, 0.5, -1}, {1, 0.5, -1}, {2, 0.5, 0}}, surface);             // no area: an edge
    lab.polygon({{-2, 0.8, -2}, {-2, 0.8, -2}, {-2, 0.8, -2}}, surface);         // no extent: a point
    lab.polygon({{-1, 0, 1}, {0, 2.5, 1.5}, {-1, 0, 2}}, surface);               // a leaning tooth
    lab.ready();
}

bool inside(const Lab& lab, const MovementSettings& s, const PlayerState& state) {
    return overlaps_any(lab.scene().collision, s.radii, state.position);
}

PlayerState free_start(const Lab& lab, const MovementSettings& s, Random& random) {
    for (;;) {
        const PlayerState state =
            at({random.between(-3.5, 3.5), random.between(0.5, 3.0), random.between(-3.5, 3.5)});
        if (!inside(lab, s, state)) return state;
    }
}

std::uint64_t walk_randomly(Lab& lab, const MovementSettings& s, int steps, double fling,
                            std::uint64_t seed) {
    Random random(seed);
    PlayerState state = free_start(lab, s, random);
    PlayerInput input;
    std::uint64_t hash = 0;
    for (int i = 0; i < steps; ++i) {
        if (i % 17 == 0) input = wish(random.between(-1, 1), random.between(-1, 1), random.below(3) == 0);
        if (random.below(50) == 0) {
            state.velocity =
                fling * Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
        }
        if (i % 2000 == 1999) state = free_start(lab, s, random);
        TraceRecorder trace;
        state = step(lab.scene(), s, state, input, tick, &trace).state;
        EXPECT_FALSE(inside(lab, s, state)) << "step " << i << " at " << state.position.transpose();
        for (const TraceRecord& record : trace.records) {
            const auto* sweep = std::get_if<SweepRecord>(&record);
            if (sweep == nullptr || sweep->reached == sweep->from) continue;
            EXPECT_FALSE(cast_ray(lab.world(), sweep->from, sweep->reached - sweep->from, 1.0))
                << "step " << i;
        }
        EXPECT_LT(state.position.cwiseAbs().maxCoeff(), 5.0) << "step " << i;
        if (::testing::Test::HasFailure()) break;
        hash = hash_of(state, hash);
    }
    return hash;
}

}  // namespace

TEST(NeverInside, OverRandomWalksInAHostileRoom) {
    Lab lab;
    build_hostile(lab);
    MovementSettings s = basic_settings();
    s.radii = Vec3(0.25, 0.5, 0.25);
    walk_randomly(lab, s, 20000, 30.0, 1);
    s.static_friction = false;
    walk_randomly(lab, s, 5000, 30.0, 2);
    s = MovementSettings{};
    s.radii = Vec3(0.5, 0.3, 0.2);
    s.straight_ahead = false;
    s.ground_velocity = false;
    walk_randomly(lab, s, 5000, 300.0, 3);
}

TEST(NeverInside, OnEverySurfaceType) {
    for (const SurfaceId surface : {ice, ladder, sticky, bouncy, conveyor, turntable}) {
        Lab lab;
        build_hostile(lab, surface);
        MovementSettings s = basic_settings();
        s.radii = Vec3(0.25, 0.5, 0.25);
        walk_randomly(lab, s, 4000, 20.0, 10 + surface);
        if (HasFailure()) FAIL() << "surface " << int{surface};
    }
}

TEST(NeverInside, OneHugeStepDoesNotTunnel) {
    Lab lab;
    lab.wall({2, -50}, {2, 50}, -50, 50);
    lab.ready();
    MovementSettings s = basic_settings();
    s.gravity = 0.0;
    const PlayerState state = step(lab.scene(), s, at({0, 0, 0}, {1e6, 0, 0}), {}, 0.25).state;
    EXPECT_NEAR(state.position.x(), 2 - 0.4 - s.skin, 1e-6);
}

TEST(Energy, NeverGrowsWithoutInput) {
    // Kinetic and potential energy per mass. The push that restores a skin may lift the player by a skin.
    for (const SurfaceId surface : {plain, ice, bouncy}) {
        for (int variant = 0; variant < 8; ++variant) {
            Lab lab;
            build_hostile(lab, surface);
            MovementSettings s = basic_settings();
            s.radii = Vec3(0.25, 0.5, 0.25);
            s.static_friction = (variant & 1) == 0;
            s.keep_energy = (variant & 2) == 0;
            s.straight_ahead = (variant & 4) == 0;
            s.ground_acceleration = 1.0;
            Random random(static_cast<std::uint64_t>(100 + variant));
            for (int trial = 0; trial < 20; ++trial) {
                PlayerState state = free_start(lab, s, random);
                state.velocity =
                    8.0 * Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
                const auto energy = [&](const PlayerState& p) {
                    // The press on the ground is no motion; the descent along a slope is: N.x x + N.y y + N.z
                    // z = 0.
                    Vec3 v = p.velocity;
                    if (p.grounded && s.static_friction && surface != ice) {
                        const Vec3& n = p.ground_normal;
                        v.y() = std::min(0.0, -(n.x() * v.x() + n.z() * v.z()) / n.y());
                    }
                    return 0.5 * v.squaredNorm() + s.gravity * p.position.y();
                };
                double least = energy(state);
                for (int i = 0; i < 120; ++i) {
                    state = step(lab.scene(), s, state, {}, tick).state;
                    ASSERT_LE(energy(state), least + 2.0 * s.gravity * s.skin)
                        << "surface " << int{surface} << " variant " << variant << " trial " << trial
                        << " tick " << i;
                    least = std::min(least, energy(state));
                }
            }
        }
    }
}

TEST(Determinism, TheSameArgumentsGiveTheSameBits) {
    Lab lab;
    build_hostile(lab);
    MovementSettings s = basic_settings();
    s.radii = Vec3(0.25, 0.5, 0.25);
    const std::uint64_t first = walk_randomly(lab, s, 5000, 30.0, 7);
    EXPECT_EQ(walk_randomly(lab, s, 5000, 30.0, 7), first);
    EXPECT_NE(walk_randomly(lab, s, 5000, 30.0, 8), first);
    s.walk_speed = 6.0000001;
    EXPECT_NE(walk_randomly(lab, s, 5000, 30.0, 7), first);
}

TEST(Determinism, ATraceChangesNothing) {
    Lab lab;
    build_hostile(lab);
    const MovementSettings s = basic_settings();
    PlayerState quiet = at({0, 2, 3});
    PlayerState explained = quiet;
    TraceRecorder trace;
    for (int i = 0; i < 300; ++i) {
        const PlayerInput input = wish(std::sin(0.1 * i), std::cos(0.07 * i), i % 40 == 0);
        const StepResult a = step(lab.scene(), s, quiet, input, tick);
        const StepResult b = step(lab.scene(), s, explained, input, tick, &trace);
        ASSERT_TRUE(a.state == b.state);
        ASSERT_EQ(a.sweeps, b.sweeps);
        quiet = a.state;
        explained = b.state;
    }
    EXPECT_GT(trace.records.size(), 300u);
}

TEST(BadInput, LeavesTheStateUnchanged) {
    Lab lab;
    lab.floor();
    lab.ready();
    const MovementSettings s = basic_settings();
    const PlayerState start = at({0, 3, 0}, {1, 0, 0});
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    for (const double dt : {0.0, -0.1, 1e-5, nan, inf}) {
        EXPECT_TRUE(step(lab.scene(), s, start, {}, dt).state == start) << dt;
    }
    EXPECT_FALSE(step(lab.scene(), s, start, {}, 0.25).state == start);
    for (const double bad : {nan, inf, -inf}) {
        EXPECT_TRUE(step(lab.scene(), s, start, wish(bad, 0), tick).state == start);
        PlayerState odd = start;
        odd.velocity.y() = bad;
        EXPECT_EQ(step(lab.scene(), s, odd, {}, tick).state.position, start.position);
        MovementSettings broken = basic_settings();
        broken.gravity = bad;
        EXPECT_TRUE(step(lab.scene(), broken, start, {}, tick).state == start);
        broken = {};
        broken.radii.x() = bad;
        EXPECT_TRUE(step(lab.scene(), broken, start, {}, tick).state == start);
        const SlideResult slid = slide_move(lab.scene(), s, start.position, {bad, 0, 0});
        EXPECT_EQ(slid.position, start.position);
    }
    MovementSettings broken = basic_settings();
    broken.radii.y() = 0.0;
    EXPECT_TRUE(step(lab.scene(), broken, start, {}, tick).state == start);
    // Finite but absurd numbers end finite.
    PlayerState huge = at({1e300, 1e300, -1e300}, {1e308, -1e308, 1e308});
    huge = step(lab.scene(), s, huge, wish(1e308, 1e308, true), 0.25).state;
    EXPECT_TRUE(huge.position.allFinite());
    EXPECT_TRUE(huge.velocity.allFinite());
}

TEST(EmptyWorld, IsFallenThroughForEver) {
    const CollisionWorld nothing;
    const MovementScene scene{.collision = nothing, .surfaces = {}};
    PlayerState state = at({0, 0, 0});
    for (int i = 0; i < 60; ++i)
        state = step(scene, {}, state, {}, tick).state;
    EXPECT_NEAR(state.position.y(), -10.0, 1e-9);
}

TEST(PlayerState, lists_every_member) {
    // A member in no list would keep what is written over all of them.
    PlayerState state;
    std::memset(static_cast<void*>(&state), 1, sizeof state);
    const PlayerState fresh;
    for (const auto member : PlayerState::vectors)
        state.*member = fresh.*member;
    for (const auto member : PlayerState::flags)
        state.*member = fresh.*member;
    for (const auto member : PlayerState::numbers)
        state.*member = fresh.*member;
    for (const auto member : PlayerState::counts)
        state.*member = fresh.*member;
    EXPECT_NE(state, fresh);
    state.sector = fresh.sector;
    state.ground_face = fresh.ground_face;
    state.ground_surface = fresh.ground_surface;
    state.ground_platform = fresh.ground_platform;
    state.carrier = fresh.carrier;
    EXPECT_EQ(state, fresh);
}

}  // namespace slipface::test
