// The search: the same bytes whatever the threads, going on from a file, and never a yes without a proof.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "reach/known_scenes.h"
#include "slipface/base/files.h"
#include "slipface/base/parallel.h"

namespace slipface::test {
namespace {

MovementSettings drawn_settings(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    return random_settings(random);
}

double drawn(std::uint64_t seed, double low, double high) {
    std::mt19937_64 random(seed * 7919 + 17);
    return std::uniform_real_distribution<double>(low, high)(random);
}

class ReachFile : public ::testing::Test {
  protected:
    ReachFile() : path_(std::filesystem::temp_directory_path() / ("slipface_reach_" + name())) {}
    ~ReachFile() override { std::filesystem::remove(path_); }
    std::filesystem::path path_;

  private:
    static std::string name() { return std::to_string(::getpid()); }
};

TEST(ReachPress, DirectionsAreUnitAndAtTheirAngles) {
    for (std::uint32_t i = 0; i < press_directions; ++i) {
        const Vec2 direction = direction_vector(i);
        EXPECT_NEAR(direction.norm(), 1.0, 1e-15);
        EXPECT_NEAR(
            std::remainder(std::atan2(direction.y(), direction.x()) - 2.0 * std::numbers::pi * i / 64.0,
                           2.0 * std::numbers::pi),
            0.0, 1e-14);
    }
}

TEST(ReachSearch, GapsAndLedgesThatAreEasyAreFoundAndProved) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        SCOPED_TRACE(seed);
        const MovementSettings settings = drawn_settings(seed);
        const bool ledge = seed % 2 == 0;
        const double maximum = max_possible(settings, ledge, 4);
        const double size = drawn(seed, 0.5, 0.85) * maximum, yaw = drawn(seed + 50, 0.0, 6.28);
        const ReachScene scene =
            ledge ? gap_scene(settings, 0.5, size, yaw) : gap_scene(settings, size, 0.0, yaw);
        ReachSearch search = search_of(scene, 0, seed);
        EXPECT_TRUE(rounds_until(search, face_at(scene.level, scene.target), 60));
        EXPECT_EQ(false_claims(search), "");
    }
}

TEST(ReachSearch, AGapThatNoJumpMastersIsNotReachedAndSaysByHowMuch) {
    for (std::uint64_t seed = 11; seed <= 12; ++seed) {
        SCOPED_TRACE(seed);
        const MovementSettings settings = drawn_settings(seed);
        const double beyond = drawn(seed, 0.3, 1.5);
        const ReachScene scene = gap_scene(settings, max_possible(settings, false, 8) + beyond, 0.0, 0.0);
        const FaceId face = face_at(scene.level, scene.target);
        const ReachSearch search = search_of(scene, 20, seed);
        EXPECT_FALSE(search.faces()[face].found());
        const auto miss = search.nearest_miss_of_face(face);
        ASSERT_TRUE(miss);
        // The feet come down in front of the edge, at most what the gap is too wide and a little.
        EXPECT_GT(miss->distance_m, 0.0);
        EXPECT_LT(miss->distance_m, beyond + 0.8);
        EXPECT_GT(miss->tape.tick_count(), 0u);
    }
}

TEST(ReachSearch, TheSameBytesForAnyNumberOfThreads) {
    const ReachScene scene = gap_scene(drawn_settings(3), 1.5, 0.2, 0.4);
    std::uint64_t hashes[2];
    for (const int threads : {1, 2}) {
        const ThreadLimit limit(threads);
        hashes[threads - 1] = search_of(scene, 12).hash();
    }
    EXPECT_EQ(hashes[0], hashes[1]);
    EXPECT_NE(hashes[0], search_of(scene, 12, 2).hash());
}

TEST_F(ReachFile, ASearchGoesOnFromItsFileAsIfItHadNeverStopped) {
    const ReachScene scene = gap_scene(drawn_settings(4), 1.5, 0.2, 0.4);
    ASSERT_TRUE(search_of(scene, 6).store(path_).ok());
    Result<ReachSearch> resumed = ReachSearch::resume(scene.level, path_);
    ASSERT_TRUE(resumed.ok()) << resumed.error().text();
    EXPECT_EQ(resumed->hash(), search_of(scene, 6).hash());
    ReachLimits limits;
    limits.rounds = 12;
    resumed->run(limits);
    EXPECT_EQ(resumed->hash(), search_of(scene, 12).hash());
}

