// A search that several processes share gives the bytes of one.
#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <filesystem>

#include "base/thread_team.h"
#include "slipface/base/files.h"
#include "slipface/level/level_file.h"
#include "slipface/reach/search.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

std::string stored(const ReachSearch& search) {
    std::string name = testing::TempDir() + "slipface-reach-XXXXXX";
    const int file = ::mkstemp(name.data());
    EXPECT_GE(file, 0);
    ::close(file);
    EXPECT_TRUE(search.store(name));
    std::string bytes = *read_file(name);
    fs::remove(name);
    return bytes;
}

// `island` has platforms that move, `easy` ladders and ice.
class TeamOfLevel : public testing::TestWithParam<const char*> {};

TEST_P(TeamOfLevel, GivesTheBytesOfOneProcess) {
    const auto loaded = load_level(std::string(SLIPFACE_SOURCE_DIR) + "/assets/levels/" + GetParam());
    ASSERT_TRUE(loaded);
    const Level& level = loaded->level;
    const std::uint64_t rounds = 6;
    Result<ReachSearch> alone = ReachSearch::begin(level, level.spawn, {});
    ASSERT_TRUE(alone) << alone.error().text();
    alone->run({.rounds = rounds});
    const std::string expected = stored(*alone);
    for (const std::size_t size : {2u, 5u}) {
        std::vector<std::string> found(size);
        test::ThreadTeam(size).run([&](Team& team) {
            Result<ReachSearch> search = ReachSearch::begin(level, level.spawn, {});
            ASSERT_TRUE(search);
            // Half of it, then what was stored goes on.
            ReachLimits limits{.rounds = rounds / 2, .seconds = 0.0, .until_goals = false, .team = &team};
            search->run(limits);
            const std::string half = team.from_first(team.rank() == 0 ? stored(*search) : "");
            search = ReachSearch::resume_text(level, half, "half");
            ASSERT_TRUE(search) << search.error().text();
            limits.rounds = rounds;
            search->run(limits);
            found[team.rank()] = stored(*search);
        });
        for (const std::string& bytes : found)
            EXPECT_TRUE(bytes == expected) << size << " processes";
    }
}

INSTANTIATE_TEST_SUITE_P(Levels, TeamOfLevel, testing::Values("easy.obj", "island.obj"));

TEST(ReachTeam, TimeIsOverForAllAtOnce) {
    const auto loaded = load_level(std::string(SLIPFACE_SOURCE_DIR) + "/assets/levels/easy.obj");
    ASSERT_TRUE(loaded);
    std::vector<std::uint64_t> hashes(3);
    std::vector<std::size_t> rounds(3);
    test::ThreadTeam(3).run([&](Team& team) {
        Result<ReachSearch> search = ReachSearch::begin(loaded->level, loaded->level.spawn, {});
        ASSERT_TRUE(search);
        // Each by its own clock would end elsewhere.
        search->run(
            {.rounds = {}, .seconds = team.rank() == 0 ? 0.3 : 0.001, .until_goals = false, .team = &team});
        hashes[team.rank()] = search->hash();
        rounds[team.rank()] = search->rounds().size();
    });
    EXPECT_GT(rounds[0], 0u);
    EXPECT_EQ(hashes, std::vector<std::uint64_t>(3, hashes[0]));
}

}  // namespace
}  // namespace slipface
