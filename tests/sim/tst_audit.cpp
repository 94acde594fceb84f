// Audits of small levels: a closed box that holds, a box with a hole, a box with a wall that lies.
#include <gmock/gmock.h>

#include "slipface/base/parallel.h"
#include "slipface/mesh/build.h"
#include "slipface/sim/audit.h"
#include "slipface/sim/simulate.h"

namespace slipface::test {
namespace {

// A box seen from inside: floor, ceiling and four walls, 8 x 4 x 8 m, the floor at y = 0.
MeshPtr box(int left_out = -1) {
    const std::array<Vec3f, 8> corner{Vec3f(-4, 0, -4), Vec3f(4, 0, -4), Vec3f(4, 0, 4), Vec3f(-4, 0, 4),
                                      Vec3f(-4, 4, -4), Vec3f(4, 4, -4), Vec3f(4, 4, 4), Vec3f(-4, 4, 4)};
    const int faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                             {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
    PolygonSoup soup;
    soup.face_first_corner = {0};
    for (int face = 0; face < 6; ++face) {
        if (face == left_out) continue;
        for (const int index : faces[face])
            soup.corner_position.push_back(corner[static_cast<std::size_t>(index)]);
        soup.face_first_corner.push_back(static_cast<std::uint32_t>(soup.corner_position.size()));
    }
    return build_mesh(std::move(soup)).value();
}

constexpr FaceId wall = 2;

Level box_level(int left_out = -1) {
    Level level;
    level.mesh_path = "box.obj";
    level.mesh = box(left_out);
    level.overrides.resize(level.mesh->face_count());
    level.spawn = {0.0, 1.0, 0.0};
    return level;
}

AuditOptions short_audit() {
    AuditOptions options;
    options.walkers = 7;
    options.duration_s = 4.0;
    options.speeds = {6.0, 20.0};
    return options;
}

TEST(Audit, AClosedBoxHolds) {
    const AuditReport report = run_audit(box_level(), short_audit()).value();
    EXPECT_TRUE(report.closed);
    EXPECT_TRUE(report.clean());
    EXPECT_EQ(report.steps, 7u * 240u);
    EXPECT_EQ(report.lives, 7u);
    EXPECT_EQ(report.left, 0u);
}

TEST(Audit, AnotherSeedWalksElsewhere) {
    AuditOptions options = short_audit();
    const std::uint64_t first = run_audit(box_level(), options).value().hash;
    options.seed = 2;
    EXPECT_NE(first, run_audit(box_level(), options).value().hash);
}

TEST(Audit, ThreadsDoNotMatter) {
    AuditOptions options = short_audit();
    options.heat = true;
    const std::string many = audit_to_json(run_audit(box_level(), options).value());
    const ThreadLimit one(1);
    EXPECT_EQ(audit_to_json(run_audit(box_level(), options).value()), many);
}

TEST(Audit, ShardsMergedAreTheWhole) {
    AuditOptions options = short_audit();
    options.heat = true;
    const std::string whole = audit_to_json(run_audit(box_level(), options).value());
    std::vector<AuditReport> parts;
    for (const std::uint32_t index : {2u, 0u, 1u}) {
        options.shard = {index, 3};
        const std::string part = audit_to_json(run_audit(box_level(), options).value());
        EXPECT_NE(part, whole);
        parts.push_back(audit_from_json(part, "part").value());
    }
    EXPECT_EQ(audit_to_json(merge_audits(parts).value()), whole);

    parts.push_back(parts.back());
    EXPECT_FALSE(merge_audits(parts).ok()) << "a part that comes twice";
    parts = {parts[0], parts[1]};
    parts[1].seed = 99;
    EXPECT_FALSE(merge_audits(parts).ok()) << "parts of different audits";
}

// A wall that only stops from outside: rays see it, so the level counts as closed, but walkers get through.
TEST(Audit, WalkersThatLeaveAClosedLevelAreFoundAndTheirTapesShowIt) {
    Level level = box_level();
    SurfaceType valve;
    valve.name = "valve";
    valve.one_sided = true;
    level.surfaces.push_back(valve);
    level.overrides[wall] = static_cast<SurfaceId>(level.surfaces.size() - 1);
    // The wall's front must look outwards for the way out to be free.
    const CollisionWorld world = build_collision_world(level).value();
    ASSERT_TRUE(world.triangle_normal(2 * wall).z() > 0.0);
    level.spawn = {0.0, 1.0, 0.0};

    AuditOptions options = short_audit();
    options.duration_s = 20.0;
    Level outward = level;
    const AuditReport inward = run_audit(level, options).value();
    EXPECT_TRUE(inward.clean()) << "from the front the wall is a wall";

    // The same box, turned inside out, with every face one-sided: nothing holds.
    for (auto& face : outward.overrides)
        face = level.overrides[wall];
    auto turned = std::make_shared<Mesh>(*level.mesh);
    for (auto& triangle : turned->triangles)
        std::swap(triangle[1], triangle[2]);
    outward.mesh = turned;
    const AuditReport report = run_audit(outward, options).value();
    EXPECT_TRUE(report.closed);
    ASSERT_GT(report.counts[static_cast<std::size_t>(FindingKind::escape)], 0u);
    EXPECT_FALSE(report.clean());

    const AuditFinding& finding = report.findings.front();
    const Tape tape = audit_tape(outward, options, finding);
    EXPECT_EQ(tape.tick_count(), finding.tick);
    MovementSettings settings = outward.movement;
    ASSERT_TRUE(apply_tape_settings(settings, tape, "tape").ok());
    const CollisionWorld outward_world = build_collision_world(outward).value();
    const SimulationReport replay =
        simulate(MovementScene{outward_world, outward.surfaces}, settings, *tape.start, tape);
    EXPECT_EQ(replay.final_state.position, finding.position);
}

TEST(Audit, LeavingAnOpenLevelIsCountedButNoFinding) {
    AuditOptions options = short_audit();
    options.duration_s = 20.0;
    const AuditReport report = run_audit(box_level(wall), options).value();
    EXPECT_FALSE(report.closed);
    EXPECT_GT(report.left, 0u);
    EXPECT_EQ(report.lives, options.walkers + report.left);
    EXPECT_TRUE(report.clean());
}

TEST(Audit, AWalkerWhoIsAskedToMoveAndDoesNotIsStuck) {
    AuditOptions options = short_audit();
    options.speeds = {1e-4};  // asked for a direction with free way ahead, moves 0.2 mm in 2 s
    Level level = box_level();
    level.movement.jump_speed = 0.0;
    const AuditReport report = run_audit(level, options).value();
    EXPECT_EQ(report.counts[static_cast<std::size_t>(FindingKind::stuck)], 7u);
    EXPECT_EQ(report.findings.front().kind, FindingKind::stuck);
}

TEST(Audit, HeatCountsEveryTickOnTheFloor) {
    AuditOptions options = short_audit();
    options.heat = true;
    const AuditReport report = run_audit(box_level(), options).value();
    ASSERT_EQ(report.heat.size(), 6u);
    EXPECT_GT(report.heat[0].visited, report.steps / 4);
    EXPECT_EQ(report.heat[1].visited, 0u) << "nobody stands on the ceiling";
    EXPECT_GT(report.heat[wall].lost_mm_s, 0u);
}

TEST(Audit, CancelEndsEarlyAndSaysSo) {
    AuditOptions options = short_audit();
    options.progress = [](std::uint64_t) { return false; };
    const AuditReport report = run_audit(box_level(), options).value();
    EXPECT_TRUE(report.cancelled);
    EXPECT_FALSE(report.clean());
    EXPECT_LT(report.steps, 7u * 240u);
}

TEST(Audit, RefusesWhatCannotBeRun) {
    AuditOptions options = short_audit();
    options.walkers = 0;
    EXPECT_FALSE(run_audit(box_level(), options).ok());
    options = short_audit();
    options.shard = {3, 3};
    EXPECT_FALSE(run_audit(box_level(), options).ok());
    options = short_audit();
    options.dt = 0.0;
    EXPECT_FALSE(run_audit(box_level(), options).ok());
    options = short_audit();
    options.speeds = {-1.0};
    EXPECT_FALSE(run_audit(box_level(), options).ok());
    Level level = box_level();
    level.spawn = {0.0, 0.1, 0.0};
    const auto inside = run_audit(level, short_audit());
    ASSERT_FALSE(inside.ok());
    EXPECT_THAT(inside.error().text(), testing::HasSubstr("inside face 0"));
}

TEST(Audit, ReportsThatAreNoneAreRefusedWithTheirPlace) {
    const auto error = [](std::string_view json) { return audit_from_json(json, "r.json").error().text(); };
    EXPECT_THAT(error("nonsense"), testing::HasSubstr("r.json"));
    EXPECT_THAT(error("{\"slipface_audit\": 9}"), testing::HasSubstr("version 9"));
    std::string text = audit_to_json(run_audit(box_level(), short_audit()).value());
    text.replace(text.find("\"seed\": 1"), 9, "\"seed\": -1");
    EXPECT_THAT(error(text), testing::HasSubstr("r.json:/seed"));
}

}  // namespace
}  // namespace slipface::test
