// What happened in a run and why, in levels of random sizes in which it is known; and where a tick's velocity
// came from.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "slipface/sim/run_events.h"
#include "snags.h"

namespace slipface::test {
namespace {

struct Walked {
    std::vector<RunEvent> events;
    double worst_sum = 0.0;  // of velocity_changes() against the change of the velocity, m/s

    const RunEvent* of(const std::string& word) const {
        const auto event = std::ranges::find(events, word, &RunEvent::word);
        return event == events.end() ? nullptr : &*event;
    }
};

Walked walk(const Snag& snag) {
    Walked walked;
    Result<LevelScene> built = LevelScene::build(snag.level, snag.level.movement);
    if (!built) {
        ADD_FAILURE() << built.error().text();
        return walked;
    }
    const TickScene scene(*built);
    TapeRun run(std::make_shared<const Tape>(snag.tape), snag.level.movement, snag.level.spawn);
    run.advance(scene, TapeRun::max_ticks);
    walked.events = find_events(scene, run, snag.level);
    for (std::size_t tick = 0; tick < run.length(); ++tick) {
        const TickTrace trace = run.trace(scene, tick);
        Vec3 sum = trace.before.velocity;
        for (const VelocityChange& change : velocity_changes(trace, snag.level))
            sum += change.change;
        walked.worst_sum = std::max(walked.worst_sum, (sum - trace.after.stepped.velocity).norm());
    }
    return walked;
}

// The event of that word, and that its text has that in it.
void expect_event(const Walked& walked, const std::string& word, const std::string& part) {
    const RunEvent* event = walked.of(word);
    ASSERT_NE(event, nullptr) << word << "\n" << events_text(walked.events, 1.0 / 60);
    EXPECT_NE(event->text.find(part), std::string::npos) << event->text;
}

class Events : public ::testing::TestWithParam<int> {
  protected:
    Events() : maker(static_cast<std::uint64_t>(GetParam())) {
        shapes.group("floor").material("plaster").box({-20, -1, -40}, {20, 0, 20});
        shapes.group("thing").material("stone");
    }
    Walked walk_with(const char* inputs) {
        Snag snag = snag_of("", "", shapes, settings, {}, inputs);
        snag.level.platforms = platforms;
        snag.level.surfaces.insert(snag.level.surfaces.end(), types.begin(), types.end());
        snag.level.spawn = spawn + Vec3(0, settings.radii.y() + settings.skin, 0);
        const Walked walked = walk(snag);
        EXPECT_LT(walked.worst_sum, 1e-12);
        return walked;
    }

