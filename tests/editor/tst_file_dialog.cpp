// The file dialog as it is used: by keys, by typing, by the mouse.
#include "app_fixture.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

class FileDialog : public AppFixture {
  protected:
    void SetUp() override {
        AppFixture::SetUp();
        fs::create_directories(folder / "deep" / "inner");
        write_text(folder / "deep" / "other.obj", floor_and_wall_obj(3));
        write_text(folder / "deep" / "ice cave.stl", "");
        write_text(folder / "deep" / "notes.txt", "");
        write_text(folder / "deep" / ".dotted.obj", "");
    }
};

TEST_F(FileDialog, ListsEveryFormatAndALevelOnce) {
    write_text(folder / "map.bsp", "");
    write_text(folder / "rock.gltf", "");
    write_text(folder / "grid.slipface.json", "");
    ASSERT_EQ(
        run("command file.open\nexpect widget \"File dialog/List/map.bsp\"\n"
            "expect widget \"File dialog/List/rock.gltf\"\nexpect widget \"File dialog/List/grid.obj\"\n"
            "expect no_widget \"File dialog/List/grid.slipface.json\"\n"
            "click \"File dialog/Format\"\nclick \"File dialog/Format/Quake 3 map\"\n"
            "expect widget \"File dialog/List/map.bsp\"\n"
            "expect no_widget \"File dialog/List/rock.gltf\"\n"
            "expect widget \"File dialog/List/deep\""),
        "");
}

TEST_F(FileDialog, TypingFiltersAndEnterOpens) {
    ASSERT_EQ(run("command file.open\nclick \"File dialog/List/deep\"\n"
                  "expect widget \"File dialog/List/ice cave.stl\"\n"
                  "expect no_widget \"File dialog/List/notes.txt\"\n"
                  "expect no_widget \"File dialog/List/.dotted.obj\"\n"
                  "type \"OTH\"\nwait 2\nexpect no_widget \"File dialog/List/ice cave.stl\"\n"
                  "type \"er\"\nwait 2\nexpect widget \"File dialog/List/other.obj\"\nkey Enter\nwait 2"),
              "");
    EXPECT_EQ(editor().file_dialog, FileDialogKind::none);
    EXPECT_EQ(document().level().mesh_path, folder / "deep" / "other.obj");
}

TEST_F(FileDialog, ArrowsChooseBackspaceGoesUp) {
    ASSERT_EQ(run("command file.open\nkey Down\nkey Enter\nwait 2\n"
                  "expect widget \"File dialog/List/other.obj\"\n"
                  "key Down\nkey Down\nkey Down\nkey Up\nkey Backspace\nwait 2\n"
                  "expect widget \"File dialog/List/grid.obj\"\nkey Down\nkey Down\nkey Enter\nwait 2"),
              "");
    EXPECT_EQ(editor().file_dialog, FileDialogKind::none) << "folders first, then grid.obj";
}

TEST_F(FileDialog, TabCompletesAPathThatIsTyped) {
    // A slash begins a path.
    const std::string begun = (folder / "de").string();
    ASSERT_EQ(
        run("command file.open\ntype \"" + begun.substr(0, 1) + "\"\nwait 2\ntype \"" + begun.substr(1) +
            "\"\nwait 2\nkey Tab\nwait 2\nexpect widget \"File dialog/List/other.obj\"\n"
            "type \"ot\"\nwait 2\nkey Tab\nwait 2\nkey Enter\nwait 2"),
        "");
    EXPECT_EQ(document().level().mesh_path, folder / "deep" / "other.obj");
}

TEST_F(FileDialog, SeveralCandidatesAreNamed) {
    write_text(folder / "deep" / "otter.obj", "");
    ASSERT_EQ(run("command file.open\nclick \"File dialog/Path\"\nkey Ctrl+A\ntype \"" +
                  (folder / "deep" / "o").string() +
                  "\"\nwait 2\nkey Tab\nwait 2\nexpect widget \"File dialog/Candidates\""),
              "");
}

TEST_F(FileDialog, OddNamesAreShownAndOpened) {
    const std::string names[] = {"two\nlines.obj", "\xff\xfe.obj", "a##b.obj",
                                 std::string(251, 'x') + ".obj"};
    for (const std::string& name : names) {
        write_text(folder / name, floor_and_wall_obj(2));
        ASSERT_EQ(run("command file.open\nwait 40"), "");  // the double click before is forgotten
        // Scripts name widgets by what stands before "##".
        const auto found = ui::widgets().find("File dialog/List/" + name.substr(0, name.find("##")));
        ASSERT_NE(found, ui::widgets().end()) << name;
        host->move_mouse(found->second.centre());
        host->frame();
        for (int i = 0; i < 2; ++i) {
            host->mouse_button(0, true);
            host->frame();
            host->mouse_button(0, false);
            host->frame();
        }
        EXPECT_EQ(editor().file_dialog, FileDialogKind::none) << name;
        EXPECT_EQ(document().level().mesh_path, folder / name);
        ASSERT_FALSE(editor().message) << editor().message->text;
        fs::remove(folder / name);
    }
}

TEST_F(FileDialog, AFolderThatVanishedIsSaid) {
    ASSERT_EQ(run("command file.open\nwait 2"), "");
    fs::remove_all(folder / "deep");
    ASSERT_EQ(run("click \"File dialog/List/deep\"\nwait 2\nexpect widget \"File dialog/Problem\""), "");
    ASSERT_EQ(run("click \"File dialog/Up\"\nwait 2\nclick \"File dialog/Cancel\""), "");
}

TEST_F(FileDialog, ColumnsSort) {
    write_text(folder / "deep" / "big.obj", std::string(5000, '#'));
    ASSERT_EQ(run("command file.open\nclick \"File dialog/List/deep\"\nwait 2\n"
                  "click \"File dialog/List/Size\"\nwait 2\nclick \"File dialog/List/Size\"\nwait 2"),
              "");
    const auto y = [](const std::string& name) {
        return ui::widgets().find("File dialog/List/" + name)->second.min.y;
    };
    EXPECT_LT(y("big.obj"), y("other.obj"));
    EXPECT_LT(y("other.obj"), y("ice cave.stl"));
    EXPECT_LT(y("inner"), y("big.obj")) << "folders stay first";
}

TEST_F(FileDialog, TheWelcomeScreenOffersSamplesAndUnsavedChanges) {
    const FaceId face = 2;
    editor().document->paint(std::span(&face, 1), ice);
    ASSERT_EQ(run("autosave\ncrash\nwait 2\nexpect widget \"Welcome/Samples/easy\"\n"
                  "expect no_widget \"Recover/grid.obj/Recover\"\n"
                  "click \"Welcome/Unsaved/grid.obj\"\nwait 2"),
              "");
    EXPECT_EQ(document().resolved().surface[2], ice);
    EXPECT_TRUE(document().dirty());
}

}  // namespace
}  // namespace slipface
