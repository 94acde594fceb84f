// Light maps: their charts, what is baked, and how the level file says it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "slipface/level/level_file.h"
#include "slipface/light/bake.h"
#include "slipface/mesh/build.h"

namespace slipface {
namespace {

// A floor of 8 x 8 m in 1 m tiles, and a roof over its western half, 2 m up, facing up.
MeshPtr floor_and_roof() {
    PolygonSoup soup;
    soup.face_first_corner.push_back(0);
    const auto quad = [&](float x0, float x1, float z0, float z1, float y) {
        for (const Vec3f& corner : {Vec3f(x0, y, z1), Vec3f(x1, y, z1), Vec3f(x1, y, z0), Vec3f(x0, y, z0)})
            soup.corner_position.push_back(corner);
        soup.face_first_corner.push_back(static_cast<std::uint32_t>(soup.corner_position.size()));
    };
    for (int i = 0; i < 64; ++i) {
        const auto x = static_cast<float>(i % 8 - 4), z = static_cast<float>(i / 8 - 4);
        quad(x, x + 1, z, z + 1, 0);
    }
    quad(-4, 0, -4, 4, 2);
    Result<MeshPtr> mesh = build_mesh(std::move(soup));
    if (!mesh) throw std::runtime_error(mesh.error().text());
    return *mesh;
}

Level lit_level() {
    Level level;
    level.file_path = "yard.slipface.json";
    level.mesh = floor_and_roof();
    level.overrides.resize(level.mesh->face_count());
    level.light = LevelLight{.sun_direction = {0, 1, 0}, .sun_color = {1, 1, 1}};
    return level;
}

TEST(LightCharts, LieBesideEachOtherAndHoldTheirFaces) {
    const MeshPtr mesh = floor_and_roof();
    const Result<LightCharts> charts = light_charts(*mesh, 0.25);
    ASSERT_TRUE(charts.ok());
    EXPECT_EQ(charts->charts.size(), mesh->face_count());
    std::vector<int> owners(static_cast<std::size_t>(charts->width * charts->height));
    for (FaceId face = 0; face < mesh->face_count(); ++face) {
        const LightChart& chart = charts->charts[face];
        for (int j = 0; j < chart.height; ++j)
            for (int i = 0; i < chart.width; ++i)
                ++owners.at(static_cast<std::size_t>((chart.y + j) * charts->width + chart.x + i));
        // All faces lie flat, so the map is seen from above: texels of at most 0.25 m, the first on the
        // western edge, the last on the eastern, and likewise from edge to edge in Z.
        Aabb box;
        for (std::uint32_t k = mesh->face_first_corner[face]; k < mesh->face_first_corner[face + 1]; ++k)
            box.add(mesh->corner_position(k).cast<double>());
        const Vec3 size = box.max - box.min;
        ASSERT_EQ(chart.width, size.x() / 0.25 + 1);
        ASSERT_EQ(chart.height, size.z() / 0.25 + 1);
        const bool north_first = chart.texel_position(0, 0).z() == box.min.z();
        for (const auto& [i, j] : {std::pair(0, 0), {0, chart.height - 1}, {chart.width - 1, 0}, {3, 2}}) {
            const double south = north_first ? 0.25 * j : size.z() - 0.25 * j;
            const Vec3 expected = box.min + Vec3(0.25 * i, 0.0, south);
            EXPECT_LT((chart.texel_position(i, j) - expected).norm(), 1e-6);
            EXPECT_LT((chart.coordinate(expected) - Vec2(i, j)).norm(), 1e-5);
        }
        // Clamped to the face's own texels.
        EXPECT_EQ(chart.coordinate({100, 0, 0}).x(), chart.width - 1);
        EXPECT_EQ(chart.coordinate({-100, 0, 0}).x(), 0);
    }
    EXPECT_EQ(*std::max_element(owners.begin(), owners.end()), 1);
}

TEST(LightCharts, TooFineIsRefusedAndOtherGeometryHasAnotherHash) {
    const MeshPtr mesh = floor_and_roof();
    EXPECT_FALSE(light_charts(*mesh, 0.0).ok());
    EXPECT_NE(light_charts(*mesh, 0.25)->geometry, light_charts(*mesh, 0.5)->geometry);
}

TEST(LightBaker, ShadowsWhatTheSunDoesNotSee) {
    const Level level = lit_level();
    const Result<LightBaker> baker = LightBaker::make(level);
    ASSERT_TRUE(baker.ok()) << baker.error().text();
    const Image image = baker->bake();
    const auto middle = [&](FaceId face) {
        const LightChart& chart = baker->charts().charts[face];
        return static_cast<int>(*image.pixel(chart.x + chart.width / 2, chart.y + chart.height / 2));
    };
    const FaceId under_roof = 8 * 4 + 1, in_sun = 8 * 4 + 6, roof = 64;
    EXPECT_LT(middle(under_roof) + 60, middle(in_sun));
    EXPECT_GT(middle(roof), middle(under_roof) + 60);
    EXPECT_EQ(image.width, baker->charts().width);
    // One face alone gives the bytes of the whole.
    for (const FaceId face : {under_roof, in_sun, roof}) {
        const LightChart& chart = baker->charts().charts[face];
        const std::vector<std::uint8_t> bytes = baker->bake_face(face);
        ASSERT_EQ(bytes.size(), 3U * chart.width * chart.height);
        for (std::size_t at = 0; at < bytes.size(); ++at) {
            const int texel = static_cast<int>(at / 3);
            const auto* pixel = image.pixel(chart.x + texel % chart.width, chart.y + texel / chart.width);
            ASSERT_EQ(pixel[at % 3], bytes[at]);
        }
    }
}

// Where nothing reflects and the sky is black, light is the cosine of the sun. From the east at 45 degrees a
// roof 2 m up throws its shadow 2 m to the west: over x < -2 of the floor.
TEST(LightBaker, SunlightAndShadowAreThoseOfTheSunsAngle) {
    Level level = lit_level();
    auto black = std::make_shared<Mesh>(*level.mesh);
    for (Material& material : black->materials)
        material.diffuse = Vec3f::Zero();
    level.mesh = std::move(black);
    level.light->sky_zenith = level.light->ambient = Vec3::Zero();
    level.light->sky_horizon = Vec3::Constant(1e-6);  // the sun shines in from outside at all
    level.light->sun_direction = {3, 3, 0};
    const Result<LightBaker> baker = LightBaker::make(level);
    ASSERT_TRUE(baker.ok()) << baker.error().text();
    const auto in_sun = static_cast<int>(255.0 * std::sqrt(std::sqrt(0.5) / light_map_range));
    for (FaceId face = 0; face < 65; ++face) {
        const int west = static_cast<int>(face % 8) - 4, row = static_cast<int>(face / 8);
        // The shadow's borders, as soft as the sun is large.
        if (face < 64 && (west == -3 || west == -2 || row == 0 || row == 7)) continue;
        const int expected = face < 64 && west < -3 ? 0 : in_sun;
        for (const std::uint8_t byte : baker->bake_face(face))
            ASSERT_NEAR(byte, expected, 1) << "face " << face;
    }
}

TEST(LightBaker, GlowingFacesLightOthers) {
    Level level = lit_level();
    level.light->sun_color = Vec3::Zero();
    level.light->sky_zenith = level.light->sky_horizon = level.light->ambient = Vec3::Zero();
    const auto brightest = [&] {
        const Result<LightBaker> baker = LightBaker::make(level);
        const std::vector<std::uint8_t> bytes = baker->bake_face(0);
        return static_cast<int>(*std::max_element(bytes.begin(), bytes.end()));
    };
    EXPECT_EQ(brightest(), 0);
    level.light->emitters = {{"*", {1, 0, 0}}};
    EXPECT_GT(brightest(), 100);
}

TEST(LevelLight, SurvivesTheLevelFile) {
    Level level = lit_level();
    level.light->image = "yard.light.png";
    level.light->geometry = 0x0123456789abcdefULL;
    level.light->emitters = {{"lamp*", {4, 3, 1}}, {"sky", {1, 2, 3}, true}};
    const Result<LoadedLevel> again = level_from_json(level_to_json(level), "yard.slipface.json", level.mesh);
    ASSERT_TRUE(again.ok()) << again.error().text();
    EXPECT_EQ(again->level.light, level.light);
    EXPECT_EQ(level_to_json(again->level), level_to_json(level));
}

TEST(LevelLight, NumbersAreChecked) {
    const MeshPtr mesh = floor_and_roof();
    const auto read = [&](const std::string& light) {
        return level_from_json(R"({"slipface": 1, "light": )" + light + "}", "yard.slipface.json", mesh);
    };
    EXPECT_TRUE(read(R"({"image": "a.png"})").ok());
    // One outside the folder is kept, and not drawn: named_file() decides.
    const Result<LoadedLevel> outside = read(R"({"image": "../a.png"})");
    ASSERT_TRUE(outside.ok());
    EXPECT_EQ(outside->level.light->image, "../a.png");
    EXPECT_FALSE(read(R"({"texel": 0})").ok());
    EXPECT_FALSE(read(R"({"geometry": "xyz"})").ok());
}

}  // namespace
}  // namespace slipface