TEST_F(ReachFile, DamagedAndForeignFilesAreRefusedWithAReason) {
    const ReachScene scene = gap_scene(drawn_settings(4), 1.5, 0.2, 0.4);
    ASSERT_TRUE(search_of(scene, 3).store(path_).ok());
    const std::string good = read_file(path_).value();
    std::mt19937_64 random(1);
    for (int i = 0; i < 60; ++i) {
        std::string bad = good;
        const std::size_t at = random() % bad.size();
        // The summary is for people: no byte of it is read back.
        const std::size_t first = bad.find('\n'), second = bad.find('\n', first + 1);
        if (at > first && at <= second) continue;
        if (i % 3 == 0)
            bad.resize(at);
        else
            bad[at] = static_cast<char>(bad[at] ^ (1 << (random() % 8)));
        std::ofstream(path_, std::ios::binary) << bad;
        const Result<ReachSearch> read = ReachSearch::resume(scene.level, path_);
        ASSERT_FALSE(read.ok()) << "byte " << at;
        EXPECT_NE(read.error().message.find("expected"), std::string::npos) << read.error().text();
    }
    std::ofstream(path_, std::ios::binary) << good;
    ReachScene other = scene;
    other.level.movement.jump_speed += 0.1;
    const Result<ReachSearch> read = ReachSearch::resume(other.level, path_);
    ASSERT_FALSE(read.ok());
    EXPECT_NE(read.error().message.find("other settings"), std::string::npos);
}

TEST(ReachSearch, ACellTakesAtMost64BytesBesideItsState) {
    const ReachSearch search = search_of(gap_scene(drawn_settings(5), 1.5, 0.0, 0.0), 40);
    const double beside = static_cast<double>(search.archive().bytes()) -
                          static_cast<double>(search.archive().nodes.size() * sizeof(PlayerState));
    EXPECT_LT(beside / static_cast<double>(search.archive().nodes.size()), 64.0);
}

// One wall on the path to the last tile is closed, or none: the tiles reached are those connected with the
// first.
TEST(ReachSearch, TheConnectedTilesOfAMazeAreReachedAndNoOthers) {
    for (const bool closed : {false, true}) {
        SCOPED_TRACE(closed);
        const Maze maze = maze_of(closed ? 2 : 1, 5, closed);
        const ReachScene scene = maze_scene(Draw{}, maze);
        const ReachSearch search = search_of(scene, 25);
        const ReachReport report = make_reach_report(search);
        const std::vector<bool> connected = maze.connected();
        EXPECT_EQ(connected.back(), !closed);
        for (FaceId tile = 0; tile < connected.size(); ++tile)
            EXPECT_EQ(search.faces()[tile].found(), connected[tile]) << "tile " << tile;
        EXPECT_TRUE(report.traps.empty());
        EXPECT_EQ(false_claims(search), "");
        if (closed) continue;
        // Not faster than straight through all walls.
        const double time = search.faces()[face_at(scene.level, scene.target)].tick * tick_s;
        EXPECT_GT(time, (scene.target - scene.start).norm() / scene.level.movement.walk_speed - 0.5);
    }
}

// Each kind once below its limit and once beyond.
TEST(ReachSearch, KnownScenesAreReachedUpToTheirLimitAndNotBeyond) {
    std::uint64_t seed = 20;
    for (const KnownScene& kind : known_scenes()) {
        const Draw draw = draw_of(++seed);
        const double maximum = kind.maximum(draw, 4);
        for (const double fraction : {draw.in(90, 0.5, 0.85), draw.in(91, 1.1, 1.3)}) {
            SCOPED_TRACE(kind.name + std::string(" at ") + std::to_string(fraction));
            const ReachScene scene = kind.make(draw, fraction, maximum);
            ReachSearch search = search_of(scene, 0, seed);
            const FaceId face = face_at(scene.level, scene.target);
            const bool found = rounds_until(search, face, fraction < 1.0 ? 300 : 4).has_value();
            EXPECT_EQ(found, fraction < 1.0) << search.steps();
            EXPECT_EQ(false_claims(search), "");
        }
    }
}

