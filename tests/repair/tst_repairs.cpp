// Repairs: what the doctor finds at a stop is mended in a copy of the mesh, and offered only where it helps.
#include <gtest/gtest.h>

#include <cmath>

#include "mesh_edits.h"
#include "slipface/mesh/build.h"
#include "slipface/repair/repairs.h"

namespace slipface::test {
namespace {

MeshPtr mesh_of(const std::vector<std::vector<Vec3f>>& polygons) {
    PolygonSoup soup;
    soup.face_first_corner = {0};
    for (const auto& polygon : polygons) {
        soup.corner_position.insert(soup.corner_position.end(), polygon.begin(), polygon.end());
        soup.face_first_corner.push_back(static_cast<std::uint32_t>(soup.corner_position.size()));
    }
    return build_mesh(std::move(soup)).value();
}

// Two sheets of floor that meet at z = -3; the second lies `gap` further off and `high` higher.
Level sheets(float gap, float high) {
    Level level;
    level.mesh = mesh_of({{{-8, 0, 5}, {8, 0, 5}, {8, 0, -3}, {-8, 0, -3}},
                          {{-8, high, -3 - gap}, {8, high, -3 - gap}, {8, high, -24}, {-8, high, -24}}});
    level.overrides.resize(2);
    level.movement = basic_settings();
    level.movement.max_slope = 0.09;
    level.spawn = Vec3(0, level.movement.radii.y() + level.movement.skin, 0);
    return level;
}

struct Found {
    Stop stop;
    std::vector<Cure> cures;
};

std::optional<Found> walk(const Level& level) {
    Result<LevelScene> built = LevelScene::build(level, level.movement);
    if (!built) return std::nullopt;
    const TickScene scene(*built);
    const Tape tape = parse_tape("slipface-tape 1\ndt 1/60\n15 wish 0,0\n120 wish 0,-1\n", "walk").value();
    TapeRun run(std::make_shared<const Tape>(tape), level.movement, level.spawn);
    run.advance(scene, TapeRun::max_ticks);
    const std::vector<Stop> stops = find_stops(scene, run, level);
    const Stop* stop = headline_stop(stops);
    if (stop == nullptr) return std::nullopt;
    return Found{*stop, find_cures_and_repairs(level, run, *stop)};
}

const Cure* repair_in(const std::vector<Cure>& cures) {
    for (const Cure& cure : cures)
        if (cure.mesh) return &cure;
    return nullptr;
}

TEST(Repairs, ARaisedSheetIsOfferedToBeClosedAndThenTheWalkIsFree) {
    for (const float high : {0.004f, 0.01f, 0.025f}) {
        const Level level = sheets(0.0f, high);
        const std::optional<Found> found = walk(level);
        ASSERT_TRUE(found) << high;
        const Cure* cure = repair_in(found->cures);
        ASSERT_NE(cure, nullptr) << high;
        EXPECT_TRUE(cure->passes);
        EXPECT_EQ(cure->text.find("Close the "), 0u) << cure->text;
        Level changed = level;
        ASSERT_TRUE(apply_cure(changed, *cure).ok());
        EXPECT_FALSE(walk(changed)) << high;
    }
}

TEST(Repairs, AFreeWalkAndAPlainWallHaveNone) {
    EXPECT_FALSE(walk(sheets(0.0f, 0.0f)));
    Level level;
    level.mesh = mesh_of({{{-8, 0, 5}, {8, 0, 5}, {8, 0, -24}, {-8, 0, -24}},
                          {{-8, 0, -3}, {8, 0, -3}, {8, 3, -3}, {-8, 3, -3}}});
    level.overrides.resize(2);
    level.movement = basic_settings();
    level.spawn = Vec3(0, level.movement.radii.y() + level.movement.skin, 0);
    const std::optional<Found> found = walk(level);
    ASSERT_TRUE(found);
    EXPECT_EQ(repair_in(found->cures), nullptr);
}

TEST(Repairs, ACureOfAnotherMeshIsRefused) {
    Level level = sheets(0.0f, 0.01f);
    Cure cure;
    cure.mesh = mesh_of({{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}});
    EXPECT_FALSE(apply_cure(level, cure).ok());
}

TEST(MeshEdits, AFlippedFaceLooksTheOtherWayWithTheSameCorners) {
    Mesh mesh = *sheets(0.1f, 0.0f).mesh;
    const Vec3 normal = face_normal(mesh, 1), centre = face_centroid(mesh, 1);
    const auto before = mesh.triangles;
    flip_face(mesh, 1);
    EXPECT_LT((face_normal(mesh, 1) + normal).norm(), 1e-12);
    EXPECT_LT((face_centroid(mesh, 1) - centre).norm(), 1e-6);
    // Each triangle of the face, too.
    for (std::uint32_t i = mesh.face_first_triangle[1]; i < mesh.face_first_triangle[2]; ++i) {
        const auto corner = [&](std::size_t k) {
            return Vec3(mesh.corner_position(mesh.triangles[i][k]).cast<double>());
        };
        EXPECT_LT((corner(1) - corner(0)).cross(corner(2) - corner(0)).dot(normal), 0.0);
    }
    flip_face(mesh, 1);
    EXPECT_LT((face_normal(mesh, 1) - normal).norm(), 1e-12);
    EXPECT_EQ(mesh.triangles, before);
}

TEST(MeshEdits, AGapIsClosedAsWideAsItIsAndNoOtherCornerMoves) {
    Mesh mesh = *sheets(0.02f, 0.01f).mesh;
    const double moved = close_gap(mesh, 0, 1, Vec3(0, 0.005, -3.01), 0.8);
    EXPECT_NEAR(moved, std::hypot(0.02, 0.01), 1e-6);
    for (std::uint32_t corner = 4; corner < 8; ++corner) {
        const Vec3f p = mesh.corner_position(corner);
        EXPECT_TRUE((p.z() == -3.0f && p.y() == 0.0f) || (p.z() == -24.0f && p.y() == 0.01f)) << corner;
    }
    for (std::uint32_t corner = 0; corner < 4; ++corner)
        EXPECT_EQ(mesh.corner_position(corner).y(), 0.0f);
}

TEST(MeshEdits, OnlyLowUprightFacesAreFlattened) {
    const auto riser = [](float height) {
        return Mesh(*mesh_of({{{-1, 0, 0}, {1, 0, 0}, {1, height, 0}, {-1, height, 0}}}));
    };
    Mesh low = riser(0.03f);
    EXPECT_NEAR(flatten_riser(low, 0, 0.05), 0.03, 1e-8);
    EXPECT_EQ(low.bounds.max.y(), 0.0);
    Mesh high = riser(0.2f);
    EXPECT_EQ(flatten_riser(high, 0, 0.05), 0.0);
    EXPECT_NEAR(high.bounds.max.y(), 0.2, 1e-7);
    Mesh flat = *sheets(0.0f, 0.0f).mesh;
    EXPECT_EQ(flatten_riser(flat, 0, 0.05), 0.0);
}

}  // namespace
}  // namespace slipface::test
