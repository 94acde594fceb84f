// Stories: every number is the one of the trace that its sentence means, and every record has its line.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <regex>

#include "sim/stripes.h"
#include "slipface/sim/story.h"

namespace slipface::test {
namespace {

using testing::HasSubstr;

constexpr double degrees = 180.0 / std::numbers::pi;

// A number that a line must show, worked out here again from the record. Lengths are shown in m or mm.
struct Value {
    double value;
    std::string unit;
};
Value metres(double length) {
    return {length, " m"};
}
Value speed(const Vec3& velocity) {
    return {velocity.norm(), " m/s"};
}
bool is_shown(const StoryNumber& number, const Value& value) {
    return (number.value == value.value && number.unit == value.unit) ||
           (value.unit == " m" && number.value == value.value * 1000.0 && number.unit == " mm");
}

Value value_of(const DecisionInfo& info, double number) {
    switch (info.unit) {
        case DecisionUnit::metres: return metres(number);
        case DecisionUnit::speed: return {number, " m/s"};
        case DecisionUnit::seconds: return {number, " s"};
        case DecisionUnit::percent: return {100.0 * number, " %"};
        case DecisionUnit::slope:
        case DecisionUnit::angle: return {std::acos(std::clamp(number, -1.0, 1.0)) * degrees, "\u00b0"};
        case DecisionUnit::lift: return {std::asin(std::clamp(number, -1.0, 1.0)) * degrees, "\u00b0"};
        case DecisionUnit::no_unit: break;
    }
    return {number, ""};
}

// What a line must say, in its order: words and the numbers between them.
struct Saying {
    std::vector<std::string> words;
    std::vector<Value> values;
};

void add_sweep(Saying& saying, const SweepRecord& sweep, const StoryLine& line,
               const MovementSettings& settings) {
    const double length = sweep.move.norm();
    if (!sweep.contact) {
        saying.words = {"Moved ", "nothing in the way"};
        saying.values = {metres(length)};
        return;
    }
    const Contact& contact = *sweep.contact;
    EXPECT_EQ(line.face, contact.face);
    const std::string face = "face " + std::to_string(contact.face);
    if (line.title.empty()) {
        saying.words = {"Resting on ", face};
        return;
    }
    const std::string thing = contact.feature == Feature::edge     ? "an edge"
                              : contact.feature == Feature::vertex ? "a corner"
                              : contact.normal.y() > 0.999         ? "the floor"
                                                                   : "";
    saying.words = {"Touched " + thing, face};
    const double tilt = std::acos(std::clamp(contact.normal.y(), -1.0, 1.0)) * degrees;
    if (tilt > 0.05 && std::abs(tilt - 90.0) > 0.05 && tilt < 179.95)
        saying.values.push_back({tilt > 90.0 ? tilt - 90.0 : tilt, "\u00b0"});
    if (contact.feature != Feature::interior) {
        const double feet = sweep.from.y() + contact.t * sweep.move.y() - settings.radii.y();
        saying.values.push_back(metres(std::abs(contact.point.y() - feet)));
        saying.words.emplace_back(contact.point.y() < feet ? "below the feet" : "above the feet");
    }
    saying.words.emplace_back("after ");
    saying.values.insert(saying.values.end(), {metres(contact.t * length), metres(length)});
}

void add_response(Saying& saying, const ResponseRecord& response) {
    static const std::map<Rule, std::string> begins{{Rule::slide, "Slid along it"},
                                                    {Rule::bounce, "Bounced"},
                                                    {Rule::stick, "Stuck"},
                                                    {Rule::straight_ahead, "Continued straight ahead"},
                                                    {Rule::stop, "Stopped"},
                                                    {Rule::keep_energy, "Turned along it at full speed"},
                                                    {Rule::crease, "Slid along the crease"}};
    // What a landing leaves is walked.
    const bool lands = response.rule == Rule::stop && !response.remainder_after.isZero(0.0);
    saying.words = {lands ? "Landed" : begins.at(response.rule)};
    const Value before = metres(response.remainder_before.norm()),
                after = metres(response.remainder_after.norm());
    if (after.value > 0.0) saying.values.push_back(after);
    saying.words.emplace_back(after.value > 0.0 ? "remain" : "are lost");
    saying.values.push_back(before);
    const Value from = speed(response.velocity_before), to = speed(response.velocity_after);
    if (std::abs(to.value - from.value) >= 0.005) saying.values.insert(saying.values.end(), {from, to});
}

// The sentence of the table with its numbers in place of {value} and {limit}.
void add_decision(Saying& saying, const DecisionRecord& decision) {
    const DecisionInfo& info = decision_info(decision.kind);
    std::string_view rest = info.sentence;
    for (std::size_t open = rest.find('{'); open != std::string_view::npos; open = rest.find('{')) {
        saying.words.emplace_back(rest.substr(0, open));
        rest.remove_prefix(open);
        const bool value = rest.starts_with("{value}");
        saying.values.push_back(value_of(info, value ? decision.value : decision.limit));
        rest.remove_prefix(rest.find('}') + 1);
    }
    saying.words.emplace_back(rest);
}

Saying saying_of(const TraceRecord& record, const StoryLine& line, const MovementSettings& settings) {
    Saying saying;
    if (const auto* sweep = std::get_if<SweepRecord>(&record)) {
        add_sweep(saying, *sweep, line, settings);
    } else if (const auto* response = std::get_if<ResponseRecord>(&record)) {
        add_response(saying, *response);
    } else if (const auto* decision = std::get_if<DecisionRecord>(&record)) {
        add_decision(saying, *decision);
    } else if (const auto* push = std::get_if<PushOutRecord>(&record)) {
        saying.words = {push->free ? "Pushed out of " : "Not pushed out of "};
        saying.values = {{static_cast<double>(push->planes), ""}, metres((push->to - push->from).norm())};
    }
    return saying;
}

// One who rests on the ground has no speed to be shown.
std::vector<Value> speed_of(const PlayerState& state) {
    const Value value = speed(motion_velocity(state));
    if (state.grounded && value.value < 5e-4) return {};
    return {value};
}

Saying saying_of_begin(const TickTrace& trace) {
    Saying saying{{trace.before.grounded ? "standing on face "
                   : trace.before.stuck  ? "stuck to face "
                                         : "in the air"},
                  speed_of(trace.before)};
    const Vec2& wish = trace.input.wish;
    if (wish.isZero(0.0)) return saying;
    double heading = std::atan2(wish.x(), -wish.y()) * degrees;
    if (heading < 0) heading += 360.0;
    saying.words.emplace_back(", stick ");
    saying.values.insert(saying.values.end(), {{100.0 * wish.norm(), " %"}, {heading, "\u00b0"}});
    return saying;
}

Saying saying_of_end(const TickTrace& trace) {
    const PlayerState& end = trace.after.stepped;
    Saying saying{{end.grounded ? "standing on face "
                   : end.stuck  ? "stuck to face "
                                : "in the air",
                   ", moved "},
                  speed_of(end)};
    saying.values.push_back(metres((trace.to - trace.from).norm()));
    return saying;
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
        const Saying saying = i == 0  ? saying_of_begin(trace)
                              : whole ? saying_of_end(trace)
                                      : saying_of(trace.records[*line.record], line, trace.settings);
        std::size_t said = 0;
        for (const std::string& words : saying.words) {
            said = line.text.find(words, said);
            ASSERT_NE(said, std::string::npos) << '"' << words << "\" in: " << line.text;
            said += words.size();
        }
        ASSERT_EQ(line.numbers.size(), saying.values.size()) << line.text;
        std::string rest = std::regex_replace(line.text, std::regex("face [0-9]+"), "");
        for (std::size_t k = 0; k < line.numbers.size(); ++k) {
            const StoryNumber& number = line.numbers[k];
            EXPECT_TRUE(is_shown(number, saying.values[k])) << number.text << number.unit << " instead of "
                                                            << saying.values[k].value << " in: " << line.text;
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

void expect_run_equal_to_the_trace(const MovementScene& scene, std::shared_ptr<const Tape> tape,
                                   const MovementSettings& settings, const Vec3& start) {
    TapeRun run(std::move(tape), settings, start);
    run.advance(scene, TapeRun::max_ticks);
    for (std::size_t tick = 0; tick < run.length() && !testing::Test::HasFailure(); ++tick) {
        SCOPED_TRACE(tick);
        expect_equal_to_the_trace(run.trace(scene, tick), scene.surfaces);
    }
}

TEST(Story, EveryNumberEqualsTheTrace) {
    const Stripes stripes;
    const auto tape = std::make_shared<const Tape>(tape_of({{30, {}},
                                                            {60, {Vec2(0, 1), {}}},
                                                            {1, {Vec2(0, 1), Button::jump}},
                                                            {120, {Vec2(0.5, 0.5), {}}},
                                                            {100, {Vec2(-1, 0), {}}}}));
    for (const Vec3& start : {Vec3(0, 1.2, 5), Vec3(0, 1.2, 16), Vec3(0, 1.2, 27), Vec3(0, 2, 35)})
        expect_run_equal_to_the_trace(stripes.scene(), tape, {}, start);
}

// A kerb of 0.3 m across the way, and 2 m behind its edge a wall: edges are touched, and moves cut short.
TEST(Story, EveryNumberAtAKerbAndAWallEqualsTheTrace) {
    std::vector<Vec3f> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<FaceId> faces;
    const std::array<Vec2, 5> profile{Vec2(-9, 0), Vec2(2, 0), Vec2(2, 0.3), Vec2(4, 0.3), Vec2(4, 5)};
    for (const Vec2& corner : profile)
        for (const double z : {-9.0, 9.0})
            positions.push_back(Vec3(corner.x(), corner.y(), z).cast<float>());
    for (std::uint32_t face = 0; face + 1 < profile.size(); ++face) {
        const std::uint32_t i = 2 * face;
        triangles.insert(triangles.end(), {{i, i + 1, i + 3}, {i, i + 3, i + 2}});
        faces.insert(faces.end(), {face, face});
    }
    const Result<CollisionWorld> world = CollisionWorld::build({positions, triangles, faces});
    ASSERT_TRUE(world.ok());
    const std::vector<SurfaceType> surfaces = preset_surface_types();
    const auto tape = std::make_shared<const Tape>(tape_of({{150, {Vec2(0.9, 0.2), {}}}}));
    for (const bool step_up : {true, false}) {
        MovementSettings settings;
        settings.step_up = step_up;
        expect_run_equal_to_the_trace({*world, surfaces}, tape, settings, Vec3(0, 0.95, 0));
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
