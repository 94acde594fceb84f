#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <cstring>
#include <random>

#include "mesh_test_tools.h"
#include "slipface/base/base64.h"

namespace slipface {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class ImportScene : public ScratchFolder {
  protected:
    Result<ImportedMesh> import_as(const std::string& name, std::string_view text) {
        write(name, text);
        return import_mesh(folder / name);
    }
};

// A quad and a triangle; the quad must stay one face.
TEST_F(ImportScene, PlyKeepsPolygons) {
    const auto result =
        import_as("level.PLY",
                  "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
                  "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
                  "0 0 0\n0 0 1\n1 0 1\n1 0 0\n2 0 0\n4 0 1 2 3\n3 2 4 3\n");
    ASSERT_TRUE(result) << result.error().text();
    const Mesh& mesh = *result->mesh;
    ASSERT_EQ(mesh.face_count(), 2U);
    EXPECT_EQ(mesh.face_corner_count(0), 4U);
    EXPECT_EQ(mesh.positions.size(), 5U);
    EXPECT_EQ(mesh.materials[mesh.face_material[0]].name, "");
    EXPECT_EQ(face_normal(mesh, 0), Vec3(0, 0, -1)) << "PLY files have +Z up";
}

// Two nodes draw one triangle: one moved by 10 m, one mirrored in x, whose front must stay its front.
std::string two_nodes(const std::string& uri) {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],
        "nodes":[{"mesh":0,"name":"moved","translation":[10,0,0]},{"mesh":0,"name":"mirrored","scale":[-1,1,1]}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
        "materials":[{"name":"ice","pbrMetallicRoughness":{"baseColorFactor":[0.25,0.5,1,1]}}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,0,1]}],
        "bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36}],
        "buffers":[{"byteLength":36,"uri":")" +
           uri + "\"}]}";
}

std::string triangle_bytes() {
    const float coordinates[9] = {0, 0, 0, 0, 0, 1, 1, 0, 0};
    std::string bytes(sizeof coordinates, '\0');
    std::memcpy(bytes.data(), coordinates, sizeof coordinates);
    return bytes;
}

// The name that the material of the triangles has after `"name":"ice"` and more members were written.
TEST_F(ImportScene, GltfMaterialExtrasBecomeASuffix) {
    write("data.bin", triangle_bytes());
    const auto named = [&](const std::string& name, const std::string& members) {
        std::string text = two_nodes("data.bin");
        const std::string usual = R"("name":"ice")";
        text.replace(text.find(usual), usual.size(), "\"name\":\"" + name + "\"" + members);
        const auto result = import_as("level.gltf", text);
        if (!result) return "error: " + result.error().text();
        const std::string warning = result->warnings.empty() ? "" : " !" + result->warnings[0].message;
        return result->mesh->materials[result->mesh->face_material[0]].name + warning;
    };
    EXPECT_EQ(named("stone", ""), "stone");
    EXPECT_EQ(named("stone", R"(,"extras":{"slipface_type":"wet ice"})"), "stone__wet ice");
    EXPECT_EQ(named("Stone__Wet_Ice", R"(,"extras":{"slipface_type":"wet ice"})"), "Stone__Wet_Ice");
    EXPECT_EQ(named("stone__wall", R"(,"extras":{"slipface_type":"ice"})"), "stone__wall__ice");
    EXPECT_EQ(named("stone", R"(,"extras":{"slipface_type":""})"), "stone");
    EXPECT_EQ(named("stone", R"(,"extras":{"other":1})"), "stone");
    for (const char* const extras : {"1", "\"ice\"", "[]", "null"})
        EXPECT_EQ(named("stone", std::string(R"(,"extras":)") + extras), "stone") << extras;
    for (const std::string& hostile : {std::string("7"), std::string("{}"),
                                       "\"" + std::string(300, 'x') + "\"", std::string(R"("a\u0000b")")})
        EXPECT_THAT(named("stone", R"(,"extras":{"slipface_type":)" + hostile + "}"),
                    HasSubstr("stone !ignored \"slipface_type\" of the material"))
            << hostile;
    // Another material with the same name has no say.
    EXPECT_EQ(named("stone", R"(,"extras":{"slipface_type":"ice"}},{"name":"stone")"), "stone__ice");
}

TEST_F(ImportScene, ExtrasOfABinaryGltfCountToo) {
    std::string json = two_nodes("");
    const std::string uri = R"(,"uri":"")";
    json.erase(json.find(uri), uri.size());  // the buffer is the file's second chunk
    json.insert(json.find(R"("name":"ice")"), R"("extras":{"slipface_type":"sticky"},)");
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const auto number = [](std::size_t value) {
        std::string bytes;
        for (int i = 0; i < 4; ++i)
            bytes.push_back(static_cast<char>(value >> (8 * i)));
        return bytes;
    };
    const std::string binary = number(36) + std::string("BIN\0", 4) + triangle_bytes();
    const std::string head = "glTF" + number(2) + number(20 + json.size() + binary.size());
    const auto result = import_as("level.glb", head + number(json.size()) + "JSON" + json + binary);
    ASSERT_TRUE(result) << result.error().text();
    EXPECT_EQ(result->mesh->materials[result->mesh->face_material[0]].name, "ice__sticky");
    // Lengths that lie.
    for (const std::size_t length : {0U, 8U, 1000000U}) {
        const auto lying = import_as("lying.glb", head + number(length) + "JSON" + json + binary);
        EXPECT_TRUE(!lying || lying->mesh->materials[0].name.starts_with("ice")) << length;
    }
    EXPECT_FALSE(import_as("short.glb", "glTF slipface_type"));
}

TEST_F(ImportScene, GltfNodesArePlacedInTheWorld) {
    write("data.bin", triangle_bytes());
    const auto result = import_as("level.gltf", two_nodes("data.bin"));
    ASSERT_TRUE(result) << result.error().text();
    const Mesh& mesh = *result->mesh;
    ASSERT_EQ(mesh.face_count(), 2U);
    EXPECT_EQ(mesh.bounds.min, Vec3(-1, 0, 0));
    EXPECT_EQ(mesh.bounds.max, Vec3(11, 0, 1));
    EXPECT_EQ(face_normal(mesh, 0), Vec3(0, 1, 0));
    EXPECT_EQ(face_normal(mesh, 1), Vec3(0, 1, 0));
    EXPECT_THAT(mesh.groups, ElementsAre("moved", "mirrored"));
    EXPECT_EQ(mesh.materials[mesh.face_material[0]].name, "ice");
    const Vec3f srgb(0.5371F, 0.7354F, 1);  // the file's 0.25, 0.5 and 1 are linear
    EXPECT_LT((mesh.materials[mesh.face_material[0]].diffuse - srgb).norm(), 1e-3F);
    ASSERT_EQ(mesh.nodes.size(), 2U);
    EXPECT_EQ(mesh.nodes[1].shape, 0U) << "a copy of the first";
    EXPECT_EQ(mesh.nodes[0].world(0, 3), 10.0F);
}

// One textured triangle: positions, two sets of texture positions, and what the material says of its texture.
std::string textured_triangle(const std::array<float, 6>& uv, const std::string& texture_members,
                              const std::string& image) {
    std::string bytes = triangle_bytes();
    const std::array<float, 6> others{9, 9, 9, 9, 9, 9};
    bytes.append(reinterpret_cast<const char*>(uv.data()), sizeof uv);
    bytes.append(reinterpret_cast<const char*>(others.data()), sizeof others);
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
        "extensionsUsed":["KHR_texture_transform"],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":2,"TEXCOORD_1":1},"material":0}]}],
        "materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0)" +
           texture_members + R"(}}}],"textures":[{"source":0}],"images":[)" + image + R"(],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,0,1]},
            {"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"},
            {"bufferView":2,"componentType":5126,"count":3,"type":"VEC2"}],
        "bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":24},
            {"buffer":0,"byteOffset":60,"byteLength":24}],
        "buffers":[{"byteLength":84,"uri":"data:application/octet-stream;base64,)" +
           to_base64(bytes, Base64::padded) + "\"}]}";
}

// The extension's definition: scale, then rotation counter-clockwise as seen with V down, then offset.
TEST_F(ImportScene, GltfTextureTransformsAreApplied) {
    std::mt19937 draw(5);
    std::uniform_real_distribution<float> number(-3, 3);
    for (int round = 0; round < 40; ++round) {
        std::array<float, 6> uv{};
        for (float& value : uv)
            value = number(draw);
        const double x = number(draw), y = number(draw), angle = number(draw), sx = number(draw),
                     sy = number(draw);
        const std::string members = fmt::format(
            R"(,"texCoord":1,"extensions":{{"KHR_texture_transform":{{"offset":[{},{}],"rotation":{},"scale":[{},{}]}}}})",
            x, y, angle, sx, sy);
        const auto result =
            import_as("level.gltf", textured_triangle(uv, members, R"({"uri":"wall%20a.png"})"));
        ASSERT_TRUE(result) << result.error().text();
        EXPECT_EQ(result->mesh->materials[0].texture, "wall a.png");
        for (std::size_t i = 0; i < 3; ++i) {
            const double u = sx * uv[2 * i], v = sy * uv[2 * i + 1];
            const double right = std::cos(angle) * u + std::sin(angle) * v + x;
            const double down = -std::sin(angle) * u + std::cos(angle) * v + y;
            EXPECT_NEAR(result->mesh->corner_uv[i].x(), right, 2e-5) << round;
            EXPECT_NEAR(result->mesh->corner_uv[i].y(), 1 - down, 2e-5) << round;
        }
    }
}

std::string textured_fbx(const std::array<float, 6>& uv, const Eigen::Vector2d& repeat,
                         const Eigen::Vector2d& move, const char* program) {
    return fmt::format(
        R"(; FBX 7.3.0 project file
FBXHeaderExtension:  {{
	FBXHeaderVersion: 1003
	FBXVersion: 7300
	Creator: "{}"
}}
Objects:  {{
	Geometry: 1, "Geometry::mesh", "Mesh" {{
		Vertices: *9 {{
			a: 0,0,0,1,0,0,0,0,1
		}}
		PolygonVertexIndex: *3 {{
			a: 0,1,-3
		}}
		LayerElementUV: 0 {{
			MappingInformationType: "ByPolygonVertex"
			ReferenceInformationType: "Direct"
			UV: *6 {{
				a: {}
			}}
		}}
		LayerElementMaterial: 0 {{
			MappingInformationType: "AllSame"
			ReferenceInformationType: "IndexToDirect"
			Materials: *1 {{
				a: 0
			}}
		}}
		Layer: 0 {{
			LayerElement:  {{
				Type: "LayerElementMaterial"
				TypedIndex: 0
			}}
			LayerElement:  {{
				Type: "LayerElementUV"
				TypedIndex: 0
			}}
		}}
	}}
	Model: 2, "Model::shape", "Mesh" {{
		Version: 232
		Properties70:  {{
		}}
	}}
	Material: 3, "Material::wall", "" {{
		ShadingModel: "phong"
		Properties70:  {{
		}}
	}}
	Texture: 4, "Texture::wall", "" {{
		RelativeFilename: "wall.png"
		Properties70:  {{
			P: "Translation", "Vector", "", "A",{},{},0
			P: "Scaling", "Vector", "", "A",{},{},1
		}}
	}}
}}
Connections:  {{
	C: "OO",2,0
	C: "OO",1,2
	C: "OO",3,2
	C: "OP",4,3, "DiffuseColor"
}}
)",
        program, fmt::join(uv, ","), move.x(), move.y(), repeat.x(), repeat.y());
}

