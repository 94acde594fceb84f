// Two branches that changed one file of facts: what each changed is in the merge, and only what both changed
// is a conflict.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "goldens/merge_facts.h"

namespace slipface {
namespace {

using Json = nlohmann::ordered_json;

TEST(MergeFacts, TakesWhatEachSideChanged) {
    const char* const base =
        R"({"members": {"spawn": [0, 1, 0], "fall": 3}, "order": [["floor"], ["roof"]]})";
    const auto merged = merge_facts(
        base, R"({"members": {"spawn": [0, 2, 0], "fall": 3}, "order": [["floor"], ["roof"], ["a"]]})",
        R"({"members": {"spawn": [0, 1, 0]}, "order": [["b"], ["roof"]], "light": true})");
    ASSERT_TRUE(merged.ok()) << merged.error().text();
    EXPECT_EQ(Json::parse(*merged), Json::parse(R"({"members": {"spawn": [0, 2, 0]},
        "order": [["roof"], ["a"], ["b"]], "light": true})"));
}

TEST(MergeFacts, NamesWhatBothChanged) {
    const auto merged =
        merge_facts(R"({"props": {"crate": {"x": 1, "y": 2}}})", R"({"props": {"crate": {"x": 2, "y": 2}}})",
                    R"({"props": {"crate": {"x": 3}}})");
    ASSERT_FALSE(merged.ok());
    EXPECT_EQ(merged.error().location, "/props/crate/x");
    // Removed on one side, changed on the other; and texts that git marked before.
    EXPECT_FALSE(merge_facts(R"({"a": 1})", R"({})", R"({"a": 2})").ok());
    EXPECT_FALSE(merge_facts("{}", "<<<<<<<", "{}").ok());
    EXPECT_TRUE(merge_facts("", R"({"a": 1})", R"({"b": 1})").ok());  // both added the file
}

// Whatever two sides do to different members, either order gives the same members.
TEST(MergeFacts, IsSymmetric) {
    std::mt19937 random(7);
    for (int round = 0; round < 200; ++round) {
        Json base, ours, theirs;
        for (int i = 0; i < 12; ++i)
            base["m" + std::to_string(i % 3)]["k" + std::to_string(i)] = static_cast<int>(random() % 9);
        ours = theirs = base;
        for (int i = 0; i < 12; ++i) {
            Json& side = random() % 2 == 0 ? ours : theirs;
            Json& group = side["m" + std::to_string(i % 3)];
            if (random() % 3 == 0)
                group.erase("k" + std::to_string(i));
            else if (random() % 2 == 0)
                group["k" + std::to_string(i)] = 100 + i;
        }
        const auto one = merge_facts(base.dump(), ours.dump(), theirs.dump()),
                   other = merge_facts(base.dump(), theirs.dump(), ours.dump());
        ASSERT_TRUE(one.ok() && other.ok());
        EXPECT_EQ(nlohmann::json::parse(*one), nlohmann::json::parse(*other));
        for (int i = 0; i < 12; ++i) {
            const std::string group = "m" + std::to_string(i % 3), key = "k" + std::to_string(i);
            const Json& changed =
                ours[group] != base[group] && ours[group].value(key, -1) != base[group].value(key, -1)
                    ? ours
                    : theirs;
            EXPECT_EQ(Json::parse(*one)[group].value(key, -1), changed[group].value(key, -1));
        }
    }
}

}  // namespace
}  // namespace slipface
