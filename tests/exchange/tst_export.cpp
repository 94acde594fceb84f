// What other programs are given, read back.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <random>

#include "exchange/scratch_level.h"
#include "slipface/exchange/export.h"
#include "slipface/image/image.h"

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
    ASSERT_TRUE(export_level(level, {.obj = path("out/game.obj")}));
    const Level again = open_path("out/game.obj");
    EXPECT_EQ(resolve_surfaces(again).surface, resolve_surfaces(level).surface);
    EXPECT_EQ(again.mesh->positions, level.mesh->positions);
    EXPECT_EQ(again.mesh->face_first_corner, level.mesh->face_first_corner);
    EXPECT_EQ(again.mesh->materials[again.mesh->face_material[0]].name, "stone__ice");
    EXPECT_EQ(again.mesh->materials[again.mesh->face_material[0]].texture, "../pictures/stone.png");
    EXPECT_EQ(again.mesh->materials[again.mesh->face_material[30]].name, "wood__default")
        << "the rule says sticky, the paint default";
}

// As modelling tools write them: two objects that touch have vertices of their own, in the order in which
// they were read.
TEST_F(Export, ObjListsTheVerticesOfEachObjectInTheirOrder) {
    const std::string low = "v 0 0 0\nv 1 0 1\nv 0 0 1\nv 1 0 0\n";
    const std::string high = "v 1 0 0\nv 1 1 1\nv 1 0 1\nv 1 1 0\n";
    const Level level = open(low + "o low\nf 1 3 2 4\n" + high + "o high\nf 5 8 6 7\n");
    const Mesh& mesh = *level.mesh;
    ASSERT_EQ(mesh.positions.size(), 6u);
    std::vector<std::uint32_t> numbers;
    for (const std::uint32_t group : {0u, 1u})
        for (std::uint32_t c = 4 * group; c < 4 * group + 4; ++c)
            numbers.push_back(mesh.number_in_group(mesh.face_group[group], mesh.corner_vertex[c]));
    EXPECT_THAT(numbers, testing::ElementsAre(0, 2, 1, 3, 4, 7, 5, 6));
    ASSERT_TRUE(export_level(level, {.obj = path("again.obj")}));
    EXPECT_THAT(read("again.obj"), testing::HasSubstr(low + high));
    EXPECT_EQ(open_path("again.obj").mesh->positions, mesh.positions);
}

TEST_F(Export, GltfBringsTypesInNamesAndExtras) {
    const Level level = painted();
    for (const char* name : {"game.gltf", "game.glb"}) {
        ASSERT_TRUE(export_level(level, {.gltf = path(name)}));
        EXPECT_EQ(types_by_place(open_path(name)), types_by_place(level)) << name;
        EXPECT_THAT(read(name), testing::HasSubstr(R"("extras":{"slipface_type":"ice"})"));
        EXPECT_THAT(read(name), testing::HasSubstr(R"("name":"conveyor")")) << "the table of types";
    }
}

// A type that no preset has, and one that was changed.
TEST_F(Export, GltfBringsTheLevelsOwnTypes) {
    Level level = painted();
    SurfaceType own;
    own.name = "wet moss";
    own.color = {0.25F, 0.5F, 0.125F};
    own.friction = 0.35;
    own.solid = false;
    level.surfaces.push_back(own);
    level.surfaces[find_surface(level, "ice").value()].friction = 0.07;
    for (FaceId face = 20; face < 25; ++face)
        paint(level, face, "wet moss");
    for (const char* name : {"own.gltf", "own.glb"}) {
        ASSERT_TRUE(export_level(level, {.gltf = path(name)}));
        const Level again = open_path(name);
        EXPECT_EQ(again.surfaces, level.surfaces) << name;
        EXPECT_EQ(types_by_place(again), types_by_place(level)) << name;
    }
}

TEST_F(Export, ABadTableOfTypesIsAWarning) {
    ASSERT_TRUE(export_level(painted(), {.gltf = path("good.gltf")}));
    const std::string good = read("good.gltf");
    const std::size_t at = good.find(R"("slipface_types":[)");
    ASSERT_NE(at, std::string::npos);
    for (const char* bad : {R"("slipface_types":7,"was":[)", R"("slipface_types":[7],"was":[)",
                            R"("slipface_types":[{"name":"first"}],"was":[)",
                            R"("slipface_types":[{"name":"default","friction":"wet"}],"was":[)"}) {
        std::string text = good;
        write("bad.gltf", text.replace(at, 18, bad));
        const Result<LoadedLevel> loaded = load_level(path("bad.gltf"));
        ASSERT_TRUE(loaded) << loaded.error().text();
        ASSERT_EQ(loaded->warnings.size(), 1U) << bad;
        EXPECT_THAT(loaded->warnings[0].text(), testing::HasSubstr("the file's types are ignored")) << bad;
        EXPECT_EQ(loaded->level.surfaces, preset_surface_types()) << bad;
    }
}

