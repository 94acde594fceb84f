// Parts of a level that another program moved, turned, scaled or mirrored keep their types.
#include "level/faces.h"

namespace slipface::test {
namespace {

struct Motion3 {
    const char* name;
    Eigen::Affine3f motion;
    bool reversed;
};

class MovedPart : public testing::TestWithParam<Motion3> {};

TEST_P(MovedPart, KeepsItsTypes) {
    const Moving rooms = two_rooms();
    Faces after = rooms.before;
    for (std::size_t i = 0; i < rooms.moving; ++i) {
        for (Vec3f& corner : after[i].corners)
            corner = GetParam().motion * corner;
        if (GetParam().reversed) std::reverse(after[i].corners.begin(), after[i].corners.end());
    }
    after = rounded(after);
    const LoadedLevel loaded = rematch(rooms.before, after);
    EXPECT_TRUE(wrong_faces(after, loaded).empty());
    EXPECT_EQ(loaded.match.orphaned, 0u) << loaded.match.text();
    EXPECT_EQ(loaded.match.exact, painted_count(rooms.before)) << loaded.match.text();
}

Eigen::Affine3f turned(float degrees, const Vec3f& axis) {
    return Eigen::Affine3f(Eigen::AngleAxisf(degrees / 57.29578f, axis.normalized()));
}

INSTANTIATE_TEST_SUITE_P(
    Motions, MovedPart,
    testing::Values(
        Motion3{"by a tile",
                Eigen::Affine3f(Eigen::Translation3f(tiles(2)[1].corners[0] - tiles(2)[0].corners[0])),
                false},
        Motion3{"far", Eigen::Affine3f(Eigen::Translation3f(10.0f, 3.0f, -20.0f)), false},
        Motion3{"turned a little", turned(1.0f, Vec3f::UnitY()), false},
        Motion3{"turned", turned(130.0f, Vec3f(1, 2, 0.5f)), false},
        Motion3{"larger", Eigen::Affine3f(Eigen::Scaling(2.5f)), false},
        Motion3{"uneven", turned(20.0f, Vec3f::UnitY()) * Eigen::Scaling(1.3f, 0.7f, 2.0f), false},
        Motion3{"mirrored", Eigen::Affine3f(Eigen::Scaling(-1.0f, 1.0f, 1.0f)), true},
        Motion3{"mirrored inside out", Eigen::Affine3f(Eigen::Scaling(-1.0f, 1.0f, 1.0f)), false},
        Motion3{"flipped", Eigen::Affine3f::Identity(), true}),
    [](const testing::TestParamInfo<Motion3>& test) {
        std::string name = test.param.name;
        std::replace(name.begin(), name.end(), ' ', '_');
        return name;
    });

// A square floor about the origin, row by row, with a type for each tile.
Faces square(int n, float height) {
    Faces faces;
    for (int z = -n; z < n; ++z) {
        for (int x = -n; x < n; ++x) {
            const auto at = [&](int dx, int dz) {
                return Vec3f(static_cast<float>(x + dx), height, static_cast<float>(z + dz));
            };
            faces.push_back(quad(at(0, 0), at(0, 1), at(1, 1), at(1, 0)));
            faces.back().painted = (7 * x * x + 3 * z + x) % 5 + (x < 0 ? 1 : 0);
            if (faces.back().painted < 0) faces.back().painted = -1;
        }
    }
    return faces;
}

// Two floors, the first turned by `motion`, which puts it onto itself.
Faces with_first_turned(const Faces& faces, std::size_t first, const Eigen::Affine3f& motion, bool reversed) {
    Faces after = faces;
    for (std::size_t i = 0; i < first; ++i) {
        for (Vec3f& corner : after[i].corners)
            corner = motion * corner;
        if (reversed) std::reverse(after[i].corners.begin(), after[i].corners.end());
    }
    return after;
}

TEST(MovedParts, ASymmetricPartTurnedInItsPlaceIsAGuess) {
    Faces faces = square(4, 0.0f);
    const std::size_t first = faces.size();
    for (const Face& face : square(5, 20.0f))
        faces.push_back(face);
    const struct {
        Eigen::Affine3f motion;
        bool mirrors;
    } cases[] = {{Eigen::Affine3f(Eigen::Scaling(-1.0f, 1.0f, 1.0f)), true},
                 {Eigen::Affine3f(Eigen::Scaling(1.0f, 1.0f, -1.0f)), true},
                 {Eigen::Affine3f(Eigen::Scaling(-1.0f, 1.0f, -1.0f)), false},
                 {turned(90.0f, Vec3f::UnitY()), false}};
    for (const auto& one : cases) {
        const Faces after = rounded(with_first_turned(faces, first, one.motion, one.mirrors));
        const LoadedLevel loaded = rematch(faces, after);
        EXPECT_TRUE(wrong_faces(after, loaded).empty()) << one.motion.matrix();
        EXPECT_FALSE(loaded.level.guessed.empty()) << "it is asked";
    }
    // The same places in another order: nothing turned, but the whole level may have been mirrored.
    for (unsigned seed = 0; seed < 20; ++seed) {
        const Faces other = shuffled(faces, seed);
        const LoadedLevel loaded = rematch(faces, other);
        EXPECT_TRUE(wrong_faces(other, loaded).empty()) << seed;
        EXPECT_FALSE(loaded.level.guessed.empty()) << seed;
    }
    // Sorted along the other axis, it looks as if it had been mirrored in a diagonal.
    Faces sorted = faces;
    std::stable_sort(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(first),
                     [](const Face& a, const Face& b) { return a.corners[0].x() < b.corners[0].x(); });
    const LoadedLevel loaded = rematch(faces, sorted);
    for (const std::size_t face : wrong_faces(sorted, loaded))
        EXPECT_TRUE(!loaded.level.overrides[face] ||
                    std::binary_search(loaded.level.guessed.begin(), loaded.level.guessed.end(), face));
}

Faces crate(const Vec3f& low, float side);

// A single box that was turned onto itself, in a file where no other part shows that the order was kept: its
// types may be wrong, so all of them are questions.
TEST(MovedParts, ALonePartTurnedOntoItselfIsAQuestion) {
    Faces faces = crate({1, 2, 3}, 1.0f);
    for (std::size_t i = 0; i < faces.size(); ++i)
        faces[i].painted = static_cast<int>(i);
    const Vec3f centre(1.5f, 2.5f, 3.5f);
    const auto turn =
        Eigen::Translation3f(centre) * turned(90.0f, Vec3f::UnitY()) * Eigen::Translation3f(-centre);
    const Faces after = rounded(with_first_turned(faces, faces.size(), Eigen::Affine3f(turn), false));
    const LoadedLevel loaded = rematch(faces, after);
    EXPECT_EQ(loaded.match.orphaned, 0u);
    for (const std::size_t face : wrong_faces(after, loaded))
        EXPECT_TRUE(std::binary_search(loaded.level.guessed.begin(), loaded.level.guessed.end(), face))
            << face;
    // All of one type: how it turned does not matter, and nobody is asked.
    for (Face& face : faces)
        face.painted = 1;
    EXPECT_TRUE(rematch(faces, after).level.guessed.empty());
}

Faces crate(const Vec3f& low, float side) {
    const auto at = [&](int x, int y, int z) {
        return Vec3f(low + side * Vec3f(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)));
    };
    return {quad(at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)),
            quad(at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0)),
            quad(at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0)),
            quad(at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)),
            quad(at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0)),
            quad(at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1))};
}

