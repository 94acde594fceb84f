// Parts that are alike, in random levels: what moved them must not give them each other's types.
#include <array>
#include <map>

#include "faces.h"

namespace slipface::test {
namespace {

using Random = std::mt19937;

float between(Random& random, float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(random);
}

Faces box(const Vec3f& low, const Vec3f& size, Random& random) {
    const auto at = [&](int x, int y, int z) {
        return Vec3f(low + size.cwiseProduct(
                               Vec3f(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z))));
    };
    Faces faces{quad(at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)),
                quad(at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0)),
                quad(at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0)),
                quad(at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)),
                quad(at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0)),
                quad(at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1))};
    for (Face& face : faces)
        face.painted = static_cast<int>(random() % 6) - 1;
    return faces;
}

// Boxes in a row, each of the base size changed by up to `difference`, after a floor of tiles.
struct Row {
    Faces faces;
    std::vector<std::size_t> first;  // [box] its first face
    std::vector<Vec3f> low;
};

Row row_of_boxes(Random& random, float difference) {
    Row row;
    row.faces = tiles(4);
    for (Face& face : row.faces)
        face.painted = static_cast<int>(random() % 6) - 1;
    const Vec3f size(between(random, 0.3f, 3.0f), between(random, 0.3f, 3.0f), between(random, 0.3f, 3.0f));
    const int count = 3 + static_cast<int>(random() % 6);
    for (int i = 0; i < count; ++i) {
        const Vec3f change = Vec3f(between(random, -1, 1), between(random, -1, 1), between(random, -1, 1));
        row.low.emplace_back(20.0f + 5.0f * static_cast<float>(i) + between(random, 0, 1),
                             between(random, 0, 2), between(random, -9, 9));
        row.first.push_back(row.faces.size());
        const Vec3f own = size.cwiseProduct(Vec3f::Ones() + difference * change);
        for (const Face& face : box(row.low.back(), own, random))
            row.faces.push_back(face);
    }
    return row;
}

// The row after two boxes, or all of them in turn, took each other's places.
Faces after_exchange(const Row& row, Random& random) {
    std::vector<std::size_t> to(row.low.size());
    std::iota(to.begin(), to.end(), std::size_t{0});
    if (random() % 2 == 0)
        std::rotate(to.begin(), to.begin() + 1, to.end());
    else
        std::swap(to[random() % to.size()], to[random() % to.size()]);
    Faces after = row.faces;
    for (std::size_t i = 0; i < to.size(); ++i)
        for (std::size_t face = 0; face < 6; ++face)
            for (Vec3f& corner : after[row.first[i] + face].corners)
                corner += row.low[to[i]] - row.low[i];
    return rounded(after);
}

std::size_t wrong_and_unsaid(const Faces& faces, const LoadedLevel& loaded) {
    std::size_t unsaid = 0;
    for (const std::size_t face : wrong_faces(faces, loaded))
        unsaid += loaded.level.overrides[face] &&
                          !std::binary_search(loaded.level.guessed.begin(), loaded.level.guessed.end(), face)
                      ? 1
                      : 0;
    return unsaid;
}

// A tool that moves objects leaves the vertices in the order of the file, so that even equal boxes stay
// different.
TEST(Parts, BoxesThatExchangePlacesKeepTheirTypes) {
    for (unsigned seed = 0; seed < 300; ++seed) {
        Random random(seed);
        const Row row = row_of_boxes(random, seed % 3 == 0 ? 0.0f : seed % 3 == 1 ? 0.05f : 0.4f);
        const Faces after = after_exchange(row, random);
        const LoadedLevel loaded = rematch(row.faces, after);
        EXPECT_TRUE(wrong_faces(after, loaded).empty()) << seed << ": " << loaded.match.text();
    }
}

// Copies of one object, and a floor: in another order in the file, moved or not. `joined`: of one object
// then.
struct Copies {
    Faces before, after;
};