TEST_F(Export, FlatFileHasAByteATriangle) {
    const Level level = painted();
    ASSERT_TRUE(export_level(level, {.flat = path("game.flat")}));
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
    EXPECT_FALSE(export_level(level, {.obj = path("level.obj")}));
    EXPECT_FALSE(export_level(level, {.flat = path("./level.obj")}));
    EXPECT_FALSE(export_level(level, {.gltf = path("missing/game.gltf")}));
}

TEST_F(Export, WritesAllTargetsOrNone) {
    const Level level = painted();
    ExportTargets targets{path("a.obj"), path("a.gltf"), path("missing/a.flat")};
    EXPECT_FALSE(export_level(level, targets));
    EXPECT_FALSE(std::filesystem::exists(path("a.obj")));
    EXPECT_FALSE(std::filesystem::exists(path("a.bin")));
    targets.flat = path("./a.bin");
    const Status status = export_level(level, targets);
    ASSERT_FALSE(status);
    EXPECT_THAT(status.error().location, testing::HasSubstr("a.bin")) << "the buffer of the glTF";
    EXPECT_FALSE(std::filesystem::exists(path("a.gltf")));
    targets.flat = path("a.flat");
    ASSERT_TRUE(export_level(level, targets));
    for (const char* name : {"a.obj", "a.mtl", "a.gltf", "a.bin", "a.flat"})
        EXPECT_TRUE(std::filesystem::exists(path(name))) << name;
}

// A level reads more files than its geometry. Under whatever name it is exported, they stay as they are.
TEST_F(Export, NeverWritesOverWhatTheLevelReads) {
    std::filesystem::create_directory(path("pictures"));
    ASSERT_TRUE(save_png(path("pictures/stone.png"), make_image(2, 2, 200, 100, 50)));
    ASSERT_TRUE(export_level(painted(), {.gltf = path("game.gltf")}));
    write("pot.mtl", "newmtl clay\n");
    write("pot.obj", "mtllib pot.mtl\n" + grid_obj(2, {"clay"}));
    const std::vector<std::vector<std::string>> levels = {
        {"level.obj", "level.mtl", "pictures/stone.png"},
        {"game.gltf", "game.bin", "pictures/stone.png"},
    };
    for (std::vector<std::string> own : levels) {
        Level level = open_path(own[0]);
        level.props.emplace_back().mesh = "pot.obj";
        place_props(level);
        level.heightfield.emplace().file = "hills.png";
        level.light.emplace().image = "light.png";
        own.insert(own.end(), {"pot.obj", "pot.mtl", "hills.png", "light.png"});
        for (const char* map : {"hills.png", "light.png"})
            write(map, map);
        std::map<std::string, std::string> before;
        for (const std::string& file : own) {
            ASSERT_TRUE(exists(file)) << file;
            before[file] = read(file);
        }
        for (const std::string& file : own) {
            for (const char* ending : {"", ".obj", ".gltf"}) {
                std::filesystem::path target = path(file);
                if (*ending != 0) target.replace_extension(ending);
                for (const ExportTargets& targets :
                     {ExportTargets{.obj = target}, ExportTargets{.gltf = target},
                      ExportTargets{.flat = target}}) {
                    const Status status = export_level(level, targets);
                    if (target == path(file)) {
                        ASSERT_FALSE(status) << target;
                        EXPECT_THAT(status.error().text(), testing::HasSubstr("of the level itself"));
                    }
                    for (const auto& [kept, bytes] : before)
                        ASSERT_EQ(read(kept), bytes) << kept << " after exporting " << target;
                }
            }
        }
        EXPECT_TRUE(export_level(level, {.obj = path("other.obj")}));
    }
}

