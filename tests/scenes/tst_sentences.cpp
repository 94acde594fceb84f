// Every sentence that explains movement, in one file for a person to read: tests/scenes/sentences.txt. After
// a change of wording read the new list aloud, then approve it:
//   SLIPFACE_APPROVE=1 build/release/tests/tests_scenes --gtest_filter='Sentences.*'
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "default_snags.h"
#include "other_snags.h"
#include "slipface/base/files.h"
#include "slipface/scenes/demo.h"
#include "slipface/sim/cures.h"
#include "slipface/sim/run_events.h"

namespace slipface::test {
namespace {

// Numbers differ from scene to scene and with every change of movement; the words are what is read here.
std::string without_numbers(const std::string& text) {
    return std::regex_replace(text, std::regex("[0-9]+(\\.[0-9]+)?"), "#");
}

struct Seen {
    std::set<Decision> decisions;
    std::set<std::string> sweeps, responses, headlines, events;
};

void look(const Level& level, const MovementSettings& settings, const Tape& tape, Seen& seen) {
    Result<LevelScene> built = LevelScene::build(level, settings);
    ASSERT_TRUE(built.ok());
    const TickScene scene(*built);
    TapeRun run(std::make_shared<const Tape>(tape), settings, tape.start.value_or(level.spawn));
    run.advance(scene, TapeRun::max_ticks);
    const auto without_names = [](const std::string& text) {
        return std::regex_replace(without_numbers(text), std::regex("`[^`]*`"), "`name`");
    };
    for (const Stop& stop : find_stops(scene, run, level))
        seen.headlines.insert(without_names(stop.headline));
    for (const RunEvent& event : find_events(scene, run, level))
        seen.events.insert(event.word + ": " + without_names(event.text));
    // Every third tick: long runs repeat themselves.
    for (std::size_t tick = 0; tick < run.samples().size(); tick += 3) {
        const TickTrace trace = run.trace(scene, tick);
        for (const StoryLine& line : describe(trace, StoryNames(level.surfaces))) {
            if (!line.record) continue;
            const TraceRecord& record = trace.records[*line.record];
            if (const auto* decision = std::get_if<DecisionRecord>(&record)) {
                seen.decisions.insert(decision->kind);
            } else if (std::holds_alternative<SweepRecord>(record)) {
                const std::string text =
                    std::regex_replace(line.text, std::regex("\\(face [^)]*\\)"), "(face #)");
                seen.sweeps.insert(without_numbers(text));
            } else {
                seen.responses.insert(without_numbers(line.text));
            }
        }
    }
}

std::string sentence_list(const Seen& seen) {
    std::string list = "Decisions, with made-up numbers; * none of the scenes gets there\n\n";
    for (const DecisionInfo& info : decision_table()) {
        const TraceRecord record = DecisionRecord{.kind = info.kind, .value = 0.51, .limit = 0.63};
        const std::vector<StoryLine> lines = describe(std::span(&record, 1), {});
        list += (seen.decisions.contains(info.kind) ? "  " : "* ") + lines[0].text + "\n";
    }
    const auto add = [&](const char* title, const std::set<std::string>& lines) {
        list += std::string("\n") + title + "\n\n";
        for (const std::string& line : lines)
            list += "  " + line + "\n";
    };
    add("Sweeps", seen.sweeps);
    add("Responses and pushes", seen.responses);
    add("Headlines", seen.headlines);
    add("Events", seen.events);
    return list;
}

std::set<std::string> sentences_in(const std::string& list) {
    std::set<std::string> sentences;
    std::istringstream lines(list);
    for (std::string line; std::getline(lines, line);)
        if (line.size() > 2) sentences.insert(line.substr(2));
    return sentences;
}

TEST(Sentences, AreTheOnesThatWereRead) {
    Seen seen;
    for (const DemoInfo& info : demo_table()) {
        const Demo demo = make_demo(info);
        look(demo.level, demo.on, demo.tape, seen);
        look(demo.level, demo.off, demo.tape, seen);
    }
    SnagMaker maker(1);
    for (const Snag& snag : maker.make())
        look(snag.level, snag.level.movement, snag.tape, seen);
    for (const Snag& snag : maker.make_under_defaults())
        look(snag.level, snag.level.movement, snag.tape, seen);
    for (const Snag& snag : maker.make_others())
        look(snag.level, snag.level.movement, snag.tape, seen);

    const std::string list = sentence_list(seen);
    const std::filesystem::path path =
        std::filesystem::path(SLIPFACE_SOURCE_DIR) / "tests/scenes/sentences.txt";
    if (std::getenv("SLIPFACE_APPROVE") != nullptr) {
        ASSERT_TRUE(write_file_atomic(path, list).ok());
    }
    const Result<std::string> text = read_file(path);
    ASSERT_TRUE(text.ok());
    const std::set<std::string> read = sentences_in(*text);
    // What the scenes no longer show may stay in the list; what they say anew is to be read first.
    for (const std::string& sentence : sentences_in(list))
        EXPECT_TRUE(read.contains(sentence)) << sentence;
    EXPECT_GE(seen.decisions.size(), decision_table().size() / 2);
}

}  // namespace
}  // namespace slipface::test
