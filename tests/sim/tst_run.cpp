// Runs: the same bits as simulate(), from any tick on.
#include <gmock/gmock.h>

#include <cmath>

#include "sim/stripes.h"
#include "slipface/base/text.h"
#include "slipface/sim/channels.h"
#include "slipface/sim/compare.h"

namespace slipface::test {
namespace {

// Over all four stripes, with jumps, a hazard and a setting changed on the way.
std::shared_ptr<const Tape> long_tape() {
    Tape tape = tape_of({{30, {}},
                         {70, {Vec2(0, 1), {}}},
                         {1, {Vec2(0, 1), Button::jump}},
                         {150, {Vec2(0.3, 0.9), {}}},
                         {1, {Vec2(0, 0), Button::jump}},
                         {148, {Vec2(-0.5, 0.5), {}}}});
    tape.changes = {{97, "walk_speed=7"}, {211, "jump_speed=9"}};
    return std::make_shared<const Tape>(std::move(tape));
}

const Vec3 start(0, 0.95, 5);

TapeRun complete_run(const Stripes& stripes, std::shared_ptr<const Tape> tape,
                     std::size_t at_once = 1000000) {
    TapeRun run(std::move(tape), {}, start);
    while (!run.advance(stripes.scene(), at_once)) {
    }
    return run;
}

TEST(TapeRuns, HasTheBitsOfSimulate) {
    const Stripes stripes;
    const auto tape = long_tape();
    const SimulationReport report =
        simulate(stripes.scene(), {}, start, *tape, {.keep_states = true, .trace = nullptr});
    for (const std::size_t at_once : {1ul, 7ul, 64ul, 100000ul}) {
        const TapeRun run = complete_run(stripes, tape, at_once);
        ASSERT_EQ(run.samples().size(), 400u);
        EXPECT_EQ(run.hash(), report.end_hash) << at_once;
        for (std::size_t i = 0; i < 400; ++i) {
            ASSERT_EQ(run.samples()[i].position, report.states[i].position) << i;
            ASSERT_EQ(run.samples()[i].grounded, report.states[i].grounded) << i;
        }
        std::vector<SimulationEvent> events(run.events().begin(), run.events().end());
        std::erase_if(events, [](const SimulationEvent& e) { return e.kind == "contact"; });
        ASSERT_EQ(events.size(), report.events.size());
        for (std::size_t i = 0; i < events.size(); ++i) {
            EXPECT_EQ(events[i].tick, report.events[i].tick);
            EXPECT_EQ(events[i].kind, report.events[i].kind);
        }
    }
}

TEST(TapeRuns, AnyTickIsWorkedOutAgainWithTheSameBits) {
    const Stripes stripes;
    const auto tape = long_tape();
    const TapeRun run = complete_run(stripes, tape);
    const SimulationReport report =
        simulate(stripes.scene(), {}, start, *tape, {.keep_states = true, .trace = nullptr});
    for (const std::size_t tick : {0ul, 1ul, 63ul, 64ul, 96ul, 97ul, 98ul, 210ul, 211ul, 300ul, 399ul}) {
        const TickTrace trace = run.trace(stripes.scene(), tick);
        EXPECT_EQ(trace.tick, tick);
        EXPECT_EQ(trace.to, report.states[tick].position);
        EXPECT_EQ(trace.after.state, report.states[tick]) << tick;
        if (tick > 0) {
            EXPECT_EQ(trace.before, report.states[tick - 1]) << tick;
        }
        EXPECT_FALSE(trace.records.empty()) << tick;
        EXPECT_EQ(trace.settings.walk_speed, tick < 97 ? 6.0 : 7.0) << tick;
        EXPECT_EQ(trace.settings.jump_speed, tick < 211 ? 8.0 : 9.0) << tick;
    }
    EXPECT_EQ(run.state_before(stripes.scene(), 400), report.final_state);
}

TEST(TapeRuns, UnderOtherSettingsChangesOnTheWayDoNotCount) {
    const Stripes stripes;
    const auto tape = long_tape();
    MovementSettings slow;
    slow.walk_speed = 3.0;
    TapeRun run = TapeRun::under(tape, slow, start);
    run.advance(stripes.scene(), 400);
    EXPECT_EQ(run.settings_at(300), slow);
    Tape plain = *tape;
    plain.changes.clear();
    EXPECT_EQ(run.hash(), simulate(stripes.scene(), slow, start, plain).end_hash);
}

TEST(TapeRuns, CountsInHowManyTicksAHackActed) {
    const Stripes stripes;
    const TapeRun run = complete_run(stripes, long_tape());
    for (std::size_t row = 0; row < hack_rows().size(); ++row) {
        std::uint32_t counted = 0;
        for (std::size_t tick = 0; tick < run.length(); ++tick) {
            std::uint64_t acted = 0;
            for (const TraceRecord& record : run.trace(stripes.scene(), tick).records)
                acted |= hacks_acted(record);
            ASSERT_EQ(acted, run.samples()[tick].acted) << tick;
            counted += static_cast<std::uint32_t>((acted >> row) & 1);
        }
        EXPECT_EQ(run.acted_count(row), counted) << hack_rows()[row]->name;
    }
    EXPECT_GT(run.acted_count(*hack_row("static_friction")), 20u);
    TapeRun held(std::make_shared<const Tape>(tape_of({{60, {}}})), {}, Vec3(0, 1.5, 35));
    held.advance(stripes.scene(), 60);
    EXPECT_GT(held.acted_count(*hack_row("stick")), 20u) << "the sticky stripe holds to the end";
    EXPECT_EQ(run.acted_count(*hack_row("push_out")), 0u);
    EXPECT_FALSE(hack_row("gravity"));
}

TEST(TapeRuns, AHackThatIsSwitchedOffNeverActs) {
    const Stripes stripes;
    const auto tape = long_tape();
    for (const char* name : {"static_friction", "ground_velocity", "straight_ahead", "keep_energy"}) {
        MovementSettings settings = basic_settings();
        ASSERT_TRUE(set_setting(settings, std::string(name) + "=off").ok());
        TapeRun run = TapeRun::under(tape, settings, start);
        run.advance(stripes.scene(), 400);
        EXPECT_EQ(run.acted_count(*hack_row(name)), 0u) << name;
    }
}

TEST(TapeRuns, OfAnEmptyTapeIsComplete) {
    const Stripes stripes;
    TapeRun run(std::make_shared<const Tape>(), {}, start);
    EXPECT_TRUE(run.advance(stripes.scene(), 10));
    EXPECT_TRUE(run.trace(stripes.scene(), 0).records.empty());
    EXPECT_EQ(run.state_before(stripes.scene(), 5).position, start);
}

TEST(Channels, TheCsvHasTheSamplesBitByBit) {
    const Stripes stripes;
    const TapeRun run = complete_run(stripes, long_tape());
    const std::string csv = run_csv(run, stripes.surfaces);
    std::vector<std::string_view> lines = split(csv, '\n');
    ASSERT_EQ(lines.size(), 402u);  // header, ticks, the end after the last line
    const std::vector<std::string_view> names = split(lines[0], ',');
    for (std::size_t tick = 0; tick < 400; ++tick) {
        const std::vector<std::string_view> fields = split(lines[tick + 1], ',');
        ASSERT_EQ(fields.size(), names.size());
        const TickSample& sample = run.samples()[tick];
        const auto field = [&](std::string_view name) {
            return fields[static_cast<std::size_t>(std::find(names.begin(), names.end(), name) -
                                                   names.begin())];
        };
        ASSERT_EQ(parse_double(field("x")), sample.position.x());
        ASSERT_EQ(parse_double(field("vy")), sample.velocity.y());
        ASSERT_EQ(parse_double(field("speed")), sample.motion().norm());
        ASSERT_TRUE(!sample.grounded || tick < 5 || std::abs(sample.velocity.x()) > 0 ||
                    std::abs(sample.velocity.z()) > 0 || *parse_double(field("speed")) == 0.0);
        ASSERT_EQ(parse_double(field("height")), sample.position.y() - 0.9);
        ASSERT_EQ(parse_int(field("contacts")), sample.contacts);
        ASSERT_EQ(field("slope").empty(), sample.ground_face == no_id) << tick;
        ASSERT_EQ(field("surface"), sample.ground_face == no_id ? "" : stripes.surfaces[sample.surface].name);
        ASSERT_EQ(parse_int(field("static_friction")), (sample.acted >> *hack_row("static_friction")) & 1);
    }
}

TEST(Compare, FindsWhereTwoRunsPartAndByHowMuch) {
    const Stripes stripes;
    const auto tape = std::make_shared<const Tape>(tape_of({{30, {}}, {30, {Vec2(1, 0), {}}}}));
    MovementSettings slow;
    slow.walk_speed = 3.0;  // reached after 3 ticks of 60 m/s2: 1 m/s a tick
    TapeRun a(tape, {}, start), b = TapeRun::under(tape, slow, start);
    a.advance(stripes.scene(), 60);
    b.advance(stripes.scene(), 60);
    EXPECT_FALSE(compare_runs(a, a));
    const auto divergence = compare_runs(a, b);
    ASSERT_TRUE(divergence);
    EXPECT_EQ(divergence->first, 33u) << "ticks 30, 31 and 32 speed up alike";
    EXPECT_EQ(divergence->worst_tick, 59u);
    EXPECT_EQ(divergence->worst_m, divergence->end_m);
    EXPECT_EQ(divergence->end_m, (a.samples()[59].position - b.samples()[59].position).norm());
    // Speeds 6 and 3 for 27 ticks and the way from one to the other.
    EXPECT_NEAR(divergence->end_m, 3.0 * 27 / 60 - 0.075, 0.06);
}

TEST(Compare, OtherRatesHaveTheSameInputsAtTheSameTimes) {
    Tape tape = tape_of({{5, {}}, {1, {Vec2(0, 1), Button::jump}}, {6, {Vec2(1, 0), {}}}});
    tape.changes = {{7, "gravity=10"}};
    const Tape twice = tape_at_rate(tape, 120);
    EXPECT_EQ(twice.tick_count(), 24u);
    ASSERT_EQ(twice.segments.size(), 3u);
    EXPECT_EQ(twice.segments[0].ticks, 10);
    EXPECT_EQ(twice.segments[1].ticks, 2);
    EXPECT_TRUE(twice.segments[1].input.buttons.has(Button::jump));
    EXPECT_EQ(twice.changes, (std::vector<TapeChange>{{14, "gravity=10"}}));
    const Tape half = tape_at_rate(tape, 30);
    EXPECT_EQ(half.tick_count(), 6u);
    ASSERT_EQ(half.segments.size(), 3u);
    EXPECT_EQ(half.segments[0].ticks, 2);
    EXPECT_EQ(half.segments[1].ticks, 1) << "ticks 4 and 5: waits, then jumps, so it jumps";
    EXPECT_TRUE(half.segments[1].input.buttons.has(Button::jump));
    EXPECT_EQ(half.changes, (std::vector<TapeChange>{{4, "gravity=10"}}));
    EXPECT_EQ(tape_at_rate(tape, 60).tick_count(), 12u);
    EXPECT_EQ(tape_at_rate(Tape{}, 30).tick_count(), 0u);
}

TEST(Compare, RatesAgreeInFreeFallAndSayWhereTheyDoNot) {
    const Stripes stripes;
    const auto tape = std::make_shared<const Tape>(tape_of({{60, {}}}));
    TapeRun own(tape, {}, Vec3(0, 40, 5));
    own.advance(stripes.scene(), 60);
    for (const int hz : standard_rates) {
        const RateRow row = compare_rate(stripes.scene(), own, hz);
        EXPECT_EQ(row.run.samples().size(), static_cast<std::size_t>(hz));
        EXPECT_LT(row.worst_m, 1e-9) << hz;  // the displacement is exact for constant acceleration
    }
    const auto walk = std::make_shared<const Tape>(tape_of({{30, {}}, {31, {Vec2(1, 0), {}}}}));
    TapeRun walked(walk, {}, start);
    walked.advance(stripes.scene(), 61);
    EXPECT_EQ(compare_rate(stripes.scene(), walked, 60).worst_m, 0.0);
    const RateRow coarse = compare_rate(stripes.scene(), walked, 30);
    EXPECT_LT(coarse.worst_m, 0.01);
    EXPECT_GE(coarse.worst_m, coarse.end_m);
}

TEST(Compare, SaysWhatASwitchWouldHaveChanged) {
    const Stripes stripes;
    // Gliding on ice with the stick along: without its surface type the player would run.
    const auto tape = std::make_shared<const Tape>(tape_of({{90, {Vec2(0, 1), {}}}}));
    TapeRun run(tape, {}, Vec3(0, 0.95, 12));
    run.advance(stripes.scene(), 90);
    const std::vector<SwitchEffect> effects = switch_effects(stripes.scene(), run, 10, 30);
    ASSERT_FALSE(effects.empty());
    EXPECT_EQ(effects.front().setting, "surface_types=off");
    EXPECT_GT(effects.front().further_m, 1.0);
    MovementSettings off;
    off.surface_types = false;
    PlayerState state = run.state_before(stripes.scene(), 10);
    for (int i = 0; i < 30; ++i)
        state = step(stripes.scene(), off, state, {Vec2(0, 1), {}}, run.dt()).state;
    EXPECT_EQ(effects.front().end_speed, state.velocity.norm());
    for (std::size_t i = 1; i < effects.size(); ++i)
        EXPECT_GE(effects[i - 1].further_m, effects[i].further_m);
}

}  // namespace
}  // namespace slipface::test