Faces crates(unsigned seed) {
    std::mt19937 random(seed);
    Faces faces;
    for (int i = 0; i < 14; ++i) {
        const float side = random() % 3 == 0 ? 1.7f : 1.0f;
        const Vec3f low(static_cast<float>(5 * i - 20) + 0.0173f * static_cast<float>(random() % 100), 0.0f,
                        15.0f + 0.0913f * static_cast<float>(random() % 100));
        for (Face& face : crate(low, side)) {
            face.painted = static_cast<int>(random() % 6) - 1;
            faces.push_back(face);
        }
    }
    return faces;
}

// Equal crates could each be another one; far from a crate, a motion that was fitted to it is not exact.
TEST(MovedParts, EqualPartsMoveTogether) {
    for (unsigned seed = 0; seed < 6; ++seed) {
        const Faces faces = crates(seed);
        for (const Eigen::Affine3f& motion :
             {Eigen::Affine3f(Eigen::Translation3f(3, 0, 1) * Eigen::Scaling(1.83f, 1.0f, 1.26f)),
              Eigen::Affine3f(Eigen::Scaling(0.01f)), turned(77.0f, Vec3f::UnitY())}) {
            const Faces after = rounded(with_first_turned(faces, faces.size(), motion, false));
            EXPECT_TRUE(wrong_faces(after, rematch(faces, after)).empty()) << seed << "\n" << motion.matrix();
        }
    }
}