    SnagMaker maker;
    MovementSettings settings;
    Shapes shapes;
    std::vector<SurfaceType> types;
    std::vector<Platform> platforms;
    Vec3 spawn = Vec3::Zero();
};

TEST_P(Events, AJumpUnderABeamIsLowerAndNamesTheBeam) {
    shapes.box({-5, maker.between(2.0, 2.9), -5}, {5, 4, 5});
    expect_event(walk_with("20 wish 0,0\n30 wish 0,0 jump\n60 wish 0,0\n"), "jumped lower", "`thing`");
}

TEST_P(Events, AButtonThatIsReleasedCutsTheJump) {
    settings.variable_jump = true;
    const int held = static_cast<int>(maker.between(2, 10));
    const std::string inputs = "20 wish 0,0\n" + std::to_string(held) + " wish 0,0 jump\n60 wish 0,0\n";
    expect_event(walk_with(inputs.c_str()), "jumped lower",
                 "released after " + std::to_string(held) + " ticks");
}

TEST_P(Events, APressAfterTheEdgeSaysHowLateItWas) {
    settings.coyote = false;
    Shapes ledge;
    ledge.group("floor").material("plaster").box({-5, -1, -3}, {5, 0, 5});
    ledge.group("below").box({-50, -30, -50}, {50, -20, 50});
    shapes = ledge;
    const int late = static_cast<int>(maker.between(1, 8));
    // It leaves the ground where its middle is beyond the edge; the press is searched from there.
    const Walked first = walk_with("10 wish 0,0\n80 wish 0,-1\n");
    const RunEvent* left = first.of("walked off");
    ASSERT_NE(left, nullptr);
    const std::size_t walked = left->first - 10 + static_cast<std::size_t>(late);
    const std::string inputs = "10 wish 0,0\n" + std::to_string(walked) + " wish 0,-1\n20 wish 0,-1 jump\n";
    expect_event(walk_with(inputs.c_str()), "no jump", "left " + std::to_string(late) + " ticks before");
}

TEST_P(Events, AHeldButtonDoesNotJumpAgain) {
    expect_event(walk_with("20 wish 0,0\n90 wish 0,0 jump\n"), "no jump", "held");
}

TEST_P(Events, ATooSteepSlopeGivesNoJump) {
    const double slope = maker.between(55, 70) * std::numbers::pi / 180;
    Shapes ramp;
    ramp.group("thing").material("stone").ramp({-20, -40, 20}, 40, 40, 40 * std::tan(slope));
    shapes = ramp;
    spawn = Vec3(0, -40 + 20 * std::tan(slope) + 1.0, 0);
    expect_event(walk_with("60 wish 0,0\n5 wish 0,0 jump\n10 wish 0,0\n"), "no jump", "Too steep");
}

TEST_P(Events, BouncesAndLandingsAreReported) {
    SurfaceType rubber;
    rubber.name = "rubber";
    rubber.restitution = maker.between(0.5, 0.9);
    types.push_back(rubber);
    Shapes pad;
    pad.group("thing").material("mat__rubber").box({-20, -1, -20}, {20, 0, 20});
    spawn = Vec3(0, maker.between(2.0, 5.0), 0);
    const double fall = spawn.y();
    const Walked landed = walk_with("120 wish 0,0\n");
    expect_event(landed, "landed", "`floor`");
    ASSERT_NE(landed.of("landed"), nullptr);
    EXPECT_NEAR(landed.of("landed")->numbers.front().value, fall, 0.1);
    shapes = pad;
    expect_event(walk_with("120 wish 0,0\n"), "bounced", "Bounced off at");
}

TEST_P(Events, SlidingWithoutTheStickSaysOnWhat) {
    SurfaceType frozen;
    frozen.name = "frozen";
    frozen.keeps_energy = true;
    types.push_back(frozen);
    Shapes ice;
    ice.group("thing").material("water__frozen").box({-50, -1, -50}, {50, 0, 50});
    shapes = ice;
    expect_event(walk_with("10 wish 0,0\n60 wish 0,-1\n60 wish 0,0\n"), "slid", "keeps energy");
}

TEST_P(Events, ABeltCarriesWhoStandsStill) {
    SurfaceType belt;
    belt.name = "belt";
    belt.velocity = Vec3(maker.between(0.5, 5.0), 0, 0);
    types.push_back(belt);
    Shapes floor;
    floor.group("thing").material("rubber__belt").box({-50, -1, -50}, {50, 0, 50});
    shapes = floor;
    expect_event(walk_with("60 wish 0,0\n"), "carried", "Carried by the surface");
}

TEST_P(Events, AWallTurnsAside) {
    const double degrees = maker.between(25, 60), heading = degrees * std::numbers::pi / 180;
    shapes.box({2.0, 0, -40}, {2.5, 3, 20});
    char inputs[96];
    std::snprintf(inputs, sizeof inputs, "15 wish 0,0\n90 wish %.6f,%.6f\n", std::sin(heading),
                  -std::cos(heading));
    const Walked walked = walk_with(inputs);
    expect_event(walked, "turned aside", "`thing`");
    ASSERT_NE(walked.of("turned aside"), nullptr);
    EXPECT_NEAR(walked.of("turned aside")->numbers.front().value, degrees, 2.0);
}

TEST_P(Events, WhoIsSlowerUphillReadsWhy) {
    settings.constant_slope_speed = false;
    const double slope = maker.between(30, 45) * std::numbers::pi / 180;
    shapes.ramp({-5, 0, -2}, 10, 20, 20 * std::tan(slope));
    expect_event(walk_with("15 wish 0,0\n120 wish 0,-1\n"), "slower", "Slower than asked on `thing`");
}

TEST_P(Events, AStepThatTakesSeveralTicksIsReportedAsAWhole) {
    const double high = maker.between(0.15, 0.38);
    shapes.box({-8, 0, -30}, {8, high, -4});
    const Walked walked = walk_with("15 wish 0,0\n100 wish 0,-1\n");
    expect_event(walked, "stepped up", "`thing`");
    ASSERT_NE(walked.of("stepped up"), nullptr);
    EXPECT_NEAR(walked.of("stepped up")->numbers.front().value, high, 0.03);
}

TEST_P(Events, APushNamesThePlatformAndIsNoSlide) {
    const double speed = maker.between(1.0, 3.0), way = maker.between(1.9, 3.5);
    shapes.box({-4, 0.1, -1}, {-2, 2, 1});
    platforms.push_back(
        {.name = "ram",
         .group = "thing",
         .path = {{.offset = Vec3::Zero(), .speed = speed}, {.offset = Vec3(way, 0, 0), .speed = speed}},
         .repeat = PathRepeat::once});
    const Walked walked = walk_with("300 wish 0,0\n");
    expect_event(walked, "pushed", "`thing`");
    EXPECT_EQ(walked.of("slid"), nullptr) << events_text(walked.events, 1.0 / 60);
}

TEST_P(Events, AJumpThatFallsShortNamesTheGroundAhead) {
    const double length = maker.between(5.2, 5.8);
    Shapes pit;
    pit.group("floor").material("plaster").box({-8, -6, -4}, {8, 0, 5});
    pit.group("pit").box({-8, -6, -4 - length}, {8, -maker.between(2.0, 4.0), -4});
    pit.group("thing").box({-8, -6, -40}, {8, 0, -4 - length});
    shapes = pit;
    expect_event(walk_with("15 wish 0,0\n43 wish 0,-1\n60 wish 0,-1 jump\n40 wish 0,-1\n"), "fell short",
                 "short of `thing`");
}

TEST_P(Events, AWalkOnFlatGroundIsNoEvent) {
    const double heading = maker.between(0, 6.28);
    char inputs[96];
    std::snprintf(inputs, sizeof inputs, "15 wish 0,0\n90 wish %.6f,%.6f\n60 wish 0,0\n", std::sin(heading),
                  -std::cos(heading));
    const Walked walked = walk_with(inputs);
    EXPECT_TRUE(walked.events.empty()) << events_text(walked.events, 1.0 / 60);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Events, ::testing::Range(1, 9));

}  // namespace
}  // namespace slipface::test
