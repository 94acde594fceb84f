// Running tapes over the stripes.
#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "sim/stripes.h"
#include "slipface/mesh/build.h"
#include "slipface/sim/run.h"

namespace slipface::test {
namespace {

using testing::ElementsAre;

std::vector<std::string> kinds(const SimulationReport& report) {
    std::vector<std::string> kinds;
    for (const SimulationEvent& event : report.events)
        kinds.push_back(event.kind);
    return kinds;
}

const SimulationEvent* find_event(const SimulationReport& report, std::string_view kind) {
    for (const SimulationEvent& event : report.events) {
        if (event.kind == kind) return &event;
    }
    return nullptr;
}

TEST(Simulate, IsTheSameAsStepByStep) {
    const Stripes stripes;
    const Tape tape = tape_of(
        {{30, {}}, {60, {Vec2(0.6, 0.8), {}}}, {1, {Vec2(0, 1), Button::jump}}, {50, {Vec2(0, 1), {}}}});
    SimulationOptions options;
    options.keep_states = true;
    const SimulationReport report = simulate(stripes.scene(), {}, Vec3(0, 1.5, 2), tape, options);

    PlayerState state;
    state.position = Vec3(0, 1.5, 2);
    double distance = 0.0;
    std::uint64_t hash = 0;
    std::size_t tick = 0;
    ASSERT_EQ(report.states.size(), 141u);
    for (const TapeSegment& segment : tape.segments) {
        for (int i = 0; i < segment.ticks; ++i) {
            const Vec3 before = state.position;
            state = step(stripes.scene(), {}, state, segment.input, tape.dt).state;
            distance += (state.position - before).norm();
            hash = state_hash(state, hash);
            ASSERT_EQ(report.states[tick++], state);
        }
    }
    EXPECT_EQ(report.final_state, state);
    EXPECT_EQ(report.ticks, 141u);
    EXPECT_EQ(report.distance, distance);
    EXPECT_EQ(report.second_hashes.back(), hash);
}

TEST(Simulate, TheSameTapeGivesTheSameHashesAndAnotherOneDoesNot) {
    const Stripes stripes;
    const Tape tape = tape_of({{200, {Vec2(0, 1), {}}}});
    const SimulationReport a = simulate(stripes.scene(), {}, Vec3(0, 1, 2), tape);
    const SimulationReport b = simulate(stripes.scene(), {}, Vec3(0, 1, 2), tape);
    EXPECT_EQ(a.second_hashes, b.second_hashes);
    EXPECT_EQ(a.final_state, b.final_state);

    // Gravity changes the fall in the first second already, and the chain carries it on.
    MovementSettings weaker;
    weaker.gravity = 19.0;
    const SimulationReport c = simulate(stripes.scene(), weaker, Vec3(0, 1, 2), tape);
    ASSERT_EQ(c.second_hashes.size(), a.second_hashes.size());
    for (std::size_t i = 0; i < a.second_hashes.size(); ++i)
        EXPECT_NE(a.second_hashes[i], c.second_hashes[i]);
}

TEST(Simulate, HashesWholeSecondsAndTheLastTick) {
    const Stripes stripes;
    const auto hash_count = [&](double dt, int ticks) {
        Tape tape = tape_of({{ticks, {}}});
        tape.dt = dt;
        return simulate(stripes.scene(), {}, Vec3(0, 1, 2), tape).second_hashes.size();
    };
    EXPECT_EQ(hash_count(1.0 / 60, 60), 1u);
    EXPECT_EQ(hash_count(1.0 / 60, 59), 1u);
    EXPECT_EQ(hash_count(1.0 / 60, 61), 2u);
    EXPECT_EQ(hash_count(1.0 / 60, 180), 3u);
    EXPECT_EQ(hash_count(0.1, 30), 3u);  // 0.1 is above a tenth, 1.0 / 60 below a sixtieth
    EXPECT_EQ(hash_count(1.0 / 49, 49 * 3), 3u);
    EXPECT_EQ(hash_count(1.0 / 60, 1), 1u);
}

TEST(Simulate, AnEmptyTapeLeavesThePlayerAtTheStart) {
    const Stripes stripes;
    const SimulationReport report = simulate(stripes.scene(), {}, Vec3(1, 2, 3), Tape{});
    EXPECT_EQ(report.final_state.position, Vec3(1, 2, 3));
    EXPECT_EQ(report.ticks, 0u);
    EXPECT_EQ(report.distance, 0.0);
    EXPECT_TRUE(report.second_hashes.empty());
    EXPECT_TRUE(report.events.empty());
}

TEST(Simulate, FallsInTheTimeOfTheClosedForm) {
    const Stripes stripes;
    // From 2 m above the floor: t = sqrt(2 * 2 / 20) = 0.447 s, the 27th tick of 1/60 s; one tick more or
    // less is a matter of the integration.
    const SimulationReport report = simulate(stripes.scene(), {}, Vec3(0, 2.9, 5), tape_of({{60, {}}}));
    const SimulationEvent* land = find_event(report, "land");
    ASSERT_NE(land, nullptr);
    EXPECT_NEAR(static_cast<double>(land->tick), 26.0, 1.0);
    EXPECT_EQ(land->detail, "default");
    EXPECT_NEAR(report.distance, 2.0, 0.01);
}

TEST(Simulate, ReportsJumpsAndLandings) {
    const Stripes stripes;
    const SimulationReport report = simulate(stripes.scene(), {}, Vec3(0, 0.95, 5),
                                             tape_of({{30, {}}, {1, {Vec2(0, 0), Button::jump}}, {90, {}}}));
    EXPECT_THAT(kinds(report), ElementsAre("land", "jump", "land"));
    EXPECT_EQ(report.events[1].tick, 30u);
    // In the air for 2 v / g = 2 * 8 / 20 = 0.8 s = 48 ticks.
    EXPECT_NEAR(static_cast<double>(report.events[2].tick - report.events[1].tick), 48.0, 2.0);
}

TEST(Simulate, WalkingOffTheEdgeIsNoJump) {
    const Stripes stripes;
    // 3 m to the edge at 6 m/s; the jump key is held all the time, so it is never pressed while on the
    // ground.
    const SimulationReport report =
        simulate(stripes.scene(), {}, Vec3(7, 0.95, 5), tape_of({{10, {}}, {60, {Vec2(1, 0), {}}}}));
    ASSERT_GE(report.events.size(), 2u);
    EXPECT_EQ(report.events[1].kind, "leave ground");
    EXPECT_EQ(find_event(report, "jump"), nullptr);
    EXPECT_LT(report.final_state.position.y(), 0.9);
}

TEST(Simulate, ReportsTheSurfaceThatIsWalkedOn) {
    const Stripes stripes;
    const SimulationReport report =
        simulate(stripes.scene(), {}, Vec3(0, 0.95, 8), tape_of({{10, {}}, {60, {Vec2(0, 1), {}}}}));
    const SimulationEvent* surface = find_event(report, "surface");
    ASSERT_NE(surface, nullptr);
    EXPECT_EQ(surface->detail, "ice");
    // 2 m at 6 m/s, after at least 0.1 s of speeding up.
    EXPECT_NEAR(static_cast<double>(surface->tick), 10 + 20 + 3, 8.0);
}

TEST(Simulate, AHazardPutsThePlayerBackAndCountsNoDistanceForIt) {
    const Stripes stripes;
    const Vec3 start(0, 2.9, 25);
    SimulationOptions options;
    options.keep_states = true;
    const SimulationReport report =
        simulate(stripes.scene(), {}, start, tape_of({{40, {Vec2(0, 0), Button::jump}}}), options);
    const SimulationEvent* hazard = find_event(report, "hazard");
    ASSERT_NE(hazard, nullptr);
    EXPECT_EQ(hazard->detail, "hazard");
    const PlayerState& after = report.states[hazard->tick];
    EXPECT_EQ(after.position, start);
    EXPECT_EQ(after.velocity, Vec3(0, 0, 0));
    EXPECT_FALSE(after.hazard);
    EXPECT_TRUE(after.jump_held) << "a key that is held does not jump at once";
    // 2 m down, once, and what is fallen since: less than 2 m.
    EXPECT_GT(report.distance, 1.9);
    EXPECT_LT(report.distance, 4.0);
}

TEST(Simulate, WhoFallsFarBelowTheLevelIsPutBack) {
    const Stripes stripes;
    const Vec3 start(100, 1, 5);  // beside the level
    SimulationOptions options;
    options.keep_states = true;
    const SimulationReport report = simulate(stripes.scene(), {}, start, tape_of({{240, {}}}), options);
    const SimulationEvent* fall = find_event(report, "fall");
    ASSERT_NE(fall, nullptr);
    // 60 m below y = 0: sqrt(2 * 61 / 20) s = 148 ticks, limited by no terminal speed below 50 m/s.
    EXPECT_NEAR(static_cast<double>(fall->tick), 148.0, 2.0);
    EXPECT_EQ(report.states[fall->tick].position, start);
    EXPECT_GT(report.distance, 60.0);
}

// Off the edge again and again: each fall ends at the limit, is counted, and repeats to the bit.
TEST(Simulate, TheLevelsFallLimitEndsFallsAndCountsThem) {
    PolygonSoup soup;
    soup.corner_position = {{-3, 0, -3}, {-3, 0, 3}, {3, 0, 3}, {3, 0, -3}};
    soup.face_first_corner = {0, 4};
    Level level;
    level.mesh = build_mesh(std::move(soup)).value();
    level.overrides.resize(1);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> height(-50.0, -1.0);
    const auto tape = std::make_shared<const Tape>(tape_of({{900, {Vec2(0, 1), {}}}}));
    const Vec3 start(0, 1, 0);
    for (int i = 0; i < 20; ++i) {
        level.fall_limit = height(random);
        Result<LevelScene> built = LevelScene::build(level);
        ASSERT_TRUE(built.ok());
        const TickScene scene(*built);
        const SimulationReport report =
            simulate(scene, level.movement, start, *tape, {.keep_states = true, .trace = nullptr});
        EXPECT_GT(report.falls, 2u) << *level.fall_limit;
        std::uint64_t fallen = 0;
        for (const SimulationEvent& event : report.events)
            if (event.kind == "fall") ++fallen;
        EXPECT_EQ(report.falls, fallen);
        for (const PlayerState& state : report.states)
            EXPECT_GE(state.position.y(), *level.fall_limit);
        TapeRun run(tape, level.movement, start);
        run.advance(scene, 1000);
        EXPECT_EQ(run.hash(), report.end_hash);
        EXPECT_EQ(run.state_before(scene, 700), report.states[699]);
    }
    // A limit above the start would send the player back in every tick: then the usual one holds.
    level.fall_limit = 100.0;
    Result<LevelScene> built = LevelScene::build(level);
    const TickScene scene(*built);
    EXPECT_EQ(run_start(scene, start).lowest, -60.0);
}

TEST(Simulate, ASettingChangedOnTheWayCountsFromItsTickOn) {
    const Stripes stripes;
    Tape tape = tape_of({{40, {Vec2(1, 0), {}}}});
    tape.changes = {{20, "walk_speed=2"}};
    SimulationOptions options;
    options.keep_states = true;
    const SimulationReport changed = simulate(stripes.scene(), {}, Vec3(0, 0.95, 5), tape, options);
    tape.changes.clear();
    const SimulationReport plain = simulate(stripes.scene(), {}, Vec3(0, 0.95, 5), tape, options);
    for (std::size_t i = 0; i < 20; ++i)
        ASSERT_EQ(changed.states[i], plain.states[i]) << i;
    EXPECT_LT(changed.states[20].velocity.x(), plain.states[20].velocity.x());
    EXPECT_NEAR(changed.final_state.velocity.x(), 2.0, 1e-9);
}

TEST(Simulate, TheEndHashIsThatOfTheLastTick) {
    const Stripes stripes;
    const SimulationReport report =
        simulate(stripes.scene(), {}, Vec3(0, 0.95, 5), tape_of({{90, {Vec2(1, 0), {}}}}));
    EXPECT_EQ(report.end_hash, report.second_hashes.back());
}

TEST(SceneFingerprint, SeesTypesAndWhereTheyAre) {
    Stripes stripes;
    const std::uint64_t before = scene_fingerprint(stripes.scene());
    EXPECT_EQ(before, scene_fingerprint(Stripes().scene()));
    stripes.surfaces[1].keeps_energy = false;
    const std::uint64_t other_ice = scene_fingerprint(stripes.scene());
    EXPECT_NE(before, other_ice);
    stripes.world.set_face_surface(0, 1);
    EXPECT_NE(other_ice, scene_fingerprint(stripes.scene()));
    stripes.surfaces[0].color = {0, 0, 0};
    EXPECT_EQ(scene_fingerprint(stripes.scene()), scene_fingerprint(stripes.scene()));
}

TEST(Simulate, ReportsWhenASurfaceHolds) {
    const Stripes stripes;
    const SimulationReport report = simulate(stripes.scene(), {}, Vec3(0, 1.5, 35), tape_of({{60, {}}}));
    const SimulationEvent* stick = find_event(report, "stick");
    ASSERT_NE(stick, nullptr);
    EXPECT_EQ(stick->detail, "sticky");
    EXPECT_TRUE(report.final_state.stuck);
}

TEST(Simulate, FeedsTheTrace) {
    const Stripes stripes;
    TraceRecorder trace;
    SimulationOptions options;
    options.trace = &trace;
    simulate(stripes.scene(), {}, Vec3(0, 0.95, 5), tape_of({{5, {}}}), options);
    EXPECT_GE(trace.records.size(), 5u);
}

TEST(StateHash, SeesPositionVelocityFlagsAndWhatWasBefore) {
    const PlayerState state;
    const std::uint64_t hash = state_hash(state, 0);
    EXPECT_EQ(hash, 0x8882bf295dadfff0U) << "older tapes hold such hashes";
    EXPECT_NE(hash, state_hash(state, 1));
    PlayerState other = state;
    other.position.x() = 1e-300;
    EXPECT_NE(hash, state_hash(other, 0));
    other = state;
    other.velocity.z() = 1.0;
    EXPECT_NE(hash, state_hash(other, 0));
    for (const auto flag : PlayerState::flags) {
        other = state;
        other.*flag = true;
        EXPECT_NE(hash, state_hash(other, 0));
    }
    for (const auto number : PlayerState::numbers) {
        other = state;
        other.*number = 0.01;
        EXPECT_NE(hash, state_hash(other, 0));
    }
    for (const auto count : PlayerState::counts) {
        other = state;
        other.*count = 1;
        EXPECT_NE(hash, state_hash(other, 0));
    }
    const auto differs = [&](auto change) {
        other = state;
        change(other);
        return state_hash(other, 0) != hash;
    };
    EXPECT_TRUE(differs([](PlayerState& s) { s.sector[2] = 1; }));
    EXPECT_TRUE(differs([](PlayerState& s) { s.ground_face = 3; }));
    EXPECT_TRUE(differs([](PlayerState& s) { s.ground_surface = 3; }));
    EXPECT_TRUE(differs([](PlayerState& s) { s.ground_platform = 0; }));
    EXPECT_TRUE(differs([](PlayerState& s) { s.ground_normal = Vec3::UnitX(); }));
    other = state;
    other.position.x() = -0.0;
    EXPECT_EQ(hash, state_hash(other, 0)) << "equal states have equal hashes";
}

}  // namespace
}  // namespace slipface::test
