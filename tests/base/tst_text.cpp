#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <utility>

#include "slipface/base/text.h"

namespace slipface {
namespace {

TEST(Text, ShortestTextReadsBackAsTheSameDouble) {
    EXPECT_EQ(to_text(0.1), "0.1");
    EXPECT_EQ(to_text(1e-7), "1e-07");
    EXPECT_EQ(to_text(-0.0), "-0");
    std::mt19937_64 random(7);
    for (int i = 0; i < 20000; ++i) {
        const std::uint64_t bits = random();
        double value = 0;
        std::memcpy(&value, &bits, sizeof value);
        if (!std::isfinite(value)) continue;
        const auto back = parse_double(to_text(value));
        // Subnormal numbers included: from_chars reads what to_chars wrote.
        ASSERT_TRUE(back.has_value()) << to_text(value);
        ASSERT_EQ(*back, value);
    }
}

TEST(Text, NumbersDoNotDependOnTheLocale) {
    const std::string before = std::setlocale(LC_ALL, nullptr);
    const bool comma = std::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr;
    EXPECT_EQ(to_text(1.5), "1.5");
    EXPECT_EQ(parse_double("1.5"), 1.5);
    EXPECT_EQ(parse_double("1,5"), std::nullopt);
    std::setlocale(LC_ALL, before.c_str());
    if (!comma) GTEST_SKIP() << "checked in the C locale only: no German locale here";
}

TEST(Text, ParseDoubleTakesAllOfTheTextOrNothing) {
    EXPECT_EQ(parse_double("+2.5"), 2.5);
    EXPECT_EQ(parse_double("-1e3"), -1000.0);
    EXPECT_EQ(parse_double(".5"), 0.5);
    for (const char* bad :
         {"", " 1", "1 ", "1x", "+", "-", "+-1", "++1", "nan", "inf", "-inf", "1e999", "0x10", "1e"}) {
        EXPECT_EQ(parse_double(bad), std::nullopt) << '"' << bad << '"';
    }
}

TEST(Text, ParseIntTakesAllOfTheTextOrNothing) {
    EXPECT_EQ(parse_int("-12"), -12);
    EXPECT_EQ(parse_int("+12"), 12);
    EXPECT_EQ(parse_int("9223372036854775807"), std::numeric_limits<std::int64_t>::max());
    for (const char* bad : {"", "1.0", "9223372036854775808", "0x1", "+-1", "1 "}) {
        EXPECT_EQ(parse_int(bad), std::nullopt) << '"' << bad << '"';
    }
}

TEST(Text, ParseVec3) {
    EXPECT_EQ(parse_vec3("1,-2.5,3e1"), Vec3(1, -2.5, 30));
    EXPECT_EQ(parse_vec3("1, 2, 3"), Vec3(1, 2, 3));
    for (const char* bad : {"", "1,2", "1,2,3,4", "1,,3", "1,2,nan", "1;2;3"}) {
        EXPECT_EQ(parse_vec3(bad), std::nullopt) << '"' << bad << '"';
    }
}

template <class Text>
concept Splits = requires(Text&& text) {
    split(std::forward<Text>(text), ',');
};
static_assert(Splits<std::string&> && Splits<const char (&)[4]>);
static_assert(!Splits<std::string>, "the parts would outlive it");

TEST(Text, TrimSplitLower) {
    EXPECT_EQ(trim(" \t a b\r\n"), "a b");
    EXPECT_EQ(trim(" \t\r\n"), "");
    EXPECT_EQ(split("a,,b", ','), (std::vector<std::string_view>{"a", "", "b"}));
    EXPECT_EQ(split("", ','), (std::vector<std::string_view>{""}));
    EXPECT_EQ(split("a,", ','), (std::vector<std::string_view>{"a", ""}));
    EXPECT_EQ(to_lower("Ice_CUBE \xC3\x84"), "ice_cube \xC3\x84");
}

TEST(Text, GlobMatch) {
    EXPECT_TRUE(glob_match("", ""));
    EXPECT_TRUE(glob_match("*", ""));
    EXPECT_TRUE(glob_match("*ice*", "wall_ice_2"));
    EXPECT_TRUE(glob_match("i?e", "ice"));
    EXPECT_TRUE(glob_match("a*b*c", "a-b-b-c"));
    EXPECT_TRUE(glob_match("*.001", "ice.001"));
    EXPECT_FALSE(glob_match("", "a"));
    EXPECT_FALSE(glob_match("ice", "Ice"));
    EXPECT_FALSE(glob_match("i?e", "ie"));
    EXPECT_FALSE(glob_match("a*b", "a-c"));
    EXPECT_FALSE(glob_match("*ab", "aab_"));
}

// Backtracking over every star would need about 10^6 choose 10 steps here; one star at a time needs some
// 10^7.
TEST(Text, GlobMatchDoesNotExplode) {
    const std::string text(1'000'000, 'a');
    EXPECT_FALSE(glob_match("*a*a*a*a*a*a*a*a*a*b", text));
    EXPECT_TRUE(glob_match("*a*a*a*a*a*a*a*a*a*a", text));
}

}  // namespace
}  // namespace slipface