// A start on a tower in a walled yard: down is a way, up is none. And a room without a door in the yard.
TEST(ReachSearch, AOneWayDropIsATrapAndALockedRoomIsNeverReached) {
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
        SCOPED_TRACE(seed);
        const double height = drawn(seed, 2.5, 5.0);
        Shapes shapes;
        shapes.box({-1, -1, -1}, {1, height, 1});                          // tower: faces 0 to 5
        shapes.polygon({{-5, 0, -5}, {-5, 0, 5}, {5, 0, 5}, {5, 0, -5}});  // yard: face 6
        shapes.polygon(
            {{3, 0.01, 3}, {3, 0.01, 4.5}, {4.5, 0.01, 4.5}, {4.5, 0.01, 3}});  // in the room: face 7
        for (const double side : {-5.0, 5.0}) {
            shapes.box({side - 0.1, 0, -5}, {side + 0.1, 12, 5});
            shapes.box({-5, 0, side - 0.1}, {5, 12, side + 0.1});
        }
        for (const double side : {2.8, 4.7}) {
            shapes.box({side - 0.1, 0, 2.8}, {side + 0.1, 12, 4.7});
            shapes.box({2.8, 0, side - 0.1}, {4.7, 12, side + 0.1});
        }
        ReachScene scene{shapes.level(), {0, height + 0.91, 0}, {3.75, 0.01, 3.75}};
        scene.level.movement = MovementSettings{};
        const ReachSearch search = search_of(scene, 50, seed);
        const ReachReport report = make_reach_report(search);
        EXPECT_TRUE(search.faces()[0].found());
        EXPECT_TRUE(search.faces()[6].found());
        EXPECT_FALSE(search.faces()[7].found());
        EXPECT_EQ(report.traps, std::vector<FaceId>{6});
        EXPECT_TRUE(std::find(report.unreached.begin(), report.unreached.end(), 7u) !=
                    report.unreached.end());
        EXPECT_EQ(false_claims(search), "");
    }
}

// A square hole in a closed floor, a little wider than the player or a little narrower.
TEST(ReachSearch, AHoleOfTheBodysSizeIsAnExitAndANarrowerOneIsNot) {
    for (const bool wide : {true, false}) {
        SCOPED_TRACE(wide);
        MovementSettings settings;
        const double half = settings.radii.x() * (wide ? 1.1 : 0.9);
        Shapes shapes;
        shapes.box({-4, -0.2, -4}, {-half, 0, 4}).box({half, -0.2, -4}, {4, 0, 4});
        shapes.box({-half, -0.2, -4}, {half, 0, -half}).box({-half, -0.2, half}, {half, 0, 4});
        for (const double side : {-4.0, 4.0}) {
            shapes.box({side - 0.1, 0, -4}, {side + 0.1, 12, 4});
            shapes.box({-4, 0, side - 0.1}, {4, 12, side + 0.1});
        }
        ReachScene scene{shapes.level(), {2, 0.91, 2}, {}};
        scene.level.movement = settings;
        const ReachSearch search = search_of(scene, 40);
        EXPECT_EQ(search.exits().empty(), !wide);
        for (const ReachExit& exit : search.exits()) {
            // The hole, not where the fall ends.
            EXPECT_LT(std::abs(exit.hole.x()), 0.5);
            EXPECT_LT(std::abs(exit.hole.z()), 0.5);
            EXPECT_GT(exit.hole.y(), -2.0);
            EXPECT_GT(search.tape_of(exit).tick_count(), 0u);
        }
    }
}

// Too wide to jump: a ferry is the only way, and it goes back and forth.
TEST(ReachSearch, AFerryIsWaitedForAndRidden) {
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
        SCOPED_TRACE(seed);
        const double width = drawn(seed, 12.0, 16.0), speed = drawn(seed + 5, 2.0, 4.0);
        Shapes shapes;
        shapes.box({-2, -1, 0}, {2, 0, 4}).box({-2, -1, -width - 4}, {2, 0, -width});
        shapes.group("ferry").box({-1, -0.4, -2.2}, {1, 0, -0.2});
        ReachScene scene{shapes.level(), {0, 0.91, 3}, {0, 0, -width - 2}};
        scene.level.movement = MovementSettings{};
        Platform ferry;
        ferry.name = ferry.group = "ferry";
        ferry.phase_s = drawn(seed + 9, 0.0, 6.0);
        ferry.path = {{Vec3::Zero(), speed, 0.5}, {Vec3(0, 0, -width + 2.4), speed, 0.5}};
        scene.level.platforms.push_back(ferry);
        ReachSearch search = search_of(scene, 0, seed);
        const FaceId far_side = face_at(scene.level, scene.target);
        EXPECT_TRUE(rounds_until(search, far_side, 120)) << search.steps();
        EXPECT_EQ(false_claims(search), "");
    }
}

