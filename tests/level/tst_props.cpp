// Props: in the level file, as part of the geometry, and in every query that a level answers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "scratch_folder.h"
#include "slipface/level/level_file.h"
#include "slipface/level/level_scene.h"
#include "slipface/level/shown_mesh.h"

namespace slipface {
namespace {

using testing::HasSubstr;

constexpr const char* floor_obj =
    "v -9 0 -9\nv -9 0 9\nv 9 0 9\nv 9 0 -9\no floor\nusemtl stone\nf 1 2 3 4\n";
// A wedge: no symmetry hides a wrong turn. Its slope is of the material "ice ramp".
constexpr const char* wedge_obj =
    "v 0 0 0\nv 2 0 0\nv 2 0 1\nv 0 0 1\nv 0 1 0\nv 0 1 1\no wedge\nusemtl side\n"
    "f 1 2 3 4\nf 1 4 6 5\nf 1 5 2\nf 4 3 6\nusemtl ice ramp\nf 2 5 6 3\n";

class Props : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = test::make_scratch_folder();
        std::filesystem::create_directories(folder_ / "parts");
        put("floor.obj", floor_obj);
        put("parts/wedge.obj", wedge_obj);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }
    void put(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
    }
    Result<LoadedLevel> load(const std::string& members) const {
        put("floor.slipface.json", "{\"slipface\": 1, \"mesh\": \"floor.obj\", " + members + "}");
        return load_level(folder_ / "floor.obj");
    }
    std::string error(const std::string& members) const {
        const Result<LoadedLevel> loaded = load(members);
        return loaded ? "" : loaded.error().text();
    }
    std::filesystem::path folder_;
};

constexpr const char* two = R"("rules": [{"pattern": "ice*", "type": "ice"}],
  "props": [
    {"name": "ramp", "mesh": "parts/wedge.obj", "position": [1, 0, 2], "rotation": [0, 1.5707963267948966, 0],
     "scale": [1, 2, 1], "later": {"a": 1}},
    {"name": "mirrored", "mesh": "parts/wedge.obj", "scale": [-1, 1, 1], "texture": "x.png", "type": "sticky"}])";

TEST_F(Props, AreReadOnceAndWrittenAsTheyWere) {
    const Result<LoadedLevel> loaded = load(two);
    ASSERT_TRUE(loaded.ok()) << loaded.error().text();
    const Level& level = loaded->level;
    ASSERT_EQ(level.props.size(), 2U);
    ASSERT_EQ(level.placed.meshes.size(), 1U);
    EXPECT_EQ(level.placed.first_face, (std::vector<FaceId>{1, 6, 11}));
    EXPECT_EQ(level.placed.prop_of(0), no_id);
    EXPECT_EQ(level.placed.prop_of(5), 0U);
    EXPECT_EQ(level.placed.prop_of(6), 1U);
    EXPECT_EQ(level.placed.prop_of(11), no_id);
    EXPECT_EQ(level.mesh->face_count(), 11U);
    EXPECT_EQ(own_mesh(level)->face_count(), 1U);
    EXPECT_EQ(level.mesh->groups.back(), "mirrored");
    EXPECT_EQ(level.mesh->materials.back().texture, "x.png");
    EXPECT_EQ(level.mesh->materials.back().name, "ice ramp.001");  // another look than that of "ramp"
    const std::string text = level_to_json(level);
    EXPECT_THAT(text, HasSubstr("\"later\": {\n"));
    const auto again = level_from_json(text, level.file_path.string(), level);
    ASSERT_TRUE(again.ok()) << again.error().text();
    EXPECT_EQ(again->level.props, level.props);
    EXPECT_EQ(again->level.placed.meshes[0].mesh, level.placed.meshes[0].mesh);
    EXPECT_EQ(level_to_json(again->level), text);
}

TEST_F(Props, StandWhereTheyArePlacedAndFaceOutwards) {
    const Result<LoadedLevel> loaded = load(two);
    ASSERT_TRUE(loaded.ok());
    const Level& level = loaded->level;
    // A quarter turn about y takes +x to -z: the wedge's tip at (2, 0, 0) comes to (1, 0, 2 - 2).
    const auto closest = closest_point(build_collision_world(level).value(), {1, 0, -0.5});
    ASSERT_TRUE(closest.has_value());
    EXPECT_EQ(closest->face, 0U);  // the floor is nearer than the tip
    Aabb box;
    for (std::uint32_t c = level.mesh->face_first_corner[1]; c < level.mesh->face_first_corner[6]; ++c)
        box.add(level.mesh->corner_position(c).cast<double>());
    EXPECT_TRUE(box.min.isApprox(Vec3(1, 0, 0), 1e-6) || (box.min - Vec3(1, 0, 0)).norm() < 1e-6);
    EXPECT_LT((box.max - Vec3(2, 2, 2)).norm(), 1e-6);
    for (const std::size_t prop : {0U, 1U}) {
        Vec3 middle = Vec3::Zero();
        for (FaceId face = level.placed.first_face[prop]; face < level.placed.first_face[prop + 1]; ++face)
            middle += face_centroid(*level.mesh, face) / 5.0;
        for (FaceId face = level.placed.first_face[prop]; face < level.placed.first_face[prop + 1]; ++face)
            EXPECT_GT(face_normal(*level.mesh, face).dot(face_centroid(*level.mesh, face) - middle), 0.0)
                << face;
    }
}

