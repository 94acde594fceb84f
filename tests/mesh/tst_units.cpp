// Whether files arrive upright and in metres, whatever their unit and axes: each case is one shape, written
// in the coordinates of a made-up modelling tool.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "mesh/mesh_test_tools.h"
#include "slipface/mesh/size_doubt.h"
#include "slipface/mesh/up_doubt.h"

namespace slipface {
namespace {

using testing::HasSubstr;

// A triangle without symmetry, in metres, +Y up.
const std::array<Vec3, 3> shape{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.25, 2, 0.5)};

std::string numbers(const std::array<Vec3, 3>& points) {
    std::string text;
    for (const Vec3& p : points)
        for (const double x : p)
            text += (text.empty() ? "" : ",") + fmt::format("{:.9g}", x);
    return text;
}

class Units : public ScratchFolder {
  protected:
    Result<ImportedMesh> import_as(const std::string& name, std::string_view text,
                                   const ImportTransform& how = {}) const {
        write(name, text);
        ImportOptions options;
        options.transform = how;
        return import_mesh(folder / name, options);
    }
};

// Whether the mesh has the corners of the shape, in any order.
void expect_shape(const Result<ImportedMesh>& imported, const std::string& what) {
    ASSERT_TRUE(imported) << what << ": " << imported.error().text();
    ASSERT_EQ(imported->mesh->positions.size(), 3u) << what;
    for (const Vec3& corner : shape) {
        double nearest = 1e9;
        for (const Vec3f& p : imported->mesh->positions)
            nearest = std::min(nearest, (p.cast<double>() - corner).norm());
        EXPECT_LT(nearest, 1e-5) << what;
    }
}

std::string fbx(const std::string& settings, const std::array<Vec3, 3>& points) {
    return "; FBX 7.3.0 project file\nFBXHeaderExtension:  {\n\tFBXHeaderVersion: 1003\n\tFBXVersion: "
           "7300\n}\n"
           "GlobalSettings:  {\n\tVersion: 1000\n\tProperties70:  {\n" +
           settings +
           "\t}\n}\nObjects:  {\n\tGeometry: 1, \"Geometry::mesh\", \"Mesh\" {\n\t\tVertices: *9 "
           "{\n\t\t\ta: " +
           numbers(points) +
           "\n\t\t}\n\t\tPolygonVertexIndex: *3 {\n\t\t\ta: 0,1,-3\n\t\t}\n\t}\n"
           "\tModel: 2, \"Model::shape\", \"Mesh\" {\n\t\tVersion: 232\n\t\tProperties70:  {\n\t\t}\n\t}\n}\n"
           "Connections:  {\n\tC: \"OO\",2,0\n\tC: \"OO\",1,2\n}\n";
}

std::string fbx_number(const char* name, const char* type, double value) {
    return fmt::format("\t\tP: \"{}\", \"{}\", \"{}\", \"\",{:.9g}\n", name, type,
                       std::string_view(type) == "int" ? "Integer" : "Number", value);
}

TEST_F(Units, FbxOfAnyAxesAndUnit) {
    int cases = 0;
    for (int up = 0; up < 3; ++up) {
        for (int front = 0; front < 3; ++front) {
            if (front == up) continue;
            for (int signs = 0; signs < 8; ++signs) {
                const int right = 3 - up - front;
                const double up_sign = (signs & 1) ? -1 : 1, front_sign = (signs & 2) ? -1 : 1,
                             right_sign = (signs & 4) ? -1 : 1;
                const double unit = std::array{1.0, 100.0, 2.54, 30.48,
                                               0.1}[static_cast<std::size_t>(cases++ % 5)];  // centimetres
                std::array<Vec3, 3> points;
                for (std::size_t i = 0; i < 3; ++i) {
                    points[i][right] = right_sign * shape[i].x();
                    points[i][up] = up_sign * shape[i].y();
                    points[i][front] = front_sign * shape[i].z();
                    points[i] *= 100.0 / unit;
                }
                const std::string settings =
                    fbx_number("UpAxis", "int", up) + fbx_number("UpAxisSign", "int", up_sign) +
                    fbx_number("FrontAxis", "int", front) + fbx_number("FrontAxisSign", "int", front_sign) +
                    fbx_number("CoordAxis", "int", right) + fbx_number("CoordAxisSign", "int", right_sign) +
                    fbx_number("UnitScaleFactor", "double", unit);
                const auto imported = import_as("shape.fbx", fbx(settings, points));
                expect_shape(imported,
                             fmt::format("up {} front {} signs {} unit {}", up, front, signs, unit));
                ASSERT_TRUE(imported);
                EXPECT_EQ(imported->summary.scale_from, ImportSource::declared);
                EXPECT_EQ(imported->summary.up_from, ImportSource::declared);
                EXPECT_NEAR(imported->summary.scale, unit / 100, 1e-7);
            }
        }
    }
    EXPECT_EQ(cases, 48);
}

TEST_F(Units, FbxWithoutSettingsIsInCentimetres) {
    std::array<Vec3, 3> points = shape;
    for (Vec3& p : points)
        p *= 100;
    const auto imported = import_as("shape.fbx", fbx("", points));
    expect_shape(imported, "no settings");
}

std::string collada(const std::string& asset, const std::array<Vec3, 3>& points) {
    std::string coordinates = numbers(points);
    std::replace(coordinates.begin(), coordinates.end(), ',', ' ');
    return R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset>)" +
           asset + R"(</asset><library_geometries><geometry id="g" name="g"><mesh>
<source id="p"><float_array id="pa" count="9">)" +
           coordinates + R"(</float_array><technique_common><accessor source="#pa" count="3" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor>
</technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry>
</library_geometries><library_visual_scenes><visual_scene id="s"><node id="n" name="n">
<instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

TEST_F(Units, ColladaOfAnyAxisAndUnit) {
    for (const double unit : {1.0, 0.01, 0.0254, 0.3048}) {
        for (const char axis : {'X', 'Y', 'Z'}) {
            std::array<Vec3, 3> points = shape;
            for (Vec3& p : points) {
                // COLLADA 1.4: with X_UP right is -Y and in is +Z; with Z_UP right is +X and in is -Y.
                if (axis == 'X') p = Vec3(p.y(), -p.x(), p.z());
                if (axis == 'Z') p = Vec3(p.x(), -p.z(), p.y());
                p /= unit;
            }
            const auto imported = import_as(
                "shape.dae",
                collada(
                    fmt::format("<unit name=\"u\" meter=\"{:.9g}\"/><!-- <up_axis>Y_UP --><up_axis> {}_UP "
                                "</up_axis>",
                                unit, axis),
                    points));
            expect_shape(imported, fmt::format("{} {}", axis, unit));
            ASSERT_TRUE(imported);
            EXPECT_EQ(imported->summary.scale_from, ImportSource::declared);
            EXPECT_EQ(imported->summary.up_from, ImportSource::declared);
        }
    }
    const auto bare = import_as("bare.dae", collada("", shape));
    expect_shape(bare, "without unit and axis");
    EXPECT_EQ(bare->summary.up_from, ImportSource::guessed);
}

TEST_F(Units, WhatHasNoAxisIsGuessedAndCanBeChanged) {
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0.25 -0.5 2\n3 0 "
        "1 2\n";
    const auto guessed = import_as("shape.ply", ply);
    expect_shape(guessed, "PLY as Blender writes it");
    EXPECT_EQ(guessed->summary.up_from, ImportSource::guessed);
    const auto given = import_as("shape.ply", ply, {.scale = 10.0, .up = UpAxis::y});
    ASSERT_TRUE(given);
    EXPECT_TRUE(given->summary.size.isApprox(Vec3(10, 5, 20)));
    EXPECT_EQ(given->summary.up_from, ImportSource::given);
    EXPECT_EQ(given->summary.scale_from, ImportSource::given);
}