// What comes once, and late, is waited for: where a platform is makes time part of a cell, not the clock.
TEST(ReachSearch, ABridgeThatComesOnceAfterAnyTimeIsWaitedFor) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        SCOPED_TRACE(seed);
        const double width = drawn(seed, 10.0, 14.0), late = drawn(seed + 5, 20.0, 90.0);
        Shapes shapes;
        shapes.box({-2, -1, 0}, {2, 0, 4}).box({-2, -1, -width - 4}, {2, 0, -width});
        shapes.group("bridge").box({-1, -0.4, 1.5 - width}, {1, 0, -1.5});
        ReachScene scene{shapes.level(), {0, 0.91, 3}, {0, 0, -width - 2}};
        scene.level.movement = MovementSettings{};
        Platform bridge;
        bridge.name = bridge.group = "bridge";
        bridge.path = {{Vec3(25, 0, 0), 6.0, late}, {Vec3::Zero(), 6.0, 60.0}};
        bridge.repeat = PathRepeat::once;
        scene.level.platforms.push_back(bridge);
        ReachSearch search = search_of(scene, 0, seed);
        const FaceId far_side = face_at(scene.level, scene.target);
        EXPECT_TRUE(rounds_until(search, far_side, 120)) << search.steps();
        EXPECT_EQ(false_claims(search), "");
    }
}

// A level pad gives back the height of the jump; one that leans turns the speed of the run into height, too.
TEST(ReachSearch, ABounceOffALeaningPadLeadsToTheRoof) {
    Shapes shapes;
    shapes.box({-3, -1, -3}, {3, 0, 3});
    shapes.material("pad__bouncy").polygon({{3.2, -1, 1}, {5.2, -0.2, 1}, {5.2, -0.2, -1}, {3.2, -1, -1}});
    shapes.material("stone").box({6, -1, -3}, {9, 2.0, 3});
    ReachScene scene{shapes.level(), {0, 0.91, 0}, {7.5, 2.0, 0}};
    scene.level.movement = MovementSettings{};
    for (SurfaceType& type : scene.level.surfaces)
        if (type.name == "bouncy") type.restitution = 1.0;
    const double jump = 8.0 * 8.0 / (2.0 * 20.0);  // 1.6 m: not up to the roof
    ASSERT_LT(jump, 2.0);
    ReachSearch search = search_of(scene, 0);
    EXPECT_TRUE(rounds_until(search, face_at(scene.level, scene.target), 120)) << search.steps();
    EXPECT_EQ(false_claims(search), "");
}

TEST(ReachGoals, HoldOrBreakAndSayWhy) {
    const MovementSettings settings;
    const double maximum = max_possible(settings, false, 4);
    ReachScene scene = gap_scene(settings, 0.7 * maximum, 0.0, 0.0);
    const Vec3 far_side = scene.target + Vec3(0, 0.9, 0);
    const auto goal = [&](const char* name, GoalKind kind, std::optional<double> within, const char* from) {
        Goal made;
        made.name = name;
        made.kind = kind;
        made.position = far_side;
        made.within_s = within;
        made.from = from;
        scene.level.goals.push_back(made);
    };
    goal("over", GoalKind::reach, std::nullopt, "");
    goal("soon", GoalKind::reach, 30.0, "");
    goal("at once", GoalKind::reach, 0.5, "");
    goal("fenced", GoalKind::never, std::nullopt, "");
    goal("back", GoalKind::reach, std::nullopt, "over");
    scene.level.goals.back().position = scene.start;
    ReachLimits limits;
    limits.rounds = 40;
    const auto answers = check_goals(scene.level, scene.start, {}, limits);
    ASSERT_TRUE(answers.ok());
    ASSERT_EQ(answers->size(), 5u);
    const bool expected[] = {true, true, false, false, true};
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ((*answers)[i].goal, i);
        EXPECT_EQ((*answers)[i].holds, expected[i]) << (*answers)[i].text;
        EXPECT_TRUE((*answers)[i].tape);
    }
    EXPECT_NE((*answers)[3].text.find("expected never"), std::string::npos);
    // Too slow to get over: the goal breaks, and the answer names how much was missing and the last face.
    scene.level.movement.walk_speed = 1.0;
    scene.level.goals.resize(1);
    const auto broken = check_goals(scene.level, scene.start, {}, limits);
    ASSERT_TRUE(broken.ok());
    EXPECT_FALSE(broken->front().holds);
    EXPECT_NE(broken->front().text.find(" m short, last on face"), std::string::npos) << broken->front().text;
    scene.level.goals.front().from = "nowhere";
    const auto unknown = check_goals(scene.level, scene.start, {}, limits);
    ASSERT_FALSE(unknown.ok());
    EXPECT_NE(unknown.error().text().find("\"nowhere\""), std::string::npos);
}

