// Levels on disk.
#include <gmock/gmock.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "level/faces.h"
#include "mesh/bsp_maker.h"
#include "scratch_folder.h"

namespace slipface::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class LevelFile : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = test::make_scratch_folder();
        write("easy.obj",
              "v 0 0 0\nv 0 0 1\nv 1 0 1\nv 1 0 0\nv 0 2 0\nv 0 2 1\nusemtl stone\nf 1 2 3 4\nusemtl wall\nf "
              "1 5 6 2\n");
    }
    void TearDown() override { fs::remove_all(folder_); }

    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
    }
    std::string read(const std::string& name) const {
        std::ifstream file(folder_ / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    LoadedLevel load(const std::string& name) const {
        Result<LoadedLevel> loaded = load_level(folder_ / name);
        if (!loaded) {
            ADD_FAILURE() << loaded.error().text();
            return {};
        }
        return std::move(*loaded);
    }
    Error error_of(const std::string& name) const {
        const Result<LoadedLevel> loaded = load_level(folder_ / name);
        if (loaded) {
            ADD_FAILURE() << name << " was opened";
            return {};
        }
        return loaded.error();
    }

    fs::path folder_;
};

TEST_F(LevelFile, WarningsOfItsMeshAreItsOwn) {
    write("odd.obj", "mtllib gone.mtl\nv 0 0 0\nv 0 0 1\nv 1 0 1\nf 1 2 3\n");
    const LoadedLevel odd = load("odd.obj");
    ASSERT_EQ(odd.warnings.size(), 1U);
    EXPECT_THAT(odd.warnings[0].text(), HasSubstr("gone.mtl"));
    EXPECT_TRUE(load("easy.obj").warnings.empty());
}

TEST_F(LevelFile, LiesBesideItsMesh) {
    EXPECT_EQ(level_file_for("a/b.obj"), fs::path("a/b.slipface.json"));
    EXPECT_EQ(level_file_for("b.v2.obj"), fs::path("b.v2.slipface.json"));
}

TEST_F(LevelFile, AMeshWithoutOneHasTheDefaults) {
    const LoadedLevel loaded = load("easy.obj");
    EXPECT_EQ(loaded.level.mesh->face_count(), 2u);
    EXPECT_EQ(loaded.level.surfaces, preset_surface_types());
    EXPECT_EQ(loaded.level.movement, MovementSettings{});
    EXPECT_EQ(loaded.level.overrides.size(), 2u);
    EXPECT_EQ(loaded.level.mesh_path, folder_ / "easy.obj");
    EXPECT_EQ(loaded.level.file_path, folder_ / "easy.slipface.json");
    EXPECT_GT(loaded.mesh_load_s, 0.0);
    EXPECT_FALSE(fs::exists(folder_ / "easy.slipface.json"));
}

TEST_F(LevelFile, WhatIsSavedIsLoadedFromEitherFile) {
    Level level = load("easy.obj").level;
    level.overrides[1] = SurfaceId{2};
    level.spawn = Vec3(1, 2, 3);
    level.rules = {{"st*", "ice"}};
    ASSERT_TRUE(save_level(level).ok());
    for (const char* name : {"easy.obj", "easy.slipface.json"}) {
        const LoadedLevel loaded = load(name);
        EXPECT_EQ(loaded.level.overrides, level.overrides);
        EXPECT_EQ(loaded.level.spawn, level.spawn);
        EXPECT_EQ(loaded.level.rules, level.rules);
        EXPECT_EQ(loaded.level.mesh_path, folder_ / "easy.obj");
        EXPECT_EQ(loaded.level.file_path, folder_ / "easy.slipface.json");
        EXPECT_EQ(loaded.match.text(), "1 exact, 0 by plane, 0 orphaned");
    }
    EXPECT_THAT(read("easy.slipface.json"), HasSubstr("\"mesh\": \"easy.obj\""));
}

TEST_F(LevelFile, SavedElsewhereItStillFindsItsMesh) {
    Level level = load("easy.obj").level;
    level.overrides[0] = SurfaceId{1};
    fs::create_directories(folder_ / "a/b");
    // Beside the mesh's folder's parent the name is relative; in another folder it is absolute, for ".." may
    // not be followed.
    ASSERT_TRUE(save_level(level, folder_ / "variant.slipface.json").ok());
    ASSERT_TRUE(save_level(level, folder_ / "a/b/copy.slipface.json").ok());
    EXPECT_THAT(read("variant.slipface.json"), HasSubstr("\"mesh\": \"easy.obj\""));
    EXPECT_THAT(read("a/b/copy.slipface.json"), HasSubstr(folder_.string() + "/easy.obj"));
    for (const char* name : {"variant.slipface.json", "a/b/copy.slipface.json"}) {
        const LoadedLevel loaded = load(name);
        EXPECT_EQ(loaded.level.overrides, level.overrides);
        EXPECT_EQ(loaded.level.file_path, folder_ / name);
        EXPECT_TRUE(fs::equivalent(loaded.level.mesh_path, folder_ / "easy.obj"));
    }
}

TEST_F(LevelFile, AMissingMeshIsAnErrorThatNamesBothFiles) {
    write("x.slipface.json", "{\"slipface\": 1, \"mesh\": \"gone.obj\"}");
    const Error error = error_of("x.slipface.json");
    EXPECT_THAT(error.location, HasSubstr("x.slipface.json:/mesh"));
    EXPECT_THAT(error.message, HasSubstr("gone.obj"));
}

TEST_F(LevelFile, AMeshOutsideTheFolderIsRefused) {
    for (const char* name : {"../easy.obj", "a/../../easy.obj"}) {
        write("x.slipface.json", std::string("{\"slipface\": 1, \"mesh\": \"") + name + "\"}");
        EXPECT_THAT(error_of("x.slipface.json").message, HasSubstr("inside the level's folder"));
    }
    write("x.slipface.json", "{\"slipface\": 1, \"mesh\": \"a/../easy.obj\"}");
    EXPECT_EQ(load("x.slipface.json").level.mesh->face_count(), 2u);
}

TEST_F(LevelFile, NoMeshIsAnError) {
    for (const char* json :
         {"{\"slipface\": 1}", "{\"slipface\": 1, \"mesh\": \"\"}", "{\"slipface\": 1, \"mesh\": 7}"}) {
        write("x.slipface.json", json);
        EXPECT_THAT(error_of("x.slipface.json").location, HasSubstr("x.slipface.json:/mesh"));
    }
}

// What another version says of its mesh may mean something else, or be missing.
TEST_F(LevelFile, TheVersionIsLookedAtBeforeTheMesh) {
    for (const char* json : {"{\"slipface\": 99}", "{\"slipface\": 99, \"mesh\": \"gone.obj\"}"}) {
        write("x.slipface.json", json);
        const Error error = error_of("x.slipface.json");
        EXPECT_THAT(error.location, HasSubstr("x.slipface.json:/slipface"));
        EXPECT_THAT(error.message, HasSubstr("99"));
    }
    write("x.slipface.json", "[]");
    EXPECT_THAT(error_of("x.slipface.json").message, HasSubstr("expected an object"));
}

TEST_F(LevelFile, AnotherMeshesLevelFileBesideAMeshIsAWarning) {
    write("easy.slipface.json", "{\"slipface\": 1, \"mesh\": \"other.obj\"}");
    const LoadedLevel loaded = load("easy.obj");
    ASSERT_FALSE(loaded.warnings.empty());
    bool explained = false;
    for (const Diagnostic& warning : loaded.warnings)
        explained |= warning.message.find("other.obj") != std::string::npos;
    EXPECT_TRUE(explained);
    EXPECT_EQ(loaded.level.mesh_path, folder_ / "easy.obj");
}

TEST_F(LevelFile, ABrokenLevelFileIsAnErrorAndStaysAsItIs) {
    write("easy.slipface.json", "{\"slipface\": 1,");
    EXPECT_THAT(error_of("easy.obj").location, HasSubstr("easy.slipface.json:1:"));
    EXPECT_EQ(read("easy.slipface.json"), "{\"slipface\": 1,");
}

TEST_F(LevelFile, FoldersAndMissingFilesAreErrors) {
    fs::create_directories(folder_ / "easy.slipface.json");
    EXPECT_THAT(error_of("easy.obj").location, HasSubstr("easy.slipface.json"));
    EXPECT_THAT(error_of("missing.obj").location, HasSubstr("missing.obj"));
    EXPECT_THAT(error_of("missing.slipface.json").location, HasSubstr("missing.slipface.json"));
}

TEST_F(LevelFile, SavingIntoAMissingFolderIsAnError) {
    const Level level = load("easy.obj").level;
    const Status status = save_level(level, folder_ / "missing" / "x.slipface.json");
    ASSERT_FALSE(status.ok());
    EXPECT_THAT(status.error().text(), HasSubstr("missing"));
}

TEST_F(LevelFile, UnknownKeysSurviveLoadingAndSaving) {
    write("easy.slipface.json", R"({"slipface": 1, "mesh": "easy.obj", "studio": {"note": [1, 2.50]}})");
    ASSERT_TRUE(save_level(load("easy.obj").level).ok());
    EXPECT_THAT(read("easy.slipface.json"), HasSubstr("\"studio\": {\n    \"note\": [1, 2.50]\n  }"));
}

TEST_F(LevelFile, AHundredThousandPaintedFacesAreSavedAndFoundQuickly) {
    Faces faces = tiles(317);
    for (Face& face : faces)
        face.painted = 1 + static_cast<int>(face.corners[0].x()) % 7;
    Level level = level_of(faces);
    level.file_path = folder_ / "big.slipface.json";
    const auto start = std::chrono::steady_clock::now();
    ASSERT_TRUE(save_level(level).ok());
    const double save_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const Result<LoadedLevel> loaded = level_from_json(read("big.slipface.json"), "big", level.mesh);
    const double both_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    ASSERT_TRUE(loaded.ok());
    EXPECT_EQ(loaded->level.overrides, level.overrides);
    RecordProperty("save_ms", static_cast<int>(save_s * 1e3));
    RecordProperty("load_ms", static_cast<int>((both_s - save_s) * 1e3));
    RecordProperty("bytes", static_cast<int>(fs::file_size(level.file_path)));
    // A hundred times the time measured, so that only a wrong order of growth trips it.
    EXPECT_LT(both_s, 20.0);
}

// A Quake map without a level file has what the map says; with one, what that says.
TEST_F(LevelFile, AFreshMapHasItsTypesAndHidesWhatIsNotDrawn) {
    bsp_maker::Map map;
    const std::uint32_t caulk = map.add_texture("textures/common/caulk", 0x80, 1);
    const std::uint32_t ice = map.add_texture("textures/ice", 0x2, 1);
    map.add_texture("textures/water", 0, 0x20);
    bsp_maker::add_shell(map, {{0, 0, 0}, {320, 320, 320}}, 16, caulk);
    bsp_maker::add_room_tree(map, {{0, 0, 0}, {320, 320, 320}});
    map.add_polygon({{32, 32, 1}, {32, 64, 1}, {64, 64, 1}, {64, 32, 1}}, ice);
    map.add_world();
    map.entities = "{ \"classname\" \"info_player_start\" \"origin\" \"64 64 24\" }";
    write("arena.bsp", map.bytes());
    LoadedLevel fresh = load("arena.bsp");
    EXPECT_EQ(fresh.level.mesh->face_count(), 7u);
    EXPECT_EQ(fresh.level.hidden, (std::vector<FaceId>{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(resolve_surfaces(fresh.level).surface[0], find_surface(fresh.level, "ice"));
    ASSERT_TRUE(find_surface(fresh.level, "nonsolid"));
    EXPECT_FALSE(fresh.level.surfaces[*find_surface(fresh.level, "nonsolid")].solid);
    ASSERT_EQ(fresh.found_spawns.size(), 1u);
    EXPECT_TRUE(fresh.found_spawns[0].feet.isApprox(Vec3(2, 0, -2)));
    EXPECT_EQ(fresh.level.import_summary.scale, 1.0 / 32);

    fresh.level.hidden.clear();
    fresh.level.rules.clear();
    ASSERT_TRUE(save_level(fresh.level));
    EXPECT_THAT(read("arena.slipface.json"), testing::Not(HasSubstr("\"scale\""))) << "the file's own word";
    const LoadedLevel again = load("arena.bsp");
    EXPECT_TRUE(again.level.hidden.empty());
    EXPECT_EQ(resolve_surfaces(again.level).surface[0], default_surface);
    EXPECT_EQ(again.level.mesh->fingerprint, fresh.level.mesh->fingerprint);
    EXPECT_EQ(again.found_spawns.size(), 1u);
}

TEST_F(LevelFile, AGivenScaleAndAxisAreKept) {
    LoadedLevel loaded = load("easy.obj");
    EXPECT_EQ(loaded.level.import_transform, ImportTransform{});
    auto other = reload_mesh(loaded.level, {.scale = 1.0, .up = UpAxis::minus_z});
    ASSERT_TRUE(other) << other.error().text();
    ASSERT_TRUE(save_level(other->level));
    EXPECT_THAT(read("easy.slipface.json"), HasSubstr("\"scale\": 1,\n  \"up\": \"-z\""));
    const LoadedLevel again = load("easy.obj");
    EXPECT_EQ(again.level.import_transform, other->level.import_transform);
    EXPECT_EQ(again.level.import_summary.up_from, ImportSource::given);
    EXPECT_EQ(again.level.mesh->fingerprint, other->level.mesh->fingerprint);
    EXPECT_FALSE(reload_mesh(loaded.level, {.scale = 0.0, .up = {}}));
}

TEST_F(LevelFile, FlippedFacesLookTheOtherWayAndKeepTheirPaint) {
    LoadedLevel loaded = load("easy.obj");
    for (std::size_t face = 0; face < loaded.level.overrides.size(); face += 3)
        loaded.level.overrides[face] = SurfaceId{1};
    auto flipped = reload_mesh(loaded.level, {.scale = {}, .up = {}, .flip = true});
    ASSERT_TRUE(flipped) << flipped.error().text();
    ASSERT_TRUE(save_level(flipped->level));
    EXPECT_THAT(read("easy.slipface.json"), HasSubstr("\"flip\": true"));
    const LoadedLevel again = load("easy.obj");
    EXPECT_TRUE(again.level.import_transform.flip);
    EXPECT_EQ(again.level.overrides, loaded.level.overrides);
    for (FaceId face = 0; face < loaded.level.mesh.face_count(); face += 17)
        EXPECT_LT((face_normal(*again.level.mesh, face) + face_normal(*loaded.level.mesh, face)).norm(), 1e-6)
            << face;
    auto back = reload_mesh(again.level, ImportTransform{});
    ASSERT_TRUE(back);
    EXPECT_EQ(back->level.mesh->fingerprint, loaded.level.mesh->fingerprint);
}

}  // namespace
}  // namespace slipface::test