Copies copies_in_another_order(Random& random, bool joined) {
    Row row = row_of_boxes(random, 0.0f);
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i <= row.low.size(); ++i)
        order.push_back(i);
    const auto object_of = [&](std::size_t face) {
        return face < row.first[0] ? 0 : (face - row.first[0]) / 6 + 1;
    };
    for (std::size_t face = 0; face < row.faces.size(); ++face)
        row.faces[face].object = "object" + std::to_string(object_of(face));
    std::shuffle(order.begin(), order.end(), random);
    const bool all_move = random() % 4 == 0, some_move = !joined && random() % 2 == 0;
    const Vec3f way(between(random, -9, 9), between(random, -1, 1), between(random, -9, 9));
    Copies copies{row.faces, {}};
    for (const std::size_t object : order) {
        const bool moves = all_move || (some_move && object > 0 && random() % 3 == 0);
        const Vec3f own = all_move ? way : Vec3f(0, 7, between(random, 10, 19));
        for (std::size_t face = 0; face < row.faces.size(); ++face) {
            if (object_of(face) != object) continue;
            Face after = row.faces[face];
            if (joined) after.object = "all";
            for (Vec3f& corner : after.corners)
                corner += moves ? own : Vec3f(Vec3f::Zero());
            copies.after.push_back(after);
        }
    }
    copies.after = rounded(copies.after);
    return copies;
}

// Their vertices have other numbers then, even those of the copy that is at the same place in the file.
TEST(Parts, CopiesInAnotherOrderKeepTheirTypes) {
    for (unsigned seed = 0; seed < 300; ++seed) {
        Random random(seed);
        const Copies copies = copies_in_another_order(random, false);
        const LoadedLevel loaded = rematch(copies.before, copies.after);
        EXPECT_TRUE(wrong_faces(copies.after, loaded).empty()) << seed << ": " << loaded.match.text();
        EXPECT_TRUE(loaded.level.guessed.empty()) << seed << ": " << loaded.match.text();
    }
}

// The numbers of a copy's vertices are those of the next one then, which nobody painted.
TEST(Parts, ADeletedCopysTypesGoToNoOther) {
    for (unsigned seed = 0; seed < 300; ++seed) {
        Random random(seed);
        Row row = row_of_boxes(random, 0.0f);
        const std::size_t gone = random() % row.low.size();
        Faces after;
        for (std::size_t face = 0; face < row.faces.size(); ++face) {
            const std::size_t box = face < row.first[0] ? no_id : (face - row.first[0]) / 6;
            row.faces[face].object = "object" + std::to_string(box);
            if (box != no_id && box != gone && random() % 2 == 0) row.faces[face].painted = -1;
            if (box != gone) after.push_back(row.faces[face]);
        }
        after = rounded(after);
        const LoadedLevel loaded = rematch(row.faces, after);
        EXPECT_TRUE(wrong_faces(after, loaded).empty()) << seed << ": " << loaded.match.text();
    }
}

TEST(Parts, CopiesThatAreJoinedInAnotherOrderKeepTheirTypes) {
    for (unsigned seed = 0; seed < 300; ++seed) {
        Random random(seed);
        const Copies copies = copies_in_another_order(random, true);
        const LoadedLevel loaded = rematch(copies.before, copies.after);
        EXPECT_TRUE(wrong_faces(copies.after, loaded).empty()) << seed << ": " << loaded.match.text();
    }
}

