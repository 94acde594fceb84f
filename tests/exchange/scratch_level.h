// A folder with one level in it.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "scratch_folder.h"
#include "slipface/level/level_file.h"

namespace slipface::test {

// n x n unit quads, the materials taken in turn; an empty one leaves the `usemtl` out for the first faces.
inline std::string grid_obj(int n, const std::vector<std::string>& materials) {
    std::string text;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j)
            text += fmt::format("v {} {} {}\n", i, (i * j) % 3, j);
    for (std::size_t part = 0; part < materials.size(); ++part) {
        text += "usemtl " + materials[part] + "\n";
        for (int i = 0; i < n; ++i) {
            if (static_cast<std::size_t>(i) % materials.size() != part) continue;
            for (int j = 0; j < n; ++j) {
                const int at = i * (n + 1) + j + 1;
                text += fmt::format("f {} {} {} {}\n", at, at + 1, at + n + 2, at + n + 1);
            }
        }
    }
    return text;
}

class ScratchLevel : public testing::Test {
  protected:
    void SetUp() override { folder_ = test::make_scratch_folder(); }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path path(const std::string& name) const { return folder_ / name; }
    bool exists(const std::string& name) const { return std::filesystem::exists(path(name)); }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(path(name), std::ios::binary) << text;
    }
    std::string read(const std::string& name) const {
        std::ifstream file(path(name), std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }

    // The text as level.obj, opened.
    Level open(const std::string& obj) const {
        write("level.obj", obj);
        return open_path("level.obj");
    }
    Level open_path(const std::string& name) const {
        Result<LoadedLevel> loaded = load_level(path(name));
        if (loaded) return std::move(loaded->level);
        ADD_FAILURE() << loaded.error().text();
        return {};
    }

    static void paint(Level& level, FaceId face, const std::string& type) {
        level.overrides.at(face) = find_surface(level, type).value();
    }

  private:
    std::filesystem::path folder_;
};

}  // namespace slipface::test
