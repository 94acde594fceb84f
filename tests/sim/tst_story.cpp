// Stories: every number is one of the trace, and every record is told.
#include <gmock/gmock.h>

#include <regex>

#include "sim/stripes.h"
#include "slipface/sim/story.h"

namespace slipface::test {
namespace {

using testing::HasSubstr;

// What a number of a line must be one of: the record's own values, worked out here again.
std::vector<double> values_of(const TraceRecord& record) {
    std::vector<double> values;
    const auto speeds = [&](double before, double after) {
        values.insert(values.end(), {before, after, after - before});
    };
    const auto length = [&](double metres) { values.insert(values.end(), {metres, metres * 1000.0}); };
    if (const auto* sweep = std::get_if<SweepRecord>(&record)) {
        length(sweep->move.norm());
        if (sweep->contact) {
            length(sweep->contact->t * sweep->move.norm());
            for (const double n : sweep->contact->normal)
                values.push_back(n);
            values.push_back(std::acos(std::clamp(sweep->contact->normal.y(), -1.0, 1.0)) * 180.0 / M_PI);
        }
    } else if (const auto* response = std::get_if<ResponseRecord>(&record)) {
        length(response->leftover_before.norm());
        length(response->leftover_after.norm());
        speeds(response->velocity_before.norm(), response->velocity_after.norm());
    } else if (const auto* decision = std::get_if<DecisionRecord>(&record)) {
        values = {decision->value, decision->limit};
    } else if (const auto* push = std::get_if<PushOutRecord>(&record)) {
        values.push_back(push->planes);
        length((push->to - push->from).norm());
    }
    return values;
}

std::vector<double> values_of(const TickTrace& trace, bool end) {
    const PlayerState& after = trace.after.stepped;
    const double before = trace.before.velocity.norm();
    if (!end) {
        const Vec2& wish = trace.input.wish;
        double heading = std::atan2(wish.x(), -wish.y()) * 180.0 / M_PI;
        if (heading < 0) heading += 360.0;
        return {before, 100.0 * wish.norm(), heading};
    }
    const double moved = (trace.to - trace.from).norm();
    return {moved, moved * 1000.0, before, after.velocity.norm(), after.velocity.norm() - before};
}

// A number as shown stands for the value: no other value with that text lies further away than its last
// digit.
void expect_shown(const StoryNumber& number) {
    const std::string digits = number.text.substr(0, number.text.find(' '));
    const std::size_t point = digits.find('.');
    const double unit =
        point == std::string::npos ? 1.0 : std::pow(10.0, -static_cast<double>(digits.size() - point - 1));
    EXPECT_NEAR(std::stod(digits), number.value, 0.5000001 * unit) << number.text;
}

void expect_equal_to_the_trace(const TickTrace& trace, SurfaceTable surfaces) {
    const std::vector<StoryLine> lines = tell(trace, surfaces);
    ASSERT_EQ(lines.size(), trace.records.size() + 2);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const StoryLine& line = lines[i];
        const bool whole = i == 0 || i + 1 == lines.size();
        ASSERT_EQ(line.record.has_value(), !whole);
        if (!whole) {
            ASSERT_EQ(*line.record, i - 1);
        }
        const std::vector<double> values =
            whole ? values_of(trace, i != 0) : values_of(trace.records[*line.record]);
        for (const StoryNumber& number : line.numbers) {
            EXPECT_NE(std::find(values.begin(), values.end(), number.value), values.end())
                << number.text << " in: " << line.text;
            expect_shown(number);
        }
        // No number stands in the text that is not listed, but names of faces and triangles.
        std::string rest = line.text;
        for (const StoryNumber& number : line.numbers) {
            const std::size_t at = rest.find(number.text);
            ASSERT_NE(at, std::string::npos) << number.text << " in: " << line.text;
            rest.erase(at, number.text.size());
        }
        rest = std::regex_replace(rest, std::regex("(triangle|face) [0-9]+"), "");
        EXPECT_FALSE(std::regex_search(rest, std::regex("[0-9]"))) << rest;
        EXPECT_TRUE(line.place.has_value()) << line.text;
    }
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

TEST(Story, NamesTheFaceItsTypeTheFeatureAndTheRule) {
    const Stripes stripes;
    const auto tape = std::make_shared<const Tape>(tape_of({{60, {}}}));
    TapeRun run(tape, {}, Vec3(0, 2, 15));
    run.advance(stripes.scene(), 60);
    const auto land = std::find_if(run.samples().begin(), run.samples().end(),
                                   [](const TickSample& sample) { return sample.contacts > 0; });
    const TickTrace trace =
        run.trace(stripes.scene(), static_cast<std::size_t>(land - run.samples().begin()));
    const std::string story = story_text(tell(trace, stripes.surfaces));
    EXPECT_THAT(story, HasSubstr("Begins: in the air at "));
    EXPECT_THAT(story, HasSubstr("touches the inside of triangle "));
    EXPECT_THAT(story, HasSubstr("(face 1, ice)"));
    EXPECT_THAT(story, HasSubstr("slope 0.0 deg"));
    EXPECT_THAT(story, HasSubstr("Ends: "));
}

TEST(Story, APushThatStaysInsideIsTrouble) {
    const std::vector<TraceRecord> records{
        PushOutRecord{.from = Vec3::Zero(), .to = Vec3(0, 0.25, 0), .planes = 2, .free = false}};
    const std::vector<StoryLine> lines = tell(records, {});
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0].tone, StoryTone::trouble);
    EXPECT_EQ(lines[0].text, "2 planes push the player by 250.0 mm; not free there, so it stays");
    EXPECT_EQ(telling_line(lines, records), 0u);
}

TEST(Story, TheTellingLineIsTheContactThatTookMostSpeed) {
    const std::vector<TraceRecord> records{
        ResponseRecord{.velocity_before = Vec3(6, 0, 0), .velocity_after = Vec3(5.99, 0, 0)},
        ResponseRecord{.velocity_before = Vec3(6, 0, 0), .velocity_after = Vec3(2, 0, 0)},
        ResponseRecord{.velocity_before = Vec3(2, 0, 0), .velocity_after = Vec3(1, 0, 0)}};
    EXPECT_EQ(telling_line(tell(records, {}), records), 1u);
    EXPECT_FALSE(telling_line(tell(std::span(records).first(1), {}), records));
}

}  // namespace
}  // namespace slipface::test