// Where the order is lost, too, the boxes' sizes tell nearly equal ones apart, or they are questions.
TEST(Parts, NearlyEqualBoxesInAnotherOrderGetNoWrongTypeUnsaid) {
    std::size_t found = 0, painted = 0;
    for (unsigned seed = 0; seed < 60; ++seed) {
        Random random(seed);
        const Row row = row_of_boxes(random, 0.05f);
        const Faces after = shuffled(after_exchange(row, random), seed);
        const LoadedLevel loaded = rematch(row.faces, after);
        EXPECT_EQ(wrong_and_unsaid(after, loaded), 0u) << seed << ": " << loaded.match.text();
        for (std::size_t i = 0; i < after.size(); ++i) {
            painted += after[i].painted >= 0 ? 1 : 0;
            found += after[i].painted >= 0 && loaded.level.overrides[i] &&
                             int{*loaded.level.overrides[i]} == after[i].painted
                         ? 1
                         : 0;
        }
    }
    RecordProperty("found", static_cast<int>(found));
    RecordProperty("painted", static_cast<int>(painted));
    EXPECT_GT(static_cast<double>(found), 0.9 * static_cast<double>(painted));
}

// As an OBJ has them: vertices by themselves, those of an object (its faces follow each other) together. A
// mirrored face's corners come in the other order, or not (`windings_left`), but each vertex keeps its
// number.
MeshPtr obj_mesh(const Faces& faces, bool mirrored, bool windings_left = false) {
    PolygonSoup soup;
    soup.face_first_corner.push_back(0);
    std::map<std::array<float, 3>, std::uint32_t> numbers;
    for (const Face& face : faces) {
        if (soup.groups.empty() || face.object != soup.groups.back()) {
            soup.groups.push_back(face.object);
            numbers.clear();
        }
        std::vector<std::uint32_t> corners;
        for (const Vec3f& corner : face.corners) {
            const auto [at, added] = numbers.emplace(std::array{corner.x(), corner.y(), corner.z()},
                                                     static_cast<std::uint32_t>(soup.vertex_position.size()));
            if (added)
                soup.vertex_position.emplace_back(six_decimals(mirrored ? -corner.x() : corner.x()),
                                                  six_decimals(corner.y()), six_decimals(corner.z()));
            corners.push_back(at->second);
        }
        if (mirrored && !windings_left) std::reverse(corners.begin(), corners.end());
        soup.corner_vertex.insert(soup.corner_vertex.end(), corners.begin(), corners.end());
        soup.face_first_corner.push_back(static_cast<std::uint32_t>(soup.corner_vertex.size()));
        soup.face_group.push_back(static_cast<std::uint32_t>(soup.groups.size() - 1));
    }
    Material stone;
    stone.name = "stone";
    soup.materials = {stone};
    return *build_mesh(std::move(soup));
}

// A file can give many objects one name. Of a mesh that nobody changed everything is where it was.
TEST(Parts, ObjectsOfOneNameStay) {
    for (unsigned seed = 0; seed < 100; ++seed) {
        Random random(seed);
        Row row = row_of_boxes(random, 0.3f);
        Faces& faces = row.faces;
        for (std::size_t box = 0; box < row.first.size(); ++box)
            for (std::size_t i = row.first[box]; i < row.first[box] + 6; ++i)
                faces[i].object = box % 2 == 0 ? "crate" : "box" + std::to_string(box);
        Level level = level_of(faces);
        const MeshPtr mesh = obj_mesh(faces, false);
        level.mesh = mesh;
        const Result<LoadedLevel> loaded = level_from_json(level_to_json(level), "test.slipface.json", mesh);
        ASSERT_TRUE(loaded) << loaded.error().text();
        EXPECT_EQ(wrong_faces(faces, *loaded), std::vector<std::size_t>()) << seed;
        EXPECT_TRUE(loaded->level.guessed.empty()) << seed;
    }
}

Faces mirrored(Faces faces) {
    for (Face& face : faces) {
        for (Vec3f& corner : face.corners)
            corner.x() = -corner.x();
        std::reverse(face.corners.begin(), face.corners.end());
    }
    return faces;
}

// Two halves that mirror each other, with different paint: mirrored as a whole, it looks as if nothing had
// happened.
Faces symmetric_level(Random& random) {
    Faces faces = row_of_boxes(random, 0.3f).faces;
    for (Face face : mirrored(faces)) {
        face.painted = static_cast<int>(random() % 6) - 1;
        faces.push_back(face);
    }
    return faces;
}

