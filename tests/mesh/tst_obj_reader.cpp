// The OBJ reader's parts are joined as if they were one.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <random>

#include "mesh/mesh_test_tools.h"
#include "slipface/base/text.h"

namespace slipface {
namespace {

using ObjReader = ScratchFolder;

// Large enough for several parts, with every statement, on both sides of their borders.
TEST_F(ObjReader, JoinsItsPartsAsIfTheyWereOne) {
    struct Face {
        std::vector<Vec3f> corners;
        std::string group, material;
    };
    std::mt19937 random(11);
    std::string text = "\xEF\xBB\xBF# made by a test\r\nmtllib none.mtl\r\n", group, material;
    std::vector<Face> faces;
    std::vector<std::size_t> line_of_warning;
    int vertices = 0;
    for (int block = 0; text.size() < (std::size_t{3} << 19); ++block) {
        if (block % 7 == 0) text += "o " + (group = fmt::format("thing {}", block % 21)) + "\n";
        if (block % 5 == 0) text += "usemtl " + (material = fmt::format("stone {}", block % 15)) + "\n";
        if (block % 11 == 0) text += "g\n\n  # a comment \\\n", group = "";
        const int corners = 3 + static_cast<int>(random() % 4);
        std::vector<Vec3f> points;
        for (int i = 0; i < corners; ++i) {
            const auto x = static_cast<float>(random() % 50), y = static_cast<float>(random() % 50);
            points.emplace_back(x, y + 0.25F, static_cast<float>(vertices + i));
            text += fmt::format("v {} {}.25 {}{} 0.5 0.5 0.5\n", x, y, random() % 9 == 0 ? "\\\n" : "",
                                vertices + i);
        }
        vertices += corners;
        text += "vt 0.25 0.75\nvn 0 1 0\ns off\n\tf";
        Face face{.corners = {}, .group = group, .material = material};
        for (int i = 0; i < corners; ++i) {
            const int index = random() % 2 == 0 ? i - corners : vertices - corners + i + 1;
            face.corners.push_back(points[static_cast<std::size_t>(i)]);
            const char* forms[] = {" {}", " {}/-1", " {}//-1", " {}/1/1"};
            text += fmt::format(fmt::runtime(forms[random() % 4]), index);
        }
        faces.push_back(face);
        text += random() % 3 == 0 ? "\r\n" : random() % 2 == 0 ? "  # all\n" : "  \n";
        if (block % 1000 == 0) {
            line_of_warning.push_back(1 + static_cast<std::size_t>(std::ranges::count(text, '\n')));
            text += fmt::format("wobble{} 1 2\n", block);
        }
    }
    const auto imported = import(text);
    ASSERT_TRUE(imported) << imported.error().text();
    const Mesh& mesh = *imported->mesh;
    ASSERT_EQ(mesh.face_count(), faces.size());
    for (FaceId i = 0; i < faces.size(); ++i) {
        std::vector<Vec3f> corners;
        for (std::uint32_t k = mesh.face_first_corner[i]; k < mesh.face_first_corner[i + 1]; ++k)
            corners.push_back(mesh.positions[mesh.corner_vertex[k]]);
        ASSERT_EQ(corners, faces[i].corners) << i;
        ASSERT_EQ(mesh.groups[mesh.face_group[i]], faces[i].group) << i;
        ASSERT_EQ(mesh.materials[mesh.face_material[i]].name, faces[i].material) << i;
    }
    std::vector<std::string> expected{(folder / "level.obj").string() + ":2"};  // no library
    for (const std::size_t line : line_of_warning)
        expected.push_back(fmt::format("{}:{}", (folder / "level.obj").string(), line));
    std::vector<std::string> locations;
    for (const Diagnostic& warning : imported->warnings)
        locations.push_back(warning.location);
    EXPECT_THAT(locations, testing::UnorderedElementsAreArray(expected));
    EXPECT_TRUE(std::is_sorted(line_of_warning.begin(), line_of_warning.end()));
}

// Whatever part is read first, the error is that of the first wrong line.
TEST_F(ObjReader, ReportsTheFirstErrorOfManyParts) {
    std::string text = square_vertices;
    for (int i = 0; i < 200'000; ++i)
        text += i < 60'000 || i % 20'000 != 0 ? "f 1 2 3 4\n" : "f 1 2 99\n";
    const auto imported = import(text);
    ASSERT_FALSE(imported);
    const auto line = 60'001 + std::ranges::count(square_vertices, '\n');
    EXPECT_THAT(imported.error().text(), testing::HasSubstr(fmt::format("level.obj:{}: index 99", line)));
}

TEST_F(ObjReader, StopsWhenItIsCancelled) {
    write("level.obj", square_vertices + "f 1 2 3 4\n");
    Progress progress;
    progress.cancel();
    ImportOptions options;
    options.progress = &progress;
    const auto imported = import_mesh(folder / "level.obj", options);
    ASSERT_FALSE(imported);
    EXPECT_THAT(imported.error().text(), testing::HasSubstr("cancelled"));
}

TEST_F(ObjReader, TurnsAndScalesTheFile) {
    write("level.obj", "v 100 0 0\nv 0 200 0\nv 0 0 300\nf 1 2 3\n");
    ImportOptions options;
    options.transform = {.scale = 0.01, .up = UpAxis::z};
    const auto imported = import_mesh(folder / "level.obj", options);
    ASSERT_TRUE(imported) << imported.error().text();
    EXPECT_EQ(imported->mesh->positions[0], Vec3f(1, 0, 0));
    EXPECT_EQ(imported->mesh->positions[1], Vec3f(0, 0, -2)) << "the file's +Y lies behind";
    EXPECT_EQ(imported->mesh->positions[2], Vec3f(0, 3, 0)) << "the file's +Z is up";
}

}  // namespace
}  // namespace slipface
