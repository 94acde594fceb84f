// Hidden faces and saved selections belong to the level: they are saved, found again and recovered.
#include <gmock/gmock.h>

#include "app_fixture.h"

namespace slipface {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using Kept = AppFixture;

TEST_F(Kept, HidingAndKeepingSelectionsIsSaved) {
    ASSERT_EQ(run("select faces 3,4\nexpect dirty no\nselect save corner\nexpect dirty yes\n"
                  "command file.save\nexpect dirty no\nselect faces 8-10\ncommand select.hide\n"
                  "expect dirty yes\ncommand file.save\nexpect dirty no"),
              "");
    ASSERT_EQ(run("open grid.obj\nexpect hidden 3\nexpect saved 1\nexpect dirty no\n"
                  "expect status \"*72 faces, 3 hidden\""),
              "");
    EXPECT_THAT(document().hidden(), ElementsAre(8, 9, 10));
    EXPECT_THAT(document().saved_selections()[0].faces, ElementsAre(3, 4));
    EXPECT_EQ(document().saved_selections()[0].name, "corner");
    // They are hidden indeed: neither selected nor picked.
    ASSERT_EQ(run("command select.all\nexpect selected 69\nselect recall corner\nexpect selected 2"), "");
    EXPECT_FALSE(editor().document->pick({1.5, 5, 0.5}, {0, -1, 0}, false));
    // Nor do they count when the camera frames all.
    ASSERT_EQ(run("command view.frame_all"), "");
    const double with_three_hidden = editor().view.distance;
    ASSERT_EQ(run("select faces 20-71\ncommand select.hide\ncommand view.frame_all"), "");
    EXPECT_LT(editor().view.distance, 0.7 * with_three_hidden);
    ASSERT_EQ(run("key Ctrl+Z\nexpect hidden 3"), "");
    ASSERT_EQ(run("command select.show_all\nexpect hidden 0\nkey Ctrl+Z\nexpect hidden 3"), "");
}

TEST_F(Kept, AreFoundOnReloadedGeometryOrListed) {
    ASSERT_EQ(run("select faces 0,65\nselect save both\nselect faces 5,66\ncommand select.hide"), "");
    // Two more vertices in front, so that no index stays; and the wall, faces 64 on, is gone.
    std::string text = floor_and_wall_obj(n);
    text = text.substr(0, text.find("usemtl wall"));
    std::string turned;
    std::istringstream lines(text);
    std::vector<std::string> faces;
    for (std::string line; std::getline(lines, line);)
        line[0] == 'f' ? faces.push_back(line + "\n") : void(turned += line + "\n");
    for (auto face = faces.rbegin(); face != faces.rend(); ++face)
        turned += *face;
    write_text(obj, turned);
    ASSERT_EQ(run("command file.reload\nexpect hidden 1\nexpect saved 1"), "");
    EXPECT_THAT(document().hidden(), ElementsAre(63 - 5));
    EXPECT_THAT(document().saved_selections()[0].faces, ElementsAre(63));
    std::string listed;
    for (const Diagnostic& warning : document().warnings())
        listed += warning.text() + "\n";
    EXPECT_THAT(listed, HasSubstr("1 of the 2 faces hidden"));
    EXPECT_THAT(listed, HasSubstr("1 of the 2 faces of the selection \"both\""));
    EXPECT_TRUE(editor().layout.shown(PanelId::warnings));
    ASSERT_EQ(run("key Ctrl+Z\nexpect hidden 2"), "");
    EXPECT_THAT(document().hidden(), ElementsAre(5, 66));
    EXPECT_THAT(document().saved_selections()[0].faces, ElementsAre(0, 65));
}

TEST_F(Kept, ALevelFileThatChangedOnDiskBringsItsOwn) {
    ASSERT_EQ(run("select faces 1,2\ncommand select.hide\ncommand file.save"), "");
    const std::string with_hidden = read_text(level_file);
    ASSERT_EQ(run("command select.show_all\nselect faces 1,3\ncommand file.save"), "");
    write_text(level_file, with_hidden);
    ASSERT_EQ(run("wait 200"), "");
    EXPECT_THAT(document().hidden(), ElementsAre(1, 2));
    EXPECT_THAT(document().selection(), ElementsAre(3)) << "what is hidden is not selected";
    EXPECT_TRUE(document().is_hidden(1));
    EXPECT_FALSE(document().dirty());
    ASSERT_EQ(run("key Ctrl+Z"), "");
    EXPECT_THAT(document().hidden(), IsEmpty());
    EXPECT_FALSE(document().is_hidden(1));
    EXPECT_THAT(document().selection(), ElementsAre(1, 3));
}

TEST_F(Kept, ACrashLosesNeither) {
    ASSERT_EQ(run("select faces 3,4\nselect save corner\ncommand select.hide\nautosave\ncrash\ncommand "
                  "file.recover\n"
                  "click \"Recover/grid.obj/Recover\"\nexpect hidden 2\nexpect saved 1"),
              "");
}

TEST_F(Kept, ThereIsALimitThatIsReported) {
    std::vector<SavedSelection> many(max_saved_selections, SavedSelection{"a", {}});
    editor().document->set_saved_selections(many, "Many");
    ASSERT_EQ(run("select faces 1\nselect save another\nexpect status \"Not saved: a level can have at most "
                  "1000*\""),
              "");
    EXPECT_EQ(document().saved_selections().size(), max_saved_selections);
    ASSERT_TRUE(editor().document->save());
    ASSERT_EQ(run("open grid.obj\nexpect saved 1000"), "");
}

}  // namespace
}  // namespace slipface
