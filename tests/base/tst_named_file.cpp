#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <random>

#include "scratch_folder.h"
#include "slipface/base/files.h"
#include "slipface/base/named_file.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

class NamedFiles : public test::InScratchFolder {
  protected:
    void SetUp() override {
        fs::create_directories(folder / "level" / "parts" / "deep");
        fs::create_directories(folder / "beside");
        for (const char* file : {"secret", "beside/b", "level/a", "level/parts/b", "level/parts/deep/c"})
            std::ofstream(folder / file) << file;
        std::error_code no_links;
        fs::create_symlink("../secret", folder / "level" / "link", no_links);
        fs::create_symlink("../../beside", folder / "level" / "parts" / "way", no_links);
        fs::create_symlink("parts/deep", folder / "level" / "inner", no_links);
        has_links = !no_links;
    }
    bool has_links = false;  // the library for Windows makes none
    const fs::path level = folder / "level";
};

TEST_F(NamedFiles, AreThoseOfTheFolderAndBelow) {
    using State = NamedFile::State;
    for (const char* name : {"a", "./a", "parts/b", "parts\\b", "inner/c", "parts/../a", "nowhere/../a"})
        EXPECT_NE(named_file(name, level).state, State::outside) << name;
    EXPECT_EQ(named_file((level / "a").string(), level).state, State::there);
    for (const char* name : {"", "x", "parts/x", "a/x"})
        EXPECT_EQ(named_file(name, level).state, State::missing) << name;
    EXPECT_EQ(named_file(std::string_view("a\0b", 3), level).state, State::missing);
    for (const char* name :
         {"../secret", "..\\secret", "parts/../../secret", "/etc/passwd", "../no such file"})
        EXPECT_EQ(named_file(name, level).state, State::outside) << name;
    EXPECT_NE(named_file("../secret", level).error().message.find("outside"), std::string::npos);
    for (const char* name : {"link", "parts/way/b"})
        EXPECT_EQ(named_file(name, level).state, has_links ? State::outside : State::missing) << name;
    EXPECT_NE(named_file("x", level).error().location.find("level"), std::string::npos);
}

// Whatever the name: a file that may be opened is, after all links, below the folder.
TEST_F(NamedFiles, NeverLeadOut) {
    std::mt19937 random(7);
    const char* const pieces[] = {"..",   "..",  ".",     "a",      "b",      "c",     "parts", "deep",
                                  "link", "way", "inner", "secret", "beside", "level", "",      "/"};
    const fs::path root = fs::canonical(level);
    int there = 0;
    for (int round = 0; round < 20'000; ++round) {
        std::string name;
        for (auto i = random() % 6 + 1; i > 0; --i)
            name += std::string(pieces[random() % std::size(pieces)]) + (random() % 5 == 0 ? "\\" : "/");
        name.pop_back();
        const NamedFile file = named_file(name, level);
        if (!file) continue;
        ++there;
        const fs::path real = fs::canonical(file.path);
        ASSERT_EQ(std::mismatch(root.begin(), root.end(), real.begin(), real.end()).first, root.end())
            << name;
    }
    EXPECT_GT(there, 500);
}

}  // namespace
}  // namespace slipface
