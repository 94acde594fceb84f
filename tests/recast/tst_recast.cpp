// Links in Recast and Detour, as a game uses them: a way is found over a jump that the mesh alone has not.
#include <gtest/gtest.h>

#include <cstdio>

#include "reach/reach_scenes.h"
#include "recast/nav_mesh.h"
#include "slipface/level/level_file.h"
#include "slipface/reach/links.h"

namespace slipface::test {
namespace {

class RecastGap : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(RecastGap, IsCrossedByALinkAndNotWithout) {
    std::mt19937_64 random(GetParam());
    const MovementSettings settings = random_settings(random);
    const bool ledge = GetParam() % 2 == 0;
    const double size = 0.8 * max_possible(settings, ledge, 6);
    const double yaw = std::uniform_real_distribution<double>(0.0, 6.28)(random);
    const ReachScene scene =
        ledge ? gap_scene(settings, 0.5, size, yaw) : gap_scene(settings, size, 0.0, yaw);
    const ReachSearch search = search_of(scene, 60);
    const Connections links = connections_of(links_to_gset(search, search.links()));
    ASSERT_GT(links.size(), 0);

    const Vec3 feet = scene.start - Vec3(0.0, settings.radii.y(), 0.0);
    const auto without = NavMesh::build(scene.level, {});
    const auto with = NavMesh::build(scene.level, links);
    ASSERT_TRUE(without && with);
    EXPECT_FALSE(without->way(feet, scene.target).complete);
    const NavMesh::Way way = with->way(feet, scene.target);
    EXPECT_TRUE(way.complete);
    EXPECT_EQ(way.connections, 1);
}
INSTANTIATE_TEST_SUITE_P(Seeds, RecastGap, ::testing::Range<std::uint64_t>(1, 8));

// Parts of the level that the mesh alone does not come to are joined to the spawn's. Links from and to ledges
// that are narrower than the player are lost: Recast has no mesh there.
TEST(Recast, ComesToMoreOfALevelByLinks) {
    const Result<LoadedLevel> loaded = load_level(SLIPFACE_SOURCE_DIR "/assets/levels/easy.slipface.json");
    ASSERT_TRUE(loaded.ok());
    const ReachScene scene{loaded->level, loaded->level.spawn, {}};
    const ReachSearch search = search_of(scene, 60);
    const Connections links = connections_of(links_to_gset(search, search.links()));
    const auto without = NavMesh::build(scene.level, {});
    const auto with = NavMesh::build(scene.level, links);
    ASSERT_TRUE(without && with);
    const Vec3 feet = scene.start - Vec3(0.0, scene.level.movement.radii.y(), 0.0);
    const double before = without->area_from(feet), after = with->area_from(feet);
    std::printf("%.0f of %.0f m2 without links, %.0f with %d\n", before, with->area(), after, links.size());
    EXPECT_GT(after, before + 30.0);
}

}  // namespace
}  // namespace slipface::test
