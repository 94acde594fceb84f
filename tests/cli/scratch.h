// A folder of its own with the level that the command line tests ask about, removed at the end.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "scratch_folder.h"

namespace slipface::test {

// A floor of 20 x 20 m at y = 0 in two halves, facing up: face 0 (x < 0) is stone, face 1 (x > 0) is ice by
// rule.
inline const std::string floor_obj =
    "v -10 0 10\nv 0 0 10\nv 10 0 10\nv -10 0 -10\nv 0 0 -10\nv 10 0 -10\n"
    "usemtl stone\nf 1 2 5 4\nusemtl frozen\nf 2 3 6 5\n";
inline const std::string floor_json =
    R"({"slipface": 1, "mesh": "floor.obj", "spawn": {"position": [-5, 1, 0]}, "rules": [{"pattern": "frozen", "type": "ice"}]})";

class Scratch : public testing::Test {
  protected:
    void SetUp() override {
        folder = test::make_scratch_folder();
        level = write("floor.obj", floor_obj);
        write("floor.slipface.json", floor_json);
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    std::filesystem::path write(const std::string& name, const std::string& text) const {
        std::ofstream(folder / name, std::ios::binary) << text;
        return folder / name;
    }

    std::filesystem::path folder;
    std::filesystem::path level;
};

}  // namespace slipface::test
