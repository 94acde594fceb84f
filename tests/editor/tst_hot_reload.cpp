// Other programs write the open level's files: what the editor does about it.
#include <random>

#include "level_fixture.h"
#include "slipface/exchange/export.h"
#include "slipface/level/level_file.h"
#include "tools/commands/commands.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

class HotReload : public LevelFixture {
  protected:
    void SetUp() override {
        LevelFixture::SetUp();
        open_level(editor, obj);
        ASSERT_FALSE(editor.message);
        seconds(2);
    }

    // Lets time pass as an idle window does.
    void seconds(int count) {
        bool shown_changed = false;
        for (int i = 0; i < count; ++i)
            tick_session(editor, now += 1.0, shown_changed);
    }
    Document& document() { return *editor.document; }
    void paint(FaceId face, SurfaceId surface) { document().paint(std::span(&face, 1), surface); }
    Editor editor;
    double now = 0.0;
};

TEST_F(HotReload, ReadsAChangedFileAndStaysSaved) {
    paint(5, ice);
    ASSERT_TRUE(document().save());
    watch_files(editor);
    write_text(obj, "# a comment\n" + floor_and_wall_obj(n));
    seconds(3);
    EXPECT_EQ(document().history().back().name, "Reload grid.obj");
    EXPECT_FALSE(document().dirty()) << "the level file says the same as before";
    EXPECT_NE(editor.status.find("All paint kept"), std::string::npos) << editor.status;
    EXPECT_FALSE(editor.message);
}

TEST_F(HotReload, ATouchDoesNothing) {
    ASSERT_TRUE(document().save());
    watch_files(editor);
    const std::size_t steps = document().history().size();
    editor.status = "as it was";
    for (const fs::path& file : {obj, level_file}) {
        fs::last_write_time(file, fs::file_time_type::clock::now() + std::chrono::seconds(5));
        seconds(3);
        write_text(file, read_text(file));
        seconds(3);
    }
    EXPECT_EQ(document().history().size(), steps);
    EXPECT_EQ(editor.status, "as it was");
    EXPECT_FALSE(document().dirty());
}

TEST_F(HotReload, DoesNotAskWhenThereAreUnsavedChanges) {
    paint(5, ice);
    write_text(obj, "# a comment\n" + floor_and_wall_obj(n));
    seconds(3);
    EXPECT_EQ(document().history().back().name, "Reload grid.obj");
    EXPECT_TRUE(document().dirty());
    EXPECT_EQ(document().resolved().surface[5], ice);
    EXPECT_NE(editor.status.find("undo"), std::string::npos) << editor.status;
}

TEST_F(HotReload, AHalfWrittenFileIsNoError) {
    const std::string whole = "# new\n" + floor_and_wall_obj(n);
    write_text(obj, whole.substr(0, whole.size() / 2) + "f 1 2 x");
    seconds(3);
    EXPECT_FALSE(editor.message);
    EXPECT_TRUE(editor.session.broken);
    write_text(obj, whole);
    seconds(3);
    EXPECT_FALSE(editor.message);
    EXPECT_FALSE(editor.session.broken);
    EXPECT_EQ(document().history().back().name, "Reload grid.obj");
}

TEST_F(HotReload, AnErrorThatStaysIsSaidAndClosesByItself) {
    write_text(obj, "v 0 0 0\nf 1 2 3\n");
    seconds(10);
    ASSERT_TRUE(editor.message);
    EXPECT_NE(editor.message->text.find("grid.obj:2"), std::string::npos) << editor.message->text;
    EXPECT_EQ(document().face_count(), face_count) << "the level stays as it was";
    write_text(obj, "v 0 0 0\nf 1 2 3 4\n");
    seconds(3);
    ASSERT_TRUE(editor.message);
    write_text(obj, floor_and_wall_obj(n));
    seconds(3);
    EXPECT_FALSE(editor.message) << "the same bytes as ever: nothing to read, and nothing wrong any more";

    write_text(obj, "v 0 0 0\nf 1 2 3\n");
    seconds(10);
    editor.message.reset();  // the user closes it
    seconds(10);
    EXPECT_FALSE(editor.message) << "said once";
    editor.message = MessageDialog{"Another", "matter", {}};
    write_text(obj, floor_and_wall_obj(n - 1));
    seconds(3);
    EXPECT_TRUE(editor.message) << "of something else";
    EXPECT_EQ(document().face_count(), static_cast<std::size_t>((n - 1) * n));
}

