// Painted faces under or above unpainted ones, as patches and clip brushes of maps are.
#include <cmath>

#include "level/faces.h"

namespace slipface::test {
namespace {

// Two floors of bent tiles, the second one above the first by millimetres to centimetres, half of both
// painted.
Faces two_layers(Random& random) {
    constexpr int n = 12;
    const double highest = drawn(random, 0.005, 0.05);
    std::vector<float> heights;
    for (int i = 0; i < (n + 1) * (n + 1); ++i)
        heights.push_back(static_cast<float>(drawn(random, 0.0, highest)));
    Faces faces = tiles(n);
    for (Face tile : tiles(n)) {
        for (Vec3f& corner : tile.corners) {
            const int x = static_cast<int>(corner.x()),
                      z = static_cast<int>(std::lround(corner.z() + 7.77777f));
            corner.y() += 0.002f + heights[static_cast<std::size_t>(z * (n + 1) + x)];
        }
        faces.push_back(tile);
    }
    for (Face& face : faces)
        face.painted = random() % 2 == 0 ? static_cast<int>(random() % 6) : -1;
    return faces;
}

// A painted tile, and an unpainted one a centimetre above it.
Faces tile_under_another() {
    Faces faces = tiles(1);
    faces.push_back(faces[0]);
    faces[0].painted = 1;
    for (Vec3f& corner : faces[1].corners)
        corner.y() += 0.01f;
    return faces;
}

std::size_t unpainted_in(const std::string& json) {
    const std::size_t at = json.find("\"unpainted\": ");
    return at == std::string::npos ? 0 : json.find('}', at) - at;
}

class Layers : public testing::TestWithParam<unsigned> {};

TEST_P(Layers, CutFacesGetNoTypeOfAnUnpaintedLayer) {
    Random random(GetParam());
    const Faces before = two_layers(random);
    Faces after = rounded(triangulated(before));
    const Vec3f way(static_cast<float>(drawn(random, -3.0, 3.0)), static_cast<float>(drawn(random, 0.0, 2.0)),
                    0);
    for (Face& face : after)
        for (Vec3f& corner : face.corners)
            corner += way;
    const LoadedLevel loaded = rematch(before, after);
    std::size_t listed = 0;
    for (const std::size_t face : wrong_faces(after, loaded)) {
        EXPECT_FALSE(loaded.level.overrides[face]) << face;
        ++listed;
    }
    EXPECT_LE(50 * listed, painted_count(after));
}

TEST_P(Layers, NoFaceGetsTheTypeOfADeletedOneBelow) {
    Random random(GetParam());
    const Faces before = two_layers(random);
    Faces after;
    for (const Face& face : before)
        if (random() % 3 != 0) after.push_back(face);
    EXPECT_TRUE(wrong_faces(after, rematch(before, after)).empty());
}

INSTANTIATE_TEST_SUITE_P(Random, Layers, testing::Range(1u, 13u));

TEST(LayersInAFile, OnlyUnpaintedFacesThatLieOnPaintedOnesAreStored) {
    Faces faces = tiles(3);
    faces[4].painted = 1;
    EXPECT_EQ(unpainted_in(level_to_json(level_of(faces))), 0u);
    Face above = faces[4], beside = faces[4], back = faces[4], of_another = faces[4];
    for (Vec3f& corner : above.corners)
        corner.y() += 0.01f;
    for (Vec3f& corner : beside.corners)
        corner.x() += 1.0f;
    std::reverse(back.corners.begin(), back.corners.end());
    of_another.object = "another";
    for (Face* other : {&beside, &back, &of_another}) {
        other->painted = -1;
        faces.push_back(*other);
        EXPECT_EQ(unpainted_in(level_to_json(level_of(faces))), 0u);
    }
    above.painted = -1;
    faces.push_back(above);
    EXPECT_GT(unpainted_in(level_to_json(level_of(faces))), 0u);
}

TEST(LayersInAFile, AWrongRowIsRefusedWithItsPlace) {
    const Faces faces = tile_under_another();
    const std::string json = level_to_json(level_of(faces));
    const std::size_t member = json.find("\"unpainted\": ");
    ASSERT_NE(member, std::string::npos);
    for (const char* name : {"\"packed\": [", "\"corners\": ["}) {
        std::string broken = json;
        const std::size_t row = broken.find('"', broken.find(name, member) + std::string(name).size());
        broken.insert(row + 1, "!");
        const auto loaded = level_from_json(broken, "test.slipface.json", mesh_of(faces));
        ASSERT_FALSE(loaded.ok()) << name;
        EXPECT_NE(loaded.error().text().find("/parts/unpainted"), std::string::npos) << loaded.error().text();
    }
}

// Another program has changed the members: the faces are left out, and the paint is there.
TEST(LayersInAFile, FacesWithoutOutlinesAreLeftOut) {
    const Faces faces = tile_under_another();
    std::string json = level_to_json(level_of(faces));
    const std::size_t at = json.find("\"corners\": [", json.find("\"unpainted\": ")) + 12;
    json.erase(at, json.find(']', at) - at);
    const auto loaded = level_from_json(json, "test.slipface.json", mesh_of(faces));
    ASSERT_TRUE(loaded.ok()) << loaded.error().text();
    EXPECT_TRUE(wrong_faces(faces, *loaded).empty());
}

}  // namespace
}  // namespace slipface::test
