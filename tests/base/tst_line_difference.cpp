#include <gtest/gtest.h>

#include <random>

#include "slipface/base/line_difference.h"

namespace slipface::test {
namespace {

std::string random_lines(std::mt19937& random) {
    std::string text;
    for (std::size_t i = random() % 40; i > 0; --i) {
        // Few letters, so that many lines are equal; '=' and '+' as rows have them.
        for (std::size_t letters = random() % 3; letters > 0; --letters)
            text += "a=+ 1"[random() % 5];
        if (random() % 8 != 0) text += '\n';
    }
    return text;
}

TEST(LineDifference, MakesTheTextAgain) {
    std::mt19937 random(1);
    for (int i = 0; i < 3000; ++i) {
        const std::string base = random_lines(random), text = random_lines(random);
        const auto again = apply_line_difference(base, line_difference(base, text), 1000);
        ASSERT_TRUE(again.has_value());
        EXPECT_EQ(*again, text) << base;
    }
}

TEST(LineDifference, OneLineOfManyIsOneRow) {
    std::string base, text;
    for (int i = 0; i < 1000; ++i) {
        base += std::to_string(i) + "\n";
        text += (i == 500 ? "other" : std::to_string(i)) + "\n";
        if (i == 700) text += "one more\n";
    }
    EXPECT_EQ(line_difference(base, text), "=0 500\n+other\n=501 200\n+one more\n=701 300\n");
    EXPECT_EQ(line_difference(base, base), "=0 1001\n");
}

TEST(LineDifference, RefusesWhatTheBaseLacks) {
    const std::string base = "a\nb\nc";
    for (const char* const bad : {"", "=0 3", "=0 4\n", "=3 1\n", "=-1 1\n", "=0 0\n", "=0\n", "= \n", "=\n",
                                  "\n", "-a\n", "=0 9223372036854775807\n", "=0 1\n\n"})
        EXPECT_FALSE(apply_line_difference(base, bad, 1000)) << bad;
    EXPECT_EQ(apply_line_difference(base, "=1 2\n+x\n", 7), "b\nc\nx");
    EXPECT_FALSE(apply_line_difference(base, "=1 2\n+x\n", 5)) << "too many bytes";
}

// Whatever the rows are, nothing is read beside the base.
TEST(LineDifference, SurvivesRandomRows) {
    std::mt19937 random(2);
    for (int i = 0; i < 20000; ++i) {
        std::string rows;
        for (std::size_t n = random() % 20; n > 0; --n)
            rows += "=+-019 \n"[random() % 8];
        const auto text = apply_line_difference("a\nb\nc\nd", rows, 50);
        EXPECT_LT(text ? text->size() : 0u, 50u);
    }
}

}  // namespace
}  // namespace slipface::test
