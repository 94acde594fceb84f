#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <random>

#include "mesh_test_tools.h"
#include "slipface/mesh/formats.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr std::uint64_t four_gigabytes = std::uint64_t{4} << 30;

class ImportHostile : public ScratchFolder {
  protected:
    void expect_refused(std::string_view text, int line, const std::string& message) {
        const auto result = import(text);
        ASSERT_FALSE(result) << text.substr(0, 200);
        EXPECT_EQ(result.error().location, line > 0 ? location() + ":" + std::to_string(line) : location());
        EXPECT_THAT(result.error().message, HasSubstr(message));
    }

    static double seconds_since(std::chrono::steady_clock::time_point start) {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
};

TEST_F(ImportHostile, WhatIsNoObjFile) {
    expect_refused("", 0, "is empty");
    expect_refused("\n\n", 0, "no faces");
    expect_refused("# only\nv 0 0 0\n", 0, "no faces");
    expect_refused("hello\nworld\n", 0, "no faces");
    expect_refused(std::string_view("v 0 0 0\nv 0\0 0 0\n", 17), 2, "byte 0x00 is not text");
    expect_refused(
        "v 0 0 0\n\x7f"
        "ELF\x02\x01\x01\n",
        2, "byte 0x02 is not text");

    const auto missing = import_mesh(folder / "no.obj");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().text(), (folder / "no.obj").string() + ": no such file");

    fs::create_directory(folder / "folder.obj");
    const auto directory = import_mesh(folder / "folder.obj");
    ASSERT_FALSE(directory);
    EXPECT_THAT(directory.error().message, HasSubstr("directory"));

    write("level.txt", square_vertices + "f 1 2 3\n");
    const auto ending = import_mesh(folder / "level.txt");
    ASSERT_FALSE(ending);
    EXPECT_THAT(ending.error().message, HasSubstr("'txt'"));
    const auto blend = import_mesh(folder / "Level.BLEND");
    ASSERT_FALSE(blend);
    EXPECT_THAT(blend.error().message, HasSubstr("export it from there"));
}

TEST_F(ImportHostile, CoordinatesOutOfRange) {
    expect_refused("v 0 0 0\nv 0 nan 0\nv 1 0 0\nf 1 2 3\n", 2, "'nan' is out of range");
    expect_refused("v 0 0 0\nv 0 0 -inf\nv 1 0 0\nf 1 2 3\n", 2, "'-inf' is out of range");
    expect_refused("v 0 0 0\nv 1e38 0 0\nv 1 0 0\nf 1 2 3\n", 2, "'1e38' is out of range");
    expect_refused("v 0 0 0\nv 1e999 0 0\nv 1 0 0\nf 1 2 3\n", 2, "'1e999' is out of range");
    expect_refused("v 10000001 0 0\n", 1, "expected -1e+07 to 1e+07");
    EXPECT_TRUE(import("v 1e7 0 0\nv -1e7 0 0\nv 0 0 1e7\nf 1 2 3\n"));
    expect_refused("v 1,5 0 0\n", 1, "'1,5' is no number");
    expect_refused("v 1.#QNAN 0 0\n", 1, "is no number");
    expect_refused("v 0 0\n", 1, "found 2 coordinates, expected 3");
    expect_refused("v 1 # 2 3\n", 1, "found 1 coordinates");
    expect_refused(fmt::format("v {:9<100000} 0 0\n", ""), 1, "out of range");
}

TEST_F(ImportHostile, IndicesOutOfRange) {
    const std::string head = square_vertices + "vt 0 0\nvn 0 1 0\n";  // six lines
    expect_refused(head + "f 1 2 5\n", 7, "index 5 is out of range; expected 1 to 4");
    expect_refused(head + "f 1 2 0\n", 7, "index 0 is out of range");
    expect_refused(head + "f 1 2 -5\n", 7, "index -5 is out of range");
    expect_refused(head + "f 1 2 99999999999999999999\n", 7, "index 99999999999999999999 is out of range");
    expect_refused(head + "f 1 2 4294967297\n", 7, "out of range");
    expect_refused("f 1 2 3\n", 1, "expected 1 to 0");
    // A face may stand before its vertices, but they must come.
    expect_refused("f 1 2 5\n" + head, 1, "index 5 is out of range");
}

