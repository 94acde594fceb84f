// Each demo shows what it says: the artefact with the switch off, and its absence with it on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "slipface/level/level_file.h"
#include "slipface/level/level_scene.h"
#include "slipface/scenes/demo.h"

namespace slipface {
namespace {

struct Trip {
    PlayerState start;
    std::vector<PlayerState> states;
    const PlayerState& end() const { return states.back(); }
    double highest(std::size_t from = 0) const {
        double y = -1e9;
        for (std::size_t i = from; i < states.size(); ++i)
            y = std::max(y, states[i].position.y());
        return y;
    }
    std::size_t airborne(std::size_t from, std::size_t to) const {
        std::size_t count = 0;
        for (std::size_t i = from; i < std::min(to, states.size()); ++i)
            count += states[i].grounded ? 0 : 1;
        return count;
    }
};

Trip run(const Demo& demo, const MovementSettings& settings, StepFunction mover = step) {
    Result<LevelScene> scene = LevelScene::build(demo.level, settings);
    EXPECT_TRUE(scene.ok());
    Trip run{.start = scene->player_at(demo.level.spawn), .states = {}};
    PlayerState state = run.start;
    for (const TapeSegment& segment : demo.tape.segments) {
        for (int i = 0; i < segment.ticks; ++i) {
            const double time = static_cast<double>(run.states.size()) * demo.tape.dt;
            state = mover(scene->at(time, demo.tape.dt), settings, state, segment.input, demo.tape.dt,
                          nullptr, nullptr)
                        .state;
            run.states.push_back(state);
        }
    }
    return run;
}

struct Pair {
    Demo demo;
    Trip off, on;
};

Pair pair_of(const char* name) {
    const DemoInfo* info = find_demo(name);
    EXPECT_NE(info, nullptr) << name;
    Demo demo = make_demo(*info);
    Trip off = run(demo, demo.off, step_of(demo.off_tape)), on = run(demo, demo.on, step_of(demo.tape));
    return {std::move(demo), std::move(off), std::move(on)};
}

// The lecture's first half.
TEST(Demos, BounceScalarTakesHeightFromEachRebound) {
    const Pair pair = pair_of("bounce-scalar");
    EXPECT_GT(pair.off.highest(250), 3.0);  // as high as it fell
    EXPECT_LT(pair.on.highest(250), 1.2);
}

TEST(Demos, SlidesLeadOnWhereOneFewerEnds) {
    for (const char* name : {"one-slide", "two-slides"}) {
        SCOPED_TRACE(name);
        const Pair pair = pair_of(name);
        // In the last quarter the one walks and the other hangs at what it touched.
        const auto later = [](const Trip& r) {
            return (r.end().position - r.states[r.states.size() * 3 / 4].position).norm();
        };
        EXPECT_GT(later(pair.on), 1.0);
        EXPECT_LT(later(pair.off), 0.05);
    }
    const Pair round = pair_of("three-slides");
    EXPECT_GT((round.on.end().position - round.off.end().position).norm(), 0.5);
}

TEST(Demos, WholeDisplacementsSpeedUp) {
    const Pair pair = pair_of("remainder");
    const auto fastest = [&](const Trip& r) {
        double most = 0.0;
        for (std::size_t i = 1; i < r.states.size(); ++i)
            most = std::max(most, (r.states[i].position - r.states[i - 1].position).norm());
        return most / pair.demo.tape.dt;
    };
    const double walk = pair.demo.on.walk_speed;
    EXPECT_LT(fastest(pair.on), 1.02 * walk);  // the pushes by the skin
    EXPECT_GT(fastest(pair.off), 1.3 * walk);
}

TEST(Demos, DividedNormalsClimbTheRamp) {
    const Pair pair = pair_of("contact-plane");
    EXPECT_GT(pair.on.highest(), pair.off.highest() + 1.0);
}

TEST(Demos, EpsilonHoldsThePlayerOnTheFloor) {
    const Pair pair = pair_of("epsilon");
    EXPECT_GT(pair.on.end().position.y(), pair.demo.on.radii.y() + 0.29);
    EXPECT_LT(pair.off.end().position.y(), 0.0);
}

TEST(Demos, SayProblemAndCureInTwoShortLines) {
    const auto words = [](const std::string& text) {
        return text.empty() ? 0 : 1 + std::count(text.begin(), text.end(), ' ');
    };
    for (const DemoInfo& info : demo_table()) {
        SCOPED_TRACE(info.name);
        EXPECT_LE(words(sentences_of(info)), 25);
        for (const std::string text : {info.problem, info.cure}) {
            EXPECT_GE(words(text), 4);
            EXPECT_EQ(text.back(), '.');
        }
    }
    // Every card has a demo, and with it these lines.
    for (const SettingInfo& setting : settings_table())
        EXPECT_TRUE(!is_switch(setting) || std::any_of(demo_table().begin(), demo_table().end(),
                                                       [&](const DemoInfo& info) {
                                                           return setting.name == std::string_view(info.hack);
                                                       }))
            << setting.name;
}

TEST(Demos, StaticFrictionHoldsOnTheRamp) {
    const Pair pair = pair_of("static-friction");
    EXPECT_GT((pair.off.end().position - pair.off.start.position).norm(), 1.0);
    EXPECT_EQ(pair.on.end().position, pair.on.states[60].position);  // bit-still
    EXPECT_LT((pair.on.end().position - pair.on.start.position).norm(), 0.01);
}

TEST(Demos, GroundVelocityStaysOnTheRamp) {
    // Past the crest, which both leave, from tick 90 on; the ramp is 14 m long, 140 ticks.
    const Pair pair = pair_of("ground-velocity");
    EXPECT_GT(pair.off.airborne(90, 190), 30U);  // more than 30 %
    EXPECT_EQ(pair.on.airborne(90, 190), 0U);
}

TEST(Demos, StraightAheadKeepsTheHeading) {
    const Pair pair = pair_of("straight-ahead");
    const auto heading = [](const Trip& r) {
        const Vec3 motion = r.end().position - r.states[r.states.size() - 30].position;
        return std::atan2(motion.x(), -motion.z());
    };
    EXPECT_NEAR(heading(pair.on), 0.25 * 3.141592653589793, 1e-4);
    EXPECT_GT(std::abs(heading(pair.off) - 0.25 * 3.141592653589793), 0.05);
    // The stripe, 0.7 m wide, has its middle on x + z = -1.
    const auto aside = [](const Trip& r) {
        return std::abs(r.end().position.x() + r.end().position.z() + 1.0);
    };
    EXPECT_LT(aside(pair.on), 0.01);
    EXPECT_GT(aside(pair.off), 0.35 + pair.demo.on.radii.x());
}

TEST(Demos, KeepEnergyReachesTheFarRim) {
    // From 5.2 m the centre comes back to that height less what the ellipsoid's shape takes; without the hack
    // each of 12 faces takes 1 - cos(15 deg) of the speed.
    const Pair pair = pair_of("keep-energy");
    const auto risen = [](const Trip& r) {
        double y = -10;
        for (const PlayerState& s : r.states)
            if (s.position.x() > 2.0) y = std::max(y, s.position.y());
        return y;
    };
    EXPECT_GT(risen(pair.on), risen(pair.off) + 1.0);
}

double moved(const Trip& trip) {
    return (trip.end().position - trip.start.position).norm();
}

// The same demo with the stick held in one direction, in the plane, at `angle` from +X.
Trip run_towards(Demo demo, const MovementSettings& settings, double angle) {
    demo.tape.segments = {{.ticks = 60, .input = {.wish = 0.99 * Vec2(std::cos(angle), std::sin(angle))}}};
    return run(demo, settings);
}

TEST(Demos, PushOutFreesFromTheWedge) {
    const Pair pair = pair_of("push-out");
    const Result<CollisionWorld> world = build_collision_world(pair.demo.level);
    const Vec3& radii = pair.demo.on.radii;
    EXPECT_LT(moved(pair.off), 1e-6);
    EXPECT_TRUE(overlaps_any(*world, radii, pair.off.end().position));
    EXPECT_FALSE(overlaps_any(*world, radii, pair.on.states[0].position));
    EXPECT_FALSE(overlaps_any(*world, radii, pair.on.end().position));
    EXPECT_GT(pair.on.end().position.x(), 2.5);  // past the wall, 40 ticks at 5.4 m/s less 6 to start

    MovementSettings iterative = pair.demo.on;
    iterative.push_out = PushOut::iterative;
    EXPECT_LT((run(pair.demo, iterative).end().position - pair.on.end().position).norm(), 1e-5);
}

TEST(Demos, NudgeFreesFromBetweenThePosts) {
    const Pair pair = pair_of("nudge");
    const Result<CollisionWorld> world = build_collision_world(pair.demo.level);
    const Vec3& radii = pair.demo.on.radii;
    EXPECT_LT(moved(pair.off), 1e-6);
    EXPECT_TRUE(overlaps_any(*world, radii, pair.off.end().position));
    EXPECT_FALSE(pair.on.states[0].trapped);
    EXPECT_FALSE(overlaps_any(*world, radii, pair.on.states[0].position));
    EXPECT_FALSE(overlaps_any(*world, radii, pair.on.end().position));
    EXPECT_GT(moved(pair.on), 2.5);
    for (const PushOut kind : {PushOut::iterative, PushOut::analytic}) {  // there is no plane to leave
        MovementSettings pushed = pair.demo.off;
        pushed.push_out = kind;
        EXPECT_LT(moved(run(pair.demo, pushed)), 1e-6);
    }
    for (int i = 0; i < 16; ++i) {  // no direction of the stick leads out
        const double angle = 2.0 * 3.141592653589793 * i / 16;
        EXPECT_LT(moved(run_towards(pair.demo, pair.demo.off, angle)), 1e-6) << angle;
    }
}

TEST(Demos, StepUpClimbsTheStairs) {
    const Pair pair = pair_of("step-up");
    EXPECT_LT(pair.off.highest(), 1.0);
    EXPECT_NEAR(pair.on.highest(), 3.9 + pair.demo.on.skin, 0.02);
    EXPECT_EQ(pair.on.airborne(20, 120), 0U);
}

TEST(Demos, HeightfieldCarries) {
    const Pair pair = pair_of("heightfield");
    EXPECT_LT(pair.off.end().position.y(), -35.0);
    for (const PlayerState& s : pair.on.states) {
        const auto ground = terrain_at(*pair.demo.level.terrain, s.position.x(), s.position.z());
        ASSERT_TRUE(ground);
        EXPECT_GE(s.position.y(), ground->height + pair.demo.on.radii.y() - 1e-12);
    }
    EXPECT_LT(pair.on.end().position.z(), -6.0);
}

TEST(Demos, SectorsMoveAsAtTheOrigin) {
    // Bit for bit: the same level with no placement, and 10^6 m out.
    Pair pair = pair_of("sectors");
    Demo home = pair.demo;
    home.level.sectors.placement = Vec3::Zero();
    const Trip at_origin = run(home, home.on);
    Result<LevelScene> far = LevelScene::build(pair.demo.level, pair.demo.off);
    constexpr std::size_t before_the_gate = 60;  // 3.1 m at 5.4 m/s from tick 30 on, less the radius
    double worst = 0.0;
    for (std::size_t i = 0; i < at_origin.states.size(); ++i) {
        EXPECT_EQ(pair.on.states[i].position, at_origin.states[i].position) << i;
        EXPECT_EQ(pair.on.states[i].velocity, at_origin.states[i].velocity) << i;
        EXPECT_EQ(pair.on.states[i].sector[0], 1000);
        EXPECT_EQ(pair.on.states[i].sector[2], -1000);
        const Vec3 local = far->to_level(far->at(0.0), pair.off.states[i]);
        if (i < before_the_gate) worst = std::max(worst, (local - at_origin.states[i].position).norm());
    }
    // The posts of the gates stand 0.75 m apart there, closer than the player is wide.
    EXPECT_LT(pair.on.end().position.z(), -6.2);  // through all three
    const Vec3 stopped = far->to_level(far->at(0.0), pair.off.end());
    EXPECT_GT(stopped.z(), 0.0);
    // On the floor before them: float coordinates are 0.0625 m apart, so corners lie up to 0.031 m aside on a
    // plane of slope 0.29, up to 9 mm too high or low, and half of that where three of them mix.
    EXPECT_GT(worst, 0.003);
}

TEST(Demos, BounceGivesBack) {
    const Pair pair = pair_of("bounce");
    EXPECT_LT(pair.off.highest(120), 1.2);
    EXPECT_GT(pair.on.highest(80), 2.5);
}

TEST(Demos, StickyWallsHold) {
    const Pair pair = pair_of("sticky");
    EXPECT_TRUE(pair.off.end().grounded);
    EXPECT_LT(pair.off.end().position.y(), 1.0);
    EXPECT_TRUE(pair.on.end().stuck);
    EXPECT_GT(pair.on.end().position.y(), 2.0);
    EXPECT_EQ(pair.on.end().position, pair.on.states[pair.on.states.size() - 30].position);  // bit by bit
}

TEST(Demos, SnapDownFollowsTheStairs) {
    const Pair pair = pair_of("snap-down");
    EXPECT_GT(pair.off.airborne(20, 110), 10U);
    EXPECT_EQ(pair.on.airborne(20, 110), 0U);
}

TEST(Demos, SeamFilterPassesTriangleEdges) {
    const Pair pair = pair_of("seam-filter");
    const double ideal = 6.0 * 2.0;
    EXPECT_LT(std::abs(pair.off.start.position.z() - pair.off.end().position.z()), 0.1);
    EXPECT_LT(pair.off.end().position.y(), 0.6);  // sunk to the waist in the floor at y = 0
    EXPECT_GT(pair.on.start.position.z() - pair.on.end().position.z(), 0.95 * ideal);
    EXPECT_NEAR(pair.on.end().position.y(), pair.demo.on.radii.y() + pair.demo.on.skin, 1e-5);
}

TEST(Demos, JumpsAreForgiving) {
    const Pair coyote = pair_of("coyote");
    EXPECT_LT(coyote.off.end().position.y(), 0.0);
    EXPECT_TRUE(coyote.on.end().grounded);
    EXPECT_GT(coyote.on.end().position.y(), 0.5);
    const Pair buffer = pair_of("jump-buffer");
    EXPECT_LT(buffer.off.highest(70), 1.5);
    EXPECT_GT(buffer.on.highest(70), 2.2);
    const Pair variable = pair_of("variable-jump");
    EXPECT_GT(variable.off.highest(), variable.on.highest() + 0.3);
    EXPECT_LT(variable.on.end().position.z(), variable.off.end().position.z() + 0.01);
    const Pair air = pair_of("air-control");
    EXPECT_TRUE(air.on.end().grounded);
    EXPECT_GT(air.on.end().position.y(), 0.5);
    EXPECT_LT(air.off.end().position.y(), 0.0);
}

// Feet: of the far ledge 0 m, of the ledge below -3.2 m, of the shaft's lower wall 4 m.
TEST(Demos, AbilitiesLeadOn) {
    const auto feet = [](const Pair& pair, const Trip& trip) {
        return trip.end().position.y() - pair.demo.on.radii.y();
    };
    const Pair twice = pair_of("air-jump");
    EXPECT_NEAR(feet(twice, twice.on), 0.0, 0.05);
    EXPECT_NEAR(feet(twice, twice.off), -4.0, 0.05);
    const Pair slide = pair_of("wall-slide");
    EXPECT_NEAR(feet(slide, slide.on), -3.2, 0.05);
    EXPECT_NEAR(feet(slide, slide.off), -6.0, 0.05);
    const Pair shaft = pair_of("wall-jump");
    EXPECT_NEAR(feet(shaft, shaft.on), 4.0, 0.05);
    EXPECT_NEAR(feet(shaft, shaft.off), 0.0, 0.05);
    const Pair dash = pair_of("dash");
    EXPECT_NEAR(feet(dash, dash.on), 0.0, 0.05);
    EXPECT_NEAR(feet(dash, dash.off), -4.0, 0.05);
    const Pair passage = pair_of("crouch");
    EXPECT_LT(passage.on.end().position.z(), -3.5);
    EXPECT_FALSE(passage.on.end().crouched);
    EXPECT_GT(passage.off.end().position.z(), 0.0);
    const Pair wall = pair_of("ledge-grab");
    EXPECT_NEAR(feet(wall, wall.on), 2.8, 0.05);
    EXPECT_NEAR(feet(wall, wall.off), 0.0, 0.05);
    const Pair grate = pair_of("drop-through");
    EXPECT_NEAR(feet(grate, grate.on), 0.0, 0.05);
    EXPECT_NEAR(feet(grate, grate.off), 3.0, 0.05);
    const Pair glide = pair_of("glide");
    EXPECT_NEAR(feet(glide, glide.on), 0.0, 0.05);
    EXPECT_NEAR(feet(glide, glide.off), -4.0, 0.05);
}

TEST(Demos, PlatformsCarry) {
    const Pair raft = pair_of("moving-platforms");
    EXPECT_LT(raft.off.end().position.y(), -2.0);
    EXPECT_TRUE(raft.on.end().grounded);
    EXPECT_LT(raft.on.end().position.z(), -6.0);
    EXPECT_GT(raft.on.end().position.y(), 0.5);
    // 1.2 rad/s on a circle of 3 m, from the first tick on: (3 cos a, -3 sin a).
    const Pair table = pair_of("turntable");
    const double a = 1.2 * 180 / 60;
    EXPECT_NEAR(table.on.end().position.x(), 3.0 * std::cos(a), 1e-4);
    EXPECT_NEAR(table.on.end().position.z(), -3.0 * std::sin(a), 1e-4);
    const Pair types = pair_of("surface-types");
    EXPECT_LT(types.off.highest(), 1.5);
    EXPECT_GT(types.on.highest(), 4.5);
}

TEST(Demos, AreSavedAsFilesThatLoad) {
    const auto folder = std::filesystem::path(::testing::TempDir()) / "slipface-demos";
    std::filesystem::create_directories(folder);
    for (const DemoInfo& info : demo_table()) {
        const Demo demo = make_demo(info);
        const auto path = save_demo(info, folder);
        ASSERT_TRUE(path.ok()) << path.error().text();
        const auto loaded = load_level(*path);
        ASSERT_TRUE(loaded.ok()) << loaded.error().text();
        EXPECT_TRUE(loaded->warnings.empty()) << info.name << ": " << loaded->warnings.front().text();
        EXPECT_EQ(loaded->level.mesh->face_count(), demo.level.mesh->face_count()) << info.name;
        EXPECT_EQ(loaded->level.platforms, demo.level.platforms);
        ASSERT_EQ(loaded->level.goals.size(), 1u);
        EXPECT_EQ(loaded->level.movement, demo.on);
        EXPECT_EQ(loaded->level.terrain == nullptr, demo.level.terrain == nullptr);
        if (demo.level.terrain) {
            EXPECT_EQ(loaded->level.terrain->heights, demo.level.terrain->heights);
        }
        const auto tape = load_tape(folder / (std::string(info.name) + ".tape"));
        ASSERT_TRUE(tape.ok());
        EXPECT_EQ(tape->tick_count(), demo.tape.tick_count());
        EXPECT_EQ(tape->level_fingerprint, loaded->level.mesh->fingerprint);
    }
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace slipface
