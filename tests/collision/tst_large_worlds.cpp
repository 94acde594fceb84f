// Large worlds of mixed density; slipface_large_worlds tries many more of them.
#include <gtest/gtest.h>

#include "large_worlds.h"

namespace slipface {
namespace {

class LargeWorlds : public testing::TestWithParam<std::uint64_t> {};

TEST_P(LargeWorlds, AnswerAsTheirLeaves) {
    scenes::LargeWorld world(GetParam(), 30'000, 6);
    EXPECT_EQ(world.fault(), "");
    EXPECT_GT(world.hits(), 0u);
}

INSTANTIATE_TEST_SUITE_P(Seeds, LargeWorlds, testing::Range<std::uint64_t>(1, 17));

}  // namespace
}  // namespace slipface