std::string textured_collada(const std::array<float, 6>& uv, const Eigen::Vector2d& repeat,
                             const Eigen::Vector2d& move) {
    return fmt::format(
        R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<library_images><image id="image"><init_from>wall.png</init_from></image></library_images>
<library_effects><effect id="effect"><profile_COMMON>
<newparam sid="surface"><surface type="2D"><init_from>image</init_from></surface></newparam>
<newparam sid="sampler"><sampler2D><source>surface</source></sampler2D></newparam>
<technique sid="common"><lambert><diffuse><texture texture="sampler" texcoord="UVMap"><extra>
<technique profile="MAYA"><repeatU>{}</repeatU><repeatV>{}</repeatV><offsetU>{}</offsetU><offsetV>{}</offsetV></technique>
</extra></texture></diffuse></lambert></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="wall"><instance_effect url="#effect"/></material></library_materials>
<library_geometries><geometry id="shape"><mesh>
<source id="at"><float_array id="at-array" count="9">0 0 0 1 0 0 0 0 1</float_array><technique_common>
<accessor source="#at-array" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<source id="uv"><float_array id="uv-array" count="6">{}</float_array><technique_common>
<accessor source="#uv-array" count="3" stride="2"><param name="S" type="float"/><param name="T" type="float"/>
</accessor></technique_common></source>
<vertices id="corners"><input semantic="POSITION" source="#at"/></vertices>
<triangles material="wall" count="1"><input semantic="VERTEX" source="#corners" offset="0"/>
<input semantic="TEXCOORD" source="#uv" offset="0" set="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="scene"><node id="node"><instance_geometry url="#shape"><bind_material>
<technique_common><instance_material symbol="wall" target="#wall"/></technique_common></bind_material>
</instance_geometry></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#scene"/></scene></COLLADA>)",
        repeat.x(), repeat.y(), move.x(), move.y(), fmt::join(uv, " "));
}

