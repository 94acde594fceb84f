#include "app/screens.h"
#include "app_fixture.h"

namespace slipface {
namespace {

using ScriptTest = AppFixture;

TEST(ScriptParser, SplitsWordsQuotesAndComments) {
    const auto lines = parse_script(
        "# nothing\n\nclick \"Movement/Keep energy\"  # why\r\ntype \"say \\\"hi\\\"\"\n\tkey Ctrl+S", "p");
    ASSERT_TRUE(lines);
    ASSERT_EQ(lines->size(), 3u);
    EXPECT_EQ((*lines)[0].number, 3);
    EXPECT_EQ((*lines)[0].words, (std::vector<std::string>{"click", "Movement/Keep energy"}));
    EXPECT_EQ((*lines)[1].words, (std::vector<std::string>{"type", "say \"hi\""}));
    EXPECT_EQ((*lines)[2].words, (std::vector<std::string>{"key", "Ctrl+S"}));
}

TEST(ScriptParser, AnOpenQuoteNamesItsLine) {
    const auto lines = parse_script("wait 1\nclick \"Toolbar", "walk.script");
    ASSERT_FALSE(lines);
    EXPECT_EQ(lines.error().location, "walk.script:2");
}

TEST(ScriptDocs, EveryVerbIsInThePage) {
    const std::string page = script_verbs_markdown();
    for (const ScriptVerb& verb : script_verbs())
        EXPECT_NE(page.find("| `" + std::string(verb.name) + "` |"), std::string::npos);
    EXPECT_NE(page.find("| `surface` |"), std::string::npos);
}

TEST_F(ScriptTest, ErrorsNameTheLineAndWhatIsNear) {
    EXPECT_EQ(run("wait 1\njump high").substr(0, 33), "test.script:2: no verb \"jump\"; th");
    const std::string near = run("\n\nclick \"Toolbar/Pain\"");
    EXPECT_EQ(near.substr(0, 15), "test.script:3: ");
    EXPECT_NE(near.find("no widget \"Toolbar/Pain\""), std::string::npos) << near;
    EXPECT_NE(near.find("\"Toolbar/Paint\""), std::string::npos) << near;
    EXPECT_NE(run("command file.sav").find("file.save"), std::string::npos);
    EXPECT_NE(run("wait soon").find("found \"soon\""), std::string::npos);
    EXPECT_NE(run("wait -1").find("expected 0 to"), std::string::npos);
    EXPECT_NE(run("click").find("expected: click"), std::string::npos);
    EXPECT_NE(run("set max_slop=1").find("max_slop"), std::string::npos);
    EXPECT_NE(run("viewport poke 1 1").find("expected click, hover or drag"), std::string::npos);
    EXPECT_NE(run("viewport click 1 1 gently").find("gently"), std::string::npos);
    EXPECT_NE(run("viewport click @0,0").find("expected x,y,z"), std::string::npos);
    EXPECT_NE(run("camera eye 4,14,4 target 4,0,4\nviewport click @4,99,4").find("is outside the view"),
              std::string::npos);
    EXPECT_NE(run("camera bookmark Nowhere").find("no camera \"Nowhere\""), std::string::npos);
    EXPECT_NE(run("hold P 3").find("expected W"), std::string::npos);
    EXPECT_NE(run("expect luck").find("cannot expect \"luck\""), std::string::npos);
    EXPECT_NE(run("click \"Toolbar/Undo\"").find("disabled"), std::string::npos);
}

TEST_F(ScriptTest, ExpectationsFailAsSuchAndNameWhatWasFound) {
    const auto failure = [this](const std::string& text) {
        return run_script(*host, text, "s", folder).failure;
    };
    EXPECT_EQ(failure("expect dirty yes"), ScriptFailure::expectation);
    EXPECT_EQ(failure("expect dirty no"), ScriptFailure::none);
    EXPECT_EQ(failure("expect dirty maybe"), ScriptFailure::bad_input);
    EXPECT_EQ(failure("expect surface 0 ice"), ScriptFailure::expectation);
    EXPECT_EQ(failure("expect surface 0 default"), ScriptFailure::none);
    EXPECT_EQ(failure("expect surface 999999 default"), ScriptFailure::bad_input);
    EXPECT_EQ(failure("expect count ladder 8"), ScriptFailure::none);
    EXPECT_EQ(failure("expect count ladder 7"), ScriptFailure::expectation);
    EXPECT_EQ(failure("expect count lava 7"), ScriptFailure::bad_input);
    EXPECT_EQ(failure("expect widget \"Toolbar/Paint\""), ScriptFailure::none);
    EXPECT_EQ(failure("expect widget \"Toolbar/Dig\""), ScriptFailure::expectation);
    EXPECT_EQ(failure("expect no_widget \"Toolbar/Paint\""), ScriptFailure::expectation);
    EXPECT_EQ(failure("expect tool paint"), ScriptFailure::expectation);
    EXPECT_EQ(failure("click \"Toolbar/Paint\"\nexpect tool paint\nexpect checked \"Toolbar/Paint\" yes"),
              ScriptFailure::none);
    EXPECT_EQ(failure("set gravity=12\nexpect setting gravity=12\nexpect history 1"), ScriptFailure::none);
    EXPECT_EQ(failure("expect setting gravity=13"), ScriptFailure::expectation);
    EXPECT_NE(run("expect selected 4").find("expected selected 4, found 0"), std::string::npos);
}

TEST_F(ScriptTest, TextAndKeysReachAWidgetAsTyped) {
    ASSERT_EQ(run("command file.open\nclick \"File dialog/Path\"\nkey Ctrl+A\ntype \"nowhere.obj\"\nclick "
                  "\"File dialog/Open\""),
              "");
    EXPECT_EQ(editor().file_dialog, FileDialogKind::open);
    EXPECT_EQ(run("key Escape"), "");
}

TEST_F(ScriptTest, AWidgetBelowTheEdgeIsScrolledTo) {
    // The movement panel is longer than this window is high.
    OffscreenOptions options;
    options.height = 360;
    start(options);
    std::string last;
    for (const auto& [path, rect] : ui::widgets())
        if (path.starts_with("Movement/") && !rect.visible && rect.checked) last = path;
    ASSERT_FALSE(last.empty());
    EXPECT_EQ(run("click \"" + last + "\"\nexpect history 1"), "");
}

TEST_F(ScriptTest, OnlyOnePanelIsShownAndEverythingComesBack) {
    const auto expect_all = "expect widget \"Toolbar/Paint\"\nexpect widget \"Tabs/Types\"";
    ASSERT_EQ(run("only probe 300\nexpect widget \"Tabs/Probe\"\nexpect no_widget \"Tabs/Movement\"\n"
                  "expect no_widget \"Tabs/Types\"\nexpect no_widget \"Toolbar/Paint\"\nexpect no_widget "
                  "\"Menu/View\""),
              "");
    EXPECT_EQ(run("command panel.why\nexpect widget \"Tabs/Why\"\nexpect no_widget \"Tabs/Probe\""), "");
    EXPECT_EQ(run("only view\nexpect no_widget \"Tabs/Why\"\nexpect widget \"Viewport/View\""), "");
    EXPECT_EQ(run("only all\n" + std::string(expect_all)), "");
    // By the keyboard, and by a tab's menu.
    EXPECT_EQ(run("key F11\nexpect no_widget \"Toolbar/Paint\"\nkey Escape\n" + std::string(expect_all)), "");
    EXPECT_EQ(
        run("right_click \"Tabs/Ghosts\"\nclick \"Tabs/Tab menu/Only this\"\nexpect widget \"Tabs/Ghosts\"\n"
            "expect no_widget \"Tabs/Types\"\nkey F11\n" +
            std::string(expect_all)),
        "");
    for (const char* wrong : {"only nonsense", "only probe 7", "only view 300"})
        EXPECT_EQ(run_script(*host, wrong, "test", folder).failure, ScriptFailure::bad_input) << wrong;
}

TEST(Sizes, AreReadStrictly) {
    EXPECT_EQ(parse_size("1280x720"), (std::pair{1280, 720}));
    for (const char* bad :
         {"", "1280", "x", "1280x", "x720", "-1x5", "1e3x5", "0x10", "99999x10", "1280x720x1"})
        EXPECT_FALSE(parse_size(bad)) << bad;
}

TEST_F(ScriptTest, ScreensAreMadeFromTheScriptsOfAFolder) {
    const auto screens = folder / "screenshots" / "editor";
    std::filesystem::create_directories(screens);
    write_text(screens / "b.script", "# level: grid.obj\n# size: 640x400\nclick \"Toolbar/Paint\"\n");
    write_text(screens / "a.script", "# size: wide\n");
    write_text(screens / "notes.txt", "");
    InputBook book(screens.parent_path().parent_path());
    const auto snapshots = screen_snapshots(screens, book);
    ASSERT_EQ(snapshots.size(), 2u);
    EXPECT_EQ(snapshots[0].name, "editor/a");
    EXPECT_EQ(snapshots[1].name, "editor/b");
    host.reset();
    const auto wrong = snapshots[0].render();
    ASSERT_FALSE(wrong);
    EXPECT_EQ(wrong.error().location, "a.script:1");
    const auto image = snapshots[1].render();
    ASSERT_TRUE(image) << image.error().text();
    EXPECT_EQ(image->image.width, 640);
    EXPECT_EQ(image->image.height, 400);
}

}  // namespace
}  // namespace slipface
