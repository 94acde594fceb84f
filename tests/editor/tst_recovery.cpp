// Whose unsaved changes are offered, when, and to whom.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "level_fixture.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

class Recovery : public LevelFixture {
  protected:
    void SetUp() override {
        LevelFixture::SetUp();
        other = folder / "other.obj";
        write_text(other, floor_and_wall_obj(4));
    }
    std::unique_ptr<Editor> start() {
        auto editor = std::make_unique<Editor>();
        begin_session(*editor, {}, folder / "state");
        return editor;
    }
    static void paint_and_autosave(Editor& editor, FaceId face) {
        editor.document->paint(std::span(&face, 1), ice);
        bool shown_changed = false;
        for (double now_s = 0.0; now_s < 10.0; now_s += 1.0)
            tick_session(editor, now_s, shown_changed);
        ASSERT_TRUE(editor.session.autosave.finish());
        ASSERT_EQ(editor.session.autosave.written(), 1u);
    }
    // Leaves unsaved paint in `level` as a killed editor does.
    void crash_in(const fs::path& level) {
        const auto editor = start();
        open_level(*editor, level);
        paint_and_autosave(*editor, 3);
        editor->session.autosave.abandon();
    }

    fs::path other;
};

TEST_F(Recovery, IsOfferedWithItsOwnLevelOnly) {
    crash_in(obj);
    const auto editor = start();
    EXPECT_TRUE(editor->session.recoverable.empty()) << "nobody is asked before a level is opened";
    ASSERT_EQ(editor->session.left_behind.size(), 1u) << "the welcome screen lists it";
    open_level(*editor, other);
    EXPECT_TRUE(editor->session.recoverable.empty());
    open_level(*editor, folder / "." / "grid.obj");
    ASSERT_EQ(editor->session.recoverable.size(), 1u) << "the same file by another name";
    recover(*editor, AutosaveInfo(editor->session.recoverable[0]));
    ASSERT_FALSE(editor->message) << editor->message->text;
    EXPECT_TRUE(editor->session.recoverable.empty());
    EXPECT_EQ(editor->document->surface_of(3), ice);
    EXPECT_TRUE(editor->document->dirty());
    save_level(*editor);
    look_for_autosaves(*editor);
    EXPECT_TRUE(editor->session.recoverable.empty()) << "saved: nothing is left to recover";
}

TEST_F(Recovery, ALivingEditorsChangesAreItsOwn) {
    const auto first = start();
    open_level(*first, obj);
    paint_and_autosave(*first, 3);
    const auto second = start();
    open_level(*second, obj);
    EXPECT_TRUE(second->session.recoverable.empty());
    EXPECT_TRUE(second->session.left_behind.empty());
}

TEST_F(Recovery, WhatOneEditorRecoveredIsNotOfferedToAnother) {
    crash_in(obj);
    const auto first = start();
    const auto second = start();
    open_level(*second, obj);
    ASSERT_EQ(second->session.recoverable.size(), 1u);
    const AutosaveInfo row = second->session.recoverable[0];

    open_level(*first, obj);
    recover(*first, row);
    EXPECT_EQ(first->document->surface_of(3), ice);
    recover(*second, row);
    ASSERT_TRUE(second->message) << "the first has it";
    EXPECT_NE(second->document->surface_of(3), ice);
    EXPECT_TRUE(second->session.recoverable.empty());
    const auto third = start();
    EXPECT_TRUE(third->session.left_behind.empty());

    // The first is killed in its turn before it saved: then it is offered again.
    first->session.autosave.abandon();
    open_level(*third, obj);
    EXPECT_EQ(third->session.recoverable.size(), 1u);
}

TEST_F(Recovery, AsksBeforeUnsavedChangesOfTheOpenLevelAreLost) {
    crash_in(obj);
    const auto editor = start();
    open_level(*editor, other);
    const FaceId face = 0;
    editor->document->paint(std::span(&face, 1), ice);
    look_for_autosaves(*editor);
    ASSERT_EQ(editor->session.recoverable.size(), 1u);
    request_recovery(*editor, AutosaveInfo(editor->session.recoverable[0]));
    ASSERT_TRUE(editor->unsaved);
    answer_unsaved(*editor, UnsavedChoice::discard);
    EXPECT_EQ(editor->document->level().mesh_path, obj);
}

// A process that is killed after it autosaved, as the system sees it: its lock is free when it is dead.
TEST_F(Recovery, AKilledProcessLeavesItsChangesAndItsLock) {
    const auto document = open();
    const FaceId face = 3;
    document->paint(std::span(&face, 1), ice);
    int ready[2];
    ASSERT_EQ(::pipe(ready), 0);
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        AutosaveSession session(folder / "state" / "autosave");
        session.tick(*document, 0.0);
        session.tick(*document, 100.0);
        const char byte = session.finish() ? 'y' : 'n';
        if (::write(ready[1], &byte, 1) != 1) ::_exit(1);
        for (;;)
            ::pause();
    }
    char byte = 0;
    EXPECT_EQ(::read(ready[0], &byte, 1), 1);
    EXPECT_EQ(byte, 'y');
    EXPECT_TRUE(start()->session.left_behind.empty()) << "it lives";
    ASSERT_EQ(::kill(child, SIGKILL), 0);
    ASSERT_EQ(::waitpid(child, nullptr, 0), child);
    ::close(ready[0]);
    ::close(ready[1]);
    const auto editor = start();
    open_level(*editor, obj);
    ASSERT_EQ(editor->session.recoverable.size(), 1u);
    recover(*editor, AutosaveInfo(editor->session.recoverable[0]));
    EXPECT_EQ(editor->document->surface_of(3), ice);
}

}  // namespace
}  // namespace slipface
