// Where a player begins: spawns that fit, spawns that do not, and levels without any.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "level/faces.h"
#include "slipface/level/find_start.h"

namespace slipface::test {
namespace {

using testing::HasSubstr;
using testing::Not;

void add_quad(Faces& faces, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    faces.push_back({{a.cast<float>(), b.cast<float>(), c.cast<float>(), d.cast<float>()}});
}

// Seen from outside; with `inside` a room.
void add_box(Faces& faces, const Vec3& low, const Vec3& high, bool inside = false) {
    const auto at = [&](int x, int y, int z) {
        return Vec3(x != 0 ? high.x() : low.x(), y != 0 ? high.y() : low.y(), z != 0 ? high.z() : low.z());
    };
    const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
        inside ? add_quad(faces, d, c, b, a) : add_quad(faces, a, b, c, d);
    };
    add(at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0));
    add(at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1));
    add(at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0));
    add(at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1));
    add(at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0));
    add(at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1));
}

Level without_spawn(const Faces& faces) {
    Level level = level_of(faces);
    level.spawn_is_set = false;
    return level;
}

Start start_of(const Level& level, std::string_view name = {}) {
    Result<LevelScene> scene = LevelScene::build(level);
    EXPECT_TRUE(scene.ok());
    Result<Start> start = find_start(level, *scene, level.movement, name);
    EXPECT_TRUE(start.ok()) << start.error().text();
    return start ? *start : Start{};
}

// Ticks without input; the state at their end.
PlayerState after_idling(const Level& level, const Vec3& start, int ticks) {
    Result<LevelScene> built = LevelScene::build(level);
    const MovementScene scene = built->at(0.0);
    PlayerState state = built->player_at(start);
    for (int i = 0; i < ticks; ++i)
        state = step(scene, level.movement, state, {}, 1.0 / 60.0, nullptr).state;
    return state;
}

