// Several files that are replaced together: a process killed at any moment leaves all old or all new ones.
#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "base/folder_of_three.h"
#include "slipface/base/files.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;
using WriteFiles = test::InFolderOfThree;

TEST_F(WriteFiles, RefusedBeforeAnyFileIsReplaced) {
    ASSERT_TRUE(write("old"));
    fs::create_directory(folder / "in-the-way");
    const std::string text = "new";
    for (const fs::path& bad : {folder / "in-the-way", folder / "missing" / "x",
                                folder / std::string(300, 'n'), fs::path("/dev/full")}) {
        const FileToWrite files[] = {{folder / "a.obj", text}, {folder / "a.json", text}, {bad, text}};
        const Status status = write_files_atomic(files);
        ASSERT_FALSE(status) << bad;
        EXPECT_EQ(status.error().location, bad.string());
        EXPECT_EQ(read(), contents("old")) << bad;
    }
}

// A folder from elsewhere may contain a list that was made to do harm.
TEST_F(WriteFiles, AListRenamesOnlyTemporaryFilesOfItsFolder) {
    ASSERT_TRUE(write_file_atomic(folder / "secret", "secret"));
    ASSERT_TRUE(write_file_atomic(folder / "inner/.x.slipface.1-0.tmp", "planted"));
    using namespace std::string_literals;
    int number = 0;
    for (const std::string& pair : {"../secret\0taken\0"s, "secret\0taken\0"s,
                                    ".x.slipface.1-0.tmp\0../secret\0"s, ".x.slipface.1-0.tmp\0/tmp/x\0"s,
                                    ".x.slipface.1-0.tmp\0"s, ".x.slipface.1-0.tmp\0sub/../../secret\0"s}) {
        const std::string name = ".slipface.1-" + std::to_string(number++) + ".renames";
        ASSERT_TRUE(write_file_atomic(folder / "inner" / name, "slipface renames 1\0"s + pair));
    }
    finish_interrupted_writes(folder / "inner");
    EXPECT_EQ(*read_file(folder / "secret"), "secret");
    EXPECT_FALSE(fs::exists(folder / "inner/taken"));
}

TEST_F(WriteFiles, FilesOfALivingWriterAreLeftAlone) {
    const fs::path own = folder / (".a.obj.slipface." + std::to_string(::getpid()) + "-9999.tmp");
    ASSERT_TRUE(write_file_atomic(own, "in progress"));
    ASSERT_TRUE(write("new"));
    EXPECT_TRUE(fs::exists(own));
    for (const char* name : {".notes.tmp", ".scores-7.tmp", ".report.2147483647-11.tmp"}) {
        const fs::path user = folder / name;
        ASSERT_TRUE(write_file_atomic(user, "of another program"));
        finish_interrupted_writes(folder);
        EXPECT_TRUE(fs::exists(user)) << name;
    }
}

}  // namespace
}  // namespace slipface
