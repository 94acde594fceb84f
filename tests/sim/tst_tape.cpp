// The text of tapes.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

#include "slipface/sim/simulate.h"

namespace slipface::test {
namespace {

using testing::HasSubstr;

void expect_equal(const Tape& a, const Tape& b) {
    EXPECT_EQ(a.level_name, b.level_name);
    EXPECT_EQ(a.level_fingerprint, b.level_fingerprint);
    EXPECT_EQ(a.dt, b.dt);
    EXPECT_EQ(a.dt_text, b.dt_text);
    EXPECT_EQ(a.settings, b.settings);
    EXPECT_EQ(a.start, b.start);
    EXPECT_EQ(a.surfaces_fingerprint, b.surfaces_fingerprint);
    EXPECT_EQ(a.from_basic, b.from_basic);
    EXPECT_EQ(a.changes, b.changes);
    EXPECT_EQ(a.end_hash, b.end_hash);
    EXPECT_EQ(a.own_buttons, b.own_buttons);
    ASSERT_EQ(a.segments.size(), b.segments.size());
    for (std::size_t i = 0; i < a.segments.size(); ++i) {
        EXPECT_EQ(a.segments[i].ticks, b.segments[i].ticks);
        EXPECT_EQ(a.segments[i].input.wish, b.segments[i].input.wish);
        EXPECT_EQ(a.segments[i].input.buttons, b.segments[i].input.buttons);
    }
}

Tape parsed(std::string_view text) {
    Result<Tape> tape = parse_tape(text, "run.tape");
    if (!tape) {
        ADD_FAILURE() << tape.error().text();
        return {};
    }
    return std::move(*tape);
}

constexpr std::string_view full_tape = R"(slipface-tape 1
# recorded by hand

level easy hall.obj 1f2e3d4c5b6a7988
surfaces 0123456789abcdef
dt 1/120
settings defaults
set max_slope=0.7
  set  static_friction = off
start 0,1,-0.25
60 wish 0,-1
1	wish 0.6,-0.8 jump
set gravity=12
set walk_speed=5
30 jump
2
end fedcba9876543210
)";

TEST(Tape, ReadsEveryKindOfLine) {
    const Tape tape = parsed(full_tape);
    EXPECT_EQ(tape.level_name, "easy hall.obj");
    EXPECT_EQ(tape.level_fingerprint, 0x1f2e3d4c5b6a7988u);
    EXPECT_EQ(tape.dt, 1.0 / 120.0);
    EXPECT_EQ(tape.settings, (std::vector<std::string>{"max_slope=0.7", "static_friction = off"}));
    EXPECT_EQ(tape.start, Vec3(0, 1, -0.25));
    EXPECT_EQ(tape.tick_count(), 93u);
    ASSERT_EQ(tape.segments.size(), 4u);
    EXPECT_EQ(tape.segments[0].input.wish, Vec2(0, -1));
    EXPECT_EQ(tape.segments[1].input.wish, Vec2(0.6, -0.8));
    EXPECT_TRUE(tape.segments[1].input.buttons.has(Button::jump));
    EXPECT_TRUE(tape.segments[2].input.buttons.has(Button::jump));
    EXPECT_FALSE(tape.segments[3].input.buttons.has(Button::jump));
    EXPECT_EQ(tape.surfaces_fingerprint, 0x0123456789abcdefu);
    EXPECT_TRUE(tape.from_basic);
    EXPECT_EQ(tape.changes, (std::vector<TapeChange>{{61, "gravity=12"}, {61, "walk_speed=5"}}));
    EXPECT_EQ(tape.end_hash, 0xfedcba9876543210u);
}

TEST(Tape, ComesBackFromItsText) {
    const Tape tape = parsed(full_tape);
    expect_equal(parsed(tape_to_text(tape)), tape);
    expect_equal(parsed(tape_to_text(Tape{})), Tape{});
}

TEST(Tape, NumbersComeBackBitByBit) {
    Tape tape;
    tape.start = Vec3(1.0 / 3.0, -1e-300, 123456.789);
    append_tick(tape, {Vec2(std::sqrt(0.5), -std::sqrt(0.5)), {}});
    append_tick(tape, {Vec2(0.1, 1.0 / 7.0), Button::jump});
    expect_equal(parsed(tape_to_text(tape)), tape);
}

TEST(Tape, LineEndsOfWindowsAndAMissingLastOneAreFine) {
    const Tape tape = parsed("slipface-tape 1\r\ndt 0.02\r\n5 wish 1,0\r\n3 jump");
    EXPECT_EQ(tape.dt, 0.02);
    EXPECT_EQ(tape.tick_count(), 8u);
}

TEST(Tape, AppendedTicksAreGathered) {
    Tape tape;
    for (int i = 0; i < 10; ++i)
        append_tick(tape, {Vec2(0, 1), {Button::jump, i >= 7}});
    append_tick(tape, {});
    ASSERT_EQ(tape.segments.size(), 3u);
    EXPECT_EQ(tape.segments[0].ticks, 7);
    EXPECT_EQ(tape.segments[1].ticks, 3);
    EXPECT_EQ(tape.segments[2].ticks, 1);
}

TEST(Tape, AChangeInsideASegmentCutsItInTwo) {
    Tape tape;
    tape.segments = {{10, {Vec2(0, 1), {}}}};
    tape.changes = {{4, "gravity=10"}};
    const Tape read = parsed(tape_to_text(tape));
    ASSERT_EQ(read.segments.size(), 2u);
    EXPECT_EQ(read.segments[0].ticks, 4);
    EXPECT_EQ(read.changes, tape.changes);
}

TEST(Tape, IsCutAtATick) {
    const Tape tape = parsed(full_tape);
    const Tape cut = cut_tape(tape, 61);
    EXPECT_EQ(cut.tick_count(), 61u);
    EXPECT_TRUE(cut.changes.empty());  // they count from tick 61 on, which is not there
    EXPECT_FALSE(cut.end_hash);
    EXPECT_EQ(cut_tape(tape, 62).changes, tape.changes);
    EXPECT_EQ(cut_tape(tape, 1000).tick_count(), tape.tick_count());
    EXPECT_EQ(cut_tape(tape, 0).tick_count(), 0u);
}

struct BadTape {
    const char* name;
    const char* text;
    const char* location;
    const char* expected;
};

class BadTapes : public testing::TestWithParam<BadTape> {};

TEST_P(BadTapes, AreRefusedWithTheirLine) {
    const Result<Tape> tape = parse_tape(GetParam().text, "run.tape");
    ASSERT_FALSE(tape.ok());
    EXPECT_EQ(tape.error().location, GetParam().location) << tape.error().text();
    EXPECT_THAT(tape.error().message, HasSubstr(GetParam().expected));
}

constexpr BadTape bad_tapes[] = {
    {"Empty", "", "run.tape:1", "slipface-tape 1"},
    {"OnlyComments", "# a\n\n# b\n", "run.tape:3", "slipface-tape 1"},
    {"NoHeader", "dt 1/60\n", "run.tape:1", "dt 1/60"},
    {"LaterVersion", "slipface-tape 2\n", "run.tape:1", "slipface-tape 2"},
    {"UnknownWord", "slipface-tape 1\nspeed 3\n", "run.tape:2", "speed 3"},
    {"NoLevel", "slipface-tape 1\nlevel\n", "run.tape:2", "name"},
    {"TwoLevels", "slipface-tape 1\nlevel a\nlevel b\n", "run.tape:3", "second time"},
    {"ZeroDt", "slipface-tape 1\ndt 0\n", "run.tape:2", "\"0\""},
    {"LongDt", "slipface-tape 1\ndt 1/2\n", "run.tape:2", "0.25"},
    {"EndlessDt", "slipface-tape 1\ndt 1/0\n", "run.tape:2", "1/0"},
    {"TextDt", "slipface-tape 1\ndt 1/60s\n", "run.tape:2", "1/60s"},
    {"NegativeDt", "slipface-tape 1\ndt -1/60\n", "run.tape:2", "-1/60"},
    {"TwoDts", "slipface-tape 1\ndt 1/60\n\ndt 1/60\n", "run.tape:4", "second time"},
    {"LateDt", "slipface-tape 1\n5\ndt 1/60\n", "run.tape:3", "before all ticks"},
    {"ShortSurfaces", "slipface-tape 1\nsurfaces 12\n", "run.tape:2", "16 hexadecimal"},
    {"OtherBase", "slipface-tape 1\nsettings level\n", "run.tape:2", "settings basic"},
    {"LateBase", "slipface-tape 1\nset gravity=5\nsettings defaults\n", "run.tape:3", "before all settings"},
    {"EarlyEnd", "slipface-tape 1\nend 0123456789abcdef\n", "run.tape:2", "after the last tick"},
    {"AfterTheEnd", "slipface-tape 1\n1\nend 0123456789abcdef\n1\n", "run.tape:4", "nothing after"},
    {"UnknownSetting", "slipface-tape 1\nset max_slop=0.7\n", "run.tape:2", "max_slope"},
    {"BadSetting", "slipface-tape 1\nset gravity=up\n", "run.tape:2", "up"},
    {"NoSetting", "slipface-tape 1\nset\n", "run.tape:2", "name=value"},
    {"FlatStart", "slipface-tape 1\nstart 1,2\n", "run.tape:2", "1,2"},
    {"EndlessStart", "slipface-tape 1\nstart 1,2,inf\n", "run.tape:2", "inf"},
    {"NoTicks", "slipface-tape 1\n0 jump\n", "run.tape:2", "0 ticks"},
    {"NegativeTicks", "slipface-tape 1\n-5\n", "run.tape:2", "-5 ticks"},
    {"HugeTicks", "slipface-tape 1\n99999999999999999999\n", "run.tape:2", "99999999999999999999"},
    {"TooManyTicks", "slipface-tape 1\n10000001\n", "run.tape:2", "at most 10000000"},
    {"TooManyTicksInAll", "slipface-tape 1\n9999999\n2\n", "run.tape:3", "at most 10000000"},
    {"NoWish", "slipface-tape 1\n5 wish\n", "run.tape:2", "wish"},
    {"LongWish", "slipface-tape 1\n5 wish 1,1\n", "run.tape:2", "no longer than 1"},
    {"NanWish", "slipface-tape 1\n5 wish nan,0\n", "run.tape:2", "nan,0"},
    {"DeepWish", "slipface-tape 1\n5 wish 0,0,0\n", "run.tape:2", "0,0,0"},
    {"TrailingWord", "slipface-tape 1\n5 wish 0,1 jump jump\n", "run.tape:2", "[jump]"},
    {"ButtonTwice", "slipface-tape 1\n5 swim jump swim\n", "run.tape:2", "swim"},
    {"NoButton", "slipface-tape 1\n5 jump Swim\n", "run.tape:2", "Swim"},
    {"LongButton", "slipface-tape 1\n5 aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa\n", "run.tape:2", "aaaaa"},
    {"TooManyButtons", "slipface-tape 1\n5 a b c d e f g h i j k l m n o p q r s t u v w x\n1 y\n",
     "run.tape:3", "at most 24"},
    {"WrongOrder", "slipface-tape 1\n5 jump wish 0,1\n", "run.tape:2", "wish"},
};

INSTANTIATE_TEST_SUITE_P(Tapes, BadTapes, testing::ValuesIn(bad_tapes),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(Tape, KeepsEveryButton) {
    std::uint64_t random = 7;
    const auto below = [&](std::size_t count) {
        random = random * 6364136223846793005ULL + 1442695040888963407ULL;
        return static_cast<std::size_t>(random >> 33) % count;
    };
    for (int i = 0; i < 200; ++i) {
        // Names of the table, of a game, and of a newer program.
        std::vector<std::string> names;
        for (const ButtonInfo& info : button_table())
            names.emplace_back(info.name);
        const std::size_t own = below(ButtonSet::capacity - ButtonSet::first_own + 1);
        for (std::size_t k = 0; k < own; ++k)
            names.push_back("b" + std::to_string(below(1000) * 100 + k));
        std::string text = "slipface-tape 1\ndt 1/60\n";
        for (int line = 0; line < 20; ++line) {
            text += std::to_string(1 + below(90)) + (below(2) == 0 ? " wish 0,-1" : "");
            for (const std::string& name : names)
                if (below(3) == 0) text += " " + name;
            text += "\n";
        }
        const Tape tape = parsed(text);
        const std::string written = tape_to_text(tape);
        expect_equal(parsed(written), tape);
        // Nothing was lost: each line has the words that it had.
        std::istringstream before(text), after(written);
        for (std::string a, b; std::getline(before, a) && std::getline(after, b);) {
            std::istringstream x(a), y(b);
            const std::multiset<std::string> words_a{std::istream_iterator<std::string>(x), {}};
            const std::multiset<std::string> words_b{std::istream_iterator<std::string>(y), {}};
            ASSERT_EQ(words_a, words_b) << i;
        }
    }
}

TEST(Tape, ATapeWithoutNamesHasNamesByNumber) {
    Tape tape;
    PlayerInput input{.buttons = Button::dash};
    input.buttons.bits |= 1U << (ButtonSet::first_own + 2);
    append_tick(tape, input);
    EXPECT_THAT(tape_to_text(tape), HasSubstr("1 dash own3\n"));
    EXPECT_EQ(parsed(tape_to_text(tape)).own_buttons, std::vector<std::string>{"own3"});
}

TEST(Tape, TheLimitItselfIsAllowed) {
    EXPECT_EQ(parsed("slipface-tape 1\n9999999\n1\n").tick_count(), max_tape_ticks);
}

TEST(Tape, CutOffAnywhereItNeverCrashes) {
    for (std::size_t size = 0; size < full_tape.size(); ++size) {
        const Result<Tape> tape = parse_tape(full_tape.substr(0, size), "run.tape");
        if (size < 15) {
            EXPECT_FALSE(tape.ok()) << size;
        }
        if (!tape) {
            EXPECT_THAT(tape.error().location, HasSubstr("run.tape:"));
        }
    }
}

TEST(Tape, AMissingFileIsAnError) {
    const Result<Tape> tape = load_tape("missing/run.tape");
    ASSERT_FALSE(tape.ok());
    EXPECT_THAT(tape.error().text(), HasSubstr("missing/run.tape"));
}

TEST(Tape, AFileIsReadAndNamedInErrors) {
    const std::string path = testing::TempDir() + "slipface-run.tape";
    std::ofstream(path) << "slipface-tape 1\n7\nhop\n";
    const Result<Tape> tape = load_tape(path);
    std::filesystem::remove(path);
    ASSERT_FALSE(tape.ok());
    EXPECT_EQ(tape.error().location, path + ":3");
}

TEST(TapeSettings, AreAppliedInOrder) {
    Tape tape;
    tape.settings = {"gravity=10", "static_friction=off", "gravity=12"};
    MovementSettings settings = basic_settings();
    ASSERT_TRUE(apply_tape_settings(settings, tape, "run.tape").ok());
    EXPECT_EQ(settings.gravity, 12.0);
    EXPECT_FALSE(settings.static_friction);
}

TEST(TapeSettings, BeginWithTheBasicOnesIfTheTapeSaysSo) {
    Tape tape;
    tape.settings = {"gravity=10"};
    MovementSettings settings = basic_settings();
    settings.walk_speed = 1.0;
    ASSERT_TRUE(apply_tape_settings(settings, tape, "run.tape").ok());
    EXPECT_EQ(settings.walk_speed, 1.0);
    tape.from_basic = true;
    ASSERT_TRUE(apply_tape_settings(settings, tape, "run.tape").ok());
    EXPECT_EQ(settings.walk_speed, basic_settings().walk_speed);
    EXPECT_EQ(settings.gravity, 10.0);
    // Tapes that say "defaults" were written when these were the defaults.
    for (const char* word : {"defaults", "basic"}) {
        settings = MovementSettings{};
        const Tape read = parsed(std::string("slipface-tape 1\nsettings ") + word + "\n1\n");
        ASSERT_TRUE(apply_tape_settings(settings, read, "run.tape").ok());
        EXPECT_EQ(settings, basic_settings());
        EXPECT_THAT(tape_to_text(read), HasSubstr("settings basic\n"));
    }
}

TEST(TapeSettings, DifferencesTurnOneIntoTheOther) {
    MovementSettings from, to;
    to.gravity = 1.0 / 3.0;
    to.keep_energy = false;
    to.push_out = PushOut::iterative;
    EXPECT_TRUE(setting_changes(from, from).empty());
    for (const std::string& change : setting_changes(from, to))
        ASSERT_TRUE(set_setting(from, change).ok()) << change;
    EXPECT_EQ(from, to);
}

TEST(TapeSettings, ABadOneChangesNothing) {
    Tape tape;
    tape.settings = {"gravity=10", "gravity=-1"};
    MovementSettings settings = basic_settings();
    const Status status = apply_tape_settings(settings, tape, "run.tape");
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().location, "run.tape");
    EXPECT_THAT(status.error().message, HasSubstr("gravity=-1"));
    EXPECT_EQ(settings, basic_settings());
}

}  // namespace
}  // namespace slipface::test