// Blender's FBX moves a picture before it repeats it, as its own glTF of the same scene says; others repeat
// first.
TEST_F(ImportScene, FbxAndColladaPicturesAreRepeatedAndMoved) {
    std::mt19937 draw(6);
    std::uniform_real_distribution<float> number(-3, 3);
    for (int round = 0; round < 40; ++round) {
        std::array<float, 6> uv{};
        for (float& value : uv)
            value = number(draw);
        const Eigen::Vector2d repeat(number(draw), number(draw)), move(number(draw), number(draw));
        const auto check = [&](const char* name, const std::string& text, bool moved_first) {
            const auto result = import_as(name, text);
            ASSERT_TRUE(result) << result.error().text();
            EXPECT_EQ(result->mesh->materials[0].texture, "wall.png");
            for (std::size_t i = 0; i < 3; ++i) {
                const Eigen::Vector2d at(uv[2 * i], uv[2 * i + 1]);
                const Eigen::Vector2d expected = moved_first ? repeat.cwiseProduct(at - move).eval()
                                                             : (repeat.cwiseProduct(at) + move).eval();
                EXPECT_LT((result->mesh->corner_uv[i].cast<double>() - expected).norm(), 2e-5)
                    << name << ", " << round;
            }
        };
        check("blender.fbx", textured_fbx(uv, repeat, move, "Blender 3.4"), true);
        check("max.fbx", textured_fbx(uv, repeat, move, "3ds Max"), false);
        check("level.dae", textured_collada(uv, repeat, move), false);
    }
}

