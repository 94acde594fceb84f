// What other programs are given, read back.
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <cstring>
#include <map>

#include "exchange/scratch_level.h"
#include "slipface/exchange/export.h"

namespace slipface::test {
namespace {

class Export : public ScratchLevel {
  protected:
    Level painted() const {
        write("level.mtl", "newmtl stone\nKd 0.5 0.5 0.5\nmap_Kd pictures/stone.png\nnewmtl wood\n");
        Level level = open("mtllib level.mtl\nvt 0.25 0.75\n" + grid_obj(6, {"stone", "wood"}));
        level.rules = {{"wood", "sticky"}};
        for (FaceId face = 0; face < 9; ++face)
            paint(level, face, face % 2 == 0 ? "ice" : "ladder");
        paint(level, 30, "default");
        return level;
    }

    // Types by face centre, for formats that reorder faces.
    static std::map<std::array<int, 3>, std::string> types_by_place(const Level& level) {
        const ResolvedSurfaces resolved = resolve_surfaces(level);
        std::map<std::array<int, 3>, std::string> types;
        for (std::size_t t = 0; t < level.mesh->triangle_count(); ++t) {
            Vec3f sum = Vec3f::Zero();
            for (const std::uint32_t corner : level.mesh->triangles[t])
                sum += level.mesh->corner_position(corner);
            const FaceId face = level.mesh->triangle_face[t];
            types[{static_cast<int>(std::lround(sum[0] * 100)), static_cast<int>(std::lround(sum[1] * 100)),
                   static_cast<int>(std::lround(sum[2] * 100))}] =
                level.surfaces[resolved.surface[face]].name;
        }
        return types;
    }
};

TEST_F(Export, ObjBringsTypesInItsMaterials) {
    const Level level = painted();
    std::filesystem::create_directory(path("out"));
    ASSERT_TRUE(export_obj(level, path("out/game.obj")));
    const Level again = open_path("out/game.obj");
    EXPECT_EQ(resolve_surfaces(again).surface, resolve_surfaces(level).surface);
    EXPECT_EQ(again.mesh->positions, level.mesh->positions);
    EXPECT_EQ(again.mesh->face_first_corner, level.mesh->face_first_corner);
    EXPECT_EQ(again.mesh->materials[again.mesh->face_material[0]].name, "stone__ice");
    EXPECT_EQ(again.mesh->materials[again.mesh->face_material[0]].texture, "../pictures/stone.png");
    EXPECT_EQ(again.mesh->materials[again.mesh->face_material[30]].name, "wood__default")
        << "the rule says sticky, the paint default";
}

TEST_F(Export, GltfBringsTypesInNamesAndExtras) {
    const Level level = painted();
    for (const char* name : {"game.gltf", "game.glb"}) {
        ASSERT_TRUE(export_gltf(level, path(name)));
        EXPECT_EQ(types_by_place(open_path(name)), types_by_place(level)) << name;
        EXPECT_THAT(read(name), testing::HasSubstr(R"("extras":{"slipface_type":"ice"})"));
        EXPECT_THAT(read(name), testing::HasSubstr(R"("name":"conveyor")")) << "the table of types";
    }
}

TEST_F(Export, FlatFileHasAByteATriangle) {
    const Level level = painted();
    ASSERT_TRUE(export_flat(level, path("game.flat")));
    const std::string bytes = read("game.flat");
    ASSERT_TRUE(bytes.starts_with("slipflat"));
    std::uint32_t counts[5];
    std::memcpy(counts, bytes.data() + 8, sizeof counts);
    const auto [version, types, fields, vertices, triangles] = counts;
    EXPECT_EQ(version, 1u);
    EXPECT_EQ(types, level.surfaces.size());
    EXPECT_EQ(vertices, level.mesh->positions.size());
    EXPECT_EQ(triangles, level.mesh->triangle_count());
    ASSERT_EQ(bytes.size(), 28 + 32 * fields + types * (32 + 4 * fields) + 12 * vertices + 13 * triangles);
    const std::size_t table = 28 + 32 * std::size_t{fields};
    EXPECT_STREQ(bytes.data() + table + (32 + 4 * fields), "ice");
    const ResolvedSurfaces resolved = resolve_surfaces(level);
    for (std::size_t t = 0; t < triangles; ++t) {
        EXPECT_EQ(static_cast<unsigned char>(bytes[bytes.size() - triangles + t]),
                  resolved.surface[level.mesh->triangle_face[t]]);
    }
}

TEST_F(Export, NeverWritesOverTheLevel) {
    const Level level = painted();
    EXPECT_FALSE(export_obj(level, path("level.obj")));
    EXPECT_FALSE(export_flat(level, path("./level.obj")));
    EXPECT_FALSE(export_gltf(level, path("missing/game.gltf")));
}

TEST_F(Export, NeverWritesOverTheLevelsMaterials) {
    write("stone.mtl", "newmtl stone\n");
    const Level level = open("mtllib stone.mtl\n" + grid_obj(2, {"stone"}));
    const Status status = export_obj(level, path("stone.obj"));
    ASSERT_FALSE(status);
    EXPECT_THAT(status.error().text(), testing::HasSubstr("stone.mtl"));
    EXPECT_EQ(read("stone.mtl"), "newmtl stone\n");
    EXPECT_FALSE(exists("stone.obj"));
    EXPECT_TRUE(export_obj(level, path("other.obj")));
}

}  // namespace
}  // namespace slipface::test