// However a writer dawdles: in the end the level is what the file is, the paint is on it, and nobody was
// asked or shown an error.
TEST_F(HotReload, AWriterThatDawdlesLosesNothing) {
    paint(5, ice);
    paint(wall + 3, ice);
    std::mt19937 random(7);
    for (int round = 0; round < 30; ++round) {
        const std::string whole = "# round " + std::to_string(round) + "\n" + floor_and_wall_obj(n);
        std::size_t written = 0;
        while (written < whole.size()) {
            written = std::min(whole.size(), written + 1 + random() % 600);
            write_text(obj, whole.substr(0, written));
            seconds(static_cast<int>(random() % 3));
            ASSERT_FALSE(editor.message) << editor.message->text;
        }
        seconds(3);
        ASSERT_EQ(document().face_count(), face_count) << "round " << round;
        ASSERT_EQ(document().resolved().surface[5], ice) << "round " << round;
        ASSERT_EQ(document().resolved().surface[wall + 3], ice) << "round " << round;
        ASSERT_TRUE(document().level().orphans.empty());
        ASSERT_FALSE(editor.session.broken);
    }
}

TEST_F(HotReload, GuessedPaintIsListedAndCanBeSteppedThrough) {
    paint(0, ice);
    paint(9, ladder);
    write_text(obj, obj_with_cut_face(n));
    seconds(3);
    answer_changed(editor, ChangedAnswer::merge);
    ASSERT_EQ(document().face_count(), face_count + 1);
    ASSERT_EQ(std::vector<FaceId>(document().guessed().begin(), document().guessed().end()),
              (std::vector<FaceId>{0, 1}));
    EXPECT_TRUE(document().dirty()) << "saving writes where the paint is now";
    EXPECT_NE(editor.status.find("2 faces' paint was guessed"), std::string::npos) << editor.status;

    step_guessed(editor, true);
    EXPECT_EQ(document().selection()[0], 0u);
    step_guessed(editor, true);
    EXPECT_EQ(document().selection()[0], 1u);
    EXPECT_EQ(editor.status, "Guessed paint 2 of 2: ice");
    step_guessed(editor, true);
    EXPECT_EQ(document().selection()[0], 0u);
    step_guessed(editor, false);
    EXPECT_EQ(document().selection()[0], 1u);

    // It is known again when the level is opened before it was saved, and not when undo brings the old one.
    while (document().face_count() != face_count)
        document().undo();
    EXPECT_TRUE(document().guessed().empty());
    document().go_to(document().history().size());
    EXPECT_EQ(document().guessed().size(), 2u);

    // One is accepted and one dropped; undo brings the paint of the dropped one back.
    go_to_guess(editor, 0);
    settle_guesses(editor, selected_guesses(document()), true);
    EXPECT_EQ(document().guessed().size(), 1u);
    EXPECT_EQ(document().selection()[0], 1u) << "goes on to the next";
    settle_guesses(editor, selected_guesses(document()), false);
    EXPECT_TRUE(document().guessed().empty());
    EXPECT_EQ(document().resolved().surface[0], ice);
    EXPECT_NE(document().resolved().surface[1], ice);
    document().undo();
    EXPECT_EQ(document().resolved().surface[1], ice);
    ASSERT_EQ(document().guessed().size(), 1u) << "the dropped one is a guess again";

    // They are kept in the level file until they are settled.
    ASSERT_TRUE(document().save());
    auto opened = open();
    ASSERT_EQ(opened->guessed().size(), 1u);
    EXPECT_EQ(opened->guessed()[0], 1u);
    opened->accept_guessed(opened->guessed());
    EXPECT_TRUE(opened->guessed().empty());
    EXPECT_TRUE(opened->dirty()) << "the file still has it";
    opened->undo();
    EXPECT_EQ(opened->guessed().size(), 1u);
    EXPECT_FALSE(opened->dirty());
    const FaceId face = 1;
    opened->paint(std::span(&face, 1), ice);
    EXPECT_TRUE(opened->guessed().empty()) << "what the user paints is no guess, even in its type";
    ASSERT_TRUE(opened->save());
    EXPECT_TRUE(open()->guessed().empty());
}

