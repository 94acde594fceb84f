// Each kind of problem: a mesh that has exactly one, and the mended mesh that has none.
#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "level/faces.h"
#include "slipface/doctor/doctor.h"

namespace slipface {
namespace {

using test::Face;
using test::Faces;

Face quad(const Vec3f& a, const Vec3f& b, const Vec3f& c, const Vec3f& d) {
    return Face{{a, b, c, d}};
}

// A floor from (x, z) to (x + w, z + d), seen from above.
Face floor_at(float x, float z, float w, float d, float y = 0.0f) {
    return quad({x, y, z}, {x, y, z + d}, {x + w, y, z + d}, {x + w, y, z});
}

std::size_t count(const Faces& faces, ProblemKind kind) {
    const DoctorReport report = examine(test::level_of(faces));
    std::size_t listed = 0;
    for (const Problem& problem : report.problems)
        listed += problem.kind == kind ? 1 : 0;
    EXPECT_EQ(listed, report.count(kind));
    return listed;
}

std::string all_of(const DoctorReport& report) {
    std::string text;
    for (const Problem& problem : report.problems)
        text += std::string(info_of(problem.kind).name) + ": " + problem.text + "\n";
    return text;
}

TEST(Doctor, FindsNothingInACleanFloor) {
    Faces faces;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            faces.push_back(floor_at(float(i), float(j), 1, 1));
    const DoctorReport report = examine(test::level_of(faces));
    EXPECT_EQ(report.total(), 0u) << all_of(report);
    EXPECT_FALSE(report.cancelled);
}

TEST(Doctor, ACornerOnAnEdgeIsATJunction) {
    // Two squares meet the long side of a third in its middle.
    const Faces broken{floor_at(0, 0, 2, 2), floor_at(2, 0, 1, 1), floor_at(2, 1, 1, 1)};
    const DoctorReport report = examine(test::level_of(broken));
    ASSERT_EQ(report.count(ProblemKind::t_junction), 1u) << all_of(report);
    EXPECT_EQ(report.problems[0].face, 0u);
    EXPECT_EQ(report.problems[0].position, Vec3(2, 0, 1));
    // With a vertex on the long side it is none.
    const Faces mended{Face{{{0, 0, 0}, {0, 0, 2}, {2, 0, 2}, {2, 0, 1}, {2, 0, 0}}}, floor_at(2, 0, 1, 1),
                       floor_at(2, 1, 1, 1)};
    EXPECT_EQ(count(mended, ProblemKind::t_junction), 0u);
}

TEST(Doctor, FacesThatAlmostMeetLeaveAGap) {
    EXPECT_EQ(count({floor_at(0, 0, 1, 1), floor_at(1.001f, 0, 1, 1)}, ProblemKind::crack), 1u);
    EXPECT_EQ(count({floor_at(0, 0, 1, 1), floor_at(1.1f, 0, 1, 1)}, ProblemKind::crack), 1u);
    EXPECT_EQ(count({floor_at(0, 0, 1, 1), floor_at(1, 0, 1, 1)}, ProblemKind::crack), 0u);
    // One that is wider than a body of 0.4 m radius is a gap that somebody meant.
    EXPECT_EQ(count({floor_at(0, 0, 1, 1), floor_at(1.9f, 0, 1, 1)}, ProblemKind::crack), 0u);
    // One that other faces fill is none.
    EXPECT_EQ(count({floor_at(0, 0, 1, 1), floor_at(1.1f, 0, 1, 1), floor_at(0.9f, -1, 0.4f, 3, -0.01f)},
                    ProblemKind::crack),
              0u);
}

TEST(Doctor, TrianglesWhoseNormalRoundingTurnsAreSlivers) {
    // Corners 10 m from the origin are known to 2.4e-6 m: 0.2 degrees of a triangle 0.68 mm high.
    EXPECT_EQ(count({Face{{{0, 0, 0}, {5, 0, 0.00065f}, {10, 0, 0}}}}, ProblemKind::sliver), 1u);
    // One with a normal that is known a little better is none, whichever corner comes first.
    for (int first = 0; first < 3; ++first) {
        Face thin{{{0, 0, 0}, {5, 0, 0.00071f}, {10, 0, 0}}};
        std::rotate(thin.corners.begin(), thin.corners.begin() + first, thin.corners.end());
        EXPECT_EQ(count({thin}, ProblemKind::sliver), 0u);
        thin.corners[static_cast<std::size_t>((4 - first) % 3)].z() = 0.00065f;
        EXPECT_EQ(count({thin}, ProblemKind::sliver), 1u) << first;
    }
}

TEST(Doctor, TheSameCornersTwiceAreADuplicate) {
    Face turned = floor_at(0, 0, 1, 1);
    std::rotate(turned.corners.begin(), turned.corners.begin() + 1, turned.corners.end());
    const DoctorReport report = examine(test::level_of({floor_at(0, 0, 1, 1), turned}));
    ASSERT_EQ(report.count(ProblemKind::duplicate), 1u);
    EXPECT_EQ(report.count(ProblemKind::overlap), 0u) << "one fault is said once";
    EXPECT_EQ(report.problems.back().face, 1u);
    EXPECT_EQ(report.problems.back().other, 0u);
    // The back of a leaf is none, unless it is another surface.
    Face back = floor_at(0, 0, 1, 1);
    std::reverse(back.corners.begin(), back.corners.end());
    EXPECT_EQ(count({floor_at(0, 0, 1, 1), back}, ProblemKind::duplicate), 0u);
    back.painted = 1;
    EXPECT_EQ(count({floor_at(0, 0, 1, 1), back}, ProblemKind::duplicate), 1u);
}

TEST(Doctor, CoplanarFacesOverEachOtherAreFound) {
    EXPECT_EQ(count({floor_at(0, 0, 2, 2), floor_at(1, 1, 2, 2)}, ProblemKind::overlap), 1u);
    EXPECT_EQ(count({floor_at(0, 0, 2, 2), floor_at(2, 0, 2, 2)}, ProblemKind::overlap), 0u);
    EXPECT_EQ(count({floor_at(0, 0, 2, 2), floor_at(1, 1, 2, 2, 0.05f)}, ProblemKind::overlap), 0u);
    // The bottom of a crate hides what it stands on.
    Face bottom = floor_at(0.5f, 0.5f, 1, 1);
    std::reverse(bottom.corners.begin(), bottom.corners.end());
    EXPECT_EQ(count({floor_at(0, 0, 2, 2), bottom}, ProblemKind::overlap), 0u);
}

TEST(Doctor, TheFaceWoundAgainstItsNeighboursIsTheOneFound) {
    Faces faces;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            faces.push_back(floor_at(float(i), float(j), 1, 1));
    EXPECT_EQ(count(faces, ProblemKind::flipped), 0u);
    std::reverse(faces[4].corners.begin(), faces[4].corners.end());
    const DoctorReport report = examine(test::level_of(faces));
    ASSERT_EQ(report.count(ProblemKind::flipped), 1u) << all_of(report);
    EXPECT_EQ(report.problems[0].face, 4u);
}

// A ditch 1 m long and 9 m deep between two planes that rise at `slope`, and a wall at either end.
Faces ditch(double slope, float length = 1.0f) {
    const auto x = static_cast<float>(9.0 / std::tan(slope));
    Faces faces{quad({0, 0, 0}, {-x, 9, 0}, {-x, 9, length}, {0, 0, length}),
                quad({0, 0, 0}, {0, 0, length}, {x, 9, length}, {x, 9, 0})};
    for (const float z : {0.0f, length})
        faces.push_back(Face{{{-x, 9, z}, {0, 0, z}, {x, 9, z}}});
    return faces;
}

TEST(Doctor, OnlyCornersThatThePlayerCannotLeaveAreAcute) {
    EXPECT_EQ(count(ditch(1.4), ProblemKind::acute_corner), 1u);
    // One whose sides can be walked up.
    EXPECT_EQ(count(ditch(0.6), ProblemKind::acute_corner), 0u);
}

// A slope between two floors.
Faces ramp(double angle) {
    const auto y = static_cast<float>(4 * std::sin(angle)), x = static_cast<float>(4 * std::cos(angle));
    return {floor_at(-4, 0, 4, 4), quad({0, 0, 0}, {0, 0, 4}, {x, y, 4}, {x, y, 0}), floor_at(x, 0, 4, 4, y)};
}

TEST(Doctor, RampsThatAreTooSteepAreFound) {
    const double limit = MovementSettings{}.max_slope;
    EXPECT_EQ(count(ramp(limit + 0.02), ProblemKind::slope_limit), 1u);
    EXPECT_EQ(count(ramp(limit + 0.0005), ProblemKind::slope_limit), 1u);
    EXPECT_EQ(count(ramp(limit - 0.0005), ProblemKind::slope_limit), 1u) << "rounding decides";
    EXPECT_EQ(count(ramp(limit - 0.01), ProblemKind::slope_limit), 0u);
    EXPECT_EQ(count(ramp(limit + 0.2), ProblemKind::slope_limit), 0u) << "a slide";
    Faces alone = ramp(limit + 0.02);
    alone.pop_back();
    EXPECT_EQ(count(alone, ProblemKind::slope_limit), 0u) << "it leads nowhere";
}

// 2000 strips with corners on a grid of 1/64 m, all in one plane within a body's width of each other.
TEST(Doctor, CornersAmongManyEdgesLieOnTheFirstFace) {
    std::mt19937 random(7);
    const auto grid = [&](int from, int to) {
        return from + static_cast<int>(random() % static_cast<unsigned>(to - from));
    };
    struct Strip {
        int x, z, wide, deep;
    };
    std::vector<Strip> strips(2000);
    Faces faces;
    for (Strip& strip : strips) {
        strip = {grid(0, 100), grid(0, 100), grid(1, 8), grid(1, 8)};
        // Each at its own height, so that no two share an edge, lower than what corners are rounded by.
        faces.push_back(floor_at(float(strip.x) / 64, float(strip.z) / 64, float(strip.wide) / 64,
                                 float(strip.deep) / 64, float(faces.size()) * 0x1p-34f));
    }
    // A corner lies inside an edge of another strip, which goes on on the other side.
    std::map<FaceId, std::size_t> expected;
    for (std::size_t i = 0; i < strips.size(); ++i) {
        const Strip& s = strips[i];
        for (const int x : {s.x, s.x + s.wide}) {
            for (const int z : {s.z, s.z + s.deep}) {
                const auto first = std::find_if(strips.begin(), strips.end(), [&](const Strip& o) {
                    const int beside_x = x == s.x ? o.x + o.wide : o.x,
                              beside_z = z == s.z ? o.z + o.deep : o.z;
                    return (x == beside_x && z > o.z && z < o.z + o.deep) ||
                           (z == beside_z && x > o.x && x < o.x + o.wide);
                });
                if (first != strips.end()) ++expected[static_cast<FaceId>(first - strips.begin())];
            }
        }
    }
    const DoctorReport report = examine(test::level_of(faces));
    std::size_t total = 0;
    for (const auto& [face, corners] : expected)
        total += corners;
    EXPECT_EQ(report.count(ProblemKind::t_junction), total);
    std::map<FaceId, std::size_t> listed;
    for (const Problem& problem : report.problems)
        if (problem.kind == ProblemKind::t_junction) ++listed[problem.face];
    ASSERT_FALSE(listed.empty());
    listed.erase(std::prev(listed.end()));  // the list may end within it
    for (const auto& [face, corners] : listed)
        EXPECT_EQ(corners, expected[face]) << face;
}

// Ramps and walls among very many triangles that boxes do not tell apart.
TEST(Doctor, InATangleWhatWouldTakeTooLongIsCountedUntried) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> within(0.0f, 0.001f);
    Faces faces(60'000);
    for (auto& face : faces)
        for (int corner = 0; corner < 3; ++corner)
            face.corners.push_back({within(random), within(random), within(random)});
    const DoctorReport report = examine(test::level_of(faces));
    EXPECT_GT(report.untried_of(ProblemKind::slope_limit), 0u);
    EXPECT_GT(report.untried_of(ProblemKind::step_limit), 0u);
    EXPECT_EQ(examine(test::level_of(faces)).untried, report.untried);
}

// Too many gaps to send walkers over each: the first are tried, the others are counted.
TEST(Doctor, GapsBeyondAllPatienceAreCountedUntried) {
    Faces faces;
    for (int i = 0; i < 60; ++i)
        for (int j = 0; j < 60; ++j)
            faces.push_back(floor_at(float(i), float(j), 0.999f, 0.999f));
    const DoctorReport report = examine(test::level_of(faces));
    EXPECT_GT(report.count(ProblemKind::crack), 0u);
    EXPECT_GT(report.untried_of(ProblemKind::crack), 0u);
    EXPECT_EQ(report.untried_of(ProblemKind::step_limit), 0u);
}

TEST(Doctor, OrphansAndMissingTexturesAreListed) {
    Level level = test::level_of({floor_at(0, 0, 1, 1)});
    level.orphans.push_back({FaceKey{.centroid = Vec3(1, 2, 3), .material = "stone"}, "ice"});
    Mesh textured = *level.mesh;
    textured.materials[0].texture = "no/such.png";
    level.mesh = std::make_shared<const Mesh>(std::move(textured));
    const DoctorReport report = examine(level);
    EXPECT_EQ(report.count(ProblemKind::orphan), 1u);
    EXPECT_EQ(report.count(ProblemKind::missing_texture), 1u);
    ASSERT_EQ(report.problems.size(), 2u) << all_of(report);
    EXPECT_EQ(report.problems[0].position, Vec3(1, 2, 3));
}

TEST(Doctor, CanBeCancelledAndTellsHowFarItIs) {
    const Level level = test::level_of({floor_at(0, 0, 1, 1)});
    double last = -1.0;
    EXPECT_FALSE(examine(level, [&](double fraction) {
                     EXPECT_GE(fraction, last);
                     last = fraction;
                     return true;
                 }).cancelled);
    EXPECT_EQ(last, 1.0);
    int calls = 0;
    EXPECT_TRUE(examine(level, [&](double) { return ++calls < 3; }).cancelled);
    EXPECT_EQ(calls, 3);
}

TEST(Doctor, EveryKindHasItsRow) {
    std::set<std::string> names;
    for (const ProblemKindInfo& kind : problem_kinds()) {
        EXPECT_EQ(&info_of(kind.kind), &kind);
        EXPECT_TRUE(names.insert(kind.name).second);
        EXPECT_NE(std::string(kind.remedy), "");
    }
    EXPECT_EQ(names.size(), problem_kind_count);
}

}  // namespace
}  // namespace slipface
