// Painted types go into `usemtl` lines and nowhere else.
#include <gmock/gmock.h>

#include <random>

#include "exchange/scratch_level.h"
#include "slipface/exchange/name_materials.h"

namespace slipface::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class NameMaterials : public ScratchLevel {
  protected:
    std::string baked_text(const Level& level) {
        const Result<NamedObj> named = obj_with_names(level, read("level.obj"));
        if (named) return named->obj;
        ADD_FAILURE() << named.error().text();
        return {};
    }
};

// Everything that a writer is tempted to tidy up.
const std::string untidy =
    "\xEF\xBB\xBF# made by hand \\\r\n"
    "mtllib level.mtl\r\n"
    "v  0.500000 0 0\r\nv 0 0 1e0\r\n\tv 1 0 \\\r\n 1\r\nv 1 .0 0\r\nv 0 1 0 0.5 0.5 0.5\r\n"
    "shadow_obj thing\r\n"
    "usemtl   stone  \r\n"
    "f 1 2 3\r\n"
    "f 1 2 3 4\r\n"
    "s 1\n"
    "f 1 2 2\n"
    "o second thing\r\n"
    "f -1 -2 -3   \r\n"
    "usemtl wall\r\n"
    "  f 1 2 \\\r\n 4 5\r\n"
    "f 3 4 5";

TEST_F(NameMaterials, WithoutPaintNoByteChanges) {
    const Level level = open(untidy);
    EXPECT_EQ(baked_text(level), untidy);
    const Result<NamedMaterials> named = name_materials(level);
    ASSERT_TRUE(named) << named.error().text();
    EXPECT_TRUE(named->written.empty());
    EXPECT_FALSE(exists("level.obj.bak"));
}

TEST_F(NameMaterials, OnlyUsemtlLinesComeInOrChange) {
    Level level = open(untidy);
    ASSERT_EQ(level.mesh->face_count(), 5u);
    paint(level, 1, "ice");
    paint(level, 2, "ladder");
    paint(level, 3, "ice");
    const std::string expected =
        "\xEF\xBB\xBF# made by hand \\\r\n"
        "mtllib level.mtl\r\n"
        "v  0.500000 0 0\r\nv 0 0 1e0\r\n\tv 1 0 \\\r\n 1\r\nv 1 .0 0\r\nv 0 1 0 0.5 0.5 0.5\r\n"
        "shadow_obj thing\r\n"
        "usemtl   stone  \r\n"
        "f 1 2 3\r\n"
        "usemtl stone__ice\r\n"
        "f 1 2 3 4\r\n"
        "s 1\n"
        "f 1 2 2\n"
        "o second thing\r\n"
        "usemtl stone__ladder\r\n"
        "f -1 -2 -3   \r\n"
        "usemtl wall__ice\r\n"
        "  f 1 2 \\\r\n 4 5\r\n"
        "usemtl wall\r\n"
        "f 3 4 5";
    EXPECT_EQ(baked_text(level), expected);
}

TEST_F(NameMaterials, TheTypesAreReadBackFromTheMaterials) {
    Level level = open("mtllib level.mtl\n" + grid_obj(12, {"stone", "", "my wood"}));
    std::mt19937 random(3);
    for (FaceId face = 0; face < level.mesh->face_count(); ++face)
        if (random() % 3 != 0)
            level.overrides[face] = static_cast<SurfaceId>(random() % level.surfaces.size());
    level.rules = {{"stone", "sticky"}};
    const ResolvedSurfaces before = resolve_surfaces(level);

    const Result<NamedMaterials> named = name_materials(level);
    ASSERT_TRUE(named) << named.error().text();
    const Level& after = named->after.level;
    EXPECT_EQ(resolve_surfaces(after).surface, before.surface);
    for (const auto& painted : after.overrides)
        EXPECT_FALSE(painted) << "the material says it now";
    EXPECT_EQ(after.mesh->positions, level.mesh->positions);
    EXPECT_EQ(after.mesh->corner_vertex, level.mesh->corner_vertex);

    // Nothing more to write: the second time changes no byte.
    const std::string once = read("level.obj");
    EXPECT_EQ(baked_text(after), once);
}

TEST_F(NameMaterials, KeepsOneBackupAndTintsTheMaterial) {
    write("level.mtl",
          "newmtl stone\r\nKd 1 1 1\r\nmap_Kd stone.png\r\nillum 2\r\n\r\nnewmtl wall\r\nKd 0 0 0\r\n");
    Level level = open(untidy);
    paint(level, 0, "ice");
    const Result<NamedMaterials> named = name_materials(level);
    ASSERT_TRUE(named) << named.error().text();
    EXPECT_EQ(named->text(), "types of 1 face written into level.obj; the old file is level.obj.bak");
    EXPECT_EQ(read("level.obj.bak"), untidy);
    const std::string library = read("level.mtl");
    EXPECT_TRUE(library.starts_with(read("level.mtl.bak")));
    EXPECT_THAT(library, HasSubstr("newmtl stone__ice\r\nKd 0."));
    EXPECT_THAT(library.substr(library.find("stone__ice")), HasSubstr("map_Kd stone.png\r\nillum 2"));
    EXPECT_THAT(library.substr(library.find("stone__ice")), Not(HasSubstr("wall")));
    EXPECT_TRUE(named->after.warnings.empty() ||
                named->after.warnings[0].message.find("stone__ice") == std::string::npos)
        << "the new material is in the library";
}

TEST_F(NameMaterials, RefusesAFileThatAnotherProgramHasChanged) {
    Level level = open(untidy);
    paint(level, 0, "ice");
    write("level.obj", untidy + "\n# saved elsewhere");
    const Result<NamedMaterials> named = name_materials(level);
    ASSERT_FALSE(named);
    EXPECT_THAT(named.error().text(), HasSubstr("changed by another program"));
    EXPECT_EQ(read("level.obj"), untidy + "\n# saved elsewhere");
    EXPECT_FALSE(exists("level.obj.bak"));
}

TEST_F(NameMaterials, RefusesATypeThatNoMaterialNameCanHold) {
    Level level = open(untidy);
    SurfaceType odd;
    odd.name = "ice.001";
    level.surfaces.push_back(odd);
    paint(level, 0, "ice.001");
    EXPECT_FALSE(obj_with_names(level, read("level.obj")));
}

TEST_F(NameMaterials, ReadOnlyGeometryIsNotWritten) {
    write("level.ply",
          "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty "
          "float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n0 0 "
          "1\n1 0 0\n3 0 1 2\n");
    Result<LoadedLevel> loaded = load_level(path("level.ply"));
    ASSERT_TRUE(loaded) << loaded.error().text();
    paint(loaded->level, 0, "ice");
    const Result<NamedMaterials> named = name_materials(loaded->level);
    ASSERT_FALSE(named);
    EXPECT_THAT(named.error().text(), HasSubstr("read only"));
}

}  // namespace
}  // namespace slipface::test
