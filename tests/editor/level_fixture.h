// A folder of its own for each test, and small levels whose faces are known by number.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "scratch_folder.h"
#include "tools/editor.h"

namespace slipface {

inline void write_text(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

inline std::string read_text(const std::filesystem::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

// A floor of n x n unit quads over [0, n] x [0, n] at y = 0; face i * n + j covers x in [i, i+1], z in [j,
// j+1]. Along x = n stands a wall of n unit quads, faces n * n + j, whose material's suffix makes it a
// ladder.
inline std::string floor_and_wall_obj(int n) {
    std::ostringstream obj;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j)
            obj << "v " << i << " 0 " << j << "\n";
    for (int j = 0; j <= n; ++j)
        obj << "v " << n << " 1 " << j << "\n";
    const auto vertex = [n](int i, int j) { return i * (n + 1) + j + 1; };
    obj << "usemtl floor\n";
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            obj << "f " << vertex(i, j) << " " << vertex(i, j + 1) << " " << vertex(i + 1, j + 1) << " "
                << vertex(i + 1, j) << "\n";
    obj << "usemtl wall__ladder\n";
    for (int j = 0; j < n; ++j)
        obj << "f " << vertex(n, j) << " " << vertex(n, j + 1) << " " << vertex(n + 1, j + 1) << " "
            << vertex(n + 1, j) << "\n";
    return obj.str();
}

// The same with face 0 cut in two: faces 0 and 1, and all others one later.
inline std::string obj_with_cut_face(int n) {
    std::string text = floor_and_wall_obj(n);
    const int corners = (n + 1) * (n + 2);
    text.insert(text.find("usemtl"), "v 0.5 0 0\nv 0.5 0 1\n");
    std::ostringstream whole, halves;
    whole << "f 1 2 " << n + 3 << " " << n + 2 << "\n";
    halves << "f 1 2 " << corners + 2 << " " << corners + 1 << "\nf " << corners + 1 << " " << corners + 2
           << " " << n + 3 << " " << n + 2 << "\n";
    return text.replace(text.find(whole.str()), whole.str().size(), halves.str());
}

// A row of tiles from `first` on, each with corners of its own.
inline std::string tiles(int first, int count) {
    std::ostringstream text;
    for (int i = first; i < first + count; ++i)
        text << "v " << i << " 0 0\nv " << i << " 0 1\nv " << i + 1 << " 0 1\nv " << i + 1 << " 0 0\n";
    for (int i = 0; i < count; ++i)
        text << "f " << 4 * i + 1 << " " << 4 * i + 2 << " " << 4 * i + 3 << " " << 4 * i + 4 << "\n";
    return text.str();
}

class LevelFixture : public testing::Test {
  protected:
    static constexpr int n = 8;
    static constexpr FaceId wall = n * n;  // the first face of the wall
    static constexpr std::size_t face_count = n * n + n;
    static constexpr SurfaceId ice = 1, ladder = 2;  // of the preset types

    void SetUp() override {
        folder = test::make_scratch_folder();
        obj = folder / "grid.obj";
        level_file = folder / "grid.slipface.json";
        write_text(obj, floor_and_wall_obj(n));
    }
    void TearDown() override {
        std::error_code ignored;
        std::filesystem::remove_all(folder, ignored);
    }

    std::unique_ptr<Document> open() {
        auto opened = Document::open(obj);
        if (!opened) {
            ADD_FAILURE() << opened.error().text();
            std::abort();
        }
        return std::move(opened).value();
    }

    std::filesystem::path folder, obj, level_file;
};

}  // namespace slipface
