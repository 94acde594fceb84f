// Levels with so many painted faces that they are packed.
#include <gmock/gmock.h>

#include "level/faces.h"

namespace slipface::test {
namespace {

using testing::HasSubstr;

constexpr int tiles_per_side = 110;  // 12 100 tiles; more than 10 000 are packed

Faces many_painted_tiles() {
    Faces faces = tiles(tiles_per_side);
    for (std::size_t i = 0; i < faces.size(); ++i) {
        faces[i].painted = static_cast<int>(i % 8);
        if (i % 2 == 1) faces[i].material = "Old Wood";
        for (Vec3f& corner : faces[i].corners)
            corner.y() = 0.3f * static_cast<float>(static_cast<int>(corner.x() * corner.z()) % 7);
    }
    // Copies, which differ by their number alone.
    faces.push_back(faces[0]);
    faces.back().painted = 5;
    return faces;
}

TEST(PackedFaces, AreFoundAgainAfterARoundTrip) {
    const Faces faces = many_painted_tiles();
    const std::string json = level_to_json(level_of(faces));
    EXPECT_THAT(json, HasSubstr("\"packed\": ["));
    EXPECT_LT(json.size(), faces.size() * 72 + 12'000)
        << "31 characters a face, 26.7 for its outline, 13.4 for its token and its number, and the rest";
    EXPECT_TRUE(wrong_faces(faces, rematch(faces, faces)).empty());

    const Faces after = rounded(faces);
    const LoadedLevel loaded = rematch(faces, after);
    EXPECT_TRUE(wrong_faces(after, loaded).empty());
    EXPECT_EQ(loaded.match.exact, faces.size()) << loaded.match.text();
    EXPECT_EQ(level_to_json(rematch(faces, faces).level), json) << "written again to the same text";
}

TEST(PackedFaces, SurviveWhatReadableOnesSurvive) {
    const Faces faces = many_painted_tiles();
    Faces gone = faces;
    gone.erase(gone.begin() + 40);
    const LoadedLevel loaded = rematch(faces, gone);
    EXPECT_TRUE(wrong_faces(gone, loaded).empty());
    ASSERT_EQ(loaded.level.orphans.size(), 1u);
    // The orphan is kept as a readable row and comes back with its face.
    const auto again = level_from_json(level_to_json(loaded.level), "test.slipface.json", mesh_of(faces));
    ASSERT_TRUE(again) << again.error().text();
    EXPECT_TRUE(again->level.orphans.empty());
    EXPECT_TRUE(wrong_faces(faces, *again).empty());
}

TEST(PackedFaces, PaintingOneMoreFaceChangesFewRows) {
    Faces faces = many_painted_tiles();
    faces[500].painted = -1;
    const std::string before = level_to_json(level_of(faces));
    faces[500].painted = 4;
    const std::string after = level_to_json(level_of(faces));
    const auto lines = [](const std::string& text) {
        std::vector<std::string> list;
        for (std::size_t at = 0; at < text.size();) {
            const std::size_t end = text.find('\n', at);
            list.push_back(text.substr(at, end - at));
            at = end + 1;
        }
        std::sort(list.begin(), list.end());
        return list;
    };
    std::vector<std::string> changed;
    const auto a = lines(before), b = lines(after);
    std::set_difference(b.begin(), b.end(), a.begin(), a.end(), std::back_inserter(changed));
    EXPECT_LE(changed.size(), 4u) << "its row, those of its outline and of its token's number, and a comma";
}

TEST(PackedFaces, BrokenRowsAreRefusedWithTheirLocation) {
    const MeshPtr mesh = mesh_of(tiles(2));
    const auto error_of = [&](const std::string& row) {
        const auto loaded = level_from_json(
            R"({"slipface": 1, "overrides": [{"type": "ice", "faces": [], "packed": [)" + row + "]}]}",
            "a.json", mesh);
        return loaded ? std::string("read") : loaded.error().text();
    };
    const std::string face(31, 'A');
    EXPECT_EQ(error_of('"' + face + '"'), "read");
    const std::string nan = std::string(8, 'A') + "AADAfwAA" + std::string(15, 'A');
    for (const std::string& row :
         {std::string("7"), std::string("\"\""), '"' + face + "A\"", '"' + face.substr(1) + '"',
          '"' + std::string(30, 'A') + "-\"", '"' + nan + '"'})
        EXPECT_THAT(error_of(row), HasSubstr("a.json:/overrides/0/packed/0")) << row;
}

}  // namespace
}  // namespace slipface::test
