// The OBJ reader's numbers are assimp's, bit for bit.
#include <assimp/scene.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <assimp/Importer.hpp>
#include <bit>
#include <random>

#include "mesh/mesh_test_tools.h"
#include "slipface/base/text.h"

namespace slipface {
namespace {

using ObjNumbers = ScratchFolder;

// Every way of writing a number that tools use, random digits behind them.
std::string random_number(std::mt19937& random) {
    const auto below = [&](unsigned count) { return static_cast<unsigned>(random() % count); };
    std::string text = below(2) == 0 ? "-" : "";
    const auto digits = [&](unsigned least, unsigned maximum) {
        for (unsigned i = 0, count = least + below(maximum - least + 1); i < count; ++i)
            text += static_cast<char>('0' + below(10));
    };
    if (below(20) != 0) digits(1, 6);
    if (text.empty() || !std::isdigit(text.back()) || below(4) != 0) {
        text += '.';
        digits(1, below(8) == 0 ? 19 : 8);
    }
    if (below(10) == 0) {
        text += below(2) == 0 ? "e-" : "E-";
        digits(1, 1);
    }
    return text;
}

TEST_F(ObjNumbers, AreReadAsByAssimp) {
    std::mt19937 random(7);
    constexpr int vertices = 6000;
    std::string text, for_assimp;  // which misreads numbers without a digit before the point
    const auto add = [&](const std::string& keyword, int numbers) {
        text += keyword, for_assimp += keyword;
        for (int i = 0; i < numbers; ++i) {
            const std::string number = random_number(random);
            text += " " + number;
            const bool whole = std::isdigit(number[number[0] == '-' ? 1 : 0]) != 0;
            for_assimp += " " + (whole ? number : to_text(*parse_double(number)));
        }
        text += "\n", for_assimp += "\n";
    };
    for (int i = 0; i < vertices; ++i)
        add("v", 3);
    for (int i = 0; i < vertices; ++i)
        add("vt", 2);
    std::string faces;
    for (int i = 1; i + 2 <= vertices; i += 3)
        faces += fmt::format("f {}/{} {}/{} {}/{}\n", i, i, i + 1, i + 1, i + 2, i + 2);
    const auto imported = import(text + faces);
    ASSERT_TRUE(imported) << imported.error().text();
    for_assimp += faces;
    const Mesh& mesh = *imported->mesh;

    Assimp::Importer assimp;
    const aiScene* const scene = assimp.ReadFileFromMemory(for_assimp.data(), for_assimp.size(), 0, "obj");
    ASSERT_NE(scene, nullptr) << assimp.GetErrorString();
    const aiMesh& expected = *scene->mMeshes[0];
    ASSERT_EQ(mesh.corner_vertex.size(), expected.mNumVertices);
    for (unsigned i = 0; i < expected.mNumVertices; ++i) {
        const Vec3f& position = mesh.positions[mesh.corner_vertex[i]];
        const Vec2f& uv = mesh.corner_uv[i];
        const aiVector3D &v = expected.mVertices[i], &vt = expected.mTextureCoords[0][i];
        // Welding makes 0 of -0.
        for (const auto& [read, wanted] :
             {std::pair(position.x(), v.x + 0.0F), std::pair(position.y(), v.y + 0.0F),
              std::pair(position.z(), v.z + 0.0F), std::pair(uv.x(), vt.x), std::pair(uv.y(), vt.y)})
            ASSERT_EQ(std::bit_cast<std::uint32_t>(read), std::bit_cast<std::uint32_t>(wanted)) << i;
    }
}

}  // namespace
}  // namespace slipface
