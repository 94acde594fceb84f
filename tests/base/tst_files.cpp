#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <stop_token>
#include <thread>

#include "scratch_folder.h"
#include "slipface/base/files.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Files : public test::InScratchFolder {
  protected:
    std::size_t files_in_folder() const {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(folder), fs::directory_iterator{}));
    }
};

TEST_F(Files, WritesAndReadsAnyBytes) {
    std::string bytes("a\0b\r\n\xff", 6);
    bytes.append(3'000'000, 'x');
    ASSERT_TRUE(write_file_atomic(folder / "f", bytes));
    const auto back = read_file(folder / "f");
    ASSERT_TRUE(back);
    EXPECT_EQ(*back, bytes);
    EXPECT_EQ(files_in_folder(), 1U) << "a temporary file was left behind";
}

TEST_F(Files, WritesAnEmptyFile) {
    ASSERT_TRUE(write_file_atomic(folder / "empty", ""));
    const auto back = read_file(folder / "empty");
    ASSERT_TRUE(back);
    EXPECT_EQ(*back, "");
}

TEST_F(Files, ReadRefusesWhatIsNoFile) {
    const auto missing = read_file(folder / "no.obj");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().location, (folder / "no.obj").string());
    EXPECT_THAT(missing.error().message, HasSubstr("no such file"));

    const auto directory = read_file(folder);
    ASSERT_FALSE(directory);
    EXPECT_THAT(directory.error().message, HasSubstr("directory"));
}

TEST_F(Files, ReadRefusesMoreThanTheLimit) {
    ASSERT_TRUE(write_file_atomic(folder / "f", "12345"));
    EXPECT_TRUE(read_file(folder / "f", 5));
    const auto refused = read_file(folder / "f", 4);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, HasSubstr("at most 4"));
}

TEST_F(Files, WriteRefusesAndLeavesNothingBehind) {
    fs::create_directory(folder / "d");
    const std::size_t before = files_in_folder();
    EXPECT_FALSE(write_file_atomic(folder / "d", "x"));
    EXPECT_FALSE(write_file_atomic(folder / "no-such-folder" / "f", "x"));
    EXPECT_FALSE(write_file_atomic(folder / "", "x"));
    EXPECT_FALSE(write_file_atomic(folder / std::string(300, 'n'), "x"));
    EXPECT_EQ(files_in_folder(), before);
}

// As in a container, where every process has the same number.
TEST_F(Files, WritesBesideWhatAKilledProcessLeft) {
    for (int i = 0; i < 50; ++i)
        std::ofstream(folder /
                      (".f.slipface." + std::to_string(::getpid()) + "-" + std::to_string(i) + ".tmp"))
            << "half";
    const Status status = write_file_atomic(folder / "f", "whole");
    ASSERT_TRUE(status) << status.error().text();
    EXPECT_EQ(*read_file(folder / "f"), "whole");
}

TEST_F(Files, AFingerprintNoticesBytesNamesAndMissingFiles) {
    ASSERT_TRUE(write_file_atomic(folder / "a", "1"));
    ASSERT_TRUE(write_file_atomic(folder / "b", "1"));
    const auto of = [&](std::vector<fs::path> names) {
        for (fs::path& name : names)
            name = folder / name;
        return fingerprint_of_files(names);
    };
    const std::uint64_t before = of({"a", "b"});
    EXPECT_EQ(of({"a", "b"}), before);
    EXPECT_NE(of({"a"}), of({"b"}));
    EXPECT_NE(of({"a", "c"}), before);
    ASSERT_TRUE(write_file_atomic(folder / "b", "2"));
    EXPECT_NE(of({"a", "b"}), before);
}

TEST_F(Files, TheLongestNamesCanBeWritten) {
    const std::string name(255, 'n');  // the limit of the usual Linux file systems
    ASSERT_TRUE(write_file_atomic(folder / name, "x"));
    EXPECT_EQ(*read_file(folder / name), "x");
}

// One writer swaps two texts of different length, one reader reads: a reader never sees a mixture or a part.
TEST_F(Files, ReadersSeeTheOldOrTheNewFile) {
    const std::string a(100'000, 'a');
    const std::string b(50'000, 'b');
    ASSERT_TRUE(write_file_atomic(folder / "f", a));
    std::jthread writer([&](const std::stop_token& stop) {
        while (!stop.stop_requested()) {
            (void)write_file_atomic(folder / "f", b);
            (void)write_file_atomic(folder / "f", a);
        }
    });
    for (int i = 0; i < 300; ++i) {
        const auto seen = read_file(folder / "f");
        ASSERT_TRUE(seen);
        ASSERT_TRUE(*seen == a || *seen == b);
    }
}

}  // namespace
}  // namespace slipface