TEST_F(ImportScene, PicturesInTheFileComeWithTheMesh) {
    const std::string picture = "any bytes \x01\x02\xff",
                      uri = "data:image/png;base64," + to_base64(picture, Base64::padded);
    const auto material = [&](const std::string& image) {
        const auto result = import_as("level.gltf", textured_triangle({0, 0, 1, 0, 0, 1}, "", image));
        return result ? result->mesh->materials[0] : Material{.name = result.error().text(), .texture = {}};
    };
    const Material named = material(R"({"name":"../brick","uri":")" + uri + "\"}");
    ASSERT_TRUE(named.picture) << named.name;
    EXPECT_EQ(*named.picture, picture);
    EXPECT_EQ(named.texture, "brick.png");
    EXPECT_EQ(material(R"({"uri":")" + uri + "\"}").texture, "picture-1.png");
    EXPECT_FALSE(material(R"({"uri":"wall.png"})").picture);
    const Material gone = material(R"({"bufferView":7,"mimeType":"image/png"})");
    EXPECT_FALSE(gone.picture);
}

TEST_F(ImportScene, FilesOutsideTheFolderAreNotRead) {
    write("secret.bin", triangle_bytes());
    EXPECT_FALSE(import_as("sub/level.gltf", two_nodes("../secret.bin")));
    EXPECT_FALSE(import_as("sub/level.gltf", two_nodes((folder / "secret.bin").string())));
    EXPECT_FALSE(import_as("sub/level.gltf", two_nodes("/dev/zero")));
    write("sub/secret.bin", triangle_bytes());
    EXPECT_TRUE(import_as("sub/level.gltf", two_nodes("secret.bin")));
}

