// The world: what is ticked and drawn, when, and which managers are notified.
#include <gmock/gmock.h>

#include <functional>

#include "slipface/mesh/build.h"
#include "slipface/world/geometric_manager.h"

namespace slipface::test {
namespace {

using testing::ElementsAre;

using Diary = std::vector<std::string>;

class CountingGraphics final : public Graphics {
  public:
    void draw_level(const Level& drawn, double time_s) override {
        levels.push_back(&drawn);
        last_time_s = time_s;
    }
    void draw_mesh(const MeshPtr& mesh, const Placement& at, const std::filesystem::path& folder,
                   const MeshLook& look) override {
        meshes.push_back(mesh);
        places.push_back(at);
        files = {folder.generic_string(), look.texture.generic_string()};
    }
    void draw_ellipsoid(const Vec3& centre, const Vec3& radii) override {
        centres.push_back(centre);
        last_radii = radii;
    }
    std::vector<const Level*> levels;
    std::vector<MeshPtr> meshes;
    std::vector<Placement> places;
    std::vector<std::string> files;  // of the last mesh: folder, texture
    double last_time_s = -1.0;
    std::vector<Vec3> centres;
    Vec3 last_radii = Vec3::Zero();
};

class NamedEntity : public Entity {
  public:
    NamedEntity(Diary& diary_, std::string name_) : diary(diary_), name(std::move(name_)) {}
    ~NamedEntity() override { diary.push_back("end " + name); }
    void on_tick(double) override {
        diary.push_back("tick " + name);
        if (action) action();
    }
    void on_draw(Graphics&) const override { diary.push_back("draw " + name); }
    Diary& diary;
    std::string name;
    std::function<void()> action;
};

class NamedManager : public Manager {
  public:
    NamedManager(Diary& diary, std::string name) : diary_(diary), name_(std::move(name)) {}
    void on_tick(double) override { diary_.push_back("tick " + name_); }
    void on_draw(Graphics&) override { diary_.push_back("draw " + name_); }
    void on_entity_added(Entity& entity) override { describe(" gets ", entity); }
    void on_entity_removed(Entity& entity) override { describe(" loses ", entity); }

