#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <random>

#include "document/faces.h"
#include "document/selection.h"
#include "level_fixture.h"

namespace slipface {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

constexpr double degree = std::numbers::pi / 180.0;

class FacesTest : public LevelFixture {
  protected:
    void load(const std::string& text) {
        write_text(obj, text);
        document = open();
    }
    std::vector<FaceId> flood(FaceId start, double degrees) const {
        return flood_by_angle(document->facts(), document->neighbours(), std::span(&start, 1),
                              degrees * degree);
    }
    std::vector<FaceId> brush(FaceId start, const Vec3& centre, double radius) const {
        return brush_faces(document->mesh(), document->neighbours(), start, centre, radius);
    }
    std::unique_ptr<Document> document;
};

TEST_F(FacesTest, FloodStopsAtTheWall) {
    document = open();
    EXPECT_THAT(flood(0, 15), SizeIs(64));
    EXPECT_THAT(flood(0, 89), SizeIs(64));
    EXPECT_THAT(flood(0, 90), SizeIs(72));  // floor and wall meet at a right angle
    EXPECT_THAT(flood(wall, 15), ElementsAre(64, 65, 66, 67, 68, 69, 70, 71));
    EXPECT_THAT(flood(63, 0), SizeIs(64));
}

TEST_F(FacesTest, FloodRefusesWhatIsNotThere) {
    document = open();
    EXPECT_THAT(flood(no_id, 15), IsEmpty());
    EXPECT_THAT(flood(0, std::nan("")), ElementsAre(0));
}

// Quads along a circle, each turned by 10 degrees against the one before.
std::string bend_obj(int faces) {
    std::ostringstream text;
    text.precision(9);
    double x = 0, y = 0;
    for (int i = 0; i <= faces; ++i) {
        text << "v " << x << " " << y << " 0\nv " << x << " " << y << " 1\n";
        x += std::cos(10.0 * i * degree);
        y += std::sin(10.0 * i * degree);
    }
    for (int i = 0; i < faces; ++i)
        text << "f " << 2 * i + 1 << " " << 2 * i + 2 << " " << 2 * i + 4 << " " << 2 * i + 3 << "\n";
    return text.str();
}

TEST_F(FacesTest, FloodComparesNeighboursNotTheStart) {
    load(bend_obj(9));  // 80 degrees from the first to the last
    EXPECT_THAT(flood(0, 10.1), SizeIs(9));
    EXPECT_THAT(flood(4, 9.9), ElementsAre(4));
    EXPECT_THAT(flood(4, 10.1), SizeIs(9));
}

// Two unit quads side by side at x = 1, and between them a face without area; the second one lies `turn`
// degrees steeper.
std::string sliver_obj(double turn) {
    std::ostringstream text;
    text.precision(9);
    text << "v 0 0 0\nv 0 0 1\nv 1 0 1\nv 1 0 0\nv 1 0 0.5\n";
    const double x = 1 + std::cos(turn * degree), y = std::sin(turn * degree);
    text << "v " << x << " " << y << " 1\nv " << x << " " << y << " 0\n";
    text << "f 1 2 3 4\n";           // touches the sliver along 3-4
    text << "f 4 5 3\n";             // no area: three points of one line
    text << "f 5 3 6\nf 4 5 6 7\n";  // touch it along 5-3 and 4-5
    return text.str();
}

TEST_F(FacesTest, FacesWithoutAreaAreCrossedButDoNotHideTheAngle) {
    load(sliver_obj(5));
    ASSERT_EQ(document->face_count(), 4u);
    EXPECT_THAT(flood(0, 15), ElementsAre(0, 1, 2, 3));
    load(sliver_obj(60));
    EXPECT_THAT(flood(0, 15), ElementsAre(0, 1));
    EXPECT_THAT(flood(2, 15), ElementsAre(1, 2, 3));
}

// Triangles over a grid of uneven ground in random order, each of one of two materials, most of the first.
std::string rough_obj(std::mt19937& random, unsigned side) {
    std::ostringstream text;
    for (unsigned i = 0; i <= side; ++i)
        for (unsigned k = 0; k <= side; ++k)
            text << "v " << i << " " << 0.1 * static_cast<double>(random() % 8) << " " << k << "\n";
    std::vector<std::string> faces;
    for (unsigned i = 0; i < side; ++i)
        for (unsigned k = 0; k < side; ++k) {
            const unsigned a = i * (side + 1) + k + 1, b = a + side + 1;
            for (const auto& [x, y, z] : {std::array{a, a + 1, b + 1}, std::array{a, b + 1, b}}) {
                std::ostringstream face;
                face << "usemtl " << (random() % 4 == 0 ? "rare" : "usual") << "\nf " << x << " " << y << " "
                     << z << "\n";
                faces.push_back(face.str());
            }
        }
    if (random() % 2 == 0) std::shuffle(faces.begin(), faces.end(), random);
    for (const std::string& face : faces)
        text << face;
    return text.str();
}

// What is reached one face after the other.
template <class Joined>
std::vector<FaceId> reached_from(const Document& document, std::vector<FaceId> open, const Joined& joined) {
    std::vector<std::uint8_t> marks(document.face_count(), 0);
    for (const FaceId face : open)
        marks[face] = 1;
    while (!open.empty()) {
        const FaceId face = open.back();
        open.pop_back();
        for (const FaceId next : document.neighbours().of(face)) {
            if (marks[next] != 0 || !joined(face, next)) continue;
            marks[next] = 1;
            open.push_back(next);
        }
    }
    return marked_faces(marks);
}

TEST_F(FacesTest, SmallAndLargeFloodsReachWhatIsConnected) {
    std::mt19937 random(5);
    std::size_t small = 0, large = 0;
    for (int round = 0; round < 60; ++round) {
        load(rough_obj(random, 2 + static_cast<unsigned>(random() % 20)));
        const std::size_t count = document->face_count();
        std::vector<FaceId> start(1 + random() % 3);
        for (FaceId& face : start)
            face = static_cast<FaceId>(random() % count);
        const AngleLimit within((5.0 + static_cast<double>(random() % 40)) * degree);
        const std::vector<Vec3f>& normal = document->facts().normal;
        const auto near = [&](FaceId a, FaceId b) { return within(normal[a], normal[b]); };
        const std::vector<FaceId> expected = reached_from(*document, start, near);
        ++(expected.size() <= count / 16 ? small : large);
        EXPECT_EQ(flood_joined(document->neighbours(), count, start, near), expected) << "round " << round;
        const std::vector<std::uint32_t>& material = document->mesh().face_material;
        EXPECT_EQ(
            connected_within_material(*document, start),
            reached_from(*document, start, [&](FaceId a, FaceId b) { return material[a] == material[b]; }))
            << "round " << round;
    }
    EXPECT_GT(small, 5u);
    EXPECT_GT(large, 5u);
}

TEST_F(FacesTest, BrushOfNoSizeTakesOneFace) {
    document = open();
    EXPECT_THAT(brush(9, Vec3(1.5, 0, 1.5), 0), ElementsAre(9));
    EXPECT_THAT(brush(9, Vec3(1.5, 0, 1.5), -1), ElementsAre(9));
    EXPECT_THAT(brush(9, Vec3(1.5, 0, 1.5), std::nan("")), ElementsAre(9));
    EXPECT_THAT(brush(no_id, Vec3(1.5, 0, 1.5), 1), IsEmpty());
}

TEST_F(FacesTest, BrushTakesWhatItsBallTouches) {
    document = open();
    // From the middle of face (3, 3) the borders are 0.5 m away and the corners 0.7071 m.
    const Vec3 middle(3.5, 0, 3.5);
    const FaceId centre = 3 * n + 3;
    EXPECT_THAT(brush(centre, middle, 0.49), ElementsAre(centre));
    EXPECT_THAT(brush(centre, middle, 0.51),
                ElementsAre(centre - n, centre - 1, centre, centre + 1, centre + n));
    EXPECT_THAT(brush(centre, middle, 0.70), SizeIs(5));
    EXPECT_THAT(brush(centre, middle, 0.71), SizeIs(9));
    EXPECT_THAT(brush(centre, middle, 100), SizeIs(face_count));
}

TEST_F(FacesTest, BrushClimbsAWallItTouches) {
    document = open();
    const FaceId last = 7 * n + 3;
    EXPECT_THAT(brush(last, Vec3(7.9, 0, 3.5), 0.2), ElementsAre(last, wall + 3));
}

TEST_F(FacesTest, BrushDoesNotJumpAGap) {
    // Two sheets 0.1 m apart that share nothing.
    load(
        "v 0 0 0\nv 0 0 1\nv 1 0 1\nv 1 0 0\nv 0 .1 0\nv 0 .1 1\nv 1 .1 1\nv 1 .1 0\nf 1 2 3 4\nf 5 6 7 8\n");
    EXPECT_THAT(brush(0, Vec3(0.5, 0, 0.5), 5), ElementsAre(0));
}

TEST_F(FacesTest, BoundsAreOfTheGivenFaces) {
    document = open();
    const Aabb box = faces_bounds(*document, std::vector<FaceId>{0, n + 1, no_id});
    EXPECT_EQ(box.min, Vec3(0, 0, 0));
    EXPECT_EQ(box.max, Vec3(2, 0, 2));
    EXPECT_TRUE(faces_bounds(*document, {}).empty());
}

}  // namespace
}  // namespace slipface