TEST_F(ImportHostile, MalformedCorners) {
    EXPECT_TRUE(import(square_vertices + "f 1/ 2// 3\n")) << "empty texture and normal indices are harmless";
    for (const char* corner : {"x", "1.5", "/1", "--1", "+1"}) {
        const auto result = import(square_vertices + "vt 0 0\nf 1 2 " + corner + "\n");
        ASSERT_FALSE(result) << corner;
        EXPECT_EQ(result.error().location, location() + ":6");
    }
}

// One bad reference costs its normal or its texture coordinate, not the level: warned of once, at the first.
TEST_F(ImportHostile, CornersDoWithoutNormalsAndTextureCoordinates) {
    std::mt19937 random(17);
    const char* const bad[] = {"9", "0", "-7", "x", "99999999999999999999", "1x", "-"};
    for (int round = 0; round < 300; ++round) {
        std::string text = square_vertices + "vt 0.5 0.25\nvn 0 1 0\n";
        int bad_vt = 0, bad_vn = 0, first_vt = 0, first_vn = 0;
        std::vector<Vec2f> expected;
        for (int face = 0; face < 4; ++face) {
            text += "f";
            for (int corner = 1; corner <= 3; ++corner) {
                const bool vt_is_bad = random() % 3 == 0, vn_is_bad = random() % 3 == 0;
                const bool has_vt = random() % 4 != 0, has_vn = random() % 4 != 0;
                text += fmt::format(" {}", random() % 2 == 0 ? corner : corner - 5);
                if (has_vt || has_vn) text += "/";
                if (has_vt) text += vt_is_bad ? bad[random() % std::size(bad)] : "1";
                if (has_vn) text += std::string("/") + (vn_is_bad ? bad[random() % std::size(bad)] : "-1");
                if (has_vt && vt_is_bad && bad_vt++ == 0) first_vt = 7 + face;
                if (has_vn && vn_is_bad && bad_vn++ == 0) first_vn = 7 + face;
                expected.push_back(has_vt && !vt_is_bad ? Vec2f(0.5F, 0.25F) : Vec2f(0, 0));
            }
            text += "\n";
        }
        const auto result = import(text);
        ASSERT_TRUE(result) << text << result.error().text();
        ASSERT_EQ(result->mesh->face_count(), 4u);
        EXPECT_EQ(result->mesh->corner_uv, expected) << text;
        ASSERT_EQ(result->warnings.size(), std::size_t{bad_vt > 0} + std::size_t{bad_vn > 0}) << text;
        for (const Diagnostic& warning : result->warnings) {
            const bool normal = warning.message.find("normal") != std::string::npos;
            EXPECT_EQ(warning.location, fmt::format("{}:{}", location(), normal ? first_vn : first_vt));
            const int count = normal ? bad_vn : bad_vt;
            if (count > 1) {
                EXPECT_THAT(warning.message, HasSubstr(fmt::format("; {} more of these", count - 1)));
            }
        }
    }
}

// Whatever stands where nothing is needed: the geometry is read as without it.
TEST_F(ImportHostile, JunkWhereNothingIsNeeded) {
    std::mt19937 random(23);
    const std::string lines[] = {"v 0 0 0", "v 0 0 1", "v 1 0 1",      "v 1 0 0",
                                 "vt 0 0",  "f 1 2 3", "f 1/1 3/1 4/1"};
    for (int round = 0; round < 400; ++round) {
        std::string text;
        for (const std::string& line : lines) {
            if (random() % 2 == 0) {
                const char* const starts[] = {"# ",  "o ", "g ", "usemtl ", "mtllib ", "s ",   "vn ",
                                              "vp ", "l ", "p ", "curv ",   "\x01",    "map ", "usemap "};
                text += starts[random() % std::size(starts)];
                for (auto i = random() % 40; i > 0; --i) {
                    const char c = static_cast<char>(random());
                    if (c != '\n' && c != '\r' && c != '\\') text += c;
                }
                text += '\n';
            }
            text += line + "\n";
        }
        text.append(random() % 3, '\0');
        const auto result = import(text);
        ASSERT_TRUE(result) << round << result.error().text();
        ASSERT_EQ(result->mesh->face_count(), 2u);
        EXPECT_EQ(result->mesh->positions.size(), 4u);
    }
}

