// What Windows has not: pipes with names, devices, modes, and links that everybody may make.
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include "scratch_folder.h"
#include "slipface/base/files.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class PosixFiles : public test::InScratchFolder {
  protected:
    static mode_t mode(const fs::path& path) {
        struct stat status {};
        ::stat(path.c_str(), &status);
        return status.st_mode & 07777;
    }
};

TEST_F(PosixFiles, ReadRefusesPipesAndDevices) {
    // A pipe without a writer would block a plain open().
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    const auto pipe = read_file(folder / "pipe");
    ASSERT_FALSE(pipe);
    EXPECT_THAT(pipe.error().message, HasSubstr("pipe"));

    const auto device = read_file("/dev/zero");
    ASSERT_FALSE(device);
    EXPECT_THAT(device.error().message, HasSubstr("device"));
}

TEST_F(PosixFiles, ReadsFilesThatDoNotKnowTheirSize) {
    // Files of the proc file system say that they have 0 bytes.
    const auto status = read_file("/proc/self/status");
    ASSERT_TRUE(status);
    EXPECT_THAT(*status, HasSubstr("Name:"));
    EXPECT_FALSE(read_file("/proc/self/status", 10));
}

TEST_F(PosixFiles, ReplacingKeepsTheMode) {
    ASSERT_TRUE(write_file_atomic(folder / "f", "old"));
    fs::permissions(folder / "f", fs::perms(0640));
    ASSERT_TRUE(write_file_atomic(folder / "f", "new"));
    EXPECT_EQ(mode(folder / "f"), 0640U);
    EXPECT_EQ(*read_file(folder / "f"), "new");
}

TEST_F(PosixFiles, NewFilesFollowTheUmask) {
    const mode_t before = ::umask(027);
    ASSERT_TRUE(write_file_atomic(folder / "f", "x"));
    ::umask(before);
    EXPECT_EQ(mode(folder / "f"), 0640U);
}

TEST_F(PosixFiles, WritesThroughSymbolicLinks) {
    fs::create_directory(folder / "real");
    ASSERT_TRUE(write_file_atomic(folder / "real" / "f", "old"));
    fs::create_symlink("real/f", folder / "second");
    fs::create_symlink("second", folder / "first");
    ASSERT_TRUE(write_file_atomic(folder / "first", "new"));
    EXPECT_TRUE(fs::is_symlink(folder / "first"));
    EXPECT_TRUE(fs::is_symlink(folder / "second"));
    EXPECT_EQ(*read_file(folder / "real" / "f"), "new");

    fs::create_symlink("not-yet", folder / "dangling");
    ASSERT_TRUE(write_file_atomic(folder / "dangling", "made"));
    EXPECT_EQ(*read_file(folder / "not-yet"), "made");

    fs::create_symlink("loop", folder / "loop");
    const auto loop = write_file_atomic(folder / "loop", "x");
    ASSERT_FALSE(loop);
    EXPECT_THAT(loop.error().message, HasSubstr("symbolic links"));
}

TEST_F(PosixFiles, WriteProtectedFilesAreLeftAlone) {
    if (::geteuid() == 0) GTEST_SKIP() << "root may write everything";
    ASSERT_TRUE(write_file_atomic(folder / "f", "old"));
    fs::permissions(folder / "f", fs::perms(0444));
    EXPECT_FALSE(write_file_atomic(folder / "f", "new"));
    EXPECT_EQ(*read_file(folder / "f"), "old");
}

}  // namespace
}  // namespace slipface