// Seconds from the start until the centre is `radius` away from the last of `by`, with the stick held towards
// each in turn; the others are passed where their z is.
double sprint_s(const ReachScene& scene, const std::vector<Vec3>& by, double radius) {
    LevelScene built = LevelScene::build(scene.level).value();
    const MovementScene now = built.at(0.0);
    PlayerState state = built.player_at(scene.start);
    std::size_t next = 0;
    for (int tick = 1; tick < 3600; ++tick) {
        const Vec3 way = by[next] - state.position;
        state =
            step(now, scene.level.movement, state, {Vec2(way.x(), way.z()).normalized(), {}}, tick_s).state;
        if (next + 1 == by.size() ? (by[next] - state.position).norm() <= radius
                                  : state.position.z() <= by[next].z())
            if (++next == by.size()) return tick * tick_s;
    }
    return 1e9;
}

TEST(ReachGoals, LimitsOfTimeAreTrueToAPerCent) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937_64 random(seed);
        const auto in = [&](double low, double high) {
            return std::uniform_real_distribution<double>(low, high)(random);
        };
        const MovementSettings s = random_settings(random);
        const double height = s.radii.y() + s.skin, wall = in(1.0, 6.0);
        Shapes shapes;
        shapes.box({-15, -1, -25}, {15, 0, 25});
        if (seed % 2 == 0) shapes.box({-14, 0, -0.5}, {wall, 6, 0.5});
        ReachScene scene{shapes.level(), Vec3(in(-5, 5), height, in(12, 22)),
                         Vec3(in(-5, 5), height, in(-22, -12))};
        scene.level.movement = s;
        scene.level.spawn = scene.start;
        std::vector<Vec3> by;
        const double beside = wall + s.radii.x() + 0.01;
        if (seed % 2 == 0) by = {{beside, height, 0.5}, {beside, height, -0.5}};
        by.push_back(scene.target);
        Goal goal{.name = "there", .position = scene.target, .radius = 0.5, .within_s = {}, .from = {}};
        const double fastest = sprint_s(scene, by, goal.radius);
        ReachLimits limits;
        limits.rounds = 60;
        for (const double share : {1.01, 0.97}) {
            if (share < 1.0 && seed > 1) continue;  // takes long
            goal.within_s = share * fastest;
            scene.level.goals = {goal};
            const auto answers = check_goals(scene.level, scene.start, {}, limits);
            ASSERT_TRUE(answers.ok());
            EXPECT_EQ(answers->front().holds, share > 1.0) << fastest << " s: " << answers->front().text;
        }
    }
}

TEST(ReachReports, TellWhatASettingGainsAndLoses) {
    const MovementSettings settings;
    ReachScene scene = gap_scene(settings, 0.8 * max_possible(settings, false, 4), 0.0, 0.0);
    const FaceId far_side = face_at(scene.level, scene.target);
    const ReachReport before = make_reach_report(search_of(scene, 30));
    ReachScene slow = scene;
    slow.level.movement.walk_speed = 2.0;
    const ReachReport after = make_reach_report(search_of(slow, 30));
    // Through the text, as files go.
    const auto a = parse_reach_report(reach_to_json(before, true), "a");
    const auto b = parse_reach_report(reach_to_json(after, false), "b");
    ASSERT_TRUE(a.ok() && b.ok());
    const ReachDifference difference = compare_reach(*a, *b);
    EXPECT_TRUE(std::find(difference.lost.begin(), difference.lost.end(), far_side) != difference.lost.end());
    // At most one, the side of the box that it starts on: a player on its rim stands on either face.
    EXPECT_EQ(std::count(difference.gained.begin(), difference.gained.end(), far_side), 0);
    EXPECT_LE(difference.gained.size(), 1U);
    for (const FaceId face : difference.gained)
        EXPECT_LT(face, face_at(scene.level, scene.start) + 5);
    EXPECT_EQ(difference.settings, std::vector<std::string>({"walk_speed=2"}));
    const ReachDifference back = compare_reach(*b, *a);
    EXPECT_EQ(back.gained, difference.lost);
    for (const char* text :
         {"", "{}", "[1]", "{\"slipface_reach\": 1}", "{\"slipface_reach\": 1, \"geometry\": 3}"})
        EXPECT_FALSE(parse_reach_report(text, "x").ok()) << text;
}

}  // namespace
}  // namespace slipface::test