std::string utf16(std::string_view ascii, bool little, bool mark) {
    std::string bytes = !mark ? "" : little ? "\xFF\xFE" : "\xFE\xFF";
    for (const char c : ascii)
        bytes += little ? std::string{c, '\0'} : std::string{'\0', c};
    return bytes;
}

TEST_F(ImportHostile, Utf16) {
    for (const bool little : {true, false}) {
        for (const bool mark : {true, false}) {
            write("a.mtl", utf16("newmtl m\nKd 1 0 0\n", little, mark));
            std::string text =
                utf16("mtllib a.mtl\r\n" + square_vertices + "usemtl m\nf 1 2 3 4\ng ", little, mark);
            text += little ? std::string("\xE9\0\x3D\xD8\0\xDE", 6) : std::string("\0\xE9\xD8\x3D\xDE\0", 6);
            text += utf16("\nf 1 2 3\n", little, false);
            const auto result = import(text);
            ASSERT_TRUE(result) << result.error().text();
            EXPECT_EQ(result->mesh->face_count(), 2u);
            EXPECT_EQ(result->mesh->materials[0].diffuse, Vec3f(1, 0, 0));
            EXPECT_EQ(result->mesh->groups.back(), "\xC3\xA9\xF0\x9F\x98\x80");
            EXPECT_TRUE(result->warnings.empty());
        }
    }
    expect_refused(std::string("\xFF\xFEv\0", 4), 1, "found 0 coordinates");
}

// Refused by its size, before it is read.
TEST_F(ImportHostile, FilesThatAreTooLarge) {
    for (const MeshFormat& format : mesh_formats()) {
        const fs::path file = folder / ("huge." + std::string(format.ending));
        write(file.filename().string(), "x");
        std::error_code error;
        fs::resize_file(file, four_gigabytes, error);
        if (error) GTEST_SKIP() << "no sparse files here";
        const auto result = import_mesh(file);
        ASSERT_FALSE(result);
        EXPECT_THAT(result.error().message, HasSubstr("at most 1073741824 are read")) << format.ending;
        fs::remove(file);
    }
}