// Where a tool sorts faces and vertices, too, nothing says whether it was mirrored.
TEST(Parts, ASymmetricLevelThatIsSortedIsAQuestion) {
    for (unsigned seed = 0; seed < 100; ++seed) {
        Random random(seed);
        const Faces faces = symmetric_level(random);
        const Faces after = shuffled(seed % 2 == 0 ? mirrored(faces) : faces, seed);
        EXPECT_EQ(wrong_and_unsaid(after, rematch(faces, after)), 0u) << seed;
    }
}

// In its order: that it was mirrored is the likelier reading.
TEST(Parts, ASymmetricLevelThatIsMirroredKeepsItsTypes) {
    for (unsigned seed = 0; seed < 100; ++seed) {
        Random random(seed);
        const Faces faces = symmetric_level(random);
        const Result<LoadedLevel> loaded =
            level_from_json(level_to_json(level_of(faces)), "test.slipface.json", obj_mesh(faces, true));
        ASSERT_TRUE(loaded.ok()) << loaded.error().text();
        EXPECT_TRUE(wrong_faces(faces, *loaded).empty()) << seed << ": " << loaded->match.text();
    }
}

// Equal boxes that touch, on both sides of the mirror: each is where another one was, and shares its corners
// with its neighbours. A tool wrote them in another order.
TEST(Parts, ObjectsThatTouchKeepTheirTypesMirroredAndInAnotherOrder) {
    for (unsigned seed = 0; seed < 300; ++seed) {
        Random random(seed);
        const Vec3f size(between(random, 0.3f, 3.0f), between(random, 0.3f, 3.0f),
                         between(random, 0.3f, 3.0f));
        const int count = 2 * (1 + static_cast<int>(random() % 4));
        std::vector<Faces> objects;
        for (int i = 0; i < count; ++i) {
            const auto column = static_cast<float>(i) - 0.5f * static_cast<float>(count);
            objects.push_back(box(Vec3f(column * size.x(), 0, 0), size, random));
            for (Face& face : objects.back())
                face.object = "object" + std::to_string(i);
        }
        Faces before, after;
        for (const Faces& object : objects)
            before.insert(before.end(), object.begin(), object.end());
        std::shuffle(objects.begin(), objects.end(), random);
        for (const Faces& object : objects)
            after.insert(after.end(), object.begin(), object.end());
        Level level = level_of(before);
        level.mesh = obj_mesh(before, false);
        const MeshPtr mesh = obj_mesh(after, seed % 3 > 0, seed % 3 == 2);
        const Result<LoadedLevel> loaded = level_from_json(level_to_json(level), "test.slipface.json", mesh);
        ASSERT_TRUE(loaded.ok()) << loaded.error().text();
        EXPECT_TRUE(wrong_faces(after, *loaded).empty()) << seed << ": " << loaded->match.text();
    }
}