// The keys of the list of guesses: J, Shift+J, Ctrl+J, Alt+J and Ctrl+Shift+J.
TEST_F(HotReload, GuessesAreSettledByKeys) {
    paint(0, ice);
    write_text(obj, obj_with_cut_face(n));
    seconds(3);
    answer_changed(editor, ChangedAnswer::merge);
    ASSERT_EQ(document().guessed().size(), 2u);
    const auto press = [&](const Shortcut& keys) {
        const Command* const row = command_for(keys);
        ASSERT_TRUE(row) << keys.text();
        EXPECT_TRUE(run_command(editor, row->id)) << row->id;
    };
    press({"J", false, false, false});
    EXPECT_EQ(document().selection()[0], 0u);
    press({"J", false, true, false});
    EXPECT_EQ(document().selection()[0], 1u);
    press({"J", true, false, false});
    EXPECT_EQ(std::vector<FaceId>(document().guessed().begin(), document().guessed().end()),
              std::vector<FaceId>{0});
    EXPECT_EQ(document().selection()[0], 0u) << "goes on to the next";
    press({"J", false, false, true});
    EXPECT_TRUE(document().guessed().empty());
    EXPECT_FALSE(document().level().overrides[0].has_value()) << "dropped";
    EXPECT_EQ(document().resolved().surface[1], ice) << "accepted";
    // Both halves of the cut face are connected.
    while (document().guessed().size() != 2)
        document().undo();
    press({"J", false, false, false});
    press({"J", true, true, false});
    EXPECT_TRUE(document().guessed().empty());
}

TEST_F(HotReload, ALevelFileThatChangedIsTakenOverAndUndoGoesBack) {
    auto other = open();
    const FaceId face = 20;
    other->paint(std::span(&face, 1), ladder);
    ASSERT_TRUE(other->save());
    seconds(3);
    EXPECT_EQ(document().resolved().surface[20], ladder);
    EXPECT_FALSE(document().dirty());
    document().undo();
    EXPECT_NE(document().resolved().surface[20], ladder);
}

TEST_F(HotReload, AChangedMaterialIsSeen) {
    const fs::path mtl = folder / "grid.mtl";
    write_text(obj, "mtllib grid.mtl\n" + floor_and_wall_obj(n));
    write_text(mtl, "newmtl floor\nKd 0.1 0.2 0.3\nnewmtl wall__ladder\n");
    open_level(editor, obj);
    paint(5, ice);
    const auto kd = [&] { return document().mesh().materials[document().mesh().face_material[0]].diffuse; };
    ASSERT_EQ(kd(), Vec3f(0.1f, 0.2f, 0.3f));
    seconds(2);
    const std::size_t steps = document().history().size();
    write_text(mtl, "# only a word\n" + read_text(mtl));
    write_text(folder / "another.mtl", "newmtl floor\nKd 1 1 1\n");
    seconds(3);
    EXPECT_EQ(document().history().size(), steps) << "the materials are as they were";
    write_text(mtl, "newmtl floor\nKd 0.9 0.2 0.3\nnewmtl wall__ladder\n");
    seconds(3);
    EXPECT_EQ(kd(), Vec3f(0.9f, 0.2f, 0.3f));
    EXPECT_EQ(document().resolved().surface[5], ice);
    EXPECT_EQ(document().history().back().name, "Reload grid.obj");
}

