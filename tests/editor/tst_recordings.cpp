// Recorded runs that nobody saved: neither the next recording nor quitting loses them.
#include <gmock/gmock.h>

#include "app_fixture.h"
#include "document/recordings.h"
#include "slipface/base/files.h"
#include "slipface/sim/tape.h"
#include "tools/lab/lab_actions.h"

namespace slipface {
namespace {

using testing::EndsWith;
using testing::SizeIs;

namespace fs = std::filesystem;

std::vector<fs::path> files_in(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

class RecordedRuns : public AppFixture {
  protected:
    void SetUp() override {
        AppFixture::SetUp();
        editor().session.recordings = Recordings(folder / "recordings");
    }
    std::uint64_t walk(int ticks) {
        EXPECT_EQ(run("key F5\nwait 10\nhold W " + std::to_string(ticks) + "\nkey Escape\nfinish"), "");
        return editor().lab.sealed_tape().end_hash.value_or(0);
    }
    std::vector<fs::path> kept() { return files_in(folder / "recordings"); }
};

TEST_F(RecordedRuns, AreAllKeptAndRepeat) {
    const std::uint64_t first = walk(20), second = walk(40);
    EXPECT_NE(first, second);
    ASSERT_THAT(kept(), SizeIs(2));
    EXPECT_THAT(kept()[0].string(), EndsWith(" grid.tape"));
    EXPECT_EQ(load_tape(kept()[0])->end_hash, first);
    open_tape(editor(), kept()[0]);
    ASSERT_EQ(run("finish"), "");
    EXPECT_EQ(editor().lab.repeats(), true);
}

TEST_F(RecordedRuns, QuittingInTheMiddleOfAWalkKeepsIt) {
    ASSERT_EQ(run("key F5\nhold W 20"), "");
    request_quit(editor());
    EXPECT_TRUE(editor().quit);
    ASSERT_THAT(kept(), SizeIs(1));
    EXPECT_GT(load_tape(kept()[0])->tick_count(), 10u);
}

TEST_F(RecordedRuns, AreOpenedFromTheMenu) {
    walk(20);
    ASSERT_EQ(run("command lab.open_recording"), "");
    EXPECT_EQ(editor().file_dialog, FileDialogKind::open_recording);
    ASSERT_EQ(run("key Escape"), "");
    editor().session.recordings = Recordings();
    EXPECT_FALSE(lab_actions::has_recordings(editor()));
}

TEST_F(RecordedRuns, WithoutAFolderNothingIsWritten) {
    editor().session.recordings = Recordings();
    walk(20);
    EXPECT_FALSE(fs::exists(folder / "recordings"));
}

TEST_F(RecordedRuns, ThatCannotBeKeptSaySo) {
    ASSERT_TRUE(write_file_atomic(folder / "recordings", "a file where the folder would be").ok());
    walk(20);
    EXPECT_THAT(editor().status, testing::HasSubstr("it will be lost at the end of this session"));
    EXPECT_TRUE(editor().lab.has_tape());
}

using RecordingsFolder = AppFixture;

TEST_F(RecordingsFolder, StoresTheNewestAndLeavesOtherFilesAlone) {
    const fs::path location = folder / "recordings";
    const Recordings recordings(location);
    fs::create_directories(location);
    ASSERT_TRUE(write_file_atomic(location / "mine.tape", "").ok());
    for (int i = 0; i < 10; ++i)
        ASSERT_TRUE(
            write_file_atomic(location / ("2001-01-01 00.00.0" + std::to_string(i) + " a.tape"), "").ok());
    for (std::size_t i = 0; i < Recordings::max_stored - 3; ++i)
        ASSERT_TRUE(recordings.store("b", "text").ok());
    const std::vector<fs::path> files = files_in(location);
    ASSERT_THAT(files, SizeIs(Recordings::max_stored + 1));
    EXPECT_EQ(files[0].filename(), "2001-01-01 00.00.07 a.tape") << "the oldest have gone";
    EXPECT_EQ(files.back().filename(), "mine.tape");
    EXPECT_EQ(*read_file(files[5]), "text");
}

}  // namespace
}  // namespace slipface
