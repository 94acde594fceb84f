// Links between regions: each is proved by its tape, and none is claimed that is not there.
#include <gtest/gtest.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "reach/reach_scenes.h"
#include "slipface/base/parallel.h"
#include "slipface/reach/grades.h"
#include "slipface/reach/links.h"

namespace slipface::test {
namespace {

ReachScene scene_of(const Shapes& shapes, const Vec3& start) {
    ReachScene scene{shapes.level(), start, {}};
    scene.level.movement = MovementSettings{};
    scene.level.spawn = start;
    return scene;
}

std::uint32_t region_at(const ReachLinks& links, const Level& level, const Vec3& point) {
    return links.regions.of_face[face_at(level, point)];
}

const ReachLink* link_between(const ReachLinks& links, std::uint32_t from, std::uint32_t to, LinkKind kind) {
    for (const ReachLink& link : links.links)
        if (link.from == from && link.to == to && link.kind == kind) return &link;
    return nullptr;
}

// Every link's tape, run anew from its text: empty if each begins and ends where it says, with no region
// between.
std::string false_links(const ReachSearch& search, const ReachLinks& links) {
    LevelScene built = LevelScene::build(search.level()).value();
    const TickScene ticks(built);
    const Vec3 down(0.0, -search.level().movement.radii.y(), 0.0);
    for (const ReachLink& link : links.links) {
        const Result<Tape> tape = parse_tape(tape_to_text(link.tape), "tape");
        if (!tape) return tape.error().text();
        MovementSettings settings;
        if (!apply_tape_settings(settings, *tape, "tape")) return "the tape's settings";
        SimulationOptions options;
        options.keep_states = true;
        const SimulationReport report = simulate(ticks, settings, *tape->start, *tape, options);
        if (report.end_hash != tape->end_hash) return "the tape does not repeat";
        const PlayerState& begin = report.states[link.begin_tick - 1];
        const PlayerState& end = report.states.back();
        if (!begin.grounded || links.regions.of(begin) != link.from || begin.ground_face != link.from_face)
            return "a link begins elsewhere";
        if (!end.grounded || links.regions.of(end) != link.to || end.ground_face != link.to_face)
            return "a link ends elsewhere";
        if (ticks.to_level(begin) + down != link.begin || ticks.to_level(end) + down != link.end)
            return "a link has other positions";
        for (std::size_t i = link.begin_tick; i + 1 < report.states.size(); ++i)
            if (links.regions.of(report.states[i]) != no_id) return "a link passes another region";
        const double seconds = static_cast<double>(report.states.size() - link.begin_tick) * tick_s;
        if (std::abs(seconds - link.time_s) > 1e-9) return "a link has another time";
    }
    return {};
}

TEST(ReachLinks, AGapIsJumpedBothWaysAndADropIsGoneDownAlone) {
    std::mt19937_64 random(5);
    for (int i = 0; i < 2; ++i) {
        const double width = std::uniform_real_distribution<double>(1.5, 2.5)(random);
        const double height = std::uniform_real_distribution<double>(2.5, 4.0)(random);
        Shapes shapes;
        shapes.box({-3, -1, 0}, {3, 0, 5}).box({-3, -1, -width - 4}, {3, 0, -width});
        shapes.polygon({{-9, -height, -9}, {-9, -height, 9}, {9, -height, 9}, {9, -height, -9}});
        const ReachScene scene = scene_of(shapes, {0, 0.91, 3});
        const ReachSearch search = search_of(scene, 30);
        const ReachLinks links = search.links();
        EXPECT_EQ(false_links(search, links), "");
        const std::uint32_t near = region_at(links, scene.level, {0, 0, 2}),
                            far = region_at(links, scene.level, {0, 0, -width - 2}),
                            low = region_at(links, scene.level, {0, -height, 0});
        ASSERT_EQ((std::set<std::uint32_t>{near, far, low}.size()), 3u);
        const ReachLink* there = link_between(links, near, far, LinkKind::jump);
        const ReachLink* drop = link_between(links, near, low, LinkKind::drop);
        ASSERT_TRUE(there && drop && link_between(links, far, near, LinkKind::jump));
        EXPECT_TRUE(there->two_way);
        EXPECT_FALSE(drop->two_way);
        EXPECT_NEAR(there->begin.y(), 0.0, 0.15);  // rolling over the edge
        EXPECT_LT(there->end.z(), -width + 0.5);
        EXPECT_NEAR(drop->end.y(), -height, 0.05);
        for (const ReachLink& link : links.links)
            EXPECT_NE(link.from, low) << "nobody gets up again";
    }
}

TEST(ReachLinks, AStepJoinsWhatAWallOfKneeHeightParts) {
    for (const bool step_up : {true, false}) {
        Shapes shapes;
        shapes.box({-4, -1, -4}, {4, 0, 4}).box({1, 0, -2}, {3, 0.3, 2});
        ReachScene scene = scene_of(shapes, {-2, 0.91, 0});
        scene.level.movement.step_up = step_up;
        scene.level.movement.step_height = 0.35;
        const WalkRegions regions = walk_regions(scene.level);
        const bool joined = regions.of_face[face_at(scene.level, {2, 0.3, 0})] ==
                            regions.of_face[face_at(scene.level, {-2, 0, 0})];
        EXPECT_EQ(joined, step_up);
        if (step_up) continue;
        const ReachSearch search = search_of(scene, 10);
        const ReachLinks links = search.links();
        EXPECT_EQ(false_links(search, links), "");
        EXPECT_FALSE(links.links.empty());
    }
}

TEST(ReachLinks, AFerryIsRiddenAndALadderClimbed) {
    Shapes shapes;
    shapes.box({-2, -1, 0}, {2, 0, 4}).box({-2, -1, -18}, {2, 0, -14});
    shapes.material("rungs__ladder").box({2, 0, 1}, {3, 4, 3});
    shapes.material("stone").box({3, 0, 0}, {6, 4, 4});
    shapes.group("ferry").box({-1, -0.4, -2.2}, {1, 0, -0.2});
    ReachScene scene = scene_of(shapes, {0, 0.91, 3});
    Platform ferry;
    ferry.name = ferry.group = "ferry";
    ferry.path = {{Vec3::Zero(), 3.0, 0.5}, {Vec3(0, 0, -11.6), 3.0, 0.5}};
    scene.level.platforms.push_back(ferry);
    ReachSearch search = search_of(scene, 0);
    ASSERT_TRUE(rounds_until(search, face_at(scene.level, {0, 0, -16}), 120));
    ASSERT_TRUE(rounds_until(search, face_at(scene.level, {5, 4, 2}), 120));
    const ReachLinks links = search.links();
    EXPECT_EQ(false_links(search, links), "");
    const std::uint32_t start = region_at(links, scene.level, {0, 0, 2});
    const ReachLink* ride =
        link_between(links, start, region_at(links, scene.level, {0, 0, -16}), LinkKind::ride);
    ASSERT_TRUE(ride);
    // A jump of 0.8 s towards the bow goes 9 m/s * 0.8 s = 7.2 m and lands with the rim, 0.4 m at either end.
    // The bow, at -2.2 m - 3 m/s * t, is near enough to -14 m after 1.27 s.
    EXPECT_GT(ride->time_s, 1.27 + 0.8 - 0.1);
    EXPECT_TRUE(link_between(links, start, region_at(links, scene.level, {5, 4, 2}), LinkKind::climb));
}

TEST(ReachLinks, AreTheSameBytesForAnyNumberOfThreadsAndReadByOthers) {
    const ReachScene scene = gap_scene(MovementSettings{}, 2.0, 0.0, 0.4);
    const ReachSearch search = search_of(scene, 12);
    std::string texts[2];
    for (const int threads : {1, 2}) {
        const ThreadLimit limit(threads);
        texts[threads - 1] = links_to_json(search, search.links());
    }
    EXPECT_EQ(texts[0], texts[1]);
    const ReachLinks links = search.links();
    const auto json = nlohmann::json::parse(texts[0]);
    ASSERT_EQ(json.at("links").size(), links.links.size());
    ASSERT_GE(links.links.size(), 2u);
    EXPECT_EQ(json.at("regions").size(), links.regions.regions.size());
    EXPECT_EQ(json.at("links")[0].at("kind"), "jump");
    EXPECT_TRUE(parse_tape(json.at("links")[0].at("tape").get<std::string>(), "t").ok());
    EXPECT_EQ(nlohmann::json::parse(link_to_json(links.links[0])), json.at("links")[0]);

    // As RecastDemo reads its lines.
    std::istringstream gset(links_to_gset(search, links));
    std::string line;
    std::getline(gset, line);
    EXPECT_EQ(line[0], 'f');
    for (const ReachLink& link : links.links) {
        ASSERT_TRUE(std::getline(gset, line));
        float v[6], radius = 0;
        int both = -1, area = -1, flags = -1;
        ASSERT_EQ(std::sscanf(line.c_str() + 1, "%f %f %f  %f %f %f %f %d %d %d", v, v + 1, v + 2, v + 3,
                              v + 4, v + 5, &radius, &both, &area, &flags),
                  10);
        EXPECT_NEAR(v[2], link.begin.z(), 1e-5);
        EXPECT_NEAR(v[4], link.end.y(), 1e-5);
        EXPECT_EQ(both, 0);
        EXPECT_EQ(area, 5);
    }
    EXPECT_FALSE(std::getline(gset, line));
}

TEST(ReachPlaces, AreStoodOnAndSpreadOverAllThatIsReached) {
    const ReachScene scene = gap_scene(MovementSettings{}, 2.0, 0.0, 0.0);
    const ReachSearch search = search_of(scene, 20);
    const std::vector<Vec3> places = search.standing_places(20);
    ASSERT_EQ(places.size(), 20u);
    const auto beyond =
        std::count_if(places.begin(), places.end(), [](const Vec3& at) { return at.z() < -2.0; });
    EXPECT_GT(beyond, 4);
    EXPECT_LT(beyond, 16);
    for (const Vec3& at : places)
        EXPECT_NEAR(at.y(), scene.level.movement.radii.y(), 0.2);
}

// A ledge and a gap a little below and a little above what an exhaustive search finds possible.
TEST(Grades, SayByHowMuchALedgeOrAGapIsTooLarge) {
    const MovementSettings settings;
    const JumpLimits limits = measure_limits(settings, tick_s);
    EXPECT_NEAR(limits.gap_m, max_possible(settings, false, 4), 0.25);
    EXPECT_NEAR(limits.ledge_m, max_possible(settings, true, 4), 0.25);
    for (const bool ledge : {true, false}) {
        const double limit = ledge ? limits.ledge_m : limits.gap_m;
        for (const double part : {0.8, 0.97, 1.05, 1.3}) {
            SCOPED_TRACE(part);
            const ReachScene scene = ledge ? gap_scene(settings, 0.0, part * limit, 0.3)
                                           : gap_scene(settings, part * limit, 0.0, 0.3);
            const Grades grades = grade(scene.level);
            const std::size_t wanted = part > 0.9 && part < 1.1 ? 1 : 0;
            // A gap is one from both sides.
            ASSERT_EQ(grades.notes.size(), ledge ? wanted : 2 * wanted);
            if (wanted == 0) continue;
            EXPECT_EQ(grades.notes[0].reached, part < 1.0);
            const std::string tail = part < 1.0 ? "below the limit" : ledge ? "too high" : "too wide";
            EXPECT_NE(grades.notes[0].text.find(tail), std::string::npos) << grades.notes[0].text;
        }
    }
}

}  // namespace
}  // namespace slipface::test
