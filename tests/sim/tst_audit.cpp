// Audits of small levels: a closed box that holds, a box with a hole, a box with a wall that lies.
#include <gmock/gmock.h>

#include <cmath>
#include <set>

#include "slipface/base/hash.h"
#include "slipface/base/parallel.h"
#include "slipface/level/level_scene.h"
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
    std::vector<AuditPart> parts;
    for (const std::uint32_t number : {3u, 1u, 2u}) {
        options.shard = {number, 3};
        const std::string part = audit_to_json(run_audit(box_level(), options).value());
        EXPECT_NE(part, whole);
        const std::string file = "part" + std::to_string(number);
        parts.push_back({file, audit_from_json(part, file).value()});
    }
    EXPECT_EQ(audit_to_json(merge_audits(parts).value()), whole);

    const auto error = [](const std::vector<AuditPart>& of) { return merge_audits(of).error().text(); };
    auto twice = parts;
    twice[1].report.shard.number = 3;
    EXPECT_THAT(error(twice), testing::AllOf(testing::HasSubstr("part1"), testing::HasSubstr("part3")));
    EXPECT_THAT(error({parts[0], parts[2]}), testing::HasSubstr("1 of 3 parts missing: 1/3"));
    EXPECT_THAT(error({parts[1]}), testing::HasSubstr("2 of 3 parts missing: 2/3, 3/3"));
    EXPECT_FALSE(merge_audits({}).ok());
    // Of another level, seed, settings, types or program: said with the file and what differs.
    const auto mixed = [&](auto change) {
        auto changed = parts;
        change(changed[1].report);
        return error(changed);
    };
    using testing::AllOf, testing::HasSubstr;
    EXPECT_THAT(mixed([](AuditReport& r) { r.seed = 99; }), AllOf(HasSubstr("part1"), HasSubstr("seed")));
    EXPECT_THAT(mixed([](AuditReport& r) { ++r.level_fingerprint; }), HasSubstr("geometry"));
    EXPECT_THAT(mixed([](AuditReport& r) { ++r.scene_fingerprint; }), HasSubstr("surface types"));
    EXPECT_THAT(mixed([](AuditReport& r) { ++r.settings_hash; }), HasSubstr("settings"));
    EXPECT_THAT(mixed([](AuditReport& r) { r.program = "0.0.1"; }), HasSubstr("program"));
    EXPECT_THAT(mixed([](AuditReport& r) { r.shard.count = 4; }), HasSubstr("is part"));
}

// A floor of very many triangles that boxes do not tell apart.
TEST(Audit, WalkersInACrowdOfTrianglesEndAndTheirStepsAreCountedUntried) {
    constexpr int count = 20'000;
    PolygonSoup soup;
    soup.face_first_corner = {0};
    for (int i = 0; i < count; ++i) {
        const auto y = -1e-6f * static_cast<float>(i);
        for (const Vec3f& corner : {Vec3f(-4, y, -4), Vec3f(-4, y, 4), Vec3f(4, y, 4), Vec3f(4, y, -4)})
            soup.corner_position.push_back(corner);
        soup.face_first_corner.push_back(static_cast<std::uint32_t>(soup.corner_position.size()));
    }
    Level level;
    level.mesh = build_mesh(std::move(soup)).value();
    level.overrides.resize(level.mesh->face_count());
    level.spawn = {0.0, 1.0, 0.0};
    AuditOptions options = short_audit();
    const AuditReport whole = run_audit(level, options).value();
    EXPECT_GT(whole.untried, 0u);
    EXPECT_GT(whole.steps, options.walkers);
    EXPECT_EQ(whole.steps + whole.untried, 7u * 240u);
    EXPECT_EQ(run_audit(box_level(), options).value().untried, 0u);
    std::vector<AuditPart> parts;
    for (const std::uint32_t number : {1u, 2u}) {
        options.shard = {number, 2};
        const std::string part = audit_to_json(run_audit(level, options).value());
        parts.push_back({std::to_string(number), audit_from_json(part, "part").value()});
    }
    EXPECT_EQ(audit_to_json(merge_audits(parts).value()), audit_to_json(whole));
}

