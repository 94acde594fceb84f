// The trace: complete, in order, readable, and free when nobody listens.
#include <gmock/gmock.h>

#include <set>
#include <string_view>

#include "allocation_counter.h"
#include "test_geometry.h"

namespace slipface::test {

TEST(Trace, WithoutASinkAStepAllocatesNothing) {
    Lab lab;
    lab.floor();
    lab.slope(radians(30));
    lab.wall({3, -9}, {3, 9});
    lab.half_pipe(16, 5.0, ice);
    lab.ready();
    MovementSettings s = basic_settings();
    s.push_out = PushOut::analytic;
    PlayerState state = at({-2, 3, 0});
    const MovementScene scene = lab.scene();
    const long before = allocation_count();
    for (int i = 0; i < 300; ++i)
        state = step(scene, s, state, wish(1, 0.3, i % 50 == 0), tick).state;
    EXPECT_EQ(allocation_count(), before);
    // And the counter does count.
    TraceRecorder trace;
    step(scene, s, state, wish(1, 0), tick, &trace);
    EXPECT_GT(allocation_count(), before);
}

// A floor, a ramp, stairs, ice, a wedge, a lift, hills and sectors: something for every hack to do.
struct Everything {
    Lab lab, lift;
    Heightfield hills;
    std::vector<MovingPart> parts;