// Every choice of axis is a rotation that brings that axis up.
TEST_F(Units, EveryAxisCanBeUp) {
    for (int axis = 0; axis < 6; ++axis) {
        const std::string_view name = up_axis_names[static_cast<std::size_t>(axis)];
        const int coordinate = name.back() - 'x';
        Vec3 top = Vec3::Zero(), right = Vec3::Zero();
        top[coordinate] = name.front() == '-' ? -3 : 3;
        right[(coordinate + 1) % 3] = 1;
        const auto imported = import_as("level.obj",
                                        fmt::format("v 0 0 0\nv {} {} {}\nv {} {} {}\nf 1 2 3\n", top.x(),
                                                    top.y(), top.z(), right.x(), right.y(), right.z()),
                                        {.scale = {}, .up = static_cast<UpAxis>(axis)});
        ASSERT_TRUE(imported);
        const auto& p = imported->mesh->positions;
        EXPECT_EQ(p[1], Vec3f(0, 3, 0)) << name;
        // Not mirrored: the triangle's normal turns with it.
        const Vec3 normal = top.cross(right) / 3;
        const Vec3 turned = p[1].cross(p[2]).cast<double>() / 3;
        EXPECT_EQ(turned.norm(), normal.norm()) << name;
        EXPECT_EQ(p[2].y(), 0.0F) << name;
    }
}

TEST_F(Units, AScaleOutOfRangeIsRefused) {
    const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    for (const double scale : {0.0, -1.0, 1e-7, 1e7, std::nan(""), HUGE_VAL}) {
        const auto imported = import_as("level.obj", obj, {.scale = scale, .up = {}});
        ASSERT_FALSE(imported) << scale;
        EXPECT_THAT(imported.error().message, HasSubstr("out of range"));
    }
}

// What a level file could not hold is not read either.
TEST_F(Units, PositionsBeyondALevelFileAreRefused) {
    for (const double metres : {9e7, 1.1e8, 1e13}) {
        for (const double scale : {metres / 9e6, metres / 1e7}) {
            if (scale > largest_import_scale) continue;
            const std::string obj = fmt::format("v 0 0 0\nv 0 0 1\nv {} 0 0\nf 1 2 3\n", metres / scale);
            const auto imported = import_as("level.obj", obj, {.scale = scale, .up = {}});
            ASSERT_EQ(imported.ok(), metres < 1e8) << metres;
            if (!imported) {
                EXPECT_THAT(imported.error().message, HasSubstr("expected at most 1e+08 m"));
            }
        }
    }
}

TEST_F(Units, ImplausibleSizesAreDoubted) {
    const auto box = [&](double size, const ImportTransform& how = {}) {
        std::string text;
        for (int i = 0; i < 8; ++i)
            text += fmt::format("v {} {} {}\n", i & 1 ? size : 0, i & 2 ? size : 0, i & 4 ? size : 0);
        text += "f 1 2 4 3\nf 5 6 8 7\nf 1 2 6 5\nf 3 4 8 7\nf 1 3 7 5\nf 2 4 8 6\n";
        return import_as("level.obj", text, how);
    };
    for (const double size : {2.0, 10.0, 60.0, 99.0}) {
        const auto imported = box(size);
        ASSERT_TRUE(imported);
        EXPECT_FALSE(size_doubt(*imported->mesh, imported->summary)) << size;
    }
    for (const double size : {0.001, 0.06, 1.0, 200.0, 1856.0, 6000.0, 60000.0}) {
        const auto imported = box(size);
        ASSERT_TRUE(imported);
        const auto doubt = size_doubt(*imported->mesh, imported->summary);
        ASSERT_TRUE(doubt) << size;
        EXPECT_EQ(doubt->too_large, size > 60);
        const auto better = box(size, {.scale = doubt->better_scale, .up = {}});
        ASSERT_TRUE(better);
        EXPECT_GT(better->summary.size.x(), size < 0.01 ? 0.9 : 10.0) << size;
        EXPECT_LT(better->summary.size.x(), 400.0) << size;
        EXPECT_FALSE(size_doubt(*better->mesh, better->summary)) << "what the user gives is not doubted";
    }
    EXPECT_NEAR(size_doubt(*box(1856.0)->mesh, box(1856.0)->summary)->better_scale, 1.0 / 32, 1e-9);
}

