// Hidden faces and selections in the level file.
#include <gmock/gmock.h>

#include "level/faces.h"

namespace slipface::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* location = "test.slipface.json";

// Nine tiles, the last three of another material; the first hidden, two selections that share a face.
Faces floor_tiles() {
    Faces faces = tiles(3);
    for (std::size_t i = 6; i < faces.size(); ++i)
        faces[i].material = "grass";
    faces[4].painted = 1;
    return faces;
}
Level kept_level() {
    Level level = level_of(floor_tiles());
    level.hidden = {0, 5, 7};
    level.selections = {{"stairs \"up\"", {1, 5, 8}}, {"nothing", {}}};
    return level;
}

LoadedLevel read(const std::string& json, const Faces& faces) {
    Result<LoadedLevel> loaded = level_from_json(json, location, mesh_of(faces));
    if (!loaded) {
        ADD_FAILURE() << loaded.error().text();
        return {};
    }
    loaded->level.mesh_path = "folder/test.obj";
    loaded->level.file_path = "folder/test.slipface.json";
    return std::move(*loaded);
}

TEST(KeptFaces, ComeBackAndGiveTheSameText) {
    const Level level = kept_level();
    const std::string json = level_to_json(level);
    const LoadedLevel loaded = read(json, floor_tiles());
    EXPECT_EQ(loaded.level.hidden, level.hidden);
    EXPECT_EQ(loaded.level.selections, level.selections);
    EXPECT_EQ(loaded.level.overrides, level.overrides);
    EXPECT_THAT(loaded.warnings, IsEmpty());
    EXPECT_EQ(loaded.match.exact, 1u) << "the summary reports paint alone";
    EXPECT_EQ(level_to_json(loaded.level), json);
}

TEST(KeptFaces, ALevelWithoutThemHasNoSuchKeys) {
    const std::string json = level_to_json(level_of(floor_tiles()));
    EXPECT_EQ(json.find("\"hidden\""), std::string::npos);
    EXPECT_EQ(json.find("\"selections\""), std::string::npos);
}

TEST(KeptFaces, UnknownKeysStayWhereTheyStand) {
    std::string json = level_to_json(kept_level());
    const auto put = [&](const std::string& before, const std::string& what) {
        const std::size_t at = json.find(before);
        ASSERT_NE(at, std::string::npos) << before;
        json.insert(at, what);
    };
    put("\"name\": \"stairs", "\"color\": \"red\", ");
    const std::size_t hidden = json.find("\"hidden\"");
    json.insert(json.find("\"material\"", hidden), "\"why\": 1, ");
    const LoadedLevel loaded = read(json, floor_tiles());
    EXPECT_EQ(loaded.warnings.size(), 2u);
    EXPECT_EQ(loaded.level.selections, kept_level().selections);
    const std::string again = level_to_json(loaded.level);
    EXPECT_THAT(again, HasSubstr("\"color\": \"red\""));
    EXPECT_THAT(again, HasSubstr("\"why\": 1"));
    EXPECT_EQ(level_to_json(read(again, floor_tiles()).level), again);
}

// Sorted anew and rounded to six decimals, every face is found; subdivided, its parts are.
TEST(KeptFaces, AreFoundAgainOnChangedGeometry) {
    const std::string json = level_to_json(kept_level());
    Faces turned = rounded(floor_tiles());
    std::reverse(turned.begin(), turned.end());  // face i is now 8 - i
    const LoadedLevel sorted = read(json, turned);
    EXPECT_THAT(sorted.level.hidden, ElementsAre(1, 3, 8));
    EXPECT_THAT(sorted.level.selections[0].faces, ElementsAre(0, 3, 7));
    const LoadedLevel cut = read(json, triangulated(floor_tiles()));  // face i is 2 i and 2 i + 1
    EXPECT_THAT(cut.level.hidden, ElementsAre(0, 1, 10, 11, 14, 15));
    EXPECT_THAT(cut.warnings, IsEmpty());
}

TEST(KeptFaces, WhatIsGoneIsDroppedAndListed) {
    Faces fewer = floor_tiles();
    fewer.erase(fewer.begin() + 5);
    // What lay beside it is no stand-in: it is another face of another set.
    const LoadedLevel loaded = read(level_to_json(kept_level()), fewer);
    EXPECT_THAT(loaded.level.hidden, ElementsAre(0, 6));
    EXPECT_THAT(loaded.level.selections[0].faces, ElementsAre(1, 7));
    ASSERT_EQ(loaded.warnings.size(), 2u);
    EXPECT_EQ(loaded.warnings[0].message, "1 of the 3 faces hidden no longer exist; they are dropped");
    EXPECT_EQ(loaded.warnings[1].message,
              "1 of the 3 faces of the selection \"stairs \"up\"\" no longer exist; they are dropped");
    EXPECT_THAT(loaded.warnings[0].location, HasSubstr(location));
    EXPECT_THAT(read(level_to_json(loaded.level), fewer).warnings, IsEmpty()) << "listed once";
}

// 90 000 faces, all hidden and half of them selected: 31 characters each, as paint has.
TEST(KeptFaces, ManyOfThemArePacked) {
    constexpr int side = 300;
    Level level = level_of(tiles(side));
    const std::size_t empty = level_to_json(level).size();
    const std::size_t count = level.mesh->face_count();
    SavedSelection half{"half", {}};
    for (FaceId face = 0; face < count; ++face) {
        level.hidden.push_back(face);
        if (face % 2 == 0) half.faces.push_back(face);
    }
    level.selections = {half};
    const std::string json = level_to_json(level);
    EXPECT_LT(json.size() - empty, count * 3 / 2 * 33);
    const Result<LoadedLevel> loaded = level_from_json(json, location, level.mesh);
    ASSERT_TRUE(loaded) << loaded.error().text();
    EXPECT_EQ(loaded->level.hidden, level.hidden);
    EXPECT_EQ(loaded->level.selections, level.selections);
}

TEST(KeptFaces, WrongOnesAreRefusedWithTheirLocation) {
    const auto error = [](const std::string& members) {
        const auto loaded =
            level_from_json("{\"slipface\": 1, " + members + "}", location, mesh_of(floor_tiles()));
        return loaded ? std::string("no error") : loaded.error().text();
    };
    EXPECT_THAT(error(R"("hidden": 3)"), HasSubstr("/hidden"));
    EXPECT_THAT(error(R"("hidden": [{"material": "stone"}])"), HasSubstr("/hidden/0"));
    EXPECT_THAT(error(R"("hidden": [{"faces": ["x"]}])"), HasSubstr("/hidden/0/faces/0"));
    EXPECT_THAT(error(R"("hidden": [{"faces": [], "packed": ["?"]}])"), HasSubstr("/hidden/0/packed/0"));
    EXPECT_THAT(error(R"("selections": [{"faces": []}])"), HasSubstr("/selections/0"));
    EXPECT_THAT(error(R"("selections": [{"name": "a"}])"), HasSubstr("/selections/0"));
    EXPECT_THAT(error(R"("selections": [{"name": 1, "faces": []}])"), HasSubstr("/selections/0/name"));
    EXPECT_THAT(error(R"("selections": [{"name": "a", "faces": [{"faces": [1]}]}])"),
                HasSubstr("/selections/0/faces/0/faces/0"));
    std::string many = R"("selections": [)";
    for (std::size_t i = 0; i <= max_saved_selections; ++i)
        many += R"({"name": "a", "faces": []},)";
    many.back() = ']';
    EXPECT_THAT(error(many), HasSubstr("/selections"));
}

}  // namespace
}  // namespace slipface::test
