// The open level's files change while there is unsaved paint.
#include "level_fixture.h"
#include "tools/commands/commands.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

class ChangedOnDisk : public LevelFixture {
  protected:
    void SetUp() override {
        LevelFixture::SetUp();
        open_level(editor, obj);
        paint(document(), 1, ice);
        save_level(editor);
        ASSERT_FALSE(editor.message);
        seconds(2);
        other = open();  // the other window
    }
    void seconds(int count) {
        bool shown_changed = false;
        for (int i = 0; i < count; ++i)
            tick_session(editor, now += 1.0, shown_changed);
    }
    Document& document() { return *editor.document; }
    static void paint(Document& in, FaceId face, std::optional<SurfaceId> surface) {
        in.paint(std::span(&face, 1), surface);
    }
    // Unsaved here: faces 2 (ice) and 3 (ladder). Saved there: 3 (ice) and 4 (ladder).
    void change_both() {
        paint(document(), 2, ice);
        paint(document(), 3, ladder);
        paint(*other, 3, ice);
        paint(*other, 4, ladder);
        ASSERT_TRUE(other->save());
        seconds(3);
        ASSERT_TRUE(editor.session.changed);
        ASSERT_EQ(document().surface_of(3), ladder) << "nothing is replaced before the answer";
    }
    std::vector<std::optional<SurfaceId>> faces_1_to_4() const {
        std::vector<std::optional<SurfaceId>> paint;
        for (FaceId face = 1; face <= 4; ++face)
            paint.push_back(editor.document->paint_of(face));
        return paint;
    }
    using Four = std::vector<std::optional<SurfaceId>>;

    Editor editor;
    std::unique_ptr<Document> other;
    double now = 0.0;
};

TEST_F(ChangedOnDisk, MergesByFaceAndSelectsTheConflicts) {
    change_both();
    ASSERT_TRUE(run_command(editor, "file.merge_by_face"));
    EXPECT_EQ(faces_1_to_4(), (Four{ice, ice, ladder, ladder}));
    ASSERT_EQ(document().selection().size(), 1u);
    EXPECT_EQ(document().selection()[0], 3u);
    ASSERT_TRUE(editor.message) << "both sides painted face 3";
    EXPECT_NE(editor.message->details[0].text().find("yours"), std::string::npos);
    EXPECT_FALSE(editor.session.changed);
    EXPECT_TRUE(document().dirty());
    document().undo();
    EXPECT_EQ(faces_1_to_4(), (Four{ice, ice, ladder, std::nullopt}));
    EXPECT_TRUE(document().dirty()) << "the file holds theirs";
    document().redo();
    editor.message.reset();
    save_level(editor);
    EXPECT_FALSE(editor.message) << "the merge knows what it replaces";
    EXPECT_EQ(open()->surface_of(4), ladder);
}

TEST_F(ChangedOnDisk, TakesTheirsAndUndoGoesBack) {
    change_both();
    ASSERT_TRUE(run_command(editor, "file.take_theirs"));
    EXPECT_EQ(faces_1_to_4(), (Four{ice, std::nullopt, ice, ladder}));
    EXPECT_FALSE(document().dirty());
    document().undo();
    EXPECT_EQ(faces_1_to_4(), (Four{ice, ice, ladder, std::nullopt}));
    EXPECT_TRUE(document().dirty());
}

TEST_F(ChangedOnDisk, KeepsMineAndSavingReplaces) {
    change_both();
    ASSERT_TRUE(run_command(editor, "file.keep_mine"));
    EXPECT_EQ(faces_1_to_4(), (Four{ice, ice, ladder, std::nullopt}));
    seconds(5);
    EXPECT_FALSE(editor.session.changed) << "answered";
    document().go_to(document().history_cursor() - 2);
    EXPECT_TRUE(document().dirty()) << "the file holds theirs, not this";
    document().go_to(document().history().size());
    save_level(editor);
    EXPECT_FALSE(editor.message);
    EXPECT_EQ(open()->surface_of(3), ladder);
}

// Before the window has looked at the file: a save must not replace it either.
TEST_F(ChangedOnDisk, SavingOverAChangedFileAsks) {
    paint(document(), 2, ice);
    paint(*other, 4, ladder);
    ASSERT_TRUE(other->save());
    save_level(editor);
    ASSERT_TRUE(editor.message);
    EXPECT_TRUE(editor.message->asks_about_files);
    EXPECT_TRUE(editor.message->of_refused_write) << "a script must expect it";
    EXPECT_EQ(open()->surface_of(4), ladder);
    answer_changed(editor, ChangedAnswer::keep_mine);
    EXPECT_FALSE(editor.message);
    EXPECT_FALSE(document().dirty()) << "the save that waited is done";
    EXPECT_EQ(open()->surface_of(2), ice);
    EXPECT_NE(open()->surface_of(4), ladder);
}

TEST_F(ChangedOnDisk, AFormatterOrATouchIsNoChange) {
    paint(document(), 2, ice);
    const std::string text = read_text(level_file);
    const std::size_t steps = document().history().size();
    for (const std::string& other_text : {text + "\n", "  " + text, text}) {
        write_text(level_file, other_text);
        seconds(3);
        ASSERT_FALSE(editor.session.changed);
        ASSERT_EQ(document().history().size(), steps);
    }
    write_text(level_file, text + "\n\n");
    save_level(editor);
    EXPECT_FALSE(editor.message);
    EXPECT_FALSE(document().dirty());
}

// A checkout and the one back.
TEST_F(ChangedOnDisk, AFileThatIsAsBeforeWithdrawsTheQuestion) {
    const std::string before = read_text(level_file);
    change_both();
    write_text(level_file, before);
    seconds(3);
    EXPECT_FALSE(editor.session.changed);
    EXPECT_EQ(faces_1_to_4(), (Four{ice, ice, ladder, std::nullopt}));
    save_level(editor);
    EXPECT_FALSE(editor.message);
}

TEST_F(ChangedOnDisk, TheSameChangesOnBothSidesAreSaved) {
    paint(document(), 2, ice);
    paint(*other, 2, ice);
    ASSERT_TRUE(other->save());
    seconds(3);
    EXPECT_FALSE(editor.session.changed);
    EXPECT_FALSE(document().dirty());
}

// Geometry in which all paint is found exactly is read at once; otherwise it waits.
TEST_F(ChangedOnDisk, GeometryWaitsWhereUnsavedPaintWouldBeGuessed) {
    paint(document(), 0, ice);
    write_text(obj, "# new\n" + floor_and_wall_obj(n));
    seconds(3);
    EXPECT_FALSE(editor.session.changed);
    write_text(obj, obj_with_cut_face(n));
    seconds(3);
    ASSERT_TRUE(editor.session.changed);
    EXPECT_EQ(document().face_count(), face_count);
    write_text(obj, "# new\n" + floor_and_wall_obj(n));
    seconds(3);
    EXPECT_FALSE(editor.session.changed) << "as before";
    write_text(obj, obj_with_cut_face(n));
    seconds(3);
    ASSERT_TRUE(editor.session.changed);
    answer_changed(editor, ChangedAnswer::merge);
    EXPECT_EQ(document().face_count(), face_count + 1);
    EXPECT_FALSE(editor.session.changed);
    document().undo();
    EXPECT_EQ(document().face_count(), face_count);
}

}  // namespace
}  // namespace slipface