TEST(Audit, PaintSpawnAndPlatformsMakeAnotherAudit) {
    Level level = box_level();
    const std::uint64_t plain = run_audit(level, short_audit()).value().scene_fingerprint;
    level.overrides[wall] = SurfaceId{1};
    EXPECT_NE(run_audit(level, short_audit()).value().scene_fingerprint, plain);
    level = box_level();
    level.spawn.x() = 0.5;
    EXPECT_NE(run_audit(level, short_audit()).value().scene_fingerprint, plain);
    level = box_level();
    level.fall_limit = -50.0;
    EXPECT_NE(run_audit(level, short_audit()).value().scene_fingerprint, plain);
    Heightfield hill{
        .columns = 2, .rows = 2, .heights = {-9, -9, -9, -9}, .origin = Vec3(90, 0, 90), .size = {1, 1}};
    std::set<std::uint64_t> found{plain};
    const auto with_hill = [&] {
        level = box_level();
        level.terrain = std::make_shared<const Heightfield>(hill);
        return found.insert(run_audit(level, short_audit()).value().scene_fingerprint).second;
    };
    EXPECT_TRUE(with_hill());
    hill.heights[3] = -8;
    EXPECT_TRUE(with_hill());
    hill.origin.x() += 1;
    EXPECT_TRUE(with_hill());
    hill.size.y() = 2;
    EXPECT_TRUE(with_hill());
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
    ASSERT_GT(report.counts[static_cast<std::size_t>(FindingKind::left_level)], 0u);
    EXPECT_EQ(report.count(FindingKind::passed_through), 0u) << "one-sided faces let pass from behind";
    EXPECT_FALSE(report.clean());

    const AuditFinding& finding = report.findings.front();
    EXPECT_THAT(finding.text, testing::HasSubstr("left the level"));
    // It says where: just outside the box, not where it was given up.
    EXPECT_LT((finding.position.cwiseAbs() - Vec3(4, 4, 4)).maxCoeff(), 0.4);
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
    std::uint64_t by_exits = 0;
    for (const AuditExit& exit : report.exits)
        by_exits += exit.times;
    EXPECT_EQ(by_exits, report.left) << "the exits account for each";
    EXPECT_TRUE(report.clean());
}

// A shelf of 4 x 4 m, 2 m up in the closed box; the fall limit lies between it and the floor.
TEST(Audit, FallingBelowALimitInsideAClosedLevelIsCountedButNoFinding) {
    Level level = box_level();
    PolygonSoup soup;
    for (const std::uint32_t first : level.mesh->face_first_corner)
        soup.face_first_corner.push_back(first);
    for (std::uint32_t corner = 0; corner < level.mesh->corner_vertex.size(); ++corner)
        soup.corner_position.push_back(level.mesh->corner_position(corner));
    for (const Vec3f& corner : {Vec3f(-2, 2, 2), Vec3f(2, 2, 2), Vec3f(2, 2, -2), Vec3f(-2, 2, -2)})
        soup.corner_position.push_back(corner);
    soup.face_first_corner.push_back(static_cast<std::uint32_t>(soup.corner_position.size()));
    level.mesh = build_mesh(std::move(soup)).value();
    level.overrides.resize(level.mesh->face_count());
    level.spawn = {0.0, 2.95, 0.0};
    AuditOptions options = short_audit();
    options.duration_s = 20.0;
    EXPECT_EQ(run_audit(level, options).value().falls, 0u);
    level.fall_limit = 1.5;
    const AuditReport report = run_audit(level, options).value();
    EXPECT_TRUE(report.closed);
    EXPECT_TRUE(report.clean());
    EXPECT_GT(report.falls, 0u);
    EXPECT_EQ(report.left, 0u);
    EXPECT_EQ(report.lives, options.walkers + report.falls);
    const AuditReport read = audit_from_json(audit_to_json(report), "audit.json").value();
    EXPECT_EQ(read.falls, report.falls);
}