class Draw {
  public:
    explicit Draw(unsigned seed) : random_(seed) {}
    double between(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    Vec3 in(const Vec3& low, const Vec3& high) {
        return {between(low.x(), high.x()), between(low.y(), high.y()), between(low.z(), high.z())};
    }

  private:
    std::mt19937 random_;
};

// A floor with boxes on it, anywhere, for a body of any size.
Level drawn_level(Draw& draw) {
    Faces faces;
    const double half = draw.between(4, 40), top = draw.between(0, 1) < 0.5 ? 0.0 : draw.between(-20, 20);
    add_box(faces, {-half, top - draw.between(0.1, 5), -half}, {half, top, half});
    for (int boxes = static_cast<int>(draw.between(0, 12)); boxes > 0; --boxes) {
        const Vec3 low = draw.in({-half, top, -half}, {half, top + 2, half});
        add_box(faces, low, low + draw.in({0.1, 0.1, 0.1}, {4, 4, 4}));
    }
    Level level = without_spawn(faces);
    level.movement.radii.x() = level.movement.radii.z() = draw.between(0.2, 0.6);
    level.movement.radii.y() = draw.between(0.4, 1.2);
    return level;
}

TEST(FindStart, AFloorAtZeroAndNoSpawnOrOneAtTheOriginJustWork) {
    Faces faces;
    add_quad(faces, {-5, 0, -5}, {-5, 0, 5}, {5, 0, 5}, {5, 0, -5});
    Level level = without_spawn(faces);
    for (const bool set : {false, true}) {
        level.spawn_is_set = set;
        const Start start = start_of(level);
        EXPECT_TRUE(start.stands);
        EXPECT_NEAR((start.position - Vec3(0, 0.902, 0)).norm(), 0.0, 1e-9);
        EXPECT_THAT(start.note, HasSubstr("lifted onto the floor by 0.90 m"));
        EXPECT_TRUE(after_idling(level, start.position, 1).grounded);
    }
}

TEST(FindStart, WhereverASpawnLiesThePlayerHasRoomAndNeverFallsThroughTheFloor) {
    int lost = 0, lifted = 0, pushed = 0, taken = 0, elsewhere = 0;
    for (unsigned seed = 0; seed < 400; ++seed) {
        Draw draw(seed);
        Level level = drawn_level(draw);
        const double half = level.mesh->bounds.max.x();
        level.spawn_is_set = seed % 4 != 0;
        level.spawn = draw.in({-half, level.mesh->bounds.min.y() - 1, -half},
                              {half, level.mesh->bounds.max.y() + 3, half});
        const Start start = start_of(level);
        ASSERT_TRUE(start.stands) << seed << " " << start.note;
        const Result<CollisionWorld> world = build_collision_world(level);
        const Vec3 less = level.movement.radii.array() - level.movement.skin;
        EXPECT_FALSE(overlaps_any(*world, less, start.position)) << seed << " " << start.note;
        const PlayerState after = after_idling(level, start.position, 240);
        EXPECT_FALSE(after.trapped) << seed;
        lost += after.position.y() < level.mesh->bounds.min.y() ? 1 : 0;
        if (start.note.empty()) {
            ++taken;
            EXPECT_EQ(start.position, level.spawn);  // to the bit
        }
        lifted += start.note.find("lifted") != std::string::npos ? 1 : 0;
        pushed += start.note.find("pushed") != std::string::npos ? 1 : 0;
        elsewhere += start.note.find("open floor") != std::string::npos ? 1 : 0;
        EXPECT_EQ(start_of(level).position, start.position);
    }
    // At a rim the player may slide off.
    EXPECT_LT(lost, 20);
    // The search reached each of them.
    EXPECT_GT(lifted, 20);
    EXPECT_GT(pushed, 5);
    EXPECT_GT(taken, 20);
    EXPECT_GT(elsewhere, 5);
}

TEST(FindStart, OpenFloorHoldsThePlayerWhereverItIs) {
    for (unsigned seed = 0; seed < 200; ++seed) {
        Draw draw(1000 + seed);
        const Level level = drawn_level(draw);
        Result<LevelScene> scene = LevelScene::build(level);
        const auto floor = find_open_floor(scene->at(0.0), level.movement);
        ASSERT_TRUE(floor) << seed;
        const PlayerState after = after_idling(level, *floor, 30);
        EXPECT_TRUE(after.grounded) << seed;
        EXPECT_LT((after.position - *floor).norm(), 0.05) << seed;
    }
}

// Triangles that boxes do not tell apart, so that each query looks at all.
Faces tangle(std::size_t count, const Vec3& low, const Vec3& high) {
    Draw draw(7);
    Faces faces(count);
    for (auto& face : faces)
        for (int corner = 0; corner < 3; ++corner)
            face.corners.push_back(draw.in(low, high).cast<float>());
    return faces;
}

TEST(FindStart, AmongManyTrianglesTheMiddleIsFound) {
    // Not at the origin, where a player would be lifted onto them without a search.
    const Start start = start_of(without_spawn(tangle(100'000, {8, -0.001, 8}, {12, 0.001, 12})));
    EXPECT_TRUE(start.stands);
    EXPECT_LT(Vec2(start.position.x() - 10, start.position.z() - 10).norm(), 1.5);
}

TEST(FindStart, OneTwoSidedTriangleAmongManyOneSidedTakesTheRoom) {
    Faces faces;
    add_quad(faces, {-2, -0.402, -2}, {-2, -0.402, 2}, {2, -0.402, 2}, {2, -0.402, -2});
    for (int i = 0; i < 200; ++i)
        add_quad(faces, {-1, 0.001 * i, -1}, {-1, 0.001 * i, 1}, {1, 0.001 * i, 1}, {1, 0.001 * i, -1});
    Level level = level_of(faces);
    level.spawn = {0, 0.5, 0};
    SurfaceType valve;
    valve.name = "valve";
    valve.one_sided = true;
    level.surfaces.push_back(valve);
    const auto one_sided = static_cast<SurfaceId>(level.surfaces.size() - 1);
    for (std::size_t face = 1; face < faces.size(); ++face)
        level.overrides[face] = one_sided;
    EXPECT_EQ(start_of(level).note, "");
    level.overrides.back().reset();
    EXPECT_THAT(start_of(level).note, HasSubstr("lifted"));
}

TEST(FindStart, WithoutFloorThereIsNone) {
    Faces walls, crumb, steep;
    add_quad(walls, {-5, 0, 0}, {5, 0, 0}, {5, 8, 0}, {-5, 8, 0});
    add_quad(walls, {0, 0, -5}, {0, 8, -5}, {0, 8, 5}, {0, 0, 5});
    crumb.push_back({{{0, 0, 0}, {0, 0, 0.001f}, {0.001f, 0, 0}}});
    add_quad(steep, {-5, 0, 0}, {-5, 10, -2}, {5, 10, -2}, {5, 0, 0});
    for (const Faces* faces : {&walls, &crumb, &steep}) {
        Level level = without_spawn(*faces);
        Result<LevelScene> scene = LevelScene::build(level);
        EXPECT_FALSE(find_open_floor(scene->at(0.0), level.movement));
        level.spawn_is_set = true;
        level.spawn = {200, 5, 200};
        const Start start = start_of(level);
        EXPECT_FALSE(start.stands);
        EXPECT_THAT(start.note, HasSubstr("no floor with room for the player"));
        EXPECT_EQ(start.position, level.spawn);
    }
}

// As many exporters leave a level: two-sided ground holds the player all the same.
TEST(FindStart, ALevelThatIsInsideOutHoldsThePlayerAndIsSaidToBe) {
    for (unsigned seed = 0; seed < 60; ++seed) {
        Draw draw(3000 + seed);
        const double half = draw.between(2, 30), y = draw.between(-20, 20);
        Faces faces;
        add_quad(faces, {-half, y, -half}, {half, y, -half}, {half, y, half}, {-half, y, half});
        Level level = without_spawn(faces);
        level.spawn_is_set = true;
        level.spawn = {500, 5, 500};
        const Start start = start_of(level);
        ASSERT_TRUE(start.stands) << seed;
        EXPECT_THAT(start.note, HasSubstr("upside down or inside out"));
        EXPECT_TRUE(after_idling(level, start.position, 30).grounded) << seed;
        // From behind, a one-sided face is air.
        level.surfaces[0].one_sided = true;
        EXPECT_FALSE(start_of(level).stands) << seed;
        // Faces that look up come first, if they are as large.
        level.surfaces[0].one_sided = false;
        const double end = 90 + 2 * half;
        add_quad(faces, {90, 0, 0}, {90, 0, 2 * half}, {end, 0, 2 * half}, {end, 0, 0});
        level.mesh = level_of(faces).mesh;
        level.overrides.resize(2);
        EXPECT_THAT(start_of(level).note, Not(HasSubstr("inside out"))) << seed;
    }
}

TEST(FindStart, ATriangleThatHoldsAPlayerDoes) {
    Faces one{{{{0, 2, 0}, {0, 2, 9}, {9, 2, 0}}}};
    const Start start = start_of(without_spawn(one));
    EXPECT_TRUE(start.stands);
    EXPECT_NEAR(start.position.y(), 2.902, 1e-6);
}

// Blender's default cube, scaled to be a floor, has its middle at the origin.
TEST(FindStart, ABodyAroundTheOriginIsAFloorAndNoRoom) {
    Draw draw(45);
    for (int i = 0; i < 60; ++i) {
        const Vec3 low = draw.in({-40, -9, -40}, {-2, -0.5, -2}), high = draw.in({2, 0.5, 2}, {40, 9, 40});
        Faces faces;
        add_box(faces, low, high);
        const Level level = without_spawn(faces);
        const Start start = start_of(level);
        EXPECT_TRUE(start.stands) << start.note;
        const PlayerState state = after_idling(level, start.position, 30);
        EXPECT_TRUE(state.grounded);
        EXPECT_GT(start.position.y(), high.y());
    }
}

TEST(FindStart, ARoomComesBeforeItsRoof) {
    for (unsigned seed = 0; seed < 40; ++seed) {
        Draw draw(seed);
        const Vec3 at = draw.in({-500, -500, -500}, {500, 500, 500});
        const Vec3 size = draw.in({6, 3, 6}, {40, 12, 40}), wall = draw.in({0.1, 0.1, 0.1}, {1, 1, 1});
        Faces faces;
        add_box(faces, at, at + size, true);
        add_box(faces, at - wall, at + size + wall);
        const Start start = start_of(without_spawn(faces));
        EXPECT_TRUE(start.stands);
        EXPECT_LT(start.position.y(), at.y() + size.y()) << seed;
        EXPECT_GT(start.position.y(), at.y()) << seed;
        EXPECT_LT(std::abs(start.position.x() - at.x() - 0.5 * size.x()), 1.5);
        EXPECT_LT(std::abs(start.position.z() - at.z() - 0.5 * size.z()), 1.5);
    }
}

TEST(FindStart, TheLargerFloorComesFirstAndHazardsNever) {
    Faces faces;
    add_quad(faces, {-1, 50, -1}, {-1, 50, 1}, {1, 50, 1}, {1, 50, -1});
    add_quad(faces, {40, 50, -10}, {40, 50, 10}, {60, 50, 10}, {60, 50, -10});
    add_quad(faces, {-200, 50, -60}, {-200, 50, 60}, {-80, 50, 60}, {-80, 50, -60});
    faces.back().painted = 7;
    Level level = without_spawn(faces);
    ASSERT_TRUE(level.surfaces[7].hazardous);
    const Start start = start_of(level);
    EXPECT_GT(start.position.x(), 40.0);
    EXPECT_THAT(start.note, HasSubstr("no spawn"));
}

TEST(FindStart, AFarSpawnIsReplacedAndABadNameIsAnError) {
    Faces faces;
    add_quad(faces, {-5, 0, -5}, {-5, 0, 5}, {5, 0, 5}, {5, 0, -5});
    Level level = level_of(faces);
    level.spawn = {1e9, 1e9, 1e9};
    level.more_spawns = {{{2, 1, 2}, 0.5, "roof"}};
    const Start far = start_of(level);
    EXPECT_TRUE(far.stands);
    EXPECT_LT(far.position.norm(), 10.0);
    EXPECT_THAT(far.note, HasSubstr("Spawn \"start\" has nothing below it"));
    const Start roof = start_of(level, "roof");
    EXPECT_EQ(roof.position, Vec3(2, 1, 2));
    EXPECT_EQ(roof.yaw, 0.5);
    EXPECT_EQ(roof.note, "");
    Result<LevelScene> scene = LevelScene::build(level);
    const Result<Start> none = find_start(level, *scene, level.movement, "cellar");
    ASSERT_FALSE(none.ok());
    EXPECT_THAT(none.error().text(), HasSubstr("\"cellar\""));
    EXPECT_THAT(none.error().text(), HasSubstr("\"start\", \"roof\""));
}

TEST(Spawns, SurviveTheFileWithTheirUnknownKeys) {
    Level level = level_of(tiles(1));
    set_spawns(level, {{{1, 2, 3}, 0.25, "door"}, {{4, 5, 6}, -1, "roof"}, {{7, 8, 9}, 0, "cellar"}});
    level.fall_limit = -12.5;
    std::string json = level_to_json(level);
    json.insert(json.find("\"name\": \"roof\""), "\"team\": \"red\", ");
    Result<LoadedLevel> loaded = level_from_json(json, "t.slipface.json", level.mesh);
    ASSERT_TRUE(loaded.ok()) << loaded.error().text();
    EXPECT_EQ(all_spawns(loaded->level), all_spawns(level));
    EXPECT_EQ(loaded->level.fall_limit, -12.5);
    EXPECT_THAT(level_to_json(loaded->level), HasSubstr("\"team\": \"red\""));

    const Result<LoadedLevel> old =
        level_from_json(R"({"slipface": 1, "spawn": {"position": [1, 2, 3], "yaw": 0.5}})", "t", level.mesh);
    ASSERT_TRUE(old.ok());
    EXPECT_EQ(all_spawns(old->level), (std::vector<Spawn>{{{1, 2, 3}, 0.5, "start"}}));
    EXPECT_FALSE(old->level.fall_limit);
    EXPECT_FALSE(level_from_json(R"({"slipface": 1})", "t", level.mesh)->level.spawn_is_set);
}

TEST(Spawns, BadOnesAreRefusedWithTheirLocation) {
    const MeshPtr mesh = mesh_of(tiles(1));
    const auto error = [&](const std::string& members) {
        const Result<LoadedLevel> loaded = level_from_json("{\"slipface\": 1, " + members + "}", "t", mesh);
        return loaded ? std::string() : loaded.error().text();
    };
    EXPECT_THAT(error(R"("spawns": [{"name": "a"}, {"name": "b"}, {"name": "a"}])"),
                HasSubstr("t:/spawns/2/name: found \"a\" a second time"));
    EXPECT_THAT(error(R"("spawn": {"name": "a"}, "spawns": [{"name": "a"}])"), HasSubstr("/spawns/0/name"));
    EXPECT_THAT(error(R"("spawns": [{"position": [0, 0, 0]}])"), HasSubstr("/spawns/0"));
    EXPECT_THAT(error(R"("spawns": [{"name": ""}])"), HasSubstr("an empty name"));
    EXPECT_THAT(error(R"("spawns": [{"name": "a", "position": [0, 1e10, 0]}])"),
                HasSubstr("/spawns/0/position"));
    EXPECT_THAT(error(R"("fall_limit": 1e300)"), HasSubstr("/fall_limit"));
    std::string many = "\"spawns\": [";
    for (int i = 0; i < 100'000; ++i)
        many += fmt::format("{}{{\"name\": \"{}\"}}", i == 0 ? "" : ",", i);
    EXPECT_THAT(error(many + "]"), HasSubstr("/spawns"));

    std::vector<Spawn> spawns{{{0, 0, 0}, 0, "a"}};
    EXPECT_EQ(spawns_problem(spawns), "");
    spawns.front().position.x() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THAT(spawns_problem(spawns), HasSubstr("The spawn \"a\" has an invalid position"));
    spawns.front() = {{0, 0, 0}, 0, "a"};
    spawns.push_back(spawns.front());
    EXPECT_THAT(spawns_problem(spawns), HasSubstr("Another spawn"));
    EXPECT_THAT(spawns_problem(std::vector<Spawn>(max_spawns + 1)), HasSubstr("at most 10000"));
    EXPECT_THAT(spawns_problem(std::vector<Spawn>(max_spawns)), Not(HasSubstr("at most 10000")));
}

TEST(Goals, SurviveTheFileWithTheirUnknownKeys) {
    Level level = level_of(tiles(1));
    Goal roof{.name = "roof",
              .position = {1, 2, 3},
              .radius = 0.5,
              .within_s = 20.0,
              .from = "door",
              .settings = {"dash=off", "jump_speed=7"}};
    Goal outside{
        .name = "outside", .kind = GoalKind::never, .position = {-4, 5, 6}, .within_s = {}, .from = {}};
    level.goals = {roof, outside};
    std::string json = level_to_json(level);
    json.insert(json.find("\"name\": \"outside\""), "\"colour\": \"red\", ");
    const Result<LoadedLevel> loaded = level_from_json(json, "t.slipface.json", level.mesh);
    ASSERT_TRUE(loaded.ok()) << loaded.error().text();
    EXPECT_EQ(loaded->level.goals, level.goals);
    EXPECT_THAT(level_to_json(loaded->level), HasSubstr("\"colour\": \"red\""));
    level.goals.clear();
    EXPECT_THAT(level_to_json(level), testing::Not(HasSubstr("goals")));
}

TEST(Goals, BadOnesAreRefusedWithTheirLocation) {
    const MeshPtr mesh = mesh_of(tiles(1));
    const auto error = [&](const std::string& goal) {
        const std::string json =
            R"({"slipface": 1, "goals": [{"name": "a", "position": [0, 0, 0]}, {)" + goal;
        const Result<LoadedLevel> loaded = level_from_json(json + "}]}", "t", mesh);
        return loaded ? std::string() : loaded.error().text();
    };
    EXPECT_EQ(error(R"("name": "b", "position": [0, 0, 0])"), "");
    EXPECT_THAT(error(R"("position": [0, 0, 0])"), HasSubstr("/goals/1"));
    EXPECT_THAT(error(R"("name": "b")"), HasSubstr("/goals/1"));
    EXPECT_THAT(error(R"("name": "", "position": [0, 0, 0])"), HasSubstr("an empty name"));
    EXPECT_THAT(error(R"("name": "a", "position": [0, 0, 0])"), HasSubstr("\"a\" a second time"));
    EXPECT_THAT(error(R"("name": "b", "position": [0, 1e10, 0])"), HasSubstr("/goals/1/position"));
    EXPECT_THAT(error(R"("name": "b", "position": [0, 0, 0], "kind": "always")"),
                HasSubstr("found \"always\", expected one of reach, never"));
    EXPECT_THAT(error(R"("name": "b", "position": [0, 0, 0], "radius": 0)"), HasSubstr("/goals/1/radius"));
    EXPECT_THAT(error(R"("name": "b", "position": [0, 0, 0], "kind": "never", "within_s": 3)"),
                HasSubstr("/goals/1/within_s"));
    EXPECT_THAT(error(R"("name": "b", "position": [0, 0, 0], "settings": ["air_jump=on", "dash=maybe"])"),
                AllOf(HasSubstr("/goals/1/settings/1"), HasSubstr("expected on or off")));
}

}  // namespace
}  // namespace slipface::test