// Blender writes the geometry of a .gltf into a .bin beside it; where only that changes, the level did.
TEST_F(HotReload, AChangedBufferIsSeen) {
    const auto export_to = [&](const fs::path& gltf) {
        const Result<LoadedLevel> level = load_level(obj);
        ASSERT_TRUE(level) << level.error().text();
        ASSERT_TRUE(export_level(level->level, {.gltf = gltf}));
    };
    fs::create_directory(folder / "new");
    export_to(folder / "grid.gltf");
    std::string moved = floor_and_wall_obj(n);
    moved.replace(moved.find("v 3 0 3\n"), 7, "v 3.4 0 3");  // the bounds stay
    write_text(obj, moved);
    export_to(folder / "new" / "grid.gltf");
    open_level(editor, folder / "grid.gltf");
    ASSERT_FALSE(editor.message);
    seconds(3);
    const std::uint64_t before = document().level().mesh.fingerprint();
    fs::copy_file(folder / "new" / "grid.bin", folder / "grid.bin", fs::copy_options::overwrite_existing);
    seconds(4);
    EXPECT_NE(document().level().mesh.fingerprint(), before);
    EXPECT_EQ(document().history().back().name, "Reload grid.gltf");
    EXPECT_TRUE(read_text(folder / "grid.gltf") == read_text(folder / "new" / "grid.gltf"))
        << "only the buffer was to change";
}

TEST_F(HotReload, AChangedTextureIsReadAgain) {
    write_text(obj, "mtllib grid.mtl\n" + floor_and_wall_obj(n));
    write_text(folder / "grid.mtl", "newmtl floor\nmap_Kd tiles.png\nnewmtl wall__ladder\n");
    open_level(editor, obj);
    seconds(3);
    const std::uint64_t before = editor.texture_revision;
    const std::size_t steps = document().history().size();
    // One that was missing is there now, then has other content, then is gone again.
    write_text(folder / "tiles.png", "a");
    seconds(3);
    EXPECT_EQ(editor.texture_revision, before + 1);
    write_text(folder / "tiles.png", "ab");
    seconds(3);
    EXPECT_EQ(editor.texture_revision, before + 2);
    fs::remove(folder / "tiles.png");
    seconds(3);
    EXPECT_EQ(editor.texture_revision, before + 3);
    seconds(10);
    EXPECT_EQ(editor.texture_revision, before + 3);
    EXPECT_EQ(document().history().size(), steps);
    EXPECT_FALSE(document().dirty());
}

TEST_F(HotReload, ALevelThatIsDeletedAndMadeAgain) {
    paint(5, ice);
    ASSERT_TRUE(document().save());
    watch_files(editor);
    fs::remove(obj);
    fs::remove(level_file);
    seconds(8);
    EXPECT_FALSE(editor.message);
    EXPECT_EQ(document().resolved().surface[5], ice);
    write_text(obj, "# again\n" + floor_and_wall_obj(n));
    seconds(4);
    EXPECT_FALSE(editor.message);
    EXPECT_EQ(document().resolved().surface[5], ice);
    save_level(editor);
    EXPECT_FALSE(editor.message);
    EXPECT_TRUE(fs::exists(level_file));
}

TEST_F(HotReload, AFolderThatIsRenamedUnderTheEditor) {
    const fs::path inside = folder / "here", moved = folder / "there";
    fs::create_directory(inside);
    write_text(inside / "grid.obj", floor_and_wall_obj(n));
    open_level(editor, inside / "grid.obj");
    paint(5, ice);
    fs::rename(inside, moved);
    seconds(8);
    EXPECT_FALSE(editor.message);
    save_level(editor);
    ASSERT_TRUE(editor.message) << "there is no such folder any more";
    EXPECT_NE(editor.message->text.find(inside.string()), std::string::npos) << editor.message->text;
    EXPECT_TRUE(document().dirty());
    editor.message.reset();
    save_level_as(editor, moved / "grid.slipface.json");
    EXPECT_FALSE(editor.message);
    EXPECT_TRUE(fs::exists(moved / "grid.slipface.json"));
}

}  // namespace
}  // namespace slipface
