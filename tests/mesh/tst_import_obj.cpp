#include <fmt/format.h>
#include <gmock/gmock.h>

#include <clocale>
#include <cmath>
#include <random>

#include "mesh_test_tools.h"

namespace slipface {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class ImportObj : public ScratchFolder {
  protected:
    // The mesh of a text that must be fine.
    MeshPtr mesh_of(std::string_view text) {
        auto result = import(text);
        if (!result) {
            ADD_FAILURE() << result.error().text();
            return std::make_shared<Mesh>();
        }
        warnings = result->warnings;
        return result->mesh;
    }

    static std::vector<Vec3f> corners_of(const Mesh& mesh, FaceId face) {
        std::vector<Vec3f> corners;
        for (std::uint32_t c = mesh.face_first_corner[face]; c < mesh.face_first_corner[face + 1]; ++c) {
            corners.push_back(mesh.corner_position(c));
        }
        return corners;
    }

    static std::vector<std::string> material_names(const Mesh& mesh) {
        std::vector<std::string> names;
        for (const std::uint32_t material : mesh.face_material)
            names.push_back(mesh.materials[material].name);
        return names;
    }

    static std::vector<std::string> group_names(const Mesh& mesh) {
        std::vector<std::string> names;
        for (const std::uint32_t group : mesh.face_group)
            names.push_back(mesh.groups[group]);
        return names;
    }

    Warnings warnings;
};

TEST_F(ImportObj, PolygonsStayFaces) {
    const MeshPtr mesh = mesh_of("v 0 0 0\nv 0 0 1\nv 1 0 1\nv 1 0 0\nv 0.5 0 -1\nf 1 2 3 4 5\nf 1 2 3\n");
    ASSERT_EQ(mesh->face_count(), 2U);
    EXPECT_EQ(mesh->face_corner_count(0), 5U);
    EXPECT_EQ(mesh->face_corner_count(1), 3U);
    EXPECT_EQ(mesh->triangle_count(), 4U);
    EXPECT_THAT(mesh->triangle_face, ElementsAre(0, 0, 0, 1));
    EXPECT_THAT(mesh->face_first_triangle, ElementsAre(0, 3, 4));
    EXPECT_THAT(mesh->positions, SizeIs(5));
    EXPECT_THAT(corners_of(*mesh, 1), ElementsAre(Vec3f(0, 0, 0), Vec3f(0, 0, 1), Vec3f(1, 0, 1)));
    EXPECT_EQ(mesh->bounds.min, Vec3(0, 0, -1));
    EXPECT_EQ(mesh->bounds.max, Vec3(1, 0, 1));
    EXPECT_THAT(warnings, IsEmpty());
}

TEST_F(ImportObj, EveryFormOfCorner) {
    const std::string head = square_vertices + "vt 0.25 0.75\nvt 1 1\nvt 0 1\nvn 0 1 0\n";
    for (const char* face :
         {"f 1 2 3", "f 1/1 2/2 3/3", "f 1//1 2//1 3//1", "f 1/1/1 2/2/1 3/3/1", "f -4 -3 -2",
          "f -4/-3/-1 -3/-2/-1 -2/-1/-1", "f\t1\t2  3\t", "  f 1 2 3 # comment"}) {
        const MeshPtr mesh = mesh_of(head + face);
        ASSERT_EQ(mesh->face_count(), 1U) << face;
        EXPECT_THAT(corners_of(*mesh, 0), ElementsAre(Vec3f(0, 0, 0), Vec3f(0, 0, 1), Vec3f(1, 0, 1)))
            << face;
        const bool has_uv = std::string_view(face).find("/1") != std::string_view::npos &&
                            std::string_view(face).find("//") == std::string_view::npos;
        const bool negative_uv = std::string_view(face).find("/-3") != std::string_view::npos;
        const Vec2f uv = has_uv || negative_uv ? Vec2f(0.25F, 0.75F) : Vec2f(0, 0);
        EXPECT_EQ(mesh->corner_uv[0], uv) << face;
    }
}

TEST_F(ImportObj, CornersWithAndWithoutTextureCoordinatesMix) {
    const MeshPtr mesh = mesh_of(square_vertices + "vt 0.5 0.25\nf 1/1 2 3/1\nf 1 3 4\nf 1 3/1 4\n");
    ASSERT_EQ(mesh->face_count(), 3U);
    const Vec2f uv(0.5F, 0.25F);
    const Vec2f none(0, 0);
    EXPECT_THAT(mesh->corner_uv, ElementsAre(uv, none, uv, none, none, none, none, uv, none));
}

TEST_F(ImportObj, LineEndsContinuationsAndByteOrderMark) {
    const std::string plain = square_vertices + "usemtl ice\nf 1 2 3 4\n";
    std::string crlf;
    std::string cr;
    for (const char c : plain) {
        crlf += c == '\n' ? "\r\n" : std::string(1, c);
        cr += c == '\n' ? '\r' : c;
    }
    const std::string continued =
        "v 0 0 \\\n0\nv 0 0 1\nv 1 \\\r\n 0 \\\r\n 1\nv 1 0 0\nusemtl ice\nf 1 2 \\\n3 4";
    const std::uint64_t fingerprint = mesh_of(plain)->fingerprint;
    EXPECT_NE(fingerprint, 0U);
    EXPECT_EQ(mesh_of(crlf)->fingerprint, fingerprint);
    EXPECT_EQ(mesh_of(cr)->fingerprint, fingerprint);
    EXPECT_EQ(mesh_of("\xEF\xBB\xBF" + plain)->fingerprint, fingerprint);
    EXPECT_EQ(mesh_of(continued)->fingerprint, fingerprint);
    EXPECT_EQ(mesh_of(plain.substr(0, plain.size() - 1))->fingerprint, fingerprint);
    EXPECT_NE(mesh_of(square_vertices + "usemtl ice\nf 1 2 3\n")->fingerprint, fingerprint);
    EXPECT_NE(mesh_of(square_vertices + "usemtl mud\nf 1 2 3 4\n")->fingerprint, fingerprint);
}

// A Windows path at the end of a comment must not swallow the vertex behind it.
TEST_F(ImportObj, CommentsAreNotContinued) {
    const MeshPtr mesh = mesh_of("# exported from C:\\levels\\\n" + square_vertices + "f 1 2 3 4\n");
    EXPECT_EQ(mesh->positions.size(), 4U);
}

TEST_F(ImportObj, LineNumbersCountContinuedLines) {
    const auto result = import("v 0 0 \\\n0\n# c\nv 0 0 1\nv 1 0 x\nf 1 2 3\n");
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().location, location() + ":5");
}