  private:
    void describe(const char* what, Entity& entity) {
        diary_.push_back(name_ + what + dynamic_cast<NamedEntity&>(entity).name);
    }
    Diary& diary_;
    std::string name_;
};

TEST(World, TicksAndDrawsInOrderEntitiesFirst) {
    Diary diary;
    World world;
    world.make_manager<NamedManager>(diary, "M");
    world.make_entity<NamedEntity>(diary, "a");
    world.make_entity<NamedEntity>(diary, "b");
    world.make_manager<NamedManager>(diary, "N");
    diary.clear();
    world.tick(0.1);
    EXPECT_THAT(diary, ElementsAre("tick a", "tick b", "tick M", "tick N"));
    diary.clear();
    CountingGraphics graphics;
    world.draw(graphics);
    EXPECT_THAT(diary, ElementsAre("draw a", "draw b", "draw M", "draw N"));
    diary.clear();
}

TEST(World, TellsManagersOfEntitiesWhicheverCameFirst) {
    Diary diary;
    World world;
    Entity& a = world.make_entity<NamedEntity>(diary, "a");
    world.make_manager<NamedManager>(diary, "M");
    world.make_entity<NamedEntity>(diary, "b");
    world.remove_entity(a);
    EXPECT_THAT(diary, ElementsAre("M gets a", "M gets b", "M loses a", "end a"));
    EXPECT_EQ(world.entity_count(), 1u);
}

TEST(World, LeavesEntitiesOfOthersAlone) {
    Diary diary;
    World world;
    World other;
    Entity& a = other.make_entity<NamedEntity>(diary, "a");
    world.remove_entity(a);
    EXPECT_EQ(other.entity_count(), 1u);
    EXPECT_TRUE(diary.empty());
}

TEST(World, AnEntityMayRemoveItselfAndOthersWhileTicked) {
    Diary diary;
    World world;
    world.make_manager<NamedManager>(diary, "M");
    auto& a = world.make_entity<NamedEntity>(diary, "a");
    auto& b = world.make_entity<NamedEntity>(diary, "b");
    world.make_entity<NamedEntity>(diary, "c");
    a.action = [&] {
        world.remove_entity(b);
        world.remove_entity(a);
        world.remove_entity(a);
        EXPECT_EQ(world.entity_count(), 1u);
    };
    diary.clear();
    world.tick(0.1);
    EXPECT_THAT(diary, ElementsAre("tick a", "M loses b", "M loses a", "tick c", "tick M", "end a", "end b"));
    EXPECT_EQ(world.entity_count(), 1u);
    diary.clear();
}

TEST(World, AnEntityMayAddOthersWhileTicked) {
    Diary diary;
    World world;
    auto& a = world.make_entity<NamedEntity>(diary, "a");
    a.action = [&] {
        // Many, so that the list must grow while it is walked.
        if (world.entity_count() == 1) {
            for (int i = 0; i < 100; ++i)
                world.make_entity<NamedEntity>(diary, "x");
        }
    };
    world.tick(0.1);
    EXPECT_EQ(world.entity_count(), 101u);
    EXPECT_EQ(std::count(diary.begin(), diary.end(), "tick x"), 100);
    diary.clear();
}

Level floor_level() {
    PolygonSoup soup;
    soup.corner_position = {Vec3f(-50, 0, -50), Vec3f(-50, 0, 50), Vec3f(50, 0, 50), Vec3f(50, 0, -50)};
    soup.face_first_corner = {0, 4};
    Result<MeshPtr> mesh = build_mesh(std::move(soup));
    EXPECT_TRUE(mesh.ok());
    Level level;
    level.mesh = *mesh;
    return level;
}

GeometricManager& add_floor(World& world) {
    Result<std::unique_ptr<GeometricManager>> manager = GeometricManager::make(floor_level());
    EXPECT_TRUE(manager.ok());
    return static_cast<GeometricManager&>(world.add_manager(std::move(*manager)));
}

TEST(GeometricManager, MovesEachCharacterAsStepDoes) {
    World world;
    GeometricManager& geometry = add_floor(world);
    auto& walker = world.make_entity<Character>();
    auto& idler = world.make_entity<Character>();
    walker.state.position = Vec3(0, 1, 0);
    idler.state.position = Vec3(5, 1, 0);
    walker.input.wish = Vec2(0, -1);

    PlayerState expected = walker.state;
    const MovementScene scene{geometry.collision(), geometry.level().surfaces};
    for (int i = 0; i < 60; ++i) {
        world.tick(1.0 / 60);
        expected = step(scene, walker.settings, expected, walker.input, 1.0 / 60).state;
        ASSERT_EQ(walker.state, expected);
    }
    EXPECT_LT(walker.state.position.z(), -4.0);
    EXPECT_TRUE(idler.state.grounded);
    // On the floor at the ellipsoid's half height of 0.9 and the skin of 0.002.
    EXPECT_NEAR(idler.state.position.y(), 0.902, 0.002);
}

TEST(GeometricManager, CharactersPushEachOtherUnlessTheyAreToldNotTo) {
    for (const bool meets : {true, false}) {
        World world;
        add_floor(world);
        auto& walker = world.make_entity<Character>();
        auto& idler = world.make_entity<Character>();
        walker.state.position = Vec3(0, 0.902, 0);
        idler.state.position = Vec3(0, 0.902, -2);
        walker.input.wish = Vec2(0, -1);
        walker.meets_others = meets;
        for (int i = 0; i < 60; ++i)
            world.tick(1.0 / 60);
        EXPECT_EQ(idler.state.position.z() < -2.5, meets);
        EXPECT_EQ(walker.state.position.z() < idler.state.position.z(), !meets);
    }
}

TEST(GeometricManager, DrawsAMeshForEachPropAndCollidesWithIt) {
    Level level = floor_level();
    level.mesh_path = "yard/yard.obj";
    PolygonSoup soup;
    soup.corner_position = {Vec3f(-1, 0, -1), Vec3f(-1, 0, 1), Vec3f(1, 0, 1), Vec3f(1, 0, -1)};
    soup.face_first_corner = {0, 4};
    const MeshPtr tile = build_mesh(std::move(soup)).value();
    const std::vector<std::array<std::uint32_t, 3>> triangles{{0, 1, 2}, {0, 2, 3}};
    const std::vector<FaceId> faces{0, 0};
    level.placed.meshes = {
        {"parts/tile.obj", tile, CollisionMesh::build({tile->positions, triangles, faces}).value(), ""}};
    level.props.resize(2);
    for (Prop& prop : level.props)
        prop.mesh = "parts/tile.obj";
    level.props[0].name = "step";
    level.props[0].position = Vec3(0, 0.5, 0);
    level.props[1].name = "lift";
    level.props[1].texture = "parts/iron.png";
    level.platforms = {{.name = "lift", .group = "lift", .path = {{}, {.offset = Vec3(0, 2, 0)}}}};
    ASSERT_TRUE(place_props(level).empty());

    World world;
    auto manager = GeometricManager::make(std::move(level));
    ASSERT_TRUE(manager.ok());
    world.add_manager(std::move(*manager));
    auto& walker = world.make_entity<Character>();
    walker.state.position = Vec3(0, 3, 0);
    for (int i = 0; i < 30; ++i)
        world.tick(1.0 / 60);
    CountingGraphics graphics;
    world.draw(graphics);
    ASSERT_EQ(graphics.levels.size(), 1U);
    EXPECT_EQ(graphics.levels[0]->mesh->face_count(), 1U) << "the props are drawn once";
    ASSERT_EQ(graphics.meshes.size(), 2U);
    EXPECT_EQ(graphics.meshes[0], tile);
    EXPECT_EQ(graphics.places[0].offset, Vec3(0, 0.5, 0));
    EXPECT_NEAR(graphics.places[1].offset.y(), 1.0, 1e-9);  // half a second at 2 m/s
    EXPECT_EQ(graphics.meshes[1]->materials.front().texture, "parts/iron.png");
    EXPECT_THAT(graphics.files, ElementsAre("yard", ""));
    EXPECT_GT(walker.state.position.y(), 1.0 + 0.9) << "on the lift";
}

// Leaves in its first tick, before the manager's, and is destroyed after both.
class LeavingCharacter : public Character {
  public:
    LeavingCharacter(World& world, Vec3& last_position) : world_(world), last_position_(last_position) {}
    ~LeavingCharacter() override { last_position_ = state.position; }
    void on_tick(double) override { world_.remove_entity(*this); }