// A decimation leaves small parts hardly a corner, but they did what the others of their object did.
TEST(Parts, DamagedOnesFollowTheOthers) {
    std::size_t found = 0, painted = 0;
    for (unsigned seed = 0; seed < 60; ++seed) {
        Random random(seed);
        const Row row = row_of_boxes(random, 0.4f);
        Faces after = row.faces;
        std::vector<bool> damaged(after.size(), false);
        for (std::size_t i = 2; i < row.first.size(); i += 3) {
            const Vec3f size = after[row.first[i] + 1].corners[2] - row.low[i];  // the far upper corner
            std::map<std::array<float, 3>, Vec3f> to;
            for (std::size_t face = row.first[i]; face < row.first[i] + 6; ++face) {
                damaged[face] = true;
                for (Vec3f& corner : after[face].corners) {
                    const auto [at, added] = to.try_emplace({corner.x(), corner.y(), corner.z()}, corner);
                    for (int axis = 0; axis < 3 && added; ++axis)
                        at->second[axis] += (corner[axis] > row.low[i][axis] ? -1.0f : 1.0f) * size[axis] *
                                            between(random, 0.02f, 0.1f);
                    corner = at->second;
                }
            }
        }
        const Eigen::Affine3f motion(Eigen::Translation3f(between(random, 1, 9), 0, between(random, 1, 9)) *
                                     Eigen::AngleAxisf(between(random, 0.1f, 3), Vec3f::UnitY()));
        for (Face& face : after)
            for (Vec3f& corner : face.corners)
                corner = motion * corner;
        const LoadedLevel loaded = rematch(row.faces, rounded(after));
        EXPECT_EQ(wrong_and_unsaid(after, loaded), 0u) << seed << ": " << loaded.match.text();
        for (std::size_t i = 0; i < after.size(); ++i) {
            if (!damaged[i] || after[i].painted < 0) continue;
            ++painted;
            found += loaded.level.overrides[i] == static_cast<SurfaceId>(after[i].painted) ? 1 : 0;
        }
    }
    RecordProperty("found", static_cast<int>(found));
    RecordProperty("painted", static_cast<int>(painted));
    EXPECT_GT(static_cast<double>(found), 0.9 * static_cast<double>(painted));
}

// At a hundredth of its size six decimals join what is less than a tenth of a millimetre apart.
TEST(Parts, OnesThatRoundingJoinsFollowTheLevel) {
    for (unsigned seed = 0; seed < 8; ++seed) {
        Random random(seed);
        Faces faces;
        for (int i = 0; i < 12; ++i) {
            const Vec3f size(between(random, 0.3f, 3.0f), between(random, 0.3f, 3.0f),
                             between(random, 0.3f, 3.0f));
            const Vec3f low(5.0f * static_cast<float>(i), between(random, 0, 2), between(random, -9, 9));
            const int count = i < 2 ? 3 : 1;  // in a stack
            for (int k = 0; k < count; ++k)
                for (const Face& face :
                     box(low + static_cast<float>(k) * Vec3f(0, size.y() + 3e-5f, 0), size, random))
                    faces.push_back(face);
        }
        Faces after = faces;
        for (Face& face : after)
            for (Vec3f& corner : face.corners)
                corner *= 0.01f;
        const LoadedLevel loaded = rematch(faces, rounded(after));
        EXPECT_TRUE(wrong_faces(after, loaded).empty()) << seed << ": " << loaded.match.text();
    }
}

// Two parts in nearly the same box, as a room and its lining: scaled along one axis, their boxes may be as
// alike as boxes of equal parts are.
TEST(Parts, OneInsideAnotherIsFoundScaledUnevenly) {
    for (unsigned seed = 0; seed < 100; ++seed) {
        Random random(seed);
        const Vec3f size(between(random, 5, 9), between(random, 2, 4), between(random, 2, 4));
        Faces faces = box(Vec3f::Zero(), size, random);
        const Vec3f smaller = size.cwiseProduct(Vec3f(1, between(random, 0.8f, 0.97f), 1));
        for (const Face& face : box(Vec3f(0.01f, 0, 0.01f), smaller - Vec3f(0.02f, 0, 0.02f), random))
            faces.push_back(face);
        std::map<std::array<float, 3>, float> moved;  // so that they are not symmetric
        for (Face& face : faces)
            for (Vec3f& corner : face.corners)
                corner.x() += moved.try_emplace({corner.x(), corner.y(), corner.z()}, between(random, 0, 1))
                                  .first->second;
        Faces after = faces;
        const float scale = between(random, 1.2f, 2.5f);
        for (Face& face : after)
            for (Vec3f& corner : face.corners)
                corner.x() *= scale;
        const LoadedLevel loaded = rematch(faces, rounded(after));
        EXPECT_TRUE(wrong_faces(after, loaded).empty()) << seed << ": " << loaded.match.text();
    }
}

