// Folders of a test's own.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <random>
#include <string>

namespace slipface::test {

// A new folder, below gtest's for such things.
inline std::filesystem::path make_scratch_folder() {
    std::random_device random;
    std::filesystem::path folder;
    do {
        folder = std::filesystem::path(testing::TempDir()) / ("slipface-" + std::to_string(random()));
    } while (!std::filesystem::create_directory(folder));
    return folder;
}

// Tests in `folder`, which is removed at their end.
class InScratchFolder : public testing::Test {
  protected:
    void TearDown() override { std::filesystem::remove_all(folder); }

    const std::filesystem::path folder = make_scratch_folder();
};

}  // namespace slipface::test