TEST_F(ImportObj, FacesMayComeBeforeTheirVertices) {
    const MeshPtr mesh = mesh_of("f 1/1 2/1 3/1\n" + square_vertices + "vt 0.5 0.5\n");
    ASSERT_EQ(mesh->face_count(), 1U);
    EXPECT_EQ(mesh->corner_uv[2], Vec2f(0.5F, 0.5F));
}

// Three texts whose faces other readers have lost: groups behind materials, materials behind groups, both
// without faces.
TEST_F(ImportObj, NoOrderOfMaterialGroupAndObjectLosesFaces) {
    const std::string faces[] = {"f 1 2 3\n", "f 1 3 4\n", "f 1 2 4\n", "f 2 3 4\n"};
    const MeshPtr groups_last =
        mesh_of(square_vertices + "usemtl a\ng one\n" + faces[0] + "usemtl b\ng two\n" + faces[1] +
                "g three\n" + faces[2] + "usemtl a\n" + faces[3]);
    EXPECT_THAT(material_names(*groups_last), ElementsAre("a", "b", "b", "a"));
    EXPECT_THAT(group_names(*groups_last), ElementsAre("one", "two", "three", "three"));

    const MeshPtr groups_first =
        mesh_of("o box\n" + square_vertices + "g one\nusemtl a\n" + faces[0] + faces[1] +
                "o other\nusemtl b\n" + faces[2] + "usemtl c\n" + "o box\n" + faces[3]);
    EXPECT_THAT(material_names(*groups_first), ElementsAre("a", "a", "b", "c"));
    EXPECT_THAT(group_names(*groups_first), ElementsAre("one", "one", "other", "box"));

    const MeshPtr empty_runs =
        mesh_of(square_vertices + faces[0] + "usemtl a\nusemtl b\ng x\ng y\no z\n" + faces[1] +
                "g\nusemtl a\n" + faces[2] + "usemtl\n" + faces[3] + "usemtl unused\ng unused\n");
    EXPECT_THAT(material_names(*empty_runs), ElementsAre("", "b", "a", ""));
    EXPECT_THAT(group_names(*empty_runs), ElementsAre("", "z", "", ""));
    EXPECT_THAT(empty_runs->materials, SizeIs(3)) << "materials without faces are not kept";
    EXPECT_THAT(empty_runs->groups, SizeIs(2));
    for (const MeshPtr& mesh : {groups_last, groups_first, empty_runs}) {
        ASSERT_EQ(mesh->face_count(), 4U);
        EXPECT_EQ(corners_of(*mesh, 3)[0], Vec3f(0, 0, 1)) << "the file's order";
    }
}