  private:
    World& world_;
    Vec3& last_position_;
};

TEST(GeometricManager, ARemovedCharacterStandsStill) {
    World world;
    add_floor(world);
    Vec3 last_position = Vec3::Zero();
    auto& stays = world.make_entity<Character>();
    auto& leaves = world.make_entity<LeavingCharacter>(world, last_position);
    stays.state.position = leaves.state.position = Vec3(0, 10, 0);
    world.tick(1.0 / 60);
    EXPECT_LT(stays.state.position.y(), 10.0);
    EXPECT_EQ(world.entity_count(), 1u);
    EXPECT_EQ(last_position, Vec3(0, 10, 0));
}

TEST(GeometricManager, DrawsItsLevelOnceAsItIsNowAndEachCharacter) {
    World world;
    const GeometricManager& geometry = add_floor(world);
    auto& character = world.make_entity<Character>();
    character.state.position = Vec3(1, 2, 3);
    character.settings.radii = Vec3(0.5, 1, 0.5);
    CountingGraphics graphics;
    world.draw(graphics);
    EXPECT_THAT(graphics.levels, ElementsAre(&geometry.level()));
    EXPECT_EQ(graphics.last_time_s, 0.0);
    ASSERT_EQ(graphics.centres.size(), 1u);
    EXPECT_EQ(graphics.centres[0], Vec3(1, 2, 3));
    EXPECT_EQ(graphics.last_radii, Vec3(0.5, 1, 0.5));
    world.tick(0.25);
    world.draw(graphics);
    EXPECT_EQ(graphics.last_time_s, 0.25);
}

// The level is drawn in its own coordinates, so its characters are too, wherever in the world it is placed:
// 100 km out with sectors, whose numbers hold most of it, and without, where the state holds all of it.
TEST(GeometricManager, DrawsCharactersWhereTheLevelHasThem) {
    for (const bool sectors : {true, false}) {
        SCOPED_TRACE(sectors);
        Level level = floor_level();
        level.sectors = {.size = 64.0, .placement = Vec3(1e5, 0, -1e5)};
        level.movement.sectors = sectors;
        Result<std::unique_ptr<GeometricManager>> manager = GeometricManager::make(std::move(level));
        ASSERT_TRUE(manager.ok()) << manager.error().text();
        World world;
        auto& geometry = static_cast<GeometricManager&>(world.add_manager(std::move(*manager)));
        auto& character = world.make_entity<Character>();
        character.state = geometry.player_at(Vec3(-40, 2, 3));
        CountingGraphics graphics;
        world.draw(graphics);
        ASSERT_EQ(graphics.centres.size(), 1u);
        EXPECT_NE(character.state.position, Vec3(-40, 2, 3));
        EXPECT_LT((graphics.centres[0] - Vec3(-40, 2, 3)).norm(), 1e-9);
        EXPECT_EQ(character.position(), graphics.centres[0]);
    }
}

TEST(GeometricManager, ACharacterOfNoLevelIsDrawnWhereItsStateIs) {
    World world;
    world.make_entity<Character>().state.position = Vec3(4, 5, 6);
    CountingGraphics graphics;
    world.draw(graphics);
    EXPECT_THAT(graphics.centres, ElementsAre(Vec3(4, 5, 6)));
    EXPECT_TRUE(graphics.levels.empty());
}

TEST(GeometricManager, RefusesALevelWithoutGeometry) {
    EXPECT_FALSE(GeometricManager::make(Level{}).ok());
}

}  // namespace
}  // namespace slipface::test