// Four tiles become one face, which has the material of one of them, whatever the others were made of.
TEST(Parts, AMergedFaceHasTheTypeOfMostOfItsTiles) {
    constexpr std::size_t side = 16;
    std::size_t clear = 0;
    for (unsigned seed = 0; seed < 30; ++seed) {
        Random random(seed);
        Faces before = tiles(side), after;
        for (Face& face : before) {
            face.painted = static_cast<int>(random() % 3);
            face.material = random() % 2 == 0 ? "stone" : "wood";
        }
        std::vector<std::optional<int>> wanted;  // [of `after`] what more than half of it is painted with
        for (std::size_t z = 0; z < side; z += 2) {
            for (std::size_t x = 0; x < side; x += 2) {
                const std::size_t block[] = {z * side + x, (z + 1) * side + x, (z + 1) * side + x + 1,
                                             z * side + x + 1};
                Face& face = after.emplace_back(before[block[random() % 4]]);
                std::array<int, 3> count{};
                for (std::size_t k = 0; k < 4; ++k) {
                    face.corners[k] = before[block[k]].corners[k];
                    ++count[static_cast<std::size_t>(before[block[k]].painted)];
                }
                const auto most = std::max_element(count.begin(), count.end());
                wanted.push_back(*most > 2 ? std::optional(static_cast<int>(most - count.begin()))
                                           : std::nullopt);
                clear += *most > 2 ? 1 : 0;
            }
        }
        const LoadedLevel loaded = rematch(before, after);
        for (std::size_t i = 0; i < after.size(); ++i) {
            const auto& type = loaded.level.overrides.at(i);
            EXPECT_EQ(type ? std::optional<int>(*type) : std::nullopt, wanted[i]) << seed << ", face " << i;
        }
    }
    EXPECT_GT(clear, 100u);
}

// Pairs of equal pieces of six faces, three of them painted in one of each pair, all moved. Where a face of
// it was deleted, it is less like itself than like the other one.
TEST(Parts, DamagedPiecesThatLookLikeOthersAreNotTheseUnsaid) {
    std::size_t wrong = 0;
    for (unsigned seed = 1; seed <= 30; ++seed) {
        Random random(seed);
        Faces before = tiles(5);
        for (Face& face : before)
            face.painted = static_cast<int>(random() % 5);
        std::vector<std::size_t> first;  // [painted piece]
        for (int pair = 0; pair < 8; ++pair) {
            std::vector<Vec3f> rim;
            for (int i = 0; i < 7; ++i)
                rim.emplace_back(0.3f * static_cast<float>(i), between(random, 0.5f, 2.0f),
                                 between(random, -0.3f, 0.3f));
            first.push_back(before.size());
            for (const bool painted : {true, false}) {
                const Vec3f at(between(random, 20, 90), between(random, 0, 3), between(random, -40, 40));
                for (std::size_t i = 1; i < rim.size(); ++i)
                    before.push_back({{at, at + rim[i - 1], at + rim[i]},
                                      "stone",
                                      painted && i % 2 != 0 ? static_cast<int>(random() % 5) : -1});
            }
        }
        Faces after = before;
        for (Face& face : after)
            for (Vec3f& corner : face.corners)
                corner.x() += 1.0f;
        for (std::size_t piece = first.size(); piece-- > 0;)
            if (random() % 2 == 0) after.erase(after.begin() + static_cast<std::ptrdiff_t>(first[piece]));
        const LoadedLevel loaded = rematch(before, after);
        const std::vector<FaceId>& guessed = loaded.level.guessed;
        for (const std::size_t face : wrong_faces(after, loaded))
            wrong += loaded.level.overrides[face] &&
                             !std::binary_search(guessed.begin(), guessed.end(), static_cast<FaceId>(face))
                         ? 1
                         : 0;
    }
    EXPECT_EQ(wrong, 0u);
}

}  // namespace
}  // namespace slipface::test
