// Painted faces are found again after what modelling tools do to a file.
#include <set>

#include "level/faces.h"

namespace slipface::test {
namespace {

constexpr int ice = 1;
constexpr int ladder = 2;
constexpr int sticky = 3;

TEST(FaceKey, DoesNotDependOnTheFirstCorner) {
    const Faces faces = random_polygons(200, 100.0f, 1);
    Faces turned = faces;
    for (Face& face : turned)
        std::rotate(face.corners.begin(), face.corners.begin() + 1, face.corners.end());
    const MeshPtr a = mesh_of(faces);
    const MeshPtr b = mesh_of(turned);
    for (FaceId face = 0; face < faces.size(); ++face) {
        EXPECT_EQ(face_key(*a, face).loop_hash, face_key(*b, face).loop_hash);
    }
}

TEST(FaceKey, TellsFacesAndWindingsApart) {
    Faces faces = random_polygons(500, 10.0f, 2);
    const std::size_t count = faces.size();
    for (std::size_t i = 0; i < count; ++i) {
        Face back = faces[i];
        std::reverse(back.corners.begin(), back.corners.end());
        faces.push_back(back);
    }
    const MeshPtr mesh = mesh_of(faces);
    std::set<std::uint64_t> hashes;
    for (FaceId face = 0; face < faces.size(); ++face)
        hashes.insert(face_key(*mesh, face).loop_hash);
    EXPECT_EQ(hashes.size(), faces.size());
}

TEST(FaceMatch, AnUntouchedMeshMatchesExactly) {
    const Faces faces = random_polygons(3000, 50.0f, 3);
    const LoadedLevel loaded = rematch(faces, faces);
    EXPECT_TRUE(wrong_faces(faces, loaded).empty());
    EXPECT_EQ(loaded.match.exact, painted_count(faces));
    EXPECT_EQ(loaded.match.orphaned + loaded.match.by_plane + loaded.match.by_nearest, 0u);
}

// Faces sorted otherwise, corners started elsewhere, coordinates written with six decimals, names made
// unique: what an export from a modelling tool does. Nothing may be lost or move, near the origin or far from
// it.
class RoundTrip : public testing::TestWithParam<float> {};

TEST_P(RoundTrip, NothingIsLost) {
    const Faces faces = random_polygons(3000, GetParam(), 4);
    Faces after = rounded(shuffled(faces, 5));
    for (Face& face : after)
        face.material = face.material == "grass" ? "grass.001" : "Stone_Wall.012.003";
    const LoadedLevel loaded = rematch(faces, after);
    EXPECT_TRUE(wrong_faces(after, loaded).empty());
    EXPECT_EQ(loaded.match.exact, painted_count(faces)) << loaded.match.text();
}

INSTANTIATE_TEST_SUITE_P(Spreads, RoundTrip, testing::Values(2.0f, 50.0f, 3000.0f));

TEST(FaceMatch, TheSavedTextDoesNotDependOnTheOrderOfFaces) {
    const Faces faces = random_polygons(300, 50.0f, 6);
    // Except for the parts, which remember the order.
    const auto text = [](const Faces& of) {
        std::string json = level_to_json(level_of(of));
        const std::size_t begin = json.find("\"parts\"");
        return json.erase(begin, json.find("\"orphans\"") - begin);
    };
    EXPECT_EQ(text(faces), text(shuffled(faces, 7)));
}

TEST(FaceMatch, FrontAndBackOfOneWallKeepTheirOwnTypes) {
    Faces faces = tiles(1);
    faces.push_back(faces[0]);
    std::reverse(faces[1].corners.begin(), faces[1].corners.end());
    faces[0].painted = ice;
    faces[1].painted = sticky;
    const Faces after = rounded(shuffled({faces[1], faces[0]}, 1));
    EXPECT_TRUE(wrong_faces(after, rematch(faces, after)).empty());
}

TEST(FaceMatch, FacesWithTheSameCornersKeepTheirOwnTypes) {
    // Four copies of one tile: ice, unset, sticky, and one of another material.
    const Face tile = tiles(1)[0];
    Faces faces{tile, tile, tile, tile};
    faces[0].painted = ice;
    faces[2].painted = sticky;
    faces[3].material = "grass";
    faces[3].painted = ladder;
    const LoadedLevel loaded = rematch(faces, faces);
    EXPECT_TRUE(wrong_faces(faces, loaded).empty());
    EXPECT_EQ(loaded.match.exact, 3u);
}

TEST(FaceMatch, DefaultAsAnOverrideIsNotUnset) {
    Faces faces = tiles(2);
    faces[1].painted = default_surface;
    EXPECT_TRUE(wrong_faces(faces, rematch(faces, faces)).empty());
}

TEST(FaceMatch, BothTrianglesOfASplitTileKeepItsTypeAndNoOther) {
    Faces faces = tiles(12);
    for (std::size_t i = 0; i < faces.size(); ++i) {
        if (i % 3 == 0) faces[i].painted = i % 2 == 0 ? ice : ladder;
    }
    const Faces after = rounded(shuffled(triangulated(faces), 8));
    const LoadedLevel loaded = rematch(faces, after);
    EXPECT_TRUE(wrong_faces(after, loaded).empty());
    // Every painted tile is found by its parts, 48 of the 144, and they are it and nothing else.
    // A square floor that a tool sorted could have turned in its place, which is a question.
    EXPECT_EQ(loaded.match.exact, 48u);
}

// Of a tile cut into quarters, one of them gone, the rest keeps its type as a guess, and no half of a
// neighbour takes it.
TEST(FaceMatch, WhatIsLeftOfATileKeepsItsTypeAsAGuess) {
    const auto flat = [](float x0, float x1, float z0, float z1) {
        return quad({x0, 0, z0}, {x0, 0, z1}, {x1, 0, z1}, {x1, 0, z0});
    };
    Faces before{flat(0, 1, 0, 1), flat(1, 2, 0, 1), flat(2, 3, 0, 1)};
    before[1].painted = ice;
    Faces after{flat(0, 0.5f, 0, 1),    flat(0.5f, 1, 0, 1),    flat(2, 2.5f, 0, 1),   flat(2.5f, 3, 0, 1),
                flat(1, 1.5f, 0, 0.5f), flat(1.5f, 2, 0, 0.5f), flat(1, 1.5f, 0.5f, 1)};
    for (std::size_t quarter = 4; quarter < 7; ++quarter)
        after[quarter].painted = ice;
    const LoadedLevel loaded = rematch(before, after);
    EXPECT_TRUE(wrong_faces(after, loaded).empty());
    EXPECT_EQ(loaded.level.guessed, (std::vector<FaceId>{4, 5, 6}));
    EXPECT_TRUE(loaded.level.orphans.empty());
}

TEST(FaceMatch, TilesMergedIntoOneFaceKeepTheirCommonType) {
    Faces faces = tiles(2);
    for (Face& face : faces)
        face.painted = ice;
    Faces after{quad(faces[0].corners[0], faces[2].corners[1], faces[3].corners[2], faces[1].corners[3])};
    after[0].painted = ice;
    const LoadedLevel loaded = rematch(faces, after);
    EXPECT_TRUE(wrong_faces(after, loaded).empty());
    EXPECT_EQ(loaded.match.by_plane, 4u);
}

TEST(FaceMatch, MergedTilesOfDifferentTypesAreAQuestion) {
    Faces faces = tiles(2);
    faces[0].painted = ice;
    faces[3].painted = ladder;
    const Faces after{
        quad(faces[0].corners[0], faces[2].corners[1], faces[3].corners[2], faces[1].corners[3])};
    const LoadedLevel loaded = rematch(faces, after);
    EXPECT_FALSE(loaded.level.overrides[0].has_value());
    EXPECT_EQ(loaded.match.by_plane, 0u);
    EXPECT_EQ(loaded.level.orphans.size(), 2u);
    EXPECT_EQ(loaded.warnings.size(), 2u);
}

// Of four merged tiles three are ice: most of the face was, so it is, as a guess, and the ladder is listed.
TEST(FaceMatch, AMergedFaceHasTheTypeOfMostOfItAsAGuess) {
    Faces faces = tiles(2);
    for (Face& face : faces)
        face.painted = ice;
    faces[3].painted = ladder;
    Faces after{quad(faces[0].corners[0], faces[2].corners[1], faces[3].corners[2], faces[1].corners[3])};
    after[0].painted = ice;
    const LoadedLevel loaded = rematch(faces, after);
    EXPECT_TRUE(wrong_faces(after, loaded).empty());
    EXPECT_EQ(loaded.level.guessed, std::vector<FaceId>{0});
    EXPECT_EQ(loaded.level.orphans.size(), 1u);
}

// Of nine merged tiles five are unset: so is the face.
TEST(FaceMatch, AMergedFaceOfMostlyUnsetTilesIsUnset) {
    Faces faces = tiles(3);
    for (std::size_t i = 0; i < 4; ++i)
        faces[i].painted = ice;
    const Faces after{
        quad(faces[0].corners[0], faces[6].corners[1], faces[8].corners[2], faces[2].corners[3])};
    const LoadedLevel loaded = rematch(faces, after);
    EXPECT_TRUE(wrong_faces(after, loaded).empty());
    EXPECT_EQ(loaded.level.orphans.size(), 4u);
}

// A collapsed vertex: triangles that each cover parts of several tiles.
TEST(FaceMatch, AFaceOverPartsOfTilesHasTheTypeOfMostOfIt) {
    Faces faces = tiles(2);
    faces[0].painted = faces[1].painted = ice;
    faces[2].painted = ladder;
    // One triangle over the first two tiles and a quarter of the third, one over the rest.
    const Vec3f a = faces[0].corners[0], b = faces[1].corners[3], c = faces[3].corners[2],
                d = faces[2].corners[1];
    const Vec3f low = a + 0.65f * (d - a), high = b + 0.65f * (c - b);
    Faces after{quad(a, low, high, b), quad(low, d, c, high)};
    after[0].painted = ice;
    const LoadedLevel loaded = rematch(faces, after);
    EXPECT_TRUE(wrong_faces(after, loaded).empty());
    EXPECT_EQ(loaded.level.guessed, std::vector<FaceId>{0});
}

TEST(FaceMatch, AnExtrudedFaceIsFoundAlongItsNormal) {
    Faces faces = tiles(5);
    faces[12].painted = sticky;
    Faces after = faces;
    extrude(after, 12, {0, 0.5f, 0});
    const LoadedLevel in_order = rematch(faces, after);
    EXPECT_TRUE(wrong_faces(after, in_order).empty());
    EXPECT_EQ(in_order.match.exact, 1u) << "it is still the thirteenth face";
    after = shuffled(after, 3);
    const LoadedLevel loaded = rematch(faces, after);
    EXPECT_TRUE(wrong_faces(after, loaded).empty());
    EXPECT_EQ(loaded.match.by_nearest, 1u);
}

// Strips that moved further than they are wide, in front of a tilted wall.
TEST(FaceMatch, ExtrudedStripsAreFoundAlongTheirNormal) {
    Faces faces;
    for (int i = 0; i < 12; ++i) {
        const float x = 0.5f * static_cast<float>(i);
        faces.push_back(quad({x, 1, 0}, {x, 1, 2}, {x + 0.1f, 1, 2}, {x + 0.1f, 1, 0}));
        faces.back().painted = i % 3 == 0 ? -1 : i % 2 == 0 ? ice : sticky;
    }
    Faces after = faces;
    for (std::size_t i = 0; i < faces.size(); ++i)
        if (faces[i].painted >= 0) extrude(after, i, {0, 0.6f, 0});
    const Face wall = quad({-1, 0.9f, -1}, {-1, 0.9f, 3}, {9, 1.5f, 3}, {9, 1.5f, -1});
    faces.push_back(wall);
    after.push_back(wall);
    const LoadedLevel loaded = rematch(faces, after);
    EXPECT_TRUE(wrong_faces(after, loaded).empty());
    EXPECT_EQ(loaded.match.by_nearest, 8u);
}

// Shelves of the same outline above each other: one that is deleted has not become the next.
TEST(FaceMatch, AFaceAboveADeletedOneIsAnother) {
    Faces faces;
    for (int i = 0; i < 6; ++i) {
        faces.push_back(tiles(1, 1.5f * static_cast<float>(i)).front());
        faces.back().painted = i % 2 == 0 ? ice : -1;
    }
    const Faces after(faces.begin() + 1, faces.end());
    const LoadedLevel loaded = rematch(faces, after);
    EXPECT_TRUE(wrong_faces(after, loaded).empty());
    EXPECT_EQ(loaded.match.orphaned, 1u);
}

TEST(FaceMatch, OfFacesAtOnePlaceTheOneThatIsLeftIsAQuestion) {
    Faces faces = tiles(5);
    faces[12].painted = sticky;
    faces.push_back(faces[12]);
    faces.back().painted = ice;
    const Faces after(faces.begin(), faces.end() - 1);
    const LoadedLevel loaded = rematch(faces, after);
    EXPECT_EQ(loaded.level.guessed, std::vector<FaceId>{12});
    EXPECT_EQ(loaded.match.orphaned, 1u);
}

TEST(FaceMatch, AFaceWithAMovedCornerIsFound) {
    Faces faces = tiles(5);
    faces[12].painted = sticky;
    Faces after = faces;
    after[12].corners[0] += Vec3f(-0.2f, 0.1f, 0.1f);
    const LoadedLevel loaded = rematch(faces, after);
    EXPECT_TRUE(wrong_faces(after, loaded).empty());
    EXPECT_EQ(loaded.match.orphaned, 0u);
}

TEST(FaceMatch, ADeletedTileDoesNotPaintItsNeighbours) {
    Faces faces = tiles(5);
    faces[12].painted = ice;
    Faces after = faces;
    after.erase(after.begin() + 12);
    const LoadedLevel loaded = rematch(faces, after);
    EXPECT_TRUE(wrong_faces(after, loaded).empty());
    ASSERT_EQ(loaded.level.orphans.size(), 1u);
    EXPECT_EQ(loaded.level.orphans[0].type, "ice");
    EXPECT_EQ(loaded.level.orphans[0].key.material, "stone");
}

TEST(FaceMatch, AMovedFaceOfAnotherMaterialIsNotTaken) {
    Faces faces = tiles(3);
    faces[4].painted = ice;
    Faces after = faces;
    after[4].material = "grass";
    after[4].painted = -1;
    for (Vec3f& corner : after[4].corners)
        corner.y() += 0.2f;
    const LoadedLevel loaded = rematch(faces, after);
    EXPECT_TRUE(wrong_faces(after, loaded).empty());
    EXPECT_EQ(loaded.match.orphaned, 1u);
}

TEST(FaceMatch, AFaceAtItsPositionIsFoundUnderANewMaterial) {
    Faces faces = tiles(3);
    faces[4].painted = ice;
    Faces after = rounded(faces);
    after[4].material = "stone__ice";
    EXPECT_TRUE(wrong_faces(after, rematch(faces, after)).empty());
}

TEST(FaceMatch, SliversAndFacesWithoutAreaAreFound) {
    Faces faces;
    for (int i = 0; i < 20; ++i) {
        const float x = static_cast<float>(i) * 1.7f + 0.1234567f;
        faces.push_back({{Vec3f(x, 0, 0), Vec3f(x + 1.0f, 1e-6f, 0), Vec3f(x + 0.5f, 3e-6f, 1e-6f)}});
        faces.push_back({{Vec3f(x, 5, 0), Vec3f(x + 1, 5, 0), Vec3f(x + 2, 5, 0)}});
        faces[faces.size() - 2].painted = ice;
        faces.back().painted = ladder;
    }
    const Faces after = rounded(shuffled(faces, 9));
    EXPECT_TRUE(wrong_faces(after, rematch(faces, after)).empty());
}

TEST(FaceMatch, TrianglesBesideADeletedTileKeepTheirOwnTypes) {
    Faces faces = tiles(5);
    faces[12].painted = ice;
    Faces after = faces;
    after.erase(after.begin() + 12);
    const Faces halves = rounded(triangulated(after));
    EXPECT_TRUE(wrong_faces(halves, rematch(faces, halves)).empty());
}

TEST(FaceMatch, AHalfDeletedTileIsAQuestion) {
    Faces faces = tiles(5);
    faces[12].painted = ice;
    faces[11].painted = sticky;
    Faces after = triangulated(faces);
    after.erase(after.begin() + 24);
    const LoadedLevel loaded = rematch(faces, after);
    for (const std::size_t face : wrong_faces(after, loaded))
        EXPECT_FALSE(loaded.level.overrides[face].has_value());
}

TEST(FaceMatch, APartThatIsGoneIsListed) {
    const Moving rooms = two_rooms();
    const Faces after(rooms.before.begin() + static_cast<std::ptrdiff_t>(rooms.moving), rooms.before.end());
    const LoadedLevel loaded = rematch(rooms.before, after);
    EXPECT_TRUE(wrong_faces(after, loaded).empty());
    EXPECT_EQ(loaded.match.exact, painted_count(after));
    EXPECT_EQ(loaded.level.orphans.size(), painted_count(rooms.before) - painted_count(after));
}

TEST(FaceMatch, PartsOfOtherPaintAreIgnoredAndBrokenOnesAreErrors) {
    const Faces faces = two_rooms().before;
    const std::string json = level_to_json(level_of(faces));
    const std::size_t paint = json.find("\"paint\": \"") + 10;
    std::string other = json;
    other[paint] = other[paint] == '0' ? '1' : '0';
    const auto ignored = level_from_json(other, "test.slipface.json", mesh_of(faces));
    ASSERT_TRUE(ignored.ok());
    EXPECT_TRUE(wrong_faces(faces, *ignored).empty());
    const std::size_t list = json.find('"', json.find("\"list\": [") + 8);
    for (const char* text : {"\"AAAA\", ", "\"?\", ", "7, "}) {
        std::string broken = json;
        broken.insert(list, text);
        const auto loaded = level_from_json(broken, "test.slipface.json", mesh_of(faces));
        ASSERT_FALSE(loaded.ok()) << text;
        EXPECT_NE(loaded.error().text().find("/parts/list/"), std::string::npos) << loaded.error().text();
    }
    // Numbers that were written for another list are left out; those that are none are errors.
    const std::size_t numbers = json.find('"', json.find("\"numbers\": [") + 11);
    std::string stale = json;
    stale[numbers + 1] = stale[numbers + 1] == 'A' ? 'B' : 'A';
    const auto left_out = level_from_json(stale, "test.slipface.json", mesh_of(faces));
    ASSERT_TRUE(left_out.ok()) << left_out.error().text();
    EXPECT_TRUE(wrong_faces(faces, *left_out).empty());
    std::string broken = json;
    broken.insert(numbers + 1, "AAA=");
    const auto refused = level_from_json(broken, "test.slipface.json", mesh_of(faces));
    ASSERT_FALSE(refused.ok());
    EXPECT_NE(refused.error().text().find("/parts/numbers/0"), std::string::npos) << refused.error().text();
    const std::size_t row = json.find('"', json.find("\"objects\": [") + 11);
    for (const char* text : {"AAAA", "?", "\"AAAAAAAAAA\", "}) {
        std::string longer = json;
        longer.insert(text[0] == '"' ? row : row + 1, text);
        const auto no_objects = level_from_json(longer, "test.slipface.json", mesh_of(faces));
        ASSERT_FALSE(no_objects.ok()) << text;
        EXPECT_NE(no_objects.error().text().find("/parts/objects"), std::string::npos)
            << no_objects.error().text();
    }
}

// Another program that knows no parts removes a painted face: all members of the parts are known
// nevertheless.
TEST(FaceMatch, PartsOfMorePaintLeaveNoUnknownMembers) {
    std::string json = level_to_json(level_of(two_rooms().before));
    ASSERT_NE(json.find("\"of\": "), std::string::npos);
    const std::size_t row = json.find('"', json.find("\"faces\": [") + 10);
    json.erase(row, json.find(',', json.find('"', row + 1)) + 1 - row);
    const auto loaded = level_from_json(json, "test.slipface.json", mesh_of(two_rooms().before));
    ASSERT_TRUE(loaded.ok()) << loaded.error().text();
    EXPECT_EQ(loaded->level.unknown, UnknownKeys{});
    EXPECT_TRUE(loaded->warnings.empty());
}

TEST(FaceMatch, ATextWithoutPartsIsShorterAndHasTheSamePaint) {
    const Faces faces = two_rooms().before;
    const Level level = level_of(faces);
    const std::string whole = level_to_json(level), text = level_to_json(level, LevelText::without_parts);
    EXPECT_EQ(text.find("\"parts\": "), std::string::npos);
    EXPECT_LT(text.size(), whole.size());
    const auto loaded = level_from_json(text, "test.slipface.json", mesh_of(faces));
    ASSERT_TRUE(loaded.ok()) << loaded.error().text();
    EXPECT_EQ(loaded->level.overrides, level.overrides);
    EXPECT_TRUE(loaded->level.guessed.empty());
}

TEST(FaceMatch, ObjectsAreReadFromAnOlderFile) {
    Faces faces = tiles(3);
    faces[0].painted = 1;
    std::string json = level_to_json(level_of(faces));
    const std::size_t list = json.find('[', json.find("\"objects\": ")), end = json.find(']', list);
    const std::size_t row = json.find('"', list);  // of the only part
    json.replace(list, end + 1 - list, json.substr(row, json.find('"', row + 1) + 1 - row));
    const auto loaded = level_from_json(json, "test.slipface.json", mesh_of(faces));
    ASSERT_TRUE(loaded.ok()) << loaded.error().text();
    EXPECT_TRUE(wrong_faces(faces, *loaded).empty());
    EXPECT_EQ(loaded->level.unknown, UnknownKeys{});
}

TEST(FaceMatch, OrphansSurviveTwoRoundsAndComeBackWithTheirFace) {
    Faces faces = tiles(5);
    faces[12].painted = ice;
    faces[3].painted = ladder;
    Faces without = faces;
    without.erase(without.begin() + 12);

    const LoadedLevel first = rematch(faces, without);
    const auto second = level_from_json(level_to_json(first.level), "test.slipface.json", mesh_of(without));
    ASSERT_TRUE(second.ok());
    ASSERT_EQ(second->level.orphans.size(), 1u);
    EXPECT_EQ(second->level.orphans, first.level.orphans);
    EXPECT_EQ(level_to_json(second->level), level_to_json(first.level));

    const auto third = level_from_json(level_to_json(second->level), "test.slipface.json", mesh_of(faces));
    ASSERT_TRUE(third.ok());
    EXPECT_TRUE(third->level.orphans.empty());
    EXPECT_TRUE(wrong_faces(faces, *third).empty());
}

TEST(FaceMatch, AnUnknownTypeIsKeptAsAnOrphan) {
    Faces faces = tiles(2);
    faces[1].painted = ice;
    std::string json = level_to_json(level_of(faces));
    const std::size_t at = json.rfind("\"type\": \"ice\"");
    json.replace(at, 13, "\"type\": \"lava\"");
    const auto loaded = level_from_json(json, "test.slipface.json", mesh_of(faces));
    ASSERT_TRUE(loaded.ok()) << loaded.error().text();
    ASSERT_EQ(loaded->level.orphans.size(), 1u);
    EXPECT_EQ(loaded->level.orphans[0].type, "lava");
    EXPECT_FALSE(loaded->level.overrides[1].has_value());
    EXPECT_NE(loaded->warnings.at(0).message.find("lava"), std::string::npos);
    EXPECT_NE(level_to_json(loaded->level).find("lava"), std::string::npos);
}

TEST(FaceMatch, ManyOrphansAreListedOnceAndBriefly) {
    Faces faces = tiles(20);
    for (Face& face : faces)
        face.painted = ice;
    Faces elsewhere = tiles(2, 500.0f);
    const LoadedLevel loaded = rematch(faces, elsewhere);
    EXPECT_EQ(loaded.match.orphaned, 400u);
    EXPECT_EQ(loaded.level.orphans.size(), 400u);
    // A hundred by name and one line for the rest.
    EXPECT_EQ(loaded.warnings.size(), 101u);
}

TEST(MatchSummary, SaysWhatWasFound) {
    MatchSummary summary;
    summary.exact = 812;
    summary.by_plane = 14;
    summary.orphaned = 3;
    EXPECT_EQ(summary.text(), "812 exact, 14 by plane, 3 orphaned");
    summary.by_nearest = 2;
    EXPECT_EQ(summary.text(), "812 exact, 14 by plane, 2 by nearest, 3 orphaned");
}

// Some models have faces twice. The twin of a face that was cut is where that one was, but the pieces are its
// own.
TEST(FaceMatch, PiecesOfAFaceThatHadATwinKeepItsType) {
    for (unsigned seed = 0; seed < 6; ++seed) {
        std::mt19937 random(seed);
        Faces before = rounded(tiles(seed < 2 ? 85 : 6));  // the large ones are packed, in another order
        for (Face& face : before)
            face.painted = static_cast<int>(random() % 6) - 1;
        const Faces twins = before;
        before.insert(before.end(), twins.begin(), twins.end());
        Faces after;
        for (const Face& face : before) {
            if (random() % 2 == 0) {
                after.push_back(face);
                continue;
            }
            Vec3f middle = Vec3f::Zero();
            for (const Vec3f& corner : face.corners)
                middle += 0.25f * corner;
            for (std::size_t i = 0; i < 4; ++i) {
                after.push_back(face);
                after.back().corners = {face.corners[i], face.corners[(i + 1) % 4], middle};
            }
        }
        after = rounded(after);
        const LoadedLevel loaded = rematch(before, after);
        EXPECT_TRUE(wrong_faces(after, loaded).empty()) << seed << ": " << loaded.match.text();
    }
}

}  // namespace
}  // namespace slipface::test