TEST_F(ImportObj, NamesKeepSpacesAndBecomeUtf8) {
    const MeshPtr mesh =
        mesh_of(square_vertices + "g  left wall \nusemtl blue ice \nf 1 2 3\nusemtl b\xE9ton\nf 1 3 4\n");
    EXPECT_THAT(material_names(*mesh), ElementsAre("blue ice", "b\xC3\xA9ton"));
    EXPECT_THAT(group_names(*mesh), ElementsAre("left wall", "left wall"));
    ASSERT_THAT(warnings, SizeIs(1));
    EXPECT_EQ(warnings[0].location, location() + ":8");
    EXPECT_THAT(warnings[0].message, HasSubstr("Latin-1"));
}

TEST_F(ImportObj, EqualPositionsAreOneVertex) {
    // Two triangles with vertices of their own, one of them with -0.
    const MeshPtr mesh =
        mesh_of("v 0 0 0\nv 0 0 1\nv 1 0 1\nv -0 0 -0.0\nv 1.0 0 1.000\nv 1 0 0\nf 1 2 3\nf 4 5 6\n");
    EXPECT_EQ(mesh->positions.size(), 4U);
    EXPECT_THAT(mesh->corner_vertex, ElementsAre(0, 1, 2, 0, 2, 3));
    EXPECT_FALSE(std::signbit(mesh->positions[0].x()));
}

// Each coordinate is read within one unit in the last place of a float.
TEST_F(ImportObj, CoordinatesKeepTheirPrecision) {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> uniform(-1000.0F, 1000.0F);
    std::vector<float> written;
    std::string text;
    for (int i = 0; i < 3000; ++i) {
        text += "v";
        for (int axis = 0; axis < 3; ++axis) {
            written.push_back(uniform(random));
            text += fmt::format(" {}", written.back());
        }
        text += "\n";
    }
    for (int i = 0; i < 1000; ++i) {
        text += fmt::format("f {} {} {}\n", 3 * i + 1, 3 * i + 2, 3 * i + 3);
    }
    const MeshPtr mesh = mesh_of(text);
    ASSERT_EQ(mesh->positions.size(), 3000U);
    for (std::size_t i = 0; i < written.size(); ++i) {
        const float read = mesh->positions[i / 3][static_cast<Eigen::Index>(i % 3)];
        ASSERT_GE(read, std::nextafter(written[i], -2000.0F));
        ASSERT_LE(read, std::nextafter(written[i], 2000.0F));
    }
}

TEST_F(ImportObj, NumbersInEverySpelling) {
    const std::string zeros(5000, '0');
    const MeshPtr mesh =
        mesh_of("v +1 .5 5.\nv -.5 1e1 1E-1\nv 1e-400 0." + zeros + "1 " + zeros + "2\nf 1 2 3\n");
    EXPECT_EQ(mesh->positions[0], Vec3f(1, 0.5F, 5));
    EXPECT_EQ(mesh->positions[1], Vec3f(-0.5F, 10, 0.1F));
    EXPECT_EQ(mesh->positions[2], Vec3f(0, 0, 2));
}

