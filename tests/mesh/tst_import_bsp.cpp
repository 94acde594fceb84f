// Quake 3 maps, made here byte by byte.
#include <gmock/gmock.h>

#include <bit>

#include "mesh/mesh_test_tools.h"

namespace slipface {
namespace {

std::string u32(std::uint32_t value) {
    std::string text;
    for (int i = 0; i < 4; ++i)
        text.push_back(static_cast<char>(value >> (8 * i)));
    return text;
}

std::string vertex(float x, float y, float z) {
    std::string record;
    for (const float value : {x, y, z, x, y})
        record += u32(std::bit_cast<std::uint32_t>(value));
    record.resize(44, '\0');
    return record;
}

std::string face(std::uint32_t texture, std::uint32_t kind, std::uint32_t first, std::uint32_t count,
                 std::uint32_t first_index = 0, std::uint32_t indices = 0, std::uint32_t width = 0,
                 std::uint32_t height = 0) {
    std::string record =
        u32(texture) + u32(0) + u32(kind) + u32(first) + u32(count) + u32(first_index) + u32(indices);
    record.resize(96, '\0');
    return record + u32(width) + u32(height);
}

struct Map {
    std::string textures, vertices, indices, faces;

    std::string bytes() const {
        std::string header = "IBSP" + u32(46);
        std::string data;
        const std::string* lumps[17] = {};
        lumps[1] = &textures;
        lumps[10] = &vertices;
        lumps[11] = &indices;
        lumps[13] = &faces;
        for (const std::string* lump : lumps) {
            header += u32(static_cast<std::uint32_t>(144 + data.size())) +
                      u32(static_cast<std::uint32_t>(lump != nullptr ? lump->size() : 0));
            if (lump != nullptr) data += *lump;
        }
        return header + data;
    }
};

// A pentagon, a triangle, and a quarter of a tube.
Map small_map() {
    Map map;
    for (std::string name : {"textures/base/floor", "textures/base/tube"}) {
        name.resize(72, '\0');
        map.textures += name;
    }
    for (const auto& [x, y] :
         {std::pair(0, 0), std::pair(2, 0), std::pair(3, 1), std::pair(2, 2), std::pair(0, 2)})
        map.vertices += vertex(static_cast<float>(x), static_cast<float>(y), 0);
    for (int y = 0; y < 3; ++y)
        map.vertices += vertex(0, static_cast<float>(y), 5) + vertex(1, static_cast<float>(y), 5) +
                        vertex(1, static_cast<float>(y), 6);
    map.indices = u32(0) + u32(1) + u32(3);
    map.faces = face(0, 1, 0, 5) + face(0, 3, 0, 5, 0, 3) + face(1, 2, 5, 9, 0, 0, 3, 3) + face(0, 4, 0, 0);
    return map;
}

class ImportBsp : public ScratchFolder {
  protected:
    Result<ImportedMesh> import_map(const std::string& bytes) const {
        write("map.bsp", bytes);
        return import_mesh(folder / "map.bsp");
    }
    std::string error_of(const Map& map) const {
        const auto imported = import_map(map.bytes());
        return imported ? "read" : imported.error().text();
    }
};

TEST_F(ImportBsp, PolygonsMeshesAndPatchesBecomeFaces) {
    const auto imported = import_map(small_map().bytes());
    ASSERT_TRUE(imported) << imported.error().text();
    const Mesh& mesh = *imported->mesh;
    ASSERT_EQ(mesh.face_count(), 2u + 16u);
    EXPECT_EQ(mesh.face_corner_count(0), 5u);
    EXPECT_EQ(mesh.face_corner_count(1), 3u);
    EXPECT_EQ(mesh.materials[mesh.face_material[0]].name, "textures/base/floor");
    EXPECT_EQ(mesh.materials[mesh.face_material[2]].name, "textures/base/tube");
    EXPECT_NEAR(face_area(mesh, 0), 5.0, 1e-6);
    EXPECT_LT(face_normal(mesh, 0).z(), -0.99) << "counter-clockwise in the file, so turned round here";
    // The middle of the curve: a quarter of each end and half of the control point.
    double nearest = 1;
    for (const Vec3f& p : mesh.positions)
        nearest = std::min(nearest, (p.cast<double>() - Vec3(0.75, 1, 5.25)).norm());
    EXPECT_LT(nearest, 1e-6);
    ASSERT_EQ(imported->warnings.size(), 1u);
    EXPECT_THAT(imported->warnings[0].text(), testing::HasSubstr("1 flares"));
}

TEST_F(ImportBsp, WhatDoesNotFitIsRefused) {
    using testing::HasSubstr;
    const std::string good = small_map().bytes();
    for (std::size_t size = 0; size < good.size(); size += 7)
        EXPECT_FALSE(import_map(good.substr(0, size))) << size;
    Map map = small_map();
    map.faces = face(2, 1, 0, 5);
    EXPECT_THAT(error_of(map), HasSubstr("face 0 has a texture"));
    map.faces = face(0, 1, 0xFFFFFFFF, 5);
    EXPECT_THAT(error_of(map), HasSubstr("face 0 has a texture"));
    map.faces = face(0, 1, 12, 0xFFFFFFFF);
    EXPECT_THAT(error_of(map), HasSubstr("face 0 has a texture"));
    map.faces = face(0, 3, 0, 3, 0, 3);
    EXPECT_THAT(error_of(map), HasSubstr("index 3 of 3"));
    map.faces = face(0, 2, 0, 9, 0, 0, 3, 4);
    EXPECT_THAT(error_of(map), HasSubstr("patch of 3 x 4"));
    map.faces = face(0, 2, 0, 9, 0, 0, 0x80000001, 0x80000001);
    EXPECT_THAT(error_of(map), HasSubstr("patch of"));
    map.faces = face(0, 4, 0, 0);
    EXPECT_THAT(error_of(map), HasSubstr("has no faces"));
    map = small_map();
    map.vertices.replace(0, 4, u32(0x7FC00000));
    EXPECT_THAT(error_of(map), HasSubstr("not within"));
}

}  // namespace
}  // namespace slipface
