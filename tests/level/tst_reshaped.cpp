// Faces that bevels, insets and moved or deleted neighbours leave in another shape.
#include <array>
#include <cmath>
#include <map>

#include "faces.h"

namespace slipface::test {
namespace {

// Of `after`: painted faces, and those of them and of the unpainted ones with another type.
struct Count {
    std::size_t painted = 0, listed = 0, wrong = 0;
};

void add(Count& count, const Faces& after, const LoadedLevel& loaded) {
    count.painted += painted_count(after);
    for (const std::size_t face : wrong_faces(after, loaded))
        ++(loaded.level.overrides[face] ? count.wrong : count.listed);
}

// Equal lamps of three rings, as models stand in maps, each face with a type of its own.
Faces lamps(Random& random) {
    Faces faces;
    for (int lamp = 0; lamp < 30; ++lamp) {
        const auto at = [&](int ring, int side) {
            const float angle = 0.785398163f * static_cast<float>(side % 8);
            const float radius = ring == 1 ? 0.3f : 0.2f;
            return Vec3f(3.0f * static_cast<float>(lamp) + radius * std::cos(angle),
                         0.3f * static_cast<float>(ring), radius * std::sin(angle));
        };
        for (int ring = 0; ring < 3; ++ring) {
            for (int side = 0; side < 8; ++side) {
                faces.push_back(
                    quad(at(ring, side), at(ring + 1, side), at(ring + 1, side + 1), at(ring, side + 1)));
                faces.back().painted = drawn_type(random);
            }
        }
    }
    return faces;
}

// With so many moved vertices one lamp is like another as much as it is like itself.
TEST(Reshaped, EqualPartsOfWhichVerticesMovedStay) {
    Count count;
    for (unsigned seed = 1; seed <= 10; ++seed) {
        Random random(seed);
        const Faces before = lamps(random);
        Faces after = before;
        std::map<std::array<float, 3>, Vec3f> moved;
        for (Face& face : after) {
            for (Vec3f& corner : face.corners) {
                const auto [at, added] =
                    moved.emplace(std::array{corner.x(), corner.y(), corner.z()}, corner);
                if (added && random() % 3 == 0)
                    at->second += Vec3(drawn(random, -0.03, 0.03), drawn(random, -0.03, 0.03),
                                       drawn(random, -0.03, 0.03))
                                      .cast<float>();
                corner = at->second;
            }
        }
        add(count, after, rematch(before, after));
    }
    EXPECT_EQ(count.wrong, 0u);
    EXPECT_LE(count.listed * 50, count.painted);
}

// Every corner this far from its old edges.
Face inset(Face face, float width) {
    const std::vector<Vec3f> old = face.corners;
    const std::size_t count = old.size();
    for (std::size_t c = 0; c < count; ++c) {
        const Vec3f to_next = (old[(c + 1) % count] - old[c]).normalized();
        const Vec3f to_last = (old[(c + count - 1) % count] - old[c]).normalized();
        face.corners[c] += width / to_next.cross(to_last).norm() * (to_next + to_last);
    }
    return face;
}

// The face inset, and the rim around it.
void add_inset(const Face& face, float width, Faces& faces) {
    const Face inner = inset(face, width);
    faces.push_back(inner);
    for (std::size_t c = 0; c < face.corners.size(); ++c) {
        const std::size_t next = (c + 1) % face.corners.size();
        faces.push_back({{face.corners[c], face.corners[next], inner.corners[next], inner.corners[c]},
                         face.material,
                         face.painted});
    }
}

// A quad cut along one diagonal lies on the same quad cut along the other: compilers of maps leave such
// faces. What is left of each triangle is still most like itself.
TEST(Reshaped, InsetTrianglesOnOthersKeepTheirTypes) {
    Count count;
    for (unsigned seed = 1; seed <= 20; ++seed) {
        Random random(seed);
        Faces before, after;
        for (int i = 0; i < 20; ++i) {
            const float x = 2.0f * static_cast<float>(i);
            const auto width = static_cast<float>(drawn(random, 0.7, 1.5));
            const Vec3f a(x, 0, 0), b(x, 0, 1), c(x + width, 0, 1), d(x + width, 0, 0);
            for (const Face& face : {Face{{a, b, c}}, Face{{a, c, d}}, Face{{b, c, d}}, Face{{a, b, d}}}) {
                before.push_back(face);
                before.back().painted = static_cast<int>(random() % 5);
                after.push_back(inset(before.back(), 0.06f));
            }
        }
        add(count, after, rematch(before, after));
    }
    EXPECT_EQ(count.wrong, 0u);
    EXPECT_LE(count.listed * 100, count.painted);
}

// A rim of 1 cm lies over the neighbour's outline if that is only known to 1 % of 20 m.
TEST(Reshaped, RimsOfLargeInsetTrianglesAreTheirs) {
    Count count;
    for (unsigned seed = 1; seed <= 10; ++seed) {
        Random random(seed);
        Faces before, after;
        for (int i = 0; i < 12; ++i) {
            const auto height = static_cast<float>(i);
            Vec3f last(20, height, 0);
            for (int k = 1; k <= 3; ++k) {
                const float angle = 0.5f * static_cast<float>(k);
                const auto radius = static_cast<float>(drawn(random, 14, 22));
                const Vec3f next(radius * std::cos(angle), height, -radius * std::sin(angle));
                const Face face{{Vec3f(0, height, 0), last, next}, "stone", drawn_type(random)};
                before.push_back(face);
                add_inset(face, 0.01f, after);
                last = next;
            }
        }
        add(count, after, rematch(before, after));
    }
    EXPECT_EQ(count.wrong, 0u);
    EXPECT_LE(count.listed * 100, count.painted);
}

// Unpainted plates close above tiles do not have the types of these, though the tiles were inset or bevelled.
TEST(Reshaped, PlatesAboveInsetTilesStayUnpainted) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
        Random random(seed);
        const Faces plates = tiles(8, static_cast<float>(drawn(random, 0.002, 0.018)));
        Faces before = tiles(8, 0.0f);
        for (Face& face : before)
            face.painted = static_cast<int>(random() % 5);
        Faces after = before;
        for (const std::size_t tile : std::array<std::size_t, 5>{9, 20, 30, 43, 54}) {
            after[tile] = inset(after[tile], static_cast<float>(drawn(random, 0.02, 0.2)));
            before.push_back(plates[tile]);
            after.push_back(plates[tile]);
        }
        EXPECT_TRUE(wrong_faces(after, rematch(before, after)).empty()) << seed;
    }
}