TEST(Audit, AWalkerWhoIsAskedToMoveAndDoesNotIsStuck) {
    AuditOptions options = short_audit();
    options.speeds = {1e-4};  // asked for a direction with free way ahead, moves 0.2 mm in 2 s
    Level level = box_level();
    level.movement.jump_speed = 0.0;
    const AuditReport report = run_audit(level, options).value();
    EXPECT_EQ(report.counts[static_cast<std::size_t>(FindingKind::stuck)], 7u);
    EXPECT_EQ(report.findings.front().kind, FindingKind::stuck);
    EXPECT_THAT(report.findings.front().text,
                testing::MatchesRegex("Walker 0 got stuck after 0.. s against face 0"));
    EXPECT_EQ(report.findings.front().face, 0u);
}

TEST(Audit, HeatCountsEveryTickOnTheFloor) {
    AuditOptions options = short_audit();
    options.heat = true;
    const AuditReport report = run_audit(box_level(), options).value();
    ASSERT_EQ(report.heat.size(), 6u);
    EXPECT_GT(report.heat[0].stood, report.steps / 4);
    EXPECT_EQ(report.heat[1].stood, 0u) << "nobody stands on the ceiling";
    // A floor that carries costs nothing; a wall costs what it takes from the stick, never more than the
    // time.
    EXPECT_EQ(report.heat[0].lost_us, 0u);
    EXPECT_GT(report.heat[wall].visits, 0u);
    EXPECT_GT(report.heat[wall].lost_us, 0u);
    EXPECT_LE(report.heat[wall].lost_us, 28'000'000u) << "7 walkers of 4 s";
}

TEST(Audit, CancelEndsEarlyAndSaysSo) {
    AuditOptions options = short_audit();
    options.progress = [](std::uint64_t) { return false; };
    const AuditReport report = run_audit(box_level(), options).value();
    EXPECT_TRUE(report.cancelled);
    EXPECT_FALSE(report.clean());
    EXPECT_LT(report.steps, 7u * 240u);
}

