// The first Play of levels without a spawn, and the doubts about how they were read, on drawn levels.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reach/drawn_levels.h"
#include "slipface/mesh/facing_doubt.h"
#include "slipface/mesh/size_doubt.h"
#include "slipface/mesh/up_doubt.h"

namespace slipface::test {
namespace {

Start start_of(const Level& level) {
    LevelScene scene = LevelScene::build(level).value();
    return find_start(level, scene, level.movement).value();
}

TEST(FirstPlay, IsOnFloorAndInNoSolid) {
    for (std::uint64_t seed = 1000; seed < 1140; ++seed) {
        const DrawnLevel drawn = drawn_level(seed);
        SCOPED_TRACE(testing::Message() << drawn.kind << ", seed " << seed);
        const Start start = start_of(drawn.level);
        EXPECT_TRUE(start.stands);
        EXPECT_FALSE(drawn.solid(start.position)) << start.note;
        LevelScene scene = LevelScene::build(drawn.level).value();
        PlayerState state = scene.player_at(start.position);
        for (int tick = 0; tick < 60; ++tick)
            state = step(scene.at(0.0), drawn.level.movement, state, {}, 1.0 / 60.0).state;
        EXPECT_TRUE(state.grounded);
        EXPECT_FALSE(state.trapped);
    }
}

TEST(FirstPlay, ReachesMoreThanHalfOfWhatAnyStartReaches) {
    for (std::uint64_t seed = 2000; seed < 2016; ++seed) {
        const DrawnLevel drawn = drawn_level(seed);
        const FirstPlay play = first_play(drawn, seed, 12, 20);
        EXPECT_GT(play.fraction(), 0.5) << drawn.kind << ", seed " << seed << ": " << play.start.note;
    }
}

TEST(Doubts, AreFalseInUnderTwoOfAHundredLevels) {
    constexpr int count = 400;
    int lying = 0, size = 0, facing = 0, said = 0, thick = 0;
    for (std::uint64_t seed = 3000; seed < 3000 + count; ++seed) {
        const DrawnLevel drawn = drawn_level(seed);
        const Mesh& mesh = *drawn.level.mesh;
        ImportSummary summary;
        summary.size = mesh.bounds.size();
        lying += up_doubt(mesh, summary) ? 1 : 0;
        size += size_doubt(mesh, summary) ? 1 : 0;
        facing += facing_doubt(mesh) ? 1 : 0;
        if (!drawn.thick) continue;
        ++thick;
        const DrawnLevel inverted = drawn_level(seed, true);
        const bool doubted = facing_doubt(*inverted.level.mesh).has_value();
        const bool noted = start_of(inverted.level).note.find("inside out") != std::string::npos;
        said += doubted || noted ? 1 : 0;
    }
    EXPECT_LT(lying, count / 50);
    EXPECT_LT(size, count / 50);
    EXPECT_LT(facing, count / 50);
    // One solid alone that is inside out may be a room, and a block with a cave a room with a rock in it.
    EXPECT_GT(said, thick * 7 / 10);
}

TEST(Doubts, ATowerHigherThanAnyIsTooLarge) {
    LevelDrawer draw(5);
    for (int i = 0; i < 20; ++i) {
        LevelDrawer tower(7);
        tower.solid(Vec3::Zero(), Vec3(draw.in(3, 8), draw.in(500, 3000), draw.in(3, 8)));
        const DrawnLevel drawn = tower.done("tower", true, Vec3::Zero());
        ImportSummary summary;
        summary.size = drawn.level.mesh->bounds.size();
        EXPECT_TRUE(size_doubt(*drawn.level.mesh, summary));
    }
}

}  // namespace
}  // namespace slipface::test