// Floors close above each other: where a tile was deleted, its type is not that of the one above or below.
TEST(Reshaped, DeletedTilesAreNotTheOnesBehind) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        Random random(seed);
        Faces before;
        for (int floor = 0; floor < 4; ++floor)
            for (const Face& face : tiles(6, 0.4f * static_cast<float>(floor)))
                before.push_back(face);
        for (Face& face : before)
            face.painted = drawn_type(random);
        Faces after = before;
        std::erase_if(after, [&](const Face&) { return random() % 6 == 0; });
        EXPECT_TRUE(wrong_faces(after, rematch(before, after)).empty()) << seed;
    }
}

// An unpainted copy of a floor lies close to it; some tiles of the floor are inset, so that only the copy has
// as many faces as the floor had.
TEST(Reshaped, AFloorWithInsetTilesIsNotTheLayerOnIt) {
    for (unsigned seed = 1; seed <= 30; ++seed) {
        Random random(seed);
        const int side = 4 + static_cast<int>(random() % 7);
        const auto gap = static_cast<float>(drawn(random, 0.002, 0.05) * (random() % 2 == 0 ? 1 : -1));
        Faces before = tiles(side), layer = tiles(side, 0.1f + gap);
        for (Face& face : before)
            face.painted = static_cast<int>(random() % 5);
        Faces after;
        const double inset_share = drawn(random, 0.02, 0.5);
        for (const Face& face : before) {
            if (after.empty() || drawn(random, 0, 1) < inset_share)
                add_inset(face, static_cast<float>(drawn(random, 0.05, 0.3)), after);
            else
                after.push_back(face);
        }
        before.insert(before.end(), layer.begin(), layer.end());
        after.insert(after.end(), layer.begin(), layer.end());
        EXPECT_TRUE(wrong_faces(after, rematch(before, after)).empty()) << seed;
    }
}

