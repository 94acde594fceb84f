// Several files that are replaced together, by processes that are killed and on a disk that is full.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>

#include "base/folder_of_three.h"

namespace slipface {
namespace {

class KilledWriters : public test::InFolderOfThree {
  protected:
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
};

TEST_F(KilledWriters, KilledAtAnySystemCallAllAreOldOrAllNew) {
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

TEST_F(KilledWriters, TheNextWriteFinishesAndTidies) {
    if (!can_trace()) GTEST_SKIP() << "processes may not be traced here";
    for (int calls = 10;; calls += 7) {
        ASSERT_TRUE(write("old"));
        if (!killed_at(calls)) break;
        ASSERT_TRUE(write("newer"));
        ASSERT_EQ(read(), contents("newer")) << calls;
    }
}

TEST_F(KilledWriters, AFullDiskLeavesTheOldFiles) {
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

}  // namespace
}  // namespace slipface