TEST(MovedParts, ExtrudedCratesThatTurnedKeepTheirSides) {
    for (unsigned seed = 0; seed < 6; ++seed) {
        Faces faces = crates(seed);
        Faces after = faces;
        for (std::size_t i = seed; i < faces.size(); i += 9) {
            const std::vector<Vec3f>& base = faces[i].corners;
            extrude(after, i, 0.3f * (base[1] - base[0]).cross(base[2] - base[0]).normalized());
        }
        after = rounded(with_first_turned(after, after.size(), turned(77.0f, Vec3f::UnitY()), false));
        const LoadedLevel loaded = rematch(faces, after);
        for (const std::size_t face : wrong_faces(after, loaded))
            EXPECT_FALSE(loaded.level.overrides[face].has_value()) << seed << ": " << face;
    }
}

TEST(MovedParts, PartsOfBentFacesKeepTheirTypes) {
    std::mt19937 random(3);
    std::vector<std::vector<float>> height(9, std::vector<float>(9));
    for (std::vector<float>& row : height)
        for (float& one : row)
            one = 0.006f * static_cast<float>(random() % 100);
    Faces faces, cut, poked;
    for (std::size_t x = 0; x < 8; ++x) {
        for (std::size_t z = 0; z < 8; ++z) {
            const auto at = [&](std::size_t dx, std::size_t dz) {
                return Vec3f(1.2f * static_cast<float>(x + dx), height[x + dx][z + dz],
                             1.1f * static_cast<float>(z + dz));
            };
            Face face = quad(at(0, 0), at(0, 1), at(1, 1), at(1, 0));
            face.painted = static_cast<int>(random() % 6) - 1;
            faces.push_back(face);
            const std::vector<Vec3f>& c = face.corners;
            const Vec3f middle = 0.25f * (c[0] + c[1] + c[2] + c[3]);
            for (std::size_t i = 0; i < 4; ++i) {
                const Vec3f next = 0.5f * (c[i] + c[(i + 1) % 4]), last = 0.5f * (c[i] + c[(i + 3) % 4]);
                cut.push_back({{c[i], next, middle, last}, face.material, face.painted});
                poked.push_back(
                    {{c[i], c[(i + 1) % 4], middle + Vec3f(0.02f, 0.03f, 0)}, face.material, face.painted});
            }
        }
    }
    for (const Faces& after : {cut, poked}) {
        const LoadedLevel loaded = rematch(faces, rounded(after));
        EXPECT_TRUE(wrong_faces(after, loaded).empty());
        EXPECT_EQ(loaded.match.by_plane, painted_count(faces)) << loaded.match.text();
        EXPECT_EQ(loaded.level.guessed.size(), painted_count(after));
    }
}

}  // namespace
}  // namespace slipface::test
