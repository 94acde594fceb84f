#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "base/thread_team.h"

namespace slipface {
namespace {

using testing::HasSubstr;

TEST(Team, EveryRunOfItemsGivesEachProcessOne) {
    for (const std::size_t size : {1u, 2u, 3u, 7u, 64u}) {
        std::vector<std::size_t> of_first(size);
        for (std::size_t run = 0; run < 1000; ++run) {
            std::set<std::size_t> doers;
            for (std::size_t item = run * size; item < (run + 1) * size; ++item)
                doers.insert(doer_of(item, size));
            EXPECT_EQ(doers.size(), size);
            ++of_first[doer_of(run * size, size)];
        }
        // Nor does one process get the first of every run: the first of four tries may always be the
        // shortest.
        for (const std::size_t count : of_first)
            EXPECT_LT(count, size == 1 ? 1001 : 700) << size;
    }
}

TEST(Team, TheFirstErrorIsEverybodys) {
    test::ThreadTeam(3).run([](Team& team) {
        EXPECT_TRUE(agree(team, {}));
        const Status mine =
            team.rank() == 0 ? Status() : Error{"disk", "full " + std::to_string(team.rank())};
        const Status status = agree(team, mine);
        ASSERT_FALSE(status);
        EXPECT_EQ(status.error().text(), "disk: full 1 (rank 1)");
    });
}

TEST(Team, WhatDiffersIsNamed) {
    test::ThreadTeam(3).run([](Team& team) {
        const std::string level = team.rank() == 2 ? "b" : "a";
        EXPECT_TRUE(agree_on(team, {{"program", "1"}, {"level", "a"}}));
        const Status status = agree_on(team, {{"program", "1"}, {"level", level}});
        ASSERT_FALSE(status);
        EXPECT_EQ(status.error().text(), "rank 2: has another level than rank 0: b instead of a");
    });
}

}  // namespace
}  // namespace slipface