// A closed room of 12 x 6 x 12 m with two boxes that move: a lift under the spawn point, which rises 1 m at 1
// m/s and rests there for 10 s, and a board as wide as the room's middle that goes from x = -4 to x = 4 at 2
// m/s, turning if asked to.
Level moving_level(double spin_rate = 0.0) {
    PolygonSoup soup;
    soup.groups = {"room", "lift", "board"};
    soup.face_first_corner = {0};
    const auto add_box = [&](std::uint32_t group, const Vec3f& low, const Vec3f& high, bool inside) {
        const int faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                 {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
        for (const auto& face : faces) {
            for (int k = 0; k < 4; ++k) {
                const int corner = face[inside ? k : 3 - k];
                const bool right = corner % 4 == 1 || corner % 4 == 2;
                const bool far = corner % 4 >= 2;
                soup.corner_position.push_back(
                    {right ? high.x() : low.x(), corner >= 4 ? high.y() : low.y(), far ? high.z() : low.z()});
            }
            soup.face_first_corner.push_back(static_cast<std::uint32_t>(soup.corner_position.size()));
            soup.face_group.push_back(group);
        }
    };
    add_box(0, {-6, 0, -6}, {6, 6, 6}, true);
    add_box(1, {-1.5, -0.5, 3}, {1.5, 0.1F, 6}, false);
    add_box(2, {-4.1F, 0.2F, -3}, {-3.9F, 2.5F, 1}, false);
    Level level;
    level.mesh_path = "moving.obj";
    level.mesh = build_mesh(soup).value();
    level.overrides.resize(level.mesh->face_count());
    Platform lift;
    lift.name = lift.group = "lift";
    lift.path = {{.offset = {0, 0, 0}, .speed = 1.0}, {.offset = {0, 1, 0}, .speed = 1.0, .pause_s = 10.0}};
    Platform board;
    board.name = board.group = "board";
    board.path = {{.offset = {0, 0, 0}, .speed = 2.0}, {.offset = {8, 0, 0}, .speed = 2.0}};
    board.spin_pivot = {-4, 0, -1};
    board.spin_rate = spin_rate;
    level.platforms = {lift, board};
    level.spawn = {0.0, 1.01, 4.5};
    return level;
}

SimulationReport replay(const Level& level, const Tape& tape) {
    MovementSettings settings = level.movement;
    EXPECT_TRUE(apply_tape_settings(settings, tape, "tape").ok());
    LevelScene scene = LevelScene::build(level, settings).value();
    return simulate(TickScene(scene), settings, *tape.start, tape);
}

TEST(Audit, WalkersWalkAmongMovingPlatformsAsTapesDo) {
    for (const double spin_rate : {0.0, 1.5}) {
        const Level level = moving_level(spin_rate);
        AuditOptions options = short_audit();
        for (std::uint32_t number = 0; number < options.walkers; ++number) {
            options.shard = {number + 1, options.walkers};  // this one alone
            const AuditReport report = run_audit(level, options).value();
            ASSERT_EQ(report.lives, 1u);
            const Tape whole = audit_tape(level, options, {.walker = number, .tick = report.steps});
            Hasher hasher;
            hasher.u64(0);
            hasher.u64(replay(level, whole).end_hash);
            EXPECT_EQ(report.hash, hasher.value()) << "walker " << number;
        }
        Level still = level;
        still.platforms.clear();
        options.shard = {};
        EXPECT_NE(run_audit(level, options).value().hash, run_audit(still, options).value().hash);
    }
}

TEST(Audit, ThreadsAndShardsDoNotMatterAmongMovingPlatforms) {
    const Level level = moving_level(1.5);
    AuditOptions options = short_audit();
    options.walkers = 40;  // several side by side in a block
    options.heat = true;
    const std::string whole = audit_to_json(run_audit(level, options).value());
    {
        const ThreadLimit one(1);
        EXPECT_EQ(audit_to_json(run_audit(level, options).value()), whole);
    }
    std::vector<AuditPart> parts;
    for (const std::uint32_t number : {2u, 1u, 3u}) {
        options.shard = {number, 3};
        parts.push_back(
            {"part", audit_from_json(audit_to_json(run_audit(level, options).value()), "part").value()});
    }
    EXPECT_EQ(audit_to_json(merge_audits(parts).value()), whole);
}

// Carried up for a second, and then asked to walk too slowly to be seen moving while the lift rests.
TEST(Audit, AFindingOnALiftIsRepeatedByItsTape) {
    const Level level = moving_level();
    AuditOptions options = short_audit();
    options.speeds = {1e-4};
    Level slow = level;
    slow.movement.jump_speed = 0.0;
    const AuditReport report = run_audit(slow, options).value();
    ASSERT_EQ(report.findings.size(), 7u);
    for (const AuditFinding& finding : report.findings) {
        EXPECT_EQ(finding.kind, FindingKind::stuck);
        EXPECT_GE(finding.tick, 60u + 120u);
        EXPECT_NEAR(finding.position.y(), 2.0, 0.01);
        const Tape tape = audit_tape(slow, options, finding);
        const SimulationReport repeated = replay(slow, parse_tape(tape_to_text(tape), "tape").value());
        EXPECT_EQ(repeated.final_state.position, finding.position);
        EXPECT_EQ(repeated.end_hash, finding.hash);
        EXPECT_EQ(tape.end_hash, finding.hash);
    }
}

TEST(Audit, ABoardThatDoesNotPushPassesThroughWalkersAndIsFound) {
    Level level = moving_level();
    level.movement = basic_settings();  // push-out would put them beside it
    AuditOptions options = short_audit();
    options.duration_s = 20.0;
    options.speeds = {6.0};
    EXPECT_TRUE(run_audit(level, options).value().clean());
    level.movement.platforms = false;
    const AuditReport report = run_audit(level, options).value();
    EXPECT_GT(report.counts[static_cast<std::size_t>(FindingKind::passed_through)], 0u);
    EXPECT_GT(report.counts[static_cast<std::size_t>(FindingKind::overlap)], 0u);
    for (const AuditFinding& finding : report.findings)
        EXPECT_EQ(replay(level, audit_tape(level, options, finding)).end_hash, finding.hash);
}

// A platform that leaves the rest of the level behind takes its riders along without their leaving the level.
// A lift that goes up to 0.4 m below the ceiling leaves nobody room: the level's doing, not the movement's.
TEST(Audit, WalkersCrushedByALiftAreCountedAndAreNoFinding) {
    Level level = moving_level();
    EXPECT_EQ(run_audit(level, short_audit()).value().crushed, 0u);
    level.platforms[0].path[0].speed = 4.0;
    level.platforms[0].path[1] = {.offset = {0, 5.5, 0}, .speed = 4.0, .pause_s = 0.5};
    const AuditReport report = run_audit(level, short_audit()).value();
    EXPECT_GT(report.crushed, 0u);
    EXPECT_TRUE(report.clean());
    EXPECT_EQ(audit_from_json(audit_to_json(report), "report").value().crushed, report.crushed);
}

// The audit does not look again where the step itself found its end free.
TEST(Audit, StepsThatCallTheirEndFreeAreRight) {
    const Level level = moving_level(1.5);
    LevelScene level_scene = LevelScene::build(level).value();
    const TickScene scene(level_scene);
    AuditOptions options = short_audit();
    std::size_t free = 0, claimed_inside = 0;
    for (const bool platforms : {true, false}) {
        MovementSettings settings = level.movement;
        settings.platforms = platforms;
        settings.skin = 1e-3;
        for (std::uint32_t walker = 0; walker < 20; ++walker) {
            const Tape tape = audit_tape(level, options, {.walker = walker, .tick = 600});
            PlayerState state = scene.player_at(level.spawn);
            std::size_t tick = 0;
            for (const TapeSegment& segment : tape.segments) {
                for (int i = 0; i < segment.ticks; ++i, ++tick) {
                    const MovementScene now = scene.at(tick, tape.dt);
                    const StepResult result = step(now, settings, state, segment.input, tape.dt);
                    state = result.state;
                    if (!result.end_is_free) continue;
                    ++free;
                    bool inside = overlaps_any(now.collision, settings.radii, state.position);
                    for (const MovingPart& part : now.platforms)
                        inside = inside || overlaps_any(part.at_end(), settings.radii, state.position);
                    if (inside) ++claimed_inside;
                }
            }
        }
    }
    EXPECT_GT(free, 10'000u);
    EXPECT_EQ(claimed_inside, 0u);
}

TEST(Audit, APlatformsWholeWayBelongsToTheLevel) {
    Level level = moving_level();
    level.platforms[0].path.back().offset = {0, 60, 0};
    level.platforms[0].path.front().speed = 10.0;
    Aabb rest;
    rest.add({-1.5, -0.5, 3.0});
    rest.add({1.5, 0.1, 6.0});
    const Aabb reach = platform_reach(level.platforms[0], rest);
    EXPECT_EQ(reach.min, rest.min);
    EXPECT_EQ(reach.max, Vec3(1.5, 60.1, 6.0));
    level.platforms[0].spin_rate = 1.0;  // about the origin: a corner is at most |(1.5, 0.5, 6)| away
    EXPECT_NEAR(platform_reach(level.platforms[0], rest).max.y(), 60.0 + std::sqrt(38.5), 1e-12);
}

TEST(Audit, WalkersStartAtTheGivenPlacesInTurn) {
    AuditOptions options = short_audit();
    options.starts = {{3, 1, 3}, {-3, 1, -3}, {3, 1, -3}};
    // Each walker is thrown out through the wall that is left out, sooner or later.
    const Level level = box_level(wall);
    const AuditReport whole = run_audit(level, options).value();
    EXPECT_EQ(whole.starts, 3u);
    EXPECT_GT(whole.lives, whole.walkers);
    options.starts.pop_back();
    EXPECT_NE(run_audit(level, options)->hash, whole.hash);
    EXPECT_EQ(audit_tape(level, options, {.walker = 4}).start, Vec3(3, 1, 3));
    EXPECT_EQ(audit_tape(level, options, {.walker = 4, .life = 1}).start, Vec3(-3, 1, -3));

    // Shards of one audit have the same starts.
    options.starts = {{3, 1, 3}, {-3, 1, -3}, {3, 1, -3}};
    std::vector<AuditPart> parts;
    for (std::uint32_t number = 1; number <= 2; ++number) {
        options.shard = {number, 2};
        const std::string text = audit_to_json(run_audit(level, options).value());
        parts.push_back({"part", audit_from_json(text, "part").value()});
    }
    EXPECT_EQ(audit_to_json(merge_audits(parts).value()), audit_to_json(whole));
    options.starts[0].x() = 2;
    parts[1].report = run_audit(level, options).value();
    EXPECT_THAT(merge_audits(parts).error().text(), testing::HasSubstr("they differ in starts"));

    const auto usable = usable_starts(level, {{0, 1, 0}, {0, 0.1, 0}, {3, 1, 3}}, options.dt);
    EXPECT_EQ(usable.value(), (std::vector<Vec3>{{0, 1, 0}, {3, 1, 3}}));
    options.starts[1] = {0, 0.1, 0};
    EXPECT_THAT(run_audit(level, options).error().text(), testing::HasSubstr("start 2 lies inside face 0"));
}

TEST(Audit, FindingsOfOtherStartsRepeat) {
    Level level = moving_level();
    level.movement = basic_settings();
    level.movement.platforms = false;
    AuditOptions options = short_audit();
    options.duration_s = 20.0;
    options.starts = {{3, 1, -3}, {-3, 1, -3}};
    const AuditReport report = run_audit(level, options).value();
    ASSERT_FALSE(report.findings.empty());
    for (const AuditFinding& finding : report.findings)
        EXPECT_EQ(replay(level, audit_tape(level, options, finding)).end_hash, finding.hash);
}

TEST(Audit, RefusesWhatCannotBeRun) {
    AuditOptions options = short_audit();
    options.walkers = 0;
    EXPECT_FALSE(run_audit(box_level(), options).ok());
    options = short_audit();
    options.shard = {4, 3};
    EXPECT_FALSE(run_audit(box_level(), options).ok());
    options = short_audit();
    options.dt = 0.0;
    EXPECT_FALSE(run_audit(box_level(), options).ok());
    options = short_audit();
    options.speeds = {-1.0};
    EXPECT_FALSE(run_audit(box_level(), options).ok());
    options = short_audit();
    options.shard = {0, 3};
    EXPECT_FALSE(run_audit(box_level(), options).ok());
    Level level = box_level();
    level.overrides[0] = find_surface(level, "hazard").value();
    const auto deadly = run_audit(level, short_audit());
    ASSERT_FALSE(deadly.ok()) << "it would only count deaths";
    EXPECT_THAT(deadly.error().text(), testing::HasSubstr("is killed after 0."));
    EXPECT_THAT(deadly.error().text(), testing::HasSubstr("face 0"));
    level = box_level();
    level.spawn = {0.0, 0.1, 0.0};
    const auto inside = run_audit(level, short_audit());
    ASSERT_FALSE(inside.ok());
    EXPECT_THAT(inside.error().text(), testing::HasSubstr("inside face 0"));
}

TEST(Audit, ReportsThatAreNoneAreRefusedWithTheirLocation) {
    const auto error = [](std::string_view json) { return audit_from_json(json, "r.json").error().text(); };
    EXPECT_THAT(error("nonsense"), testing::HasSubstr("r.json"));
    EXPECT_THAT(error("{\"slipface_audit\": 9}"), testing::HasSubstr("version 9"));
    std::string text = audit_to_json(run_audit(box_level(), short_audit()).value());
    const std::string whole = text;
    text.replace(text.find("\"seed\": 1"), 9, "\"seed\": 2");
    EXPECT_THAT(error(text), testing::HasSubstr("damaged"));
    for (std::size_t length = 1; length < whole.size() - 2; length += 37)
        EXPECT_FALSE(audit_from_json(whole.substr(0, length), "r.json").ok()) << length;
    EXPECT_TRUE(audit_from_json(whole, "r.json").ok());
}

}  // namespace
}  // namespace slipface::test