TEST_F(ImportHostile, LongLines) {
    const std::string long_comment = fmt::format("# {:x<10000000}", "");
    EXPECT_TRUE(import(square_vertices + long_comment + "\nf 1 2 3\n"));
    const auto long_name = import(square_vertices + "usemtl " + long_comment + "\nf 1 2 3\n");
    ASSERT_TRUE(long_name);
    EXPECT_EQ(long_name->warnings.size(), 1u);
    expect_refused(fmt::format("v 0 0 0 {:1<10000000}", ""), 1, "characters");
    std::string continued = "f";
    for (int i = 0; i < 400'000; ++i)
        continued += " \\\n 1";
    expect_refused(square_vertices + continued, 5, "characters");

    // Just below the limit: a face with a hundred thousand corners.
    std::string face = "f";
    for (int i = 0; i < 100'000; ++i)
        face += fmt::format(" {}", i % 4 + 1);
    const auto result = import(square_vertices + face);
    ASSERT_TRUE(result) << result.error().text();
    EXPECT_EQ(result->mesh->triangle_count(), 99'998U);
}

TEST_F(ImportHostile, LongNamesAreShortenedInMessages) {
    const auto result = import(square_vertices + "f 1 2 3\n" + std::string(100'000, 'k') + "\n");
    ASSERT_TRUE(result);
    EXPECT_LT(result->warnings[0].message.size(), 200U);
}

// A reader that looks names up one after the other would need 10^10 steps, and one that makes a mesh of each
// group gigabytes.
TEST_F(ImportHostile, ManyGroupsAndMaterialsTakeLinearTime) {
    std::string text = square_vertices;
    constexpr int count = 200'000;
    for (int i = 0; i < count; ++i) {
        text += fmt::format("g g{}\nusemtl m{}\nf 1 2 3\n", i, i);
    }
    const auto start = std::chrono::steady_clock::now();
    const auto result = import(text);
    EXPECT_LT(seconds_since(start), 20.0);
    ASSERT_TRUE(result) << result.error().text();
    EXPECT_EQ(result->mesh->groups.size(), static_cast<std::size_t>(count));
    EXPECT_EQ(result->mesh->materials.size(), static_cast<std::size_t>(count));
    EXPECT_EQ(result->mesh->materials[result->mesh->face_material[count - 1]].name, "m199999");
}

// More corners than assimp puts into one mesh, and more text than its read buffer of 16 MiB holds.
TEST_F(ImportHostile, LargeFilesKeepEveryFaceInOrder) {
    std::string text = square_vertices + "v 0 1 0\n";
    constexpr int count = 1'500'000;
    text.reserve(count * 8 + 100);
    for (int i = 0; i < count; ++i)
        text += i % 3 == 0 ? "f 1 2 3\n" : i % 3 == 1 ? "f 2 3 4\n" : "f 3 4 5\n";
    const auto result = import(text);
    ASSERT_TRUE(result) << result.error().text();
    const Mesh& mesh = *result->mesh;
    ASSERT_EQ(mesh.face_count(), static_cast<std::size_t>(count));
    for (FaceId face = 0; face < count; ++face) {
        ASSERT_EQ(mesh.corner_vertex[3 * face], face % 3) << face;
    }
}

// Lines that end exactly at, before and behind the end of assimp's read buffer. Short plain numbers reach it
// as they stand.
TEST_F(ImportHostile, BufferBoundaries) {
    constexpr std::size_t buffer = std::size_t{4096} * 4096;
    const std::string vertex = fmt::format("v 1.{:0<30} 2.{:0<30} 3.{:0<30}\n", "", "", "");
    for (std::size_t end = buffer - 3; end <= buffer + 3; ++end) {
        std::string text;
        while (text.size() + 2 * vertex.size() <= end)
            text += vertex;
        while (end - text.size() > vertex.size())
            text += "v 7 8 9\n";
        const std::size_t zeros = end - text.size() - 11;
        text += fmt::format("v 1.{:0<{}} 2.{:0<{}} 3.{:0<{}}\n", "", zeros / 3, "", (zeros + 1) / 3, "",
                            (zeros + 2) / 3);
        ASSERT_EQ(text.size(), end);
        const std::size_t count = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
        text += fmt::format("v 4 5 6\nf 1 {} {}\nf {} {} 1\n", count, count + 1, count + 1, count);
        const auto result = import(text);
        ASSERT_TRUE(result) << end << ": " << result.error().text();
        ASSERT_EQ(result->mesh->face_count(), 2U) << end;
        EXPECT_EQ(result->mesh->corner_position(1), Vec3f(1, 2, 3)) << end;
        EXPECT_EQ(result->mesh->corner_position(2), Vec3f(4, 5, 6)) << end;
    }
}

TEST_F(ImportHostile, RandomBytesNeverCrash) {
    std::mt19937 random(4);
    const std::string alphabet = "vfgo usemtl0123456789-./\\#\n\n\r\te+nai \xC3\xA9";
    for (int i = 0; i < 60; ++i) {
        std::string text = square_vertices;
        const int length = static_cast<int>(random() % 300);
        for (int k = 0; k < length; ++k)
            text += alphabet[random() % alphabet.size()];
        const auto result = import(text + "\nf 1 2 3\n");
        if (result) {
            EXPECT_GE(result->mesh->face_count(), 1U);
        } else {
            EXPECT_FALSE(result.error().message.empty());
        }
    }
    for (int i = 0; i < 100; ++i) {
        std::string junk(1000, '\0');
        for (char& c : junk)
            c = static_cast<char>(random());
        EXPECT_FALSE(import(junk));
    }
}

}  // namespace
}  // namespace slipface
