// What every shipped level promises, and what each of them does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "slipface/doctor/doctor.h"
#include "slipface/image/image.h"
#include "slipface/level/level_file.h"
#include "slipface/level/preset.h"
#include "slipface/light/bake.h"

namespace slipface {
namespace {

const std::filesystem::path folder = std::filesystem::path(SLIPFACE_SOURCE_DIR) / "assets/levels";

Level load(const std::string& name) {
    Result<LoadedLevel> loaded = load_level(folder / (name + ".obj"));
    if (!loaded) throw std::runtime_error(loaded.error().text());
    EXPECT_TRUE(loaded->warnings.empty()) << loaded->warnings.front().text();
    return std::move(loaded->level);
}

class ShippedLevel : public testing::TestWithParam<const char*> {};

TEST_P(ShippedLevel, IsOfThePromisedSize) {
    const Level level = load(GetParam());
    EXPECT_GE(level.mesh->triangle_count(), 3000U);
    EXPECT_LE(level.mesh->triangle_count(), 40000U);
    EXPECT_LE(std::filesystem::file_size(level.mesh_path), 3'000'000U);
    EXPECT_GE(level.cameras.size(), 6U);
    EXPECT_TRUE(level.orphans.empty());
}

TEST_P(ShippedLevel, PlayerSpawnsFreeAtTheOrigin) {
    const Level level = load(GetParam());
    EXPECT_EQ(level.spawn, Vec3::Zero());
    const Result<CollisionWorld> world = build_collision_world(level);
    ASSERT_TRUE(world.ok());
    EXPECT_FALSE(overlaps_any(*world, {0.4, 0.9, 0.4}, level.spawn));
    const auto floor = sweep_ellipsoid(*world, {0.4, 0.9, 0.4}, level.spawn, {0, -2, 0});
    ASSERT_TRUE(floor) << "there is no floor under the origin";
    EXPECT_GT(floor->normal.y(), 0.9);
}

TEST_P(ShippedLevel, LightMapFits) {
    const Level level = load(GetParam());
    ASSERT_TRUE(level.light);
    const Result<LightCharts> charts = light_charts(*level.mesh, level.light->texel_m);
    ASSERT_TRUE(charts.ok());
    EXPECT_EQ(charts->geometry, level.light->geometry);
    const Result<Image> image = load_image(folder / level.light->image);
    ASSERT_TRUE(image.ok()) << image.error().text();
    EXPECT_EQ(image->width, charts->width);
    EXPECT_EQ(image->height, charts->height);
    EXPECT_LE(std::filesystem::file_size(folder / level.light->image), 1'500'000U);
}

TEST_P(ShippedLevel, IsWalkedWithTheSettingsOfAPreset) {
    const Level level = load(GetParam());
    const PresetMatch match = nearest_preset(level.movement);
    EXPECT_STREQ(match.preset->id, "platformer");
    EXPECT_TRUE(match.changed.empty());
}

TEST_P(ShippedLevel, TheDoctorFindsNothing) {
    const DoctorReport report = examine(load(GetParam()));
    EXPECT_EQ(report.total(), 0U);
    for (const Problem& problem : report.problems)
        ADD_FAILURE() << info_of(problem.kind).name << ", face " << problem.face << " at "
                      << problem.position.transpose() << ": " << problem.text;
}

// Two triangles of different faces that lie in one plane, look the same way and cover a common point.
struct Flat {
    FaceId face;
    Vec3 middle;  // three points well inside are asked
    std::array<Vec3, 3> corner;
    Vec3 normal;
};

bool covers(const Flat& flat, const Vec3& point) {
    if (std::abs((point - flat.corner[0]).dot(flat.normal)) > 1e-3) return false;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 a = flat.corner[i], b = flat.corner[(i + 1) % 3];
        if ((b - a).cross(point - a).dot(flat.normal) < 1e-3 * (b - a).norm()) return false;
    }
    return true;
}

std::vector<Flat> flats_of(const Mesh& mesh) {
    std::vector<Flat> flats;
    for (TriangleId t = 0; t < mesh.triangle_count(); ++t) {
        Flat flat{mesh.triangle_face[t], Vec3::Zero(), {}, Vec3::Zero()};
        for (std::size_t i = 0; i < 3; ++i)
            flat.corner[i] = mesh.corner_position(mesh.triangles[t][i]).cast<double>();
        const Vec3 across = (flat.corner[1] - flat.corner[0]).cross(flat.corner[2] - flat.corner[0]);
        if (across.norm() < 2e-3) continue;
        flat.normal = across.normalized();
        flat.middle = (flat.corner[0] + flat.corner[1] + flat.corner[2]) / 3.0;
        flats.push_back(flat);
    }
    return flats;
}

std::vector<std::string> overlaps_in_one_plane(const Mesh& mesh) {
    const std::vector<Flat> flats = flats_of(mesh);
    std::map<std::array<int, 3>, std::vector<std::size_t>> cells;
    constexpr double cell = 3.0;
    const auto cell_of = [](const Vec3& p) {
        return std::array<int, 3>{static_cast<int>(std::floor(p.x() / cell)),
                                  static_cast<int>(std::floor(p.y() / cell)),
                                  static_cast<int>(std::floor(p.z() / cell))};
    };
    for (std::size_t i = 0; i < flats.size(); ++i) {
        Aabb box;
        for (const Vec3& corner : flats[i].corner)
            box.add(corner);
        const auto low = cell_of(box.min - Vec3::Constant(0.01)),
                   high = cell_of(box.max + Vec3::Constant(0.01));
        for (int x = low[0]; x <= high[0]; ++x)
            for (int y = low[1]; y <= high[1]; ++y)
                for (int z = low[2]; z <= high[2]; ++z)
                    cells[{x, y, z}].push_back(i);
    }
    std::vector<std::string> found;
    for (const Flat& flat : flats) {
        // The middle and points towards the corners, so that a partial overlap is seen, too.
        for (std::size_t k = 0; k < 4; ++k) {
            const Vec3 point = k == 3 ? flat.middle : Vec3(0.25 * flat.middle + 0.75 * flat.corner[k]);
            for (const std::size_t other : cells[cell_of(point)]) {
                if (flats[other].face == flat.face || flats[other].normal.dot(flat.normal) < 0.9999) continue;
                if (!covers(flats[other], point)) continue;
                // The same texture in the same place: nothing flickers.
                if (mesh.face_material[flats[other].face] == mesh.face_material[flat.face]) continue;
                found.push_back("faces " + std::to_string(flat.face) + " (" +
                                mesh.materials[mesh.face_material[flat.face]].name + ") and " +
                                std::to_string(flats[other].face) + " (" +
                                mesh.materials[mesh.face_material[flats[other].face]].name + ") at " +
                                std::to_string(point.x()) + ", " + std::to_string(point.y()) + ", " +
                                std::to_string(point.z()));
            }
        }
    }
    return found;
}

TEST_P(ShippedLevel, NoFacesLieOverEachOtherInOnePlane) {
    const Level level = load(GetParam());
    const std::vector<std::string> found = overlaps_in_one_plane(*level.mesh);
    for (std::size_t i = 0; i < std::min<std::size_t>(found.size(), 30); ++i)
        ADD_FAILURE() << found[i];
    EXPECT_EQ(found.size(), 0U);
}

// Rays from the spawn find a face in every direction: nobody can leave.
TEST(ClosedLevels, HaveNoWayOut) {
    for (const char* name : {"easy", "hard"}) {
        const Level level = load(name);
        const Result<CollisionWorld> world = build_collision_world(level);
        ASSERT_TRUE(world.ok());
        double x = 0.5, y = 0.5;
        int out = 0;
        for (int i = 0; i < 4000; ++i) {
            x += 0.7548776662466927;
            y += 0.5698402909980532;
            x -= std::floor(x);
            y -= std::floor(y);
            const double height = 2.0 * x - 1.0, across = std::sqrt(1.0 - height * height);
            const double u = 2.0 * y - 1.0;
            const Vec3 direction(across * u, height, across * (i % 2 == 0 ? 1 : -1) * std::sqrt(1.0 - u * u));
            if (!cast_ray(*world, level.spawn, direction)) ++out;
        }
        EXPECT_EQ(out, 0) << name;
    }
}

TEST(Island, HasPlatformsAndABeachOfHeights) {
    const Level level = load("island");
    EXPECT_EQ(level.platforms.size(), 3U);
    ASSERT_TRUE(level.terrain);
    const auto sand = terrain_at(*level.terrain, 0, 30);
    ASSERT_TRUE(sand);
    EXPECT_LT(sand->height, -1.5);
}

INSTANTIATE_TEST_SUITE_P(All, ShippedLevel, testing::Values("easy", "hard", "island", "playground"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace slipface
