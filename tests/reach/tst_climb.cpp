// The course of assets/climb: each stage is passed with all abilities, and not without its own.
#include <gtest/gtest.h>

#include <stdexcept>

#include "slipface/level/level_file.h"
#include "slipface/reach/search.h"

namespace slipface {
namespace {

bool passes(const Level& level, std::size_t stage, std::uint64_t rounds) {
    const Vec3 start = stage == 0 ? level.spawn : level.goals[stage - 1].position;
    Result<ReachSearch> search = ReachSearch::begin(level, start, {});
    if (!search) throw std::runtime_error(search.error().text());
    ReachLimits limits;
    for (std::uint64_t done = 5; done <= rounds && !search->goals()[stage].found(); done += 5) {
        limits.rounds = done;
        search->run(limits);
    }
    return search->goals()[stage].found();
}

class Climb : public testing::TestWithParam<std::size_t> {};

TEST_P(Climb, AStageNeedsItsAbility) {
    constexpr std::array switches{"crouch",    "drop_through", "dash", "air_jump",
                                  "wall_jump", "ledge_grab",   "glide"};
    Result<LoadedLevel> loaded =
        load_level(std::filesystem::path(SLIPFACE_SOURCE_DIR) / "assets/climb/climb.obj");
    ASSERT_TRUE(loaded.ok()) << loaded.error().text();
    Level& level = loaded->level;
    ASSERT_EQ(level.goals.size(), switches.size());
    EXPECT_TRUE(passes(level, GetParam(), 300)) << level.goals[GetParam()].name;
    ASSERT_TRUE(set_setting(level.movement, *find_setting(switches[GetParam()]), 0.0).ok());
    EXPECT_FALSE(passes(level, GetParam(), 25)) << level.goals[GetParam()].name;
}

INSTANTIATE_TEST_SUITE_P(Stages, Climb, testing::Range<std::size_t>(0, 7));

}  // namespace
}  // namespace slipface