// AC3D gives each object a material of its own, and its textures only to the objects.
TEST_F(ImportScene, MaterialsHaveNamesOfTheirOwn) {
    const auto with = [&](const std::string& name, const std::vector<std::string>& textures) {
        std::string text = "AC3Db\nMATERIAL \"" + name +
                           "\" rgb 1 1 1 amb 1 1 1 emis 0 0 0 spec 0 0 0 shi 0 trans 0\n"
                           "OBJECT world\nkids " +
                           std::to_string(textures.size()) + "\n";
        for (const std::string& texture : textures)
            text +=
                "OBJECT poly\n" + (texture.empty() ? "" : "texture \"" + texture + "\"\n") +
                "numvert 3\n0 0 0\n0 0 1\n1 0 0\nnumsurf 1\nSURF 0x00\nmat 0\nrefs 3\n0 0 0\n1 0 1\n2 1 0\n"
                "kids 0\n";
        const auto result = import_as("level.ac", text);
        std::vector<std::string> names;
        if (!result) ADD_FAILURE() << result.error().text();
        if (result)
            for (const std::uint32_t number : result->mesh->face_material)
                names.push_back(result->mesh->materials[number].name);
        return names;
    };
    EXPECT_THAT(with("", {"road.png", "wall.new.rgb", "", "road.png"}),
                ElementsAre("road", "wall.new", "", "road"));
    EXPECT_THAT(with("stone", {"road.png", "", "road.png", "wall.png"}),
                ElementsAre("stone", "stone.001", "stone", "stone.002"));
    EXPECT_THAT(with("stone.001", {"road.png", "wall.png"}), ElementsAre("stone.001", "stone.001.001"));
}

TEST_F(ImportScene, PointsAndLinesAreOneWarning) {
    std::string text =
        "AC3Db\nMATERIAL \"m\" rgb 1 1 1 amb 1 1 1 emis 0 0 0 spec 0 0 0 shi 0 trans 0\n"
        "OBJECT world\nkids 3\n";
    const std::string vertices = "OBJECT poly\nnumvert 3\n0 0 0\n1 0 0\n0 1 0\n";
    for (int i = 0; i < 2; ++i)
        text += vertices + "numsurf 1\nSURF 0x22\nmat 0\nrefs 3\n0 0 0\n1 0 0\n2 0 0\nkids 0\n";
    text += vertices + "numsurf 1\nSURF 0x20\nmat 0\nrefs 3\n0 0 0\n1 0 0\n2 0 0\nkids 0\n";
    const auto result = import_as("level.ac", text);
    ASSERT_TRUE(result) << result.error().text();
    EXPECT_EQ(result->mesh->face_count(), 1U);
    ASSERT_EQ(result->warnings.size(), 1U);
    EXPECT_THAT(result->warnings[0].text(), HasSubstr("dropped 4 points and lines of 2 meshes"));
}

TEST_F(ImportScene, BadFilesAreRefused) {
    for (const char* name : {"level.ply", "level.gltf", "level.glb", "level.stl", "level.off", "level.dae"}) {
        for (const std::string_view text :
             {"", "junk", "ply\nformat ascii 1.0\n", "{\"asset\":{}}", "OFF\n1 1 1\n"}) {
            const auto result = import_as(name, text);
            ASSERT_FALSE(result) << name << ": " << text;
            EXPECT_THAT(result.error().location, testing::StartsWith((folder / name).string()));
            EXPECT_FALSE(result.error().message.empty());
        }
    }
    const auto far =
        import_as("far.ply",
                  "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                  "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                  "0 0 0\n0 0 1\n1e20 0 1\n3 0 1 2\n");
    ASSERT_FALSE(far);
    EXPECT_THAT(far.error().message, HasSubstr("vertex 2"));
}

// Memory is taken for what is there, not for what is announced.
TEST_F(ImportScene, MoreElementsThanBytesAreRefused) {
    for (const auto& [name, text] :
         {std::pair("a.off", "OFF\n353535235358 6 0\n0 0 0\n"),
          std::pair("b.off", "OFF 3 4000000000 0\n0 0 0\n"),
          std::pair("c.ply",
                    "ply\nformat ascii 1.0\nelement vertex 3000000000\nproperty float x\nend_header\n"),
          std::pair("d.ply",
                    "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\n"
                    "element face 3000000000\nproperty list uchar int vertex_indices\nend_header\n")}) {
        const auto result = import_as(name, text);
        ASSERT_FALSE(result) << name;
        EXPECT_THAT(result.error().message, HasSubstr("declares")) << name;
    }
}

// A few bytes that stand for a polygon of millions of corners.
TEST_F(ImportScene, APolygonHasNoMoreCornersThanItsMeshAllows) {
    const auto result =
        import_as("level.ply",
                  "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                  "property float z\nelement face 1\nproperty list uint int vertex_indices\nend_header\n"
                  "0 0 0\n0 0 1\n1 0 1\n1 0 0\n3000000 0 1 2 3\n");
    ASSERT_FALSE(result);
    EXPECT_THAT(result.error().message, HasSubstr("corners, but the mesh has 4 vertices"));
}

}  // namespace
}  // namespace slipface