TEST_F(Units, AWallInAFormatWithAFixedAxisIsNotDoubted) {
    std::mt19937 random(20261128);
    for (int i = 0; i < 20; ++i) {
        const int width = static_cast<int>(4 + random() % 40), height = static_cast<int>(3 + random() % 20);
        const std::string ac =
            "AC3Db\nMATERIAL \"m\" rgb 1 1 1 amb 1 1 1 emis 0 0 0 spec 0 0 0 shi 0 trans 0\n"
            "OBJECT world\nkids 1\nOBJECT poly\nnumvert 4\n" +
            fmt::format("0 0 0\n{0} 0 0\n{0} {1} 0\n0 {1} 0\n", width, height) +
            "numsurf 1\nSURF 0x0\nmat 0\nrefs 4\n0 0 0\n1 0 0\n2 0 0\n3 0 0\nkids 0\n";
        const auto imported = import_as("wall.ac", ac);
        ASSERT_TRUE(imported) << imported.error().text();
        EXPECT_EQ(imported->summary.up_from, ImportSource::declared);
        EXPECT_NEAR(imported->summary.size.y(), height, 1e-4);
        EXPECT_FALSE(up_doubt(*imported->mesh, imported->summary));
    }
}

// Rooms of random sizes with crates in them, upright along each axis.
TEST_F(Units, LevelsThatLieOnTheirSideAreDoubted) {
    std::mt19937 random(20261126);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    for (int i = 0; i < 20; ++i) {
        std::vector<Vec3> corners;  // +Y up
        const auto add_box = [&](const Vec3& min, const Vec3& size) {
            for (int corner = 0; corner < 8; ++corner)
                corners.push_back(min +
                                  size.cwiseProduct(Vec3(corner & 1, corner >> 1 & 1, corner >> 2 & 1)));
        };
        const Vec3 room(between(10, 60), between(2.5, 5), between(10, 60));
        add_box(Vec3::Zero(), room);
        for (int crate = static_cast<int>(between(0, 12)); crate > 0; --crate)
            add_box(Vec3(between(1, 8), 0, between(1, 8)),
                    Vec3(between(0.5, 1), between(0.5, 2), between(0.5, 1)));
        const auto import_turned = [&](int axis, const ImportTransform& how) {
            std::string text;
            for (const Vec3& p : corners)
                text += fmt::format("v {} {} {}\n", p[(4 - axis) % 3], p[(5 - axis) % 3], p[(6 - axis) % 3]);
            for (std::size_t first = 1; first < corners.size(); first += 8)
                for (const char* face : {"0 1 3 2", "4 5 7 6", "0 1 5 4", "2 3 7 6", "0 2 6 4", "1 3 7 5"}) {
                    text += "f";
                    for (const char* digit = face; *digit != 0; digit += digit[1] == 0 ? 1 : 2)
                        text += fmt::format(" {}", first + static_cast<std::size_t>(*digit - '0'));
                    text += "\n";
                }
            auto imported = import_as("level.obj", text, how);
            EXPECT_TRUE(imported);
            return up_doubt(*imported->mesh, imported->summary);
        };
        constexpr UpAxis axes[] = {UpAxis::x, UpAxis::y, UpAxis::z};
        for (int axis = 0; axis < 3; ++axis) {
            SCOPED_TRACE(fmt::format("room {}, up along axis {}", i, axis));
            const auto doubt = import_turned(axis, {});
            EXPECT_EQ(doubt.has_value(), axis != 1);
            EXPECT_EQ(doubt ? doubt->better_up : UpAxis::y, axes[axis]);
            EXPECT_FALSE(import_turned(axis, {.scale = {}, .up = axes[axis]}))
                << "what the user gives is not doubted";
        }
    }
}

}  // namespace
}  // namespace slipface