// Objects, their tree, copies and colours of a glTF, read, painted, exported and read again.
class GltfObjects : public Export {
  protected:
    // A table with two mugs on it, of which one is mirrored and turned, in a room; two quads each.
    static std::string room() {
        const float quads[] = {0, 0, 0, 0, 0, 1, 1, 0, 1, 1, 0, 0, 0, 1, 0, 0, 1, 1, 1, 1, 1, 1, 1, 0};
        const std::uint32_t indices[] = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
        std::string bytes(sizeof quads + sizeof indices, '\0');
        std::memcpy(bytes.data(), quads, sizeof quads);
        std::memcpy(bytes.data() + sizeof quads, indices, sizeof indices);
        return bytes;
    }
    Level open_room() const {
        write("room.bin", room());
        write("room.gltf", R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,5]}],"nodes":[
            {"name":"room","children":[1,4]},{"name":"table","mesh":0,"children":[2,3],"translation":[2,1,0]},
            {"name":"mug","mesh":1,"translation":[0,1,0],"scale":[0.25,0.5,0.25]},
            {"name":"mug two","mesh":1,"translation":[1,1,0],"rotation":[0,0.6,0,0.8],"scale":[-1,1,1]},
            {"name":"lamp without faces"},{"name":"room","mesh":0}],
            "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]},
                      {"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":1}]}],
            "materials":[{"name":"wood","pbrMetallicRoughness":{"baseColorFactor":[0.25,0.5,1,1]}},
                         {"name":"glass__ice","pbrMetallicRoughness":{"baseColorFactor":[0.03,0.9,0.1,1]}}],
            "accessors":[{"bufferView":0,"componentType":5126,"count":8,"type":"VEC3","min":[0,0,0],"max":[1,1,1]},
                         {"bufferView":1,"componentType":5125,"count":12,"type":"SCALAR"}],
            "bufferViews":[{"buffer":0,"byteLength":96},{"buffer":0,"byteOffset":96,"byteLength":48}],
            "buffers":[{"byteLength":144,"uri":"room.bin"}]})");
        return open_path("room.gltf");
    }
    static std::vector<std::string> tree(const Mesh& mesh) {
        std::vector<std::string> names;
        for (const MeshNode& node : mesh.nodes) {
            std::string name = node.name;
            for (std::uint32_t up = node.parent; up != no_id; up = mesh.nodes[up].parent)
                name = mesh.nodes[up].name + "/" + name;
            names.push_back(name);
        }
        return names;
    }
    nlohmann::json exported(const Level& level) const {
        EXPECT_TRUE(export_level(level, {.gltf = path("out.gltf")}));
        return nlohmann::json::parse(read("out.gltf"));
    }
};

TEST_F(GltfObjects, TheTreeIsKept) {
    const Level level = open_room();
    EXPECT_THAT(tree(*level.mesh),
                testing::ElementsAre("room", "room/table", "room/table/mug", "room/table/mug two", "room"));
    const nlohmann::json json = exported(level);
    EXPECT_THAT(tree(*open_path("out.gltf").mesh), testing::ElementsAreArray(tree(*level.mesh)));
    const auto node = [&](const std::string& name) {
        for (const auto& one : json["nodes"])
            if (one["name"] == name) return one;
        return nlohmann::json();
    };
    EXPECT_EQ(node("mug")["translation"], nlohmann::json({0, 1, 0}));
    EXPECT_EQ(node("mug")["scale"], nlohmann::json({0.25, 0.5, 0.25}));
    EXPECT_LT(node("mug two")["scale"][0], 0);
    EXPECT_EQ(node("mug")["mesh"], node("mug two")["mesh"]) << "copies share a mesh";
    EXPECT_EQ(open_path("out.gltf").mesh->positions, level.mesh->positions);
    EXPECT_EQ(json["meshes"].size(), 2u) << "the table and the second room are copies, too";
}

TEST_F(GltfObjects, ReadBackEqual) {
    Level level = open_room();
    paint(level, 1, "ladder");  // of the table
    paint(level, 4, "hazard");  // of a mug, which is no copy any more
    const nlohmann::json json = exported(level);
    const Level again = open_path("out.gltf");
    EXPECT_EQ(types_by_place(again), types_by_place(level));
    EXPECT_EQ(tree(*again.mesh), tree(*level.mesh)) << "parts of one object are read as one";
    EXPECT_EQ(again.mesh->groups.size(), level.mesh->groups.size());
    std::map<std::string, Vec3f> before, after;
    for (const Material& material : level.mesh->materials)
        before[material.name] = material.diffuse;
    for (const Material& material : again.mesh->materials)
        after[material.name] = material.diffuse;
    EXPECT_LT((after["wood"] - before["wood"]).norm(), 1e-5F);
    EXPECT_LT((after["glass__ice"] - before["glass__ice"]).norm(), 1e-5F);
    EXPECT_NEAR(before["wood"].x(), 0.537F, 0.001F) << "linear 0.25 in sRGB";
    EXPECT_EQ(json["meshes"].size(), 6u) << "table in two, mug in two, the other mug, the second room";
}