TEST_F(Props, TakeTheirTypesFromPaintThenThemselvesThenTheirMaterials) {
    Result<LoadedLevel> loaded = load(two);
    ASSERT_TRUE(loaded.ok());
    Level& level = loaded->level;
    level.overrides.resize(8);
    level.overrides[7] = *find_surface(level, "ladder");
    const ResolvedSurfaces resolved = resolve_surfaces(level);
    const auto name = [&](FaceId face) { return level.surfaces[resolved.surface[face]].name; };
    EXPECT_EQ(name(1), "default");
    EXPECT_EQ(name(5), "ice");
    EXPECT_EQ(name(10), "sticky");
    EXPECT_EQ(name(7), "ladder");
    EXPECT_EQ(resolved.source[10], SurfaceSource::prop);
    // Paint of props is found again like all paint.
    const auto again = level_from_json(level_to_json(level), level.file_path.string(), level);
    ASSERT_TRUE(again.ok());
    EXPECT_EQ(again->level.overrides, level.overrides);
    const Level flat = with_flat_props(level);
    EXPECT_TRUE(flat.props.empty());
    EXPECT_EQ(resolve_surfaces(flat).surface, resolved.surface);
    EXPECT_EQ(without_props(level).mesh->face_count(), 1U);
}

TEST_F(Props, CollideAsTheirFacesDo) {
    const Result<LoadedLevel> loaded = load(two);
    ASSERT_TRUE(loaded.ok());
    const Level& level = loaded->level;
    Level flat = with_flat_props(level);
    ASSERT_TRUE(has_instances(level));
    ASSERT_FALSE(has_instances(flat));
    const CollisionWorld a = build_collision_world(level).value(), b = build_collision_world(flat).value();
    int hits = 0;
    for (int i = 0; i < 400; ++i) {
        const Vec3 from(-3 + 0.02 * i, 2.5, -2 + 0.01 * i), move(0.3, -3, 0.2);
        const auto x = sweep_ellipsoid(a, {0.3, 0.5, 0.3}, from, move);
        const auto y = sweep_ellipsoid(b, {0.3, 0.5, 0.3}, from, move);
        ASSERT_EQ(x.has_value(), y.has_value());
        if (!x) continue;
        ASSERT_TRUE(x->t == y->t && x->point == y->point && x->normal == y->normal);
        ASSERT_TRUE(x->triangle == y->triangle && x->face == y->face && x->surface == y->surface);
        hits += x->face > 0;
    }
    EXPECT_GT(hits, 50);
}

// What a level says without its whole mesh is what the whole mesh says.
TEST_F(Props, SayTheSameAsTheirWholeMesh) {
    const Result<LoadedLevel> loaded = load(two);
    ASSERT_TRUE(loaded.ok());
    const LevelMesh& mesh = loaded->level.mesh;
    const Aabb box = mesh.bounds();
    EXPECT_EQ(mesh.face_count(), mesh->face_count());
    EXPECT_EQ(mesh.triangle_count(), mesh->triangle_count());
    EXPECT_EQ(mesh.fingerprint(), mesh->fingerprint);
    EXPECT_EQ(box.min, mesh->bounds.min);
    EXPECT_EQ(box.max, mesh->bounds.max);
    for (FaceId face = 0; face < mesh.face_count(); ++face) {
        EXPECT_EQ(mesh.group_of(face), mesh->groups[mesh->face_group[face]]);
        EXPECT_THAT(mesh->materials[mesh->face_material[face]].name,
                    testing::StartsWith(mesh.material_of(face)));
    }
    for (const std::size_t prop : {0U, 1U}) {
        const MeshPtr alone = prop_mesh(loaded->level, prop);
        const FaceId first = loaded->level.placed.first_face[prop];
        ASSERT_EQ(alone->face_count(), 5U);
        for (FaceId face = 0; face < 5; ++face)
            EXPECT_EQ(face_centroid(*alone, face), face_centroid(*mesh, first + face));
        EXPECT_EQ(prop_first_triangle(loaded->level, prop), mesh->face_first_triangle[first]);
        EXPECT_EQ(prop_bounds(loaded->level, prop).min, alone->bounds.min);
    }
    Level other = loaded->level;
    other.props[1].position.x() += 1;
    (void)place_props(other);
    EXPECT_NE(other.mesh.fingerprint(), mesh.fingerprint());
    EXPECT_NE(other.mesh, mesh);
    other.props[1].position.x() -= 1;
    (void)place_props(other);
    EXPECT_EQ(other.mesh.fingerprint(), mesh.fingerprint());
    EXPECT_EQ(other.mesh.bounds().max, box.max);
}

