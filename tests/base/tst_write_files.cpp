// Several files that are replaced together: a process killed at any moment leaves all old or all new ones.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <map>

#include "slipface/base/files.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

class WriteFiles : public testing::Test {
  protected:
    void SetUp() override {
        std::string name = testing::TempDir() + "slipface-write-XXXXXX";
        ASSERT_NE(::mkdtemp(name.data()), nullptr);
        folder = name;
        fs::create_directory(folder / "inner");
    }
    void TearDown() override { fs::remove_all(folder); }

    // Three files of one age, one of them in a folder below.
    static std::map<std::string, std::string> contents(const std::string& age) {
        return {
            {"a.obj", age + " geometry"}, {"a.json", age + " level"}, {"inner/a.mtl", age + " materials"}};
    }
    Status write(const std::string& age) const {
        const std::map<std::string, std::string> texts = contents(age);
        std::vector<FileToWrite> files;
        for (const auto& [name, text] : texts)
            files.push_back({folder / name, text});
        return write_files_atomic(files);
    }
    std::map<std::string, std::string> read() const {
        std::map<std::string, std::string> found;
        for (const auto& entry : fs::recursive_directory_iterator(folder))
            if (entry.is_regular_file())
                found[entry.path().lexically_relative(folder).string()] = *read_file(entry.path());
        return found;
    }
    bool has_list() const {
        const auto found = read();
        return std::any_of(found.begin(), found.end(),
                           [](const auto& file) { return file.first.ends_with(".renames"); });
    }

    // Runs write("new") in a child and kills it at its system call number `calls`. False: it ended before.
    bool killed_at(int calls) const {
        const pid_t child = ::fork();
        if (child == 0) {
            ::ptrace(PTRACE_TRACEME, 0, nullptr, nullptr);
            ::raise(SIGSTOP);
            ::_exit(write("new") ? 0 : 1);
        }
        int status = 0;
        ::waitpid(child, &status, 0);
        for (int stop = 0; WIFSTOPPED(status) && stop < calls; ++stop) {
            ::ptrace(PTRACE_SYSCALL, child, nullptr, nullptr);
            ::waitpid(child, &status, 0);
        }
        if (!WIFSTOPPED(status)) return false;
        ::kill(child, SIGKILL);
        ::waitpid(child, &status, 0);
        return true;
    }
    static bool can_trace() {
        const pid_t child = ::fork();
        if (child == 0) ::_exit(::ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) == 0 ? 0 : 1);
        int status = 0;
        ::waitpid(child, &status, 0);
        return WIFEXITED(status) && WEXITSTATUS(status) == 0;
    }

    fs::path folder;
};

TEST_F(WriteFiles, KilledAtAnySystemCallAllAreOldOrAllNew) {
    if (!can_trace()) GTEST_SKIP() << "processes may not be traced here";
    int old_ones = 0, new_ones = 0, mixed_before_finishing = 0;
    ASSERT_TRUE(write("old"));
    // Two stops each: before a call and after it. Between two calls nothing changes on the disk.
    for (int calls = 1; killed_at(calls); calls += 2) {
        ASSERT_LT(calls, 2000);
        auto found = read();
        if (!has_list()) {
            std::erase_if(found, [](const auto& file) { return file.first.ends_with(".tmp"); });
            ASSERT_TRUE(found == contents("old") || found == contents("new")) << calls;
        } else {
            std::erase_if(found, [](const auto& file) {
                return file.first.ends_with(".tmp") || file.first.ends_with(".renames");
            });
            mixed_before_finishing += found != contents("old") && found != contents("new");
        }
        finish_interrupted_writes(folder);
        finish_interrupted_writes(folder / "inner");
        found = read();  // and nothing is left over
        ASSERT_TRUE(found == contents("old") || found == contents("new")) << calls;
        (found == contents("old") ? old_ones : new_ones) += 1;
        ASSERT_TRUE(write("old"));
    }
    EXPECT_GT(old_ones, 5);
    EXPECT_GT(new_ones, 5);
    EXPECT_GT(mixed_before_finishing, 0) << "the list is not needed, or this test does not see when it is";
}

TEST_F(WriteFiles, TheNextWriteFinishesAndTidies) {
    if (!can_trace()) GTEST_SKIP() << "processes may not be traced here";
    for (int calls = 10;; calls += 7) {
        ASSERT_TRUE(write("old"));
        if (!killed_at(calls)) break;
        ASSERT_TRUE(write("newer"));
        ASSERT_EQ(read(), contents("newer")) << calls;
    }
}

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

TEST_F(WriteFiles, AFullDiskLeavesTheOldFiles) {
    ASSERT_TRUE(write("old"));
    rlimit before{};
    ::getrlimit(RLIMIT_FSIZE, &before);
    const auto handler = ::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{1000, before.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &small);
    const std::string little = "new", much(5000, 'x');
    const FileToWrite files[] = {{folder / "a.obj", little}, {folder / "inner/a.mtl", much}};
    const Status status = write_files_atomic(files);
    ::setrlimit(RLIMIT_FSIZE, &before);
    ::signal(SIGXFSZ, handler);
    ASSERT_FALSE(status);
    EXPECT_THAT(status.error().message, testing::HasSubstr("cannot be written: File too large"));
    EXPECT_EQ(read(), contents("old"));
}

// A folder from elsewhere may contain a list that was made to do harm.
TEST_F(WriteFiles, AListRenamesOnlyTemporaryFilesOfItsFolder) {
    ASSERT_TRUE(write_file_atomic(folder / "secret", "secret"));
    ASSERT_TRUE(write_file_atomic(folder / "inner/.x.1-0.tmp", "planted"));
    using namespace std::string_literals;
    int number = 0;
    for (const std::string& pair :
         {"../secret\0taken\0"s, "secret\0taken\0"s, ".x.1-0.tmp\0../secret\0"s, ".x.1-0.tmp\0/tmp/x\0"s,
          ".x.1-0.tmp\0"s, ".x.1-0.tmp\0sub/../../secret\0"s}) {
        const std::string name = ".slipface.1-" + std::to_string(number++) + ".renames";
        ASSERT_TRUE(write_file_atomic(folder / "inner" / name, "slipface renames 1\0"s + pair));
    }
    finish_interrupted_writes(folder / "inner");
    EXPECT_EQ(*read_file(folder / "secret"), "secret");
    EXPECT_FALSE(fs::exists(folder / "inner/taken"));
}

TEST_F(WriteFiles, FilesOfALivingWriterAreLeftAlone) {
    const fs::path own = folder / (".a.obj." + std::to_string(::getpid()) + "-9999.tmp");
    ASSERT_TRUE(write_file_atomic(own, "in progress"));
    ASSERT_TRUE(write("new"));
    EXPECT_TRUE(fs::exists(own));
    const fs::path user = folder / ".notes.tmp";
    ASSERT_TRUE(write_file_atomic(user, "of the user"));
    finish_interrupted_writes(folder);
    EXPECT_TRUE(fs::exists(user));
}

}  // namespace
}  // namespace slipface