// Props are nodes that share the meshes of their files, wherever they stand and however they are scaled.
TEST_F(GltfObjects, PropsShareTheirMeshes) {
    write("wedge.obj",
          "v 0 0 0\nv 2 0 0\nv 0 0 1\nv 0 1 0\no wedge\nusemtl stone\nf 1 2 3\nf 1 4 2\nusemtl wood\nf 1 3 "
          "4\nf 2 4 3\n");
    write("slab.obj", "v 0 0 0\nv 0 0 1\nv 1 0 1\nv 1 0 0\nusemtl stone\nf 1 2 3 4\n");
    Level level = open(grid_obj(3, {"ground"}));
    std::mt19937 random(3);
    const auto number = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
    };
    const auto side = [&] { return random() % 2 == 0 ? 1.0 : -1.0; };
    for (int i = 0; i < 200; ++i) {
        Prop prop;
        prop.name = "prop " + std::to_string(i);
        prop.mesh = i % 3 == 0 ? "slab.obj" : i == 100 ? "missing.obj" : "wedge.obj";
        prop.position = Vec3(number(-900, 900), number(-5, 5), number(-900, 900));
        prop.rotation = Vec3(number(-4, 4), number(-4, 4), number(-4, 4));
        prop.scale = Vec3(side() * number(0.01, 20), side() * number(0.01, 20), side() * number(0.01, 20));
        if (i % 10 == 1) prop.type = "ice";
        level.props.push_back(prop);
    }
    EXPECT_EQ(place_props(level).size(), 1U) << "the missing one";
    for (const char* const ending : {".gltf", ".glb"}) {
        const std::string name = std::string("props") + ending;
        ASSERT_TRUE(export_level(level, {.gltf = path(name)}));
        if (std::string_view(ending) == ".gltf") {
            const auto json = nlohmann::json::parse(read(name));
            EXPECT_EQ(json["meshes"].size(), 5U) << "ground; slab and wedge, also of ice";
            std::size_t placed = 0;
            for (const auto& node : json["nodes"])
                placed += node.contains("mesh") && node["name"].get<std::string>().starts_with("prop ");
            EXPECT_EQ(placed, 199U);
        }
        const Level again = open_path(name);
        ASSERT_EQ(again.mesh->triangle_count(), level.mesh->triangle_count());
        const ResolvedSurfaces before = resolve_surfaces(level), after = resolve_surfaces(again);
        double farthest = 0.0;
        for (std::size_t t = 0; t < again.mesh->triangle_count(); ++t) {
            const FaceId a = level.mesh->triangle_face[t], b = again.mesh->triangle_face[t];
            ASSERT_EQ(again.surfaces[after.surface[b]].name, level.surfaces[before.surface[a]].name) << t;
            // Corner by corner, wherever the triangle begins.
            double nearest = 1e9;
            for (std::size_t turn = 0; turn < 3; ++turn) {
                double most = 0.0;
                for (std::size_t k = 0; k < 3; ++k) {
                    const Vec3f& p = level.mesh->corner_position(level.mesh->triangles[t][k]);
                    const Vec3f& q = again.mesh->corner_position(again.mesh->triangles[t][(k + turn) % 3]);
                    most = std::max(most, static_cast<double>((p - q).norm()));
                }
                nearest = std::min(nearest, most);
            }
            farthest = std::max(farthest, nearest);
        }
        EXPECT_LT(farthest, 1e-3) << ending;
    }
}