TEST_F(Props, ArePlatformsByTheirNames) {
    const Result<LoadedLevel> loaded = load(
        std::string(two) +
        R"(, "platforms": [{"name": "lift", "group": "ramp", "path": [{"offset": [0, 0, 0]}, {"offset": [0, 3, 0]}]}])");
    ASSERT_TRUE(loaded.ok());
    EXPECT_EQ(loaded->warnings.size(), 1U) << "the unknown key; the platform's group is found";
    auto scene = LevelScene::build(loaded->level);
    ASSERT_TRUE(scene.ok());
    EXPECT_FALSE(scene->is_static());
    const MovementScene at = scene->at(1.0, 1.0 / 60);
    EXPECT_EQ(at.collision.triangle_count(), 2U + 8U);
    ASSERT_EQ(at.triangles.size(), 10U);
    for (TriangleId i = 0; i < 10; ++i)  // the static triangles' numbers in the mesh
        EXPECT_EQ(loaded->level.mesh->triangle_face[at.triangles[i]], at.collision.triangle_face(i));
    EXPECT_GT(at.platforms[0].velocity.y(), 1.9);
}

TEST_F(Props, ThatAreMissingStayInTheListAndSayWhy) {
    put("parts/broken.obj", "f 1 2 3\n");
    const Result<LoadedLevel> loaded = load(R"("props": [
        {"name": "a", "mesh": "nowhere.obj"}, {"name": "b", "mesh": "../outside.obj"},
        {"name": "c", "mesh": "/etc/passwd"}, {"name": "d", "mesh": "parts/broken.obj"},
        {"name": "e", "mesh": "parts/wedge.obj", "type": "gravel"}])");
    ASSERT_TRUE(loaded.ok()) << loaded.error().text();
    ASSERT_EQ(loaded->level.props.size(), 5U);
    EXPECT_EQ(loaded->level.mesh->face_count(), 6U);
    std::string all;
    for (const Diagnostic& warning : loaded->warnings)
        all += warning.text() + "\n";
    EXPECT_THAT(all, HasSubstr("\"nowhere.obj\": there is no such file"));
    EXPECT_THAT(all, HasSubstr("\"../outside.obj\": lies outside the level's folder"));
    EXPECT_THAT(all, HasSubstr("\"/etc/passwd\": lies outside the level's folder"));
    EXPECT_THAT(all, HasSubstr("broken.obj:1"));
    EXPECT_THAT(all, HasSubstr("found no surface type \"gravel\""));
}

TEST_F(Props, RefuseWhatNoPropCanBe) {
    const auto of = [&](const std::string& prop) { return error("\"props\": [" + prop + "]"); };
    EXPECT_EQ(of(R"({"name": "a", "mesh": "parts/wedge.obj"})"), "");
    EXPECT_THAT(of(R"({"mesh": "x.obj"})"), HasSubstr("/props/0"));
    EXPECT_THAT(of(R"({"name": "", "mesh": "x.obj"})"), HasSubstr("an empty name"));
    EXPECT_THAT(of(R"({"name": "a"})"), HasSubstr("/props/0"));
    EXPECT_THAT(of(R"({"name": "a", "mesh": ""})"), HasSubstr("a geometry file"));
    EXPECT_THAT(of(R"({"name": "a", "mesh": "x.obj", "scale": [0, 1, 1]})"), HasSubstr("/props/0/scale"));
    EXPECT_THAT(of(R"({"name": "a", "mesh": "x.obj", "scale": [1e9, 1, 1]})"), HasSubstr("/props/0/scale"));
    EXPECT_THAT(of(R"({"name": "a", "mesh": "x.obj", "position": [1e300, 1, 1]})"), HasSubstr("/position"));
    EXPECT_THAT(of(R"({"name": "a", "mesh": "x.obj", "rotation": [1, 1]})"), HasSubstr("/rotation"));
    EXPECT_THAT(of(R"({"name": "a", "mesh": "x.obj"}, {"name": "a", "mesh": "x.obj"})"),
                HasSubstr("a second time"));
    EXPECT_THAT(error("\"props\": {}"), HasSubstr("/props"));
}

TEST_F(Props, FollowAnObjThatChanged) {
    const Result<LoadedLevel> loaded = load(two);
    ASSERT_TRUE(loaded.ok());
    Level level = loaded->level;
    level.overrides.resize(9);
    level.overrides[8] = SurfaceId{2};
    put("floor.obj", std::string(floor_obj) + "v 0 5 0\nv 1 5 0\nv 0 5 1\nf 5 6 7\n");
    const Result<LoadedLevel> again = reload_mesh(level);
    ASSERT_TRUE(again.ok());
    EXPECT_EQ(own_mesh(again->level)->face_count(), 2U);
    EXPECT_EQ(again->level.mesh->face_count(), 12U);
    EXPECT_EQ(again->level.overrides[9], SurfaceId{2});
}

}  // namespace
}  // namespace slipface
