#include <gtest/gtest.h>

#include <random>

#include "scratch_folder.h"
#include "slipface/base/files.h"
#include "slipface/base/system.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

std::string utf8(std::uint32_t letter) {
    const auto byte = [](std::uint32_t bits) { return static_cast<char>(bits); };
    if (letter < 0x80) return {byte(letter)};
    if (letter < 0x800) return {byte(0xc0 | letter >> 6), byte(0x80 | (letter & 0x3f))};
    if (letter < 0x10000)
        return {byte(0xe0 | letter >> 12), byte(0x80 | (letter >> 6 & 0x3f)), byte(0x80 | (letter & 0x3f))};
    return {byte(0xf0 | letter >> 18), byte(0x80 | (letter >> 12 & 0x3f)), byte(0x80 | (letter >> 6 & 0x3f)),
            byte(0x80 | (letter & 0x3f))};
}

using PathOf = test::InScratchFolder;

// Letters that every file system takes, of one to four bytes.
TEST_F(PathOf, FilesHaveTheNamesThatTheirTextsSpell) {
    std::mt19937 random(11);
    const std::pair<std::uint32_t, std::uint32_t> alphabets[] = {
        {'a', 26}, {0x3b1, 17}, {0x430, 32}, {0x4e00, 0x5000}, {0x1f600, 64}};
    for (int round = 0; round < 100; ++round) {
        std::string name;
        for (std::size_t i = 0; i < 1 + random() % 12; ++i) {
            const auto [first, count] = alphabets[random() % std::size(alphabets)];
            name += utf8(first + static_cast<std::uint32_t>(random()) % count);
        }
        const fs::path inner = folder / path_of(std::to_string(round) + name);
        fs::create_directory(inner);
        const fs::path file = inner / path_of(name + ".obj");
        EXPECT_EQ(file.filename().string(), name + ".obj");
        ASSERT_TRUE(write_file_atomic(file, name)) << name;
        EXPECT_EQ(*read_file(file), name);
        const fs::directory_iterator entry(inner);
        EXPECT_EQ(entry->path().filename().string(), name + ".obj");
    }
}

// Files from elsewhere name others in any bytes.
TEST_F(PathOf, TakesAnyBytes) {
    std::mt19937 random(12);
    for (int round = 0; round < 2000; ++round) {
        std::string bytes;
        for (std::size_t i = 0; i < random() % 40; ++i)
            bytes += static_cast<char>(1 + random() % 255);
        const fs::path path = path_of(bytes);
        EXPECT_EQ(path.empty(), bytes.empty());
        (void)read_file(folder / "none" / path);
    }
}

}  // namespace
}  // namespace slipface