// Four quarters of a quad.
void add_four_quads(const Face& face, Faces& faces) {
    const std::vector<Vec3f>& at = face.corners;
    const Vec3f centre = 0.25f * (at[0] + at[1] + at[2] + at[3]);
    for (std::size_t c = 0; c < 4; ++c)
        faces.push_back({{at[c], 0.5f * (at[c] + at[(c + 1) % 4]), centre, 0.5f * (at[c] + at[(c + 3) % 4])},
                         face.material,
                         face.painted});
}

// A small crate stands against an unpainted one twice as large. After both are subdivided, a quarter of the
// large one's side is where the small one's was, and looks the other way.
TEST(Reshaped, ASubdividedCrateIsNotTheSideOfTheOneBehind) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        Random random(seed);
        const auto size = static_cast<float>(drawn(random, 0.5, 3));
        Faces before = tiles(5);
        for (Face& face : before)
            face.painted = drawn_type(random);
        const Vec3f place(30.0f, 0.0f, static_cast<float>(drawn(random, -9, 9)));
        const auto add_crate = [&](const Vec3f& low, float edge, bool painted) {
            const auto at = [&](int x, int y, int z) {
                return Vec3f(
                    low + edge * Vec3f(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)));
            };
            for (const Face& face : {quad(at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)),
                                     quad(at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0)),
                                     quad(at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0)),
                                     quad(at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)),
                                     quad(at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0)),
                                     quad(at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1))})
                before.push_back({face.corners, "crate", painted && random() % 2 == 0 ? 1 : -1});
        };
        add_crate(place - Vec3f(size, 0, 0), size, true);
        before.back().painted = 2;  // the side at the large one
        add_crate(place, 2.0f * size, false);
        Faces after;
        for (const Face& face : before)
            add_four_quads(face, after);
        EXPECT_TRUE(wrong_faces(after, rematch(before, after)).empty()) << seed;
    }
}

// A bevel can make a narrow face cross itself and reach over both of its neighbours. The difference of its
// two sides, which is its area by its corners, is no measure of what it covers.
TEST(Reshaped, AFaceThatCrossesItselfIsNoneOfItsNeighbours) {
    for (unsigned seed = 1; seed <= 40; ++seed) {
        Random random(seed);
        const auto x = [&](double low, double high) { return static_cast<float>(drawn(random, low, high)); };
        const auto plate = [](float left, float right, int painted) {
            return Face{{Vec3f(left, 0, 0), Vec3f(left, 0, 1), Vec3f(right, 0, 1), Vec3f(right, 0, 0)},
                        "stone",
                        painted};
        };
        Faces before = tiles(5, 3.0f);
        for (Face& tile : before)
            tile.painted = drawn_type(random);
        Faces after = before;
        before.push_back(plate(0, 1.02f, 3));
        before.push_back(plate(1.02f, 1.08f, -1));
        before.push_back(plate(1.08f, 2, 4));
        after.push_back(plate(0, 0.9f, 3));
        after.push_back(plate(1.14f, 2, 4));
        const float wide = x(0.18, 0.2), narrow = x(0.14, 0.16), middle = 1.02f;
        after.push_back({{Vec3f(middle + 0.5f * narrow, 0, 0), Vec3f(middle - 0.5f * wide, 0, 1),
                          Vec3f(middle + 0.5f * wide, 0, 1), Vec3f(middle - 0.5f * narrow, 0, 0)}});
        EXPECT_TRUE(wrong_faces(after, rematch(before, after)).empty()) << seed;
    }
}