TEST_F(GltfObjects, BodiesInTheExtensionsOfEngines) {
    Level level = open_room();
    paint(level, 1, "ladder");
    const auto no_body = find_surface(level, "conveyor").value();
    level.surfaces[no_body].solid = false;
    paint(level, 0, "conveyor");
    const nlohmann::json json = exported(level);
    const auto& nodes = json["nodes"];
    const auto& shapes = json["extensions"]["OMI_physics_shape"]["shapes"];
    const auto& materials = json["extensions"]["KHR_physics_rigid_bodies"]["physicsMaterials"];
    std::map<std::string, std::string> type_of_mesh;
    int bodies = 0;
    for (const auto& node : nodes) {
        if (node.contains("mesh")) {
            EXPECT_FALSE(node.contains("extensions")) << "an engine makes either a mesh or a body of a node";
        }
        if (!node.contains("extensions")) continue;
        ++bodies;
        const auto& omi = node["extensions"]["OMI_physics_body"]["collider"];
        const auto& khr = node["extensions"]["KHR_physics_rigid_bodies"]["collider"];
        const auto& holder = nodes[khr["geometry"]["node"].get<std::size_t>()];
        EXPECT_EQ(shapes[omi["shape"].get<std::size_t>()]["type"], "trimesh");
        EXPECT_EQ(shapes[omi["shape"].get<std::size_t>()]["trimesh"]["mesh"], holder["mesh"]);
        EXPECT_EQ(omi["physicsMaterial"], khr["physicsMaterial"]);
        EXPECT_EQ(node["extras"]["slipface_type"], holder["extras"]["slipface_type"]);
        for (const auto& child : holder["children"])
            EXPECT_FALSE(nodes[child.get<std::size_t>()].contains("mesh")) << "would be part of the shape";
        const auto friction =
            materials[khr["physicsMaterial"].get<std::size_t>()]["dynamicFriction"].get<double>();
        const bool ice = node["extras"]["slipface_type"] == "ice";
        EXPECT_EQ(friction, ice ? 0.0 : 1.0) << node["extras"]["slipface_type"];
    }
    EXPECT_EQ(bodies, 5) << "two types of the table, two mugs, the second room; the conveyor is not solid";
}

TEST_F(GltfObjects, PicturesGoWithTheFile) {
    std::filesystem::create_directories(path("pictures"));
    std::filesystem::create_directories(path("out"));
    const Image picture = make_image(3, 2, 200, 100, 50);
    ASSERT_TRUE(save_png(path("pictures/a b.png"), picture));
    write("level.mtl", "newmtl stone\nmap_Kd pictures/a b.png\nnewmtl wood\nmap_Kd gone.png\n");
    const Level level = open("mtllib level.mtl\nvt 0.25 0.75\n" + grid_obj(2, {"stone", "wood"}));
    const std::string bytes = read("pictures/a b.png");

    ASSERT_TRUE(export_level(level, {.gltf = path("one.glb")}));
    EXPECT_NE(read("one.glb").find(bytes), std::string::npos);
    EXPECT_THAT(read("one.glb"), testing::HasSubstr(R"("mimeType":"image/png")"));
    EXPECT_THAT(read("one.glb"), testing::Not(testing::HasSubstr("gone")));
    const Level embedded = open_path("one.glb");
    const Material& stone = embedded.mesh->materials.front();
    ASSERT_TRUE(stone.picture);
    EXPECT_EQ(*stone.picture, bytes);
    EXPECT_EQ(stone.texture, "a b.png");
    ASSERT_TRUE(export_level(embedded, {.gltf = path("two.glb")}));
    EXPECT_NE(read("two.glb").find(bytes), std::string::npos) << "from file to file";
    ASSERT_TRUE(export_level(embedded, {.gltf = path("two.gltf")}));
    EXPECT_EQ(read("two-a b.png"), bytes);
    ASSERT_TRUE(export_level(embedded, {.obj = path("three.obj")}));
    EXPECT_EQ(read("three-a b.png"), bytes);
    EXPECT_EQ(open_path("three.obj").mesh->materials.front().texture, "three-a b.png");
    ASSERT_TRUE(export_level(embedded, {.obj = path("four.obj"), .gltf = path("four.gltf")}));
    EXPECT_EQ(read("four-a b.png"), bytes) << "one picture for both";

    ASSERT_TRUE(export_level(level, {.gltf = path("here.gltf")}));
    EXPECT_THAT(read("here.gltf"), testing::HasSubstr(R"("uri":"pictures/a%20b.png")"));

    const Level flat = open("mtllib level.mtl\n" + grid_obj(2, {"stone", "wood"}));
    ASSERT_TRUE(export_level(flat, {.gltf = path("flat.gltf")}));
    EXPECT_THAT(read("flat.gltf"), testing::HasSubstr("TEXCOORD_0")) << "a textured material needs them";

    ASSERT_TRUE(export_level(level, {.gltf = path("out/there.gltf")}));
    EXPECT_THAT(read("out/there.gltf"), testing::HasSubstr(R"("uri":"there-a%20b.png")"));
    EXPECT_EQ(read("out/there-a b.png"), bytes);
    const Level again = open_path("out/there.gltf");
    EXPECT_EQ(again.mesh->materials.front().texture, "there-a b.png");
}

}  // namespace
}  // namespace slipface::test
