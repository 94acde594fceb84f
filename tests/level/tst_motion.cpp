// Platforms, terrain and sectors: the level file, and where things are when.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "slipface/base/files.h"
#include "slipface/level/level_file.h"
#include "slipface/level/level_scene.h"
#include "slipface/mesh/build.h"

namespace slipface {
namespace {

Level two_boards() {
    PolygonSoup soup;
    soup.groups = {"floor", "lift"};
    soup.face_first_corner = {0};
    const auto board = [&](float x, std::uint32_t group) {
        for (const Vec3f& corner : {Vec3f(x, 0, 0), Vec3f(x, 0, 2), Vec3f(x + 2, 0, 2), Vec3f(x + 2, 0, 0)})
            soup.corner_position.push_back(corner);
        soup.face_first_corner.push_back(static_cast<std::uint32_t>(soup.corner_position.size()));
        soup.face_group.push_back(group);
    };
    board(0, 0);
    board(4, 1);
    Level level;
    level.mesh = build_mesh(soup).value();
    level.overrides.resize(2);
    level.mesh_path = "boards.obj";
    level.file_path = "boards.slipface.json";
    return level;
}

Platform lift() {
    Platform platform;
    platform.name = platform.group = "lift";
    platform.path = {{.offset = {0, 0, 0}, .speed = 2.0, .pause_s = 1.0},
                     {.offset = {0, 4, 0}, .speed = 1.0, .pause_s = 0.5}};
    return platform;
}

TEST(Platform, WalksItsPathThereAndBack) {
    // 1 s of rest, 4 m at 2 m/s: 2 s, half a second of rest, and back as fast: 2 s; 5.5 s in all.
    Platform p = lift();
    EXPECT_DOUBLE_EQ(path_period(p), 5.5);
    const auto height = [&](double t) { return platform_pose(p, t).offset.y(); };
    EXPECT_DOUBLE_EQ(height(-3), 0.0);
    EXPECT_DOUBLE_EQ(height(0.9), 0.0);
    EXPECT_DOUBLE_EQ(height(2.0), 2.0);
    EXPECT_DOUBLE_EQ(height(3.0), 4.0);
    EXPECT_DOUBLE_EQ(height(3.4), 4.0);
    EXPECT_DOUBLE_EQ(height(4.5), 2.0);
    EXPECT_NEAR(height(5.5 * 1000 + 2.0), 2.0, 1e-9);
    p.repeat = PathRepeat::once;
    EXPECT_DOUBLE_EQ(height(100), 4.0);
    p.repeat = PathRepeat::loop;  // from the last point at its own 1 m/s to the first: 1 + 2 + 0.5 + 4
    EXPECT_DOUBLE_EQ(path_period(p), 7.5);
    EXPECT_DOUBLE_EQ(height(5.5), 2.0);
    p.phase_s = 2.0;
    EXPECT_DOUBLE_EQ(height(0.0), 2.0);
}

TEST(Platform, TurnsAboutItsAxis) {
    Platform p;
    p.spin_rate = 0.5 * 3.141592653589793;
    p.spin_pivot = {1, 0, 0};
    // A quarter turn about +Y takes +X to -Z.
    EXPECT_LT((platform_pose(p, 1.0).apply({3, 5, 0}) - Vec3(1, 5, -2)).norm(), 1e-12);
    EXPECT_LT((platform_pose(p, 4e5 + 1.0).apply({3, 5, 0}) - Vec3(1, 5, -2)).norm(), 1e-8);
}

TEST(SinCos, AgreesWithTheLibrary) {
    for (double angle = -50.0; angle < 50.0; angle += 0.0137) {
        EXPECT_NEAR(sin_cos(angle).sine, std::sin(angle), 2e-15 * (1.0 + std::abs(angle)));
        EXPECT_NEAR(sin_cos(angle).cosine, std::cos(angle), 2e-15 * (1.0 + std::abs(angle)));
    }
}

TEST(LevelFileMotion, KeepsPlatformsTerrainAndSectors) {
    Level level = two_boards();
    level.platforms = {lift()};
    level.platforms[0].spin_rate = 0.25;
    level.heightfield =
        HeightfieldSource{.file = "hills.png", .origin = {1, 2, 3}, .size = {4, 5}, .low = -1, .high = 7};
    level.sectors = {.size = 512, .placement = {1e6, 0, 3}};
    level.unknown.json =
        R"({"/platforms/lift":{"mood":"calm"},"/platforms/lift/path/1":{"bell":true},"/sectors":{"x":1}})";
    const std::string text = level_to_json(level);
    const auto read = level_from_json(text, "boards.slipface.json", level.mesh);
    ASSERT_TRUE(read.ok()) << read.error().text();
    EXPECT_EQ(read->level.platforms, level.platforms);
    EXPECT_EQ(read->level.heightfield, level.heightfield);
    EXPECT_EQ(read->level.sectors, level.sectors);
    EXPECT_NE(text.find("\"mood\": \"calm\""), std::string::npos);
    EXPECT_EQ(level_to_json(read->level), text);
}

TEST(LevelFileMotion, ErrorsOfTheNewPartsNameTheirPlace) {
    const Level level = two_boards();
    const auto error = [&](const std::string& member) {
        const auto read = level_from_json("{\"slipface\": 1, " + member + "}", "b.json", level.mesh);
        return read ? std::string() : read.error().text();
    };
    const auto names = [&](const std::string& member, const char* location) {
        EXPECT_NE(error(member).find(location), std::string::npos) << member << ": " << error(member);
    };
    names(R"("platforms": 3)", "/platforms");
    names(R"("platforms": [{"group": "lift"}])", "/platforms/0");
    names(R"("platforms": [{"name": "a", "group": "lift", "repeat": "never"}])", "/platforms/0/repeat");
    names(R"("platforms": [{"name": "a", "group": "lift", "path": [{"speed": 1}]}])", "/platforms/0/path/0");
    names(R"("platforms": [{"name": "a", "group": "lift", "path": [{"offset": [0,0,0], "speed": 0}]}])",
          "/platforms/0/path/0/speed");
    names(R"("platforms": [{"name": "a", "group": "lift", "spin": {"axis": [0,0,0]}}])",
          "/platforms/0/spin/axis");
    names(R"("heightfield": {"size": [1, 2]})", "/heightfield");
    names(R"("heightfield": {"file": "x", "size": [1]})", "/heightfield/size");
    names(R"("sectors": {"size": 0.5})", "/sectors/size");
    const auto missing = level_from_json(
        R"({"slipface": 1, "platforms": [{"name": "a", "group": "nowhere"}]})", "b.json", level.mesh);
    ASSERT_TRUE(missing.ok());
    ASSERT_FALSE(missing->warnings.empty());
    EXPECT_NE(missing->warnings.back().text().find("nowhere"), std::string::npos);
}

TEST(Terrain, ComesFromA16BitPicture) {
    const auto folder = std::filesystem::path(::testing::TempDir()) / "slipface-terrain";
    std::filesystem::create_directories(folder);
    Level level = two_boards();
    level.file_path = folder / "boards.slipface.json";
    level.heightfield =
        HeightfieldSource{.file = "hills.png", .origin = {0, 10, 0}, .size = {2, 2}, .low = 0, .high = 65535};
    const GreyImage image{.width = 3, .height = 3, .values = {0, 1, 2, 300, 301, 302, 65533, 65534, 65535}};
    ASSERT_TRUE(save_grey_png(folder / "hills.png", image).ok());
    ASSERT_TRUE(load_terrain(level).ok());
    EXPECT_DOUBLE_EQ(terrain_at(*level.terrain, 0, 0)->height, 10.0);
    EXPECT_DOUBLE_EQ(terrain_at(*level.terrain, 2, 0)->height, 12.0);   // columns along +X
    EXPECT_DOUBLE_EQ(terrain_at(*level.terrain, 0, 1)->height, 310.0);  // rows along +Z
    EXPECT_DOUBLE_EQ(terrain_at(*level.terrain, 0.5, 0)->height, 10.5);
    EXPECT_FALSE(terrain_at(*level.terrain, -0.1, 0));
    // Black is `low`, white is `high`: 15 m from one to the other, above the origin's 10 m.
    level.heightfield->low = -5;
    level.heightfield->high = 10;
    ASSERT_TRUE(load_terrain(level).ok());
    EXPECT_DOUBLE_EQ(terrain_at(*level.terrain, 0, 0)->height, 5.0);
    EXPECT_DOUBLE_EQ(terrain_at(*level.terrain, 2, 2)->height, 20.0);
    ASSERT_TRUE(write_file_atomic(folder / "hills.png", "no picture").ok());
    const Status status = load_terrain(level);
    ASSERT_FALSE(status.ok());
    EXPECT_NE(status.error().text().find("hills.png"), std::string::npos);
    EXPECT_EQ(level.terrain, nullptr);
    std::filesystem::remove_all(folder);
}

TEST(LevelScene, IsAPureFunctionOfTime) {
    Level level = two_boards();
    level.platforms = {lift()};
    Result<LevelScene> scene = LevelScene::build(level);
    ASSERT_TRUE(scene.ok());
    EXPECT_FALSE(scene->is_static());
    const auto top = [&](double t) {
        const MovementScene now = scene->at(t, 0.1);
        EXPECT_EQ(now.collision.triangle_count(), 2U);
        EXPECT_EQ(now.platforms.size(), 1U);
        EXPECT_EQ(now.platforms[0].triangles[0], 2U);  // numbers of the mesh
        const auto hit = cast_ray(now.platforms[0].at_end(), {5, 10, 1}, {0, -1, 0});
        return hit ? hit->point.y() : -1.0;
    };
    const double first = top(1.9);
    EXPECT_NEAR(first, 2.0, 1e-6);  // where the tick ends
    EXPECT_NEAR(top(2.9), 4.0, 1e-6);
    EXPECT_EQ(top(1.9), first);
    // Without platforms a borrowed world is used as it is.
    Level still = two_boards();
    const Result<CollisionWorld> whole = build_collision_world(still);
    Result<LevelScene> borrowed = LevelScene::borrow(still, *whole, still.movement);
    ASSERT_TRUE(borrowed.ok());
    EXPECT_EQ(&borrowed->at(0.0).collision, &*whole);
    EXPECT_TRUE(borrowed->is_static());
}

// The smallest grid: two triangles, cut from its first corner to its last.
TEST(Heightfield, OfTwoByTwoSamplesIsTwoTriangles) {
    const Heightfield field{
        .columns = 2, .rows = 2, .heights = {1.0, 2.0, 5.0, 9.0}, .origin = {3, 0, 4}, .size = {2, 4}};
    EXPECT_EQ(field.corner(0, 0), Vec3(3, 1, 4));
    EXPECT_EQ(field.corner(1, 0), Vec3(5, 2, 4));
    EXPECT_EQ(field.corner(0, 1), Vec3(3, 5, 8));
    EXPECT_EQ(field.corner(1, 1), Vec3(5, 9, 8));
    for (const auto& [x, z, height] : {std::tuple(3.0, 4.0, 1.0),
                                       {5.0, 4.0, 2.0},
                                       {3.0, 8.0, 5.0},
                                       {5.0, 8.0, 9.0},
                                       {4.0, 6.0, 5.0},
                                       {4.5, 5.0, 3.5},
                                       {3.5, 7.0, 5.0}}) {
        const auto point = terrain_at(field, x, z);
        ASSERT_TRUE(point) << x << ", " << z;
        EXPECT_NEAR(point->height, height, 1e-12) << x << ", " << z;
    }
}

}  // namespace
}  // namespace slipface