// An edit that collapses edges can leave a triangle with the middle and the area that another one had.
TEST(Reshaped, ATriangleOfTheSamePlaceAndSizeWithOtherCornersIsAGuess) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        Random random(seed);
        const Vec3f at(static_cast<float>(drawn(random, 20, 30)), 1.0f, 0.0f);
        const auto step = static_cast<float>(drawn(random, 0.2, 2));
        const auto triangle = [&](int a, int b, int top, int painted) {
            return Face{{at + Vec3f(0, 0, step * static_cast<float>(a)),
                         at + Vec3f(0, 0, step * static_cast<float>(b)),
                         at + Vec3f(1, 0, step * static_cast<float>(top))},
                        "stone",
                        painted};
        };
        Faces before = tiles(5);
        for (int i = 0; i < 6; ++i)  // the floor beside it
            before.push_back(quad(at + Vec3f(-1, 0, step * static_cast<float>(i)),
                                  at + Vec3f(-1, 0, step * static_cast<float>(i + 1)),
                                  at + Vec3f(0, 0, step * static_cast<float>(i + 1)),
                                  at + Vec3f(0, 0, step * static_cast<float>(i))));
        for (Face& face : before)
            face.painted = drawn_type(random);
        Faces after = before;
        before.push_back(triangle(1, 2, 0, 3));
        after.insert(after.begin(), triangle(0, 1, 2, 3));  // not even where it was in the order
        const LoadedLevel loaded = rematch(before, after);
        const bool found = loaded.level.overrides.at(0).has_value();
        EXPECT_TRUE(!found || loaded.level.guessed == std::vector<FaceId>{0}) << seed;
        EXPECT_TRUE(rematch(before, shuffled(rounded(before), seed)).level.guessed.empty()) << seed;
    }
}

// Lids of five faces, of which decimating left two or three triangles and no corner in its place, on a floor
// that is as it was.
TEST(Reshaped, SmallPiecesOfWhichFewFacesAreLeftGetNoOtherTypes) {
    Count count;
    for (unsigned seed = 1; seed <= 40; ++seed) {
        Random random(seed);
        Faces before = tiles(8);
        for (Face& face : before)
            face.painted = drawn_type(random);
        Faces after = before;
        for (int i = 0; i < 5; ++i) {
            const Vec3 low(1.5 * i, 0.5, drawn(random, -6, -1));
            const Vec3 size(drawn(random, 0.2, 1), drawn(random, 0.1, 1), drawn(random, 0.2, 1));
            const auto at = [&](double x, double y, double z) -> Vec3f {
                return (low + size.cwiseProduct(Vec3(x, y, z))).cast<float>();
            };
            Faces lid = {quad(at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0)),
                         quad(at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0)),
                         quad(at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)),
                         quad(at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0)),
                         quad(at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1))};
            for (std::size_t k = 0; k < lid.size(); ++k) {
                Face& face = lid[k];
                face.painted = drawn_type(random);
                before.push_back(face);
                if (k > 1 + random() % 2) continue;
                const double from = drawn(random, 0.02, 0.2);
                const auto toward = [&](std::size_t a, std::size_t b) -> Vec3f {
                    return face.corners[a] + static_cast<float>(from) * (face.corners[b] - face.corners[a]);
                };
                after.push_back({{toward(0, 1), toward(1, 2), toward(3, 0)}, face.material, face.painted});
            }
        }
        add(count, after, rematch(before, after));
    }
    EXPECT_EQ(count.wrong, 0u);
}

}  // namespace
}  // namespace slipface::test
