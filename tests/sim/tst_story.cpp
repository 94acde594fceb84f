// Stories: every number is one of the trace, and every record has its line.
#include <gmock/gmock.h>

#include <regex>

#include "sim/stripes.h"
#include "slipface/sim/story.h"

namespace slipface::test {
namespace {

using testing::HasSubstr;

struct Value {
    double value;
    std::string unit;
};
constexpr double degrees = 180.0 / M_PI;

void add_length(std::vector<Value>& values, double metres) {
    values.push_back({metres, " m"});
    values.push_back({metres * 1000.0, " mm"});
}

void add(std::vector<Value>& values, const DecisionInfo& info, double number) {
    switch (info.unit) {
        case DecisionUnit::metres: return add_length(values, number);
        case DecisionUnit::speed: return values.push_back({number, " m/s"});
        case DecisionUnit::seconds: return values.push_back({number, " s"});
        case DecisionUnit::percent: return values.push_back({100.0 * number, " %"});
        case DecisionUnit::slope:
        case DecisionUnit::angle:
            return values.push_back({std::acos(std::clamp(number, -1.0, 1.0)) * degrees, "\u00b0"});
        case DecisionUnit::lift:
            return values.push_back({std::asin(std::clamp(number, -1.0, 1.0)) * degrees, "\u00b0"});
        case DecisionUnit::no_unit: return;
    }
}

// What a number of a line must be one of: the record's own values, worked out here again, with their units.
std::vector<Value> values_of(const TraceRecord& record, const MovementSettings& settings) {
    std::vector<Value> values;
    if (const auto* sweep = std::get_if<SweepRecord>(&record)) {
        add_length(values, sweep->move.norm());
        if (sweep->contact) {
            const Contact& contact = *sweep->contact;
            add_length(values, contact.t * sweep->move.norm());
            const double tilt = std::acos(std::clamp(contact.normal.y(), -1.0, 1.0)) * degrees;
            values.push_back({tilt, "\u00b0"});
            values.push_back({tilt - 90.0, "\u00b0"});
            const double feet = sweep->from.y() + contact.t * sweep->move.y() - settings.radii.y();
            add_length(values, std::abs(contact.point.y() - feet));
        }
    } else if (const auto* response = std::get_if<ResponseRecord>(&record)) {
        add_length(values, response->remainder_before.norm());
        add_length(values, response->remainder_after.norm());
        values.push_back({response->velocity_before.norm(), " m/s"});
        values.push_back({response->velocity_after.norm(), " m/s"});
    } else if (const auto* decision = std::get_if<DecisionRecord>(&record)) {
        add(values, decision_info(decision->kind), decision->value);
        add(values, decision_info(decision->kind), decision->limit);
    } else if (const auto* push = std::get_if<PushOutRecord>(&record)) {
        values.push_back({static_cast<double>(push->planes), ""});
        add_length(values, (push->to - push->from).norm());
    }
    return values;
}

std::vector<Value> values_of(const TickTrace& trace, bool end) {
    if (!end) {
        const Vec2& wish = trace.input.wish;
        double heading = std::atan2(wish.x(), -wish.y()) * degrees;
        if (heading < 0) heading += 360.0;
        return {{trace.before.velocity.norm(), " m/s"}, {100.0 * wish.norm(), " %"}, {heading, "\u00b0"}};
    }
    std::vector<Value> values{{trace.after.stepped.velocity.norm(), " m/s"}};
    add_length(values, (trace.to - trace.from).norm());
    return values;
}

// A number as shown stands for the value: no other value with that text lies further away than its last
// digit.
void expect_shown(const StoryNumber& number) {
    const std::string& digits = number.text;
    const std::size_t point = digits.find('.');
    const double unit =
        point == std::string::npos ? 1.0 : std::pow(10.0, -static_cast<double>(digits.size() - point - 1));
    EXPECT_NEAR(std::stod(digits), number.value, 0.5000001 * unit) << number.text;
}

void expect_equal_to_the_trace(const TickTrace& trace, const StoryNames& names) {
    const std::vector<StoryLine> lines = describe(trace, names);
    ASSERT_EQ(lines.size(), trace.records.size() + 2);
    std::vector<bool> explained(trace.records.size(), false);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const StoryLine& line = lines[i];
        const bool whole = i == 0 || i + 1 == lines.size();
        ASSERT_EQ(line.record.has_value(), !whole);
        if (!whole) explained.at(*line.record) = true;
        const std::vector<Value> values =
            whole ? values_of(trace, i != 0) : values_of(trace.records[*line.record], trace.settings);
        std::string rest = std::regex_replace(line.text, std::regex("face [0-9]+"), "");
        for (const StoryNumber& number : line.numbers) {
            const bool found = std::any_of(values.begin(), values.end(), [&](const Value& value) {
                return value.value == number.value && value.unit == number.unit;
            });
            EXPECT_TRUE(found) << number.text << number.unit << " in: " << line.text;
            expect_shown(number);
            // No number stands in the text that is not listed, but names of faces, and each has its unit,
            // where it stands or at the end of "a of b".
            const std::size_t at = rest.find(number.text);
            ASSERT_NE(at, std::string::npos) << number.text << " in: " << line.text;
            rest.erase(at, number.text.size());
            EXPECT_TRUE(rest.substr(at).starts_with(number.unit) || rest.substr(at).starts_with(" of "))
                << line.text;
        }
        EXPECT_FALSE(std::regex_search(rest, std::regex("[0-9{}]"))) << rest;
        EXPECT_TRUE(line.position.has_value()) << line.text;
    }
    EXPECT_EQ(std::count(explained.begin(), explained.end(), false), 0);
}

TEST(Story, EveryNumberEqualsTheTrace) {
    const Stripes stripes;
    const auto tape = std::make_shared<const Tape>(tape_of({{30, {}},
                                                            {60, {Vec2(0, 1), false}},
                                                            {1, {Vec2(0, 1), true}},
                                                            {120, {Vec2(0.5, 0.5), false}},
                                                            {100, {Vec2(-1, 0), false}}}));
    for (const Vec3& start : {Vec3(0, 1.2, 5), Vec3(0, 1.2, 16), Vec3(0, 1.2, 27), Vec3(0, 2, 35)}) {
        TapeRun run(tape, {}, start);
        run.advance(stripes.scene(), TapeRun::max_ticks);
        for (std::size_t tick = 0; tick < run.length(); ++tick) {
            SCOPED_TRACE(tick);
            expect_equal_to_the_trace(run.trace(stripes.scene(), tick), stripes.surfaces);
            if (testing::Test::HasFailure()) return;
        }
    }
}

TEST(Story, NamesTheFaceItsTypeAndWhatWasTouched) {
    const Stripes stripes;
    const auto tape = std::make_shared<const Tape>(tape_of({{60, {}}}));
    TapeRun run(tape, {}, Vec3(0, 2, 15));
    run.advance(stripes.scene(), 60);
    const auto land = std::find_if(run.samples().begin(), run.samples().end(),
                                   [](const TickSample& sample) { return sample.contacts > 0; });
    const TickTrace trace =
        run.trace(stripes.scene(), static_cast<std::size_t>(land - run.samples().begin()));
    const std::string story = story_text(describe(trace, stripes.surfaces));
    EXPECT_THAT(story, HasSubstr("Begins: in the air at "));
    EXPECT_THAT(story, HasSubstr("Touched the floor (face 1, ice), level, after "));
    EXPECT_THAT(story, HasSubstr("Ends: "));
}

TEST(Story, WhatRestsIsFolded) {
    const Stripes stripes;
    TapeRun run(std::make_shared<const Tape>(tape_of({{60, {}}})), {}, Vec3(0, 0.95, 5));
    run.advance(stripes.scene(), 60);
    const std::vector<StoryLine> lines = describe(run.trace(stripes.scene(), 59), stripes.surfaces);
    std::vector<std::string> shown;
    for (const StoryLine& line : lines) {
        EXPECT_NE(line.tone, StoryTone::trouble) << line.text;
        if (!line.folded) shown.push_back(line.text);
    }
    ASSERT_EQ(shown.size(), 3U) << story_text(lines);
    EXPECT_EQ(shown[1], "Resting on the floor (face 0)");
}

TEST(Story, ABackFaceIsNamedAsOne) {
    const Stripes stripes;
    // From below the floor, upwards.
    TraceRecorder trace;
    slide_move(stripes.scene(), {}, Vec3(0, -2, 5), Vec3(0, 3, 0), &trace);
    const std::string story = story_text(describe(trace.records, stripes.surfaces));
    EXPECT_THAT(story, HasSubstr("Touched the back of the ceiling (face 0), overhead, after "));
}

TEST(Story, AValueBesideItsLimitHasAsManyDigitsAsItTakes) {
    const double limit = std::cos(50.0 / degrees), just_above = std::cos(50.004 / degrees);
    const std::vector<TraceRecord> records{
        DecisionRecord{.kind = Decision::too_steep_to_stand, .value = just_above, .limit = limit},
        DecisionRecord{.kind = Decision::jumped, .value = 8.0},
        DecisionRecord{.kind = Decision::energy_head_on, .value = 0.62, .limit = 0.5}};
    const std::vector<StoryLine> lines = describe(records, {});
    EXPECT_EQ(lines[0].text, "Too steep to stand on: 50.004\u00b0 (limit 50\u00b0)");
    EXPECT_EQ(lines[1].text, "Jumped at 8 m/s");
    EXPECT_EQ(lines[2].text, "Lost speed: hit head-on at 38.3\u00b0 (limit 30\u00b0)");
}

TEST(Story, APushThatStaysInsideIsTrouble) {
    const std::vector<TraceRecord> records{
        PushOutRecord{.from = Vec3::Zero(), .to = Vec3(0, 0.25, 0), .planes = 2, .free = false}};
    const std::vector<StoryLine> lines = describe(records, {});
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0].tone, StoryTone::trouble);
    EXPECT_EQ(lines[0].text, "Not pushed out of 2 faces: moving by 0.25 m would end inside another");
}

}  // namespace
}  // namespace slipface::test