TEST_F(ImportObj, ColorsAndWeightsBehindCoordinatesAreIgnored) {
    const MeshPtr mesh =
        mesh_of("v 1 2 3 0.5\nv 0 0 1 1 0 0\nv 1 0 1\nvt 0.5\nvt 0.25 0.5 0.75\nf 1/1 2/2 3/2\n");
    EXPECT_EQ(mesh->positions[0], Vec3f(1, 2, 3));
    EXPECT_EQ(mesh->corner_uv[0], Vec2f(0.5F, 0));
    EXPECT_EQ(mesh->corner_uv[1], Vec2f(0.25F, 0.5F));
}

TEST_F(ImportObj, WhatIsDroppedIsSaid) {
    const MeshPtr mesh =
        mesh_of(square_vertices +
                "l 1 2\np 1\nwobble 3\nf 1 2\nf 1 2 1\nf 1 2 1 2 1\nvt nan 1\nf 1/1 2/1 3/1\ns off\n");
    EXPECT_EQ(mesh->face_count(), 1U);
    EXPECT_EQ(mesh->corner_uv[0], Vec2f(0, 1));
    const std::pair<int, const char*> expected[] = {{5, "lines"},
                                                    {6, "points"},
                                                    {7, "'wobble'"},
                                                    {8, "fewer than three"},
                                                    {11, "texture coordinate 'nan'"}};
    ASSERT_THAT(warnings, SizeIs(5));
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(warnings[i].location, location() + ":" + std::to_string(expected[i].first));
        EXPECT_THAT(warnings[i].message, HasSubstr(expected[i].second));
    }
    EXPECT_THAT(warnings[3].message, HasSubstr("; 2 more of these"));
}

TEST_F(ImportObj, WarningsAreCountedBeyondTheLimit) {
    std::string text = square_vertices + "f 1 2 3\n";
    for (int i = 0; i < 50; ++i)
        text += fmt::format("wobble{}\n", i);
    const auto result = import(text, 10);
    ASSERT_TRUE(result);
    ASSERT_THAT(result->warnings, SizeIs(11));
    EXPECT_EQ(result->warnings[10].text(), location() + ": 40 more warnings");
}

TEST_F(ImportObj, EqualWarningsAreOne) {
    std::string text = square_vertices + "f 1 2 3\nl 1 2\np 1\n";
    for (int i = 0; i < 100'000; ++i)  // enough for several parts, which are read side by side
        text += "l 1 2\n";
    const auto result = import(text + "wobble\n", 10);
    ASSERT_TRUE(result);
    ASSERT_THAT(result->warnings, SizeIs(3));
    EXPECT_EQ(result->warnings[0].text(),
              location() + ":6: lines are no surface: dropped; 100000 more of these");
    EXPECT_EQ(result->warnings[1].text(), location() + ":7: points are no surface: dropped");
    EXPECT_THAT(result->warnings[2].text(), HasSubstr(":100008: unknown keyword 'wobble'"));
}

TEST_F(ImportObj, EveryTriangleOfAManyCorneredFaceBelongsToIt) {
    std::string text;
    std::string face = "f";
    for (int i = 0; i < 3000; ++i) {  // beyond the limit of ear clipping
        text += fmt::format("v {} 0 {}\n", std::cos(i * 0.002), -std::sin(i * 0.002));
        face += fmt::format(" {}", i + 1);
    }
    const MeshPtr mesh = mesh_of(text + face);
    EXPECT_EQ(mesh->face_count(), 1U);
    EXPECT_EQ(mesh->triangle_count(), 2998U);
}

TEST_F(ImportObj, NothingDependsOnTheLocale) {
    const std::string before = std::setlocale(LC_ALL, nullptr);
    for (const char* locale : {"de_DE.UTF-8", "fr_FR.UTF-8"})
        (void)std::setlocale(LC_ALL, locale);
    EXPECT_EQ(mesh_of("v 0.5 0 0\nv 0 0 1\nv 1 0 1\nf 1 2 3\n")->positions[0], Vec3f(0.5F, 0, 0));
    std::setlocale(LC_ALL, before.c_str());
}

}  // namespace
}  // namespace slipface
