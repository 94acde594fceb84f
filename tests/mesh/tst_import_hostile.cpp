#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <random>

#include "mesh_test_tools.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

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
    expect_refused(head + "f 1/1 2/2 3/1\n", 7, "the number of 'vt' lines");
    expect_refused(head + "f 1//1 2//2 3//1\n", 7, "the number of 'vn' lines");
    expect_refused(head + "f 1//-2 2//1 3//1\n", 7, "the number of 'vn' lines");
    expect_refused(head + "f 1 2 99999999999999999999\n", 7, "index 99999999999999999999 is out of range");
    expect_refused(head + "f 1 2 4294967297\n", 7, "out of range");
    expect_refused("f 1 2 3\n", 1, "expected 1 to 0");
    // A face may stand before its vertices, but they must come.
    expect_refused("f 1 2 5\n" + head, 1, "index 5 is out of range");
}

TEST_F(ImportHostile, MalformedCorners) {
    EXPECT_TRUE(import(square_vertices + "f 1/ 2// 3\n")) << "empty texture and normal indices are harmless";
    for (const char* corner : {"x", "1/2/3/4", "1.5", "/1", "1/x", "1//x", "--1", "+1"}) {
        const auto result = import(square_vertices + "vt 0 0\nf 1 2 " + corner + "\n");
        ASSERT_FALSE(result) << corner;
        EXPECT_EQ(result.error().location, location() + ":6");
    }
}

TEST_F(ImportHostile, LongLines) {
    const std::string long_comment = fmt::format("# {:x<10000000}", "");
    expect_refused(square_vertices + long_comment + "\nf 1 2 3\n", 5, "10000002 characters");
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