    Everything() {
        lab.floor(0.0, plain, 12.0);
        lab.polygon({{3, 0, -3}, {3, 0, 3}, {8, 2.5, 3}, {8, 2.5, -3}});
        for (int i = 0; i < 4; ++i) {
            const double z = -4.0 - 0.4 * i, low = 0.25 * i, high = low + 0.25;
            lab.polygon({{-2, low, z}, {2, low, z}, {2, high, z}, {-2, high, z}});
            lab.polygon({{-2, high, z}, {2, high, z}, {2, high, z - 0.4}, {-2, high, z - 0.4}});
        }
        lab.polygon({{-6, 0.01, 2}, {-6, 0.01, 6}, {-3, 0.01, 6}, {-3, 0.01, 2}}, ice);
        lab.polygon({{-9, 0.01, 2}, {-9, 0.01, 6}, {-6, 0.01, 6}, {-6, 0.01, 2}}, bouncy);
        lab.wall({10, -9}, {10, 9});
        lab.wall({10, 9}, {6, 8}, 0, 5);
        lab.wall({-10, -9}, {-10, 9}, -5, 20, ladder);
        lab.wall({-9, -10}, {9, -10}, -5, 20, sticky);
        lab.ready();
        lift.polygon({{-1, 0.5, 4}, {-1, 0.5, 7}, {2, 0.5, 7}, {2, 0.5, 4}});
        lift.wall({-1, 4}, {2, 4}, 0.0, 0.5);
        lift.ready();
        hills.columns = hills.rows = 9;
        hills.origin = Vec3(-12, 0, -12);
        hills.size = Vec2(24, 24);
        for (int i = 0; i < 81; ++i)
            hills.heights.push_back(0.3 * std::sin(1.7 * i) - 0.1);
    }
    // The lift rises by 1 m/s, as this tick sees it; its faces stay where they are, which is all the same
    // here.
    MovementScene scene(double dt) {
        const Vec3 rise(0.0, 1.0, 0.0);
        MovingPart part{.rest = &lift.world(), .begin = {}, .end = {}, .velocity = rise};
        part.begin.offset = -dt * rise;
        parts = {part};
        MovementScene all = lab.scene();
        all.platforms = parts;
        all.heightfield = &hills;
        all.sectors.size = 8.0;
        return all;
    }
};

TEST(Trace, WithoutASinkAStepWithEveryHackAllocatesNothing) {
    Everything world;
    const MovementScene scene = world.scene(tick);
    std::set<std::string> acted;
    std::array<bool, 6> seen{};  // on the ground, on the lift, climbing, stuck, on ice, in another sector
    long allocated = 0;
    // Where push-out is off, the nudge has something to do.
    for (const PushOut kind : {PushOut::off, PushOut::iterative, PushOut::analytic}) {
        MovementSettings s = every_hack();
        s.push_out = kind;
        s.sub_step = 1.0 / 240;
        Random random(41);
        for (int walker = 0; walker < 40; ++walker) {
            // Some begin inside the floor or a wall.
            PlayerState state;
            const Vec3 position(random.between(-10, 10), random.between(0.3, 3.0), random.between(-10, 10));
            put_in_scene(scene, position, state);
            const Vec2 motion(random.between(-1, 1), random.between(-1, 1));
            for (int i = 0; i < 150; ++i) {
                const PlayerInput input = wish(motion.x(), motion.y(), i % 70 == 60);
                // The same step with somebody listening says what acts.
                TraceRecorder trace;
                step(scene, s, state, input, tick, &trace);
                for (const TraceRecord& record : trace.records) {
                    const auto* decision = std::get_if<DecisionRecord>(&record);
                    if (decision != nullptr) {
                        const DecisionInfo& info = decision_info(decision->kind);
                        if (info.outcome == Outcome::acted) acted.insert(info.hack);
                    }
                    if (std::holds_alternative<PushOutRecord>(record)) acted.insert("push_out");
                }
                const long before = allocation_count();
                state = step(scene, s, state, input, tick).state;
                allocated += allocation_count() - before;
                seen[0] = seen[0] || state.grounded;
                seen[1] = seen[1] || state.ground_platform == 0;
                seen[2] = seen[2] || state.climbing;
                seen[3] = seen[3] || state.stuck;
                seen[4] = seen[4] || state.ground_surface == ice;
                seen[5] = seen[5] || state.sector != std::array<std::int32_t, 3>{0, 0, 0};
            }
        }
    }
    EXPECT_EQ(allocated, 0);
    EXPECT_THAT(seen, ::testing::Each(true));
    std::size_t hacks = 0;
    for (const SettingInfo& info : settings_table())
        hacks += (is_switch(info) || is_choice(info)) && acted.contains(info.name) ? 1 : 0;
    EXPECT_GE(hacks, 14u) << ::testing::PrintToString(acted);
}

TEST(Trace, TellsTheStepsOfASlideInOrder) {
    Lab lab;
    lab.wall({2, -9}, {2, 9});
    lab.ready();
    const MovementSettings s = basic_settings();
    TraceRecorder trace;
    const SlideResult result = slide_move(lab.scene(), s, {0, 5, 0}, {4, -1, 3}, &trace);
    ASSERT_EQ(trace.records.size(), 3u);
    const auto& first = std::get<SweepRecord>(trace.records[0]);
    const auto& response = std::get<ResponseRecord>(trace.records[1]);
    const auto& second = std::get<SweepRecord>(trace.records[2]);
    EXPECT_EQ(first.pass, Pass::slide);
    EXPECT_EQ(first.from, Vec3(0, 5, 0));
    EXPECT_EQ(first.move, Vec3(4, -1, 3));
    ASSERT_TRUE(first.contact.has_value());
    EXPECT_NEAR(first.contact->t, 1.6 / 4.0, 1e-6);      // 2 m less the radius, of 4 m
    EXPECT_NEAR(first.reached.x(), 1.6 - s.skin, 1e-6);  // and the skin
    const double used = (1.6 - s.skin) / 4.0;
    EXPECT_LT((response.remainder_before - (1 - used) * Vec3(4, -1, 3)).norm(), 1e-6);
    EXPECT_LT((response.remainder_after - (1 - used) * Vec3(0, -1, 3)).norm(), 1e-6);
    EXPECT_EQ(response.rule, Rule::slide);
    EXPECT_EQ(second.iteration, 1);
    EXPECT_EQ(second.from, first.reached);
    EXPECT_FALSE(second.contact.has_value());
    EXPECT_EQ(second.reached, result.position);
}

TEST(Trace, EveryDecisionHasASentenceWithItsNumbers) {
    for (const DecisionInfo& info : decision_table()) {
        const std::string_view sentence = info.sentence;
        EXPECT_TRUE(find_setting(info.hack) != nullptr || std::string_view(info.hack) == "never_inside")
            << sentence;
        EXPECT_EQ(info.unit == DecisionUnit::no_unit, sentence.find('{') == sentence.npos) << sentence;
        EXPECT_TRUE(sentence.front() >= 'A' && sentence.front() <= 'Z') << sentence;
        EXPECT_NE(sentence.back(), '.') << sentence;
        // A switch that is off is named as the settings name it.
        if (info.outcome == Outcome::switched_off) {
            EXPECT_NE(sentence.find(std::string(find_setting(info.hack)->label) + " is off"), sentence.npos)
                << sentence;
        }
    }
    for (const Rule rule : {Rule::slide, Rule::bounce, Rule::straight_ahead, Rule::keep_energy, Rule::stick,
                            Rule::crease, Rule::stop})
        EXPECT_STRNE(rule_name(rule), "unknown");
    EXPECT_STREQ(rule_name(static_cast<Rule>(99)), "unknown");
    for (const Pass pass : {Pass::slide, Pass::horizontal, Pass::vertical, Pass::probe})
        EXPECT_STRNE(pass_name(pass), "unknown");
}

TEST(Trace, EveryDecisionHasFiniteNumbersWhereItsSentenceHasSome) {
    Lab lab;
    lab.floor();
    lab.slope(radians(30), ice);
    lab.wall({3, -9}, {3, 9}, -5, 9, bouncy);
    lab.wall({-3, -9}, {-3, 9}, -5, 9, ladder);
    lab.ready();
    const MovementSettings s = basic_settings();
    TraceRecorder trace;
    PlayerState state = at({-1, 3, 0});
    for (int i = 0; i < 400; ++i) {
        state = step(lab.scene(), s, state, wish(i / 100 % 2 == 0 ? 1 : -1, 0.1, i % 60 == 0), tick, &trace)
                    .state;
    }
    int decisions = 0;
    for (const TraceRecord& record : trace.records) {
        const auto* decision = std::get_if<DecisionRecord>(&record);
        if (decision == nullptr) continue;
        ++decisions;
        const std::string_view sentence = decision_info(decision->kind).sentence;
        if (sentence.find("{value}") == sentence.npos) {
            EXPECT_EQ(decision->value, 0.0) << sentence;
        }
        EXPECT_TRUE(std::isfinite(decision->limit));
        EXPECT_TRUE(std::isfinite(decision->value));
    }
    EXPECT_GT(decisions, 100);
}

}  // namespace slipface::test
