// Opening a hack's demo scene: what is unsaved, recorded or being walked is asked about or kept.
#include <gmock/gmock.h>

#include "app_fixture.h"
#include "slipface/scenes/demo.h"
#include "slipface/view/camera.h"
#include "tools/commands/commands.h"
#include "tools/commands/fuzzy.h"
#include "tools/lab/lab_actions.h"

namespace slipface {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

class DemoScenes : public AppFixture {
  protected:
    void SetUp() override {
        AppFixture::SetUp();
        if (const char* before = std::getenv("TMPDIR")) temporary_before = before;
        setenv("TMPDIR", folder.c_str(), 1);
        ASSERT_NE(demo, nullptr);
    }
    void TearDown() override {
        if (temporary_before)
            setenv("TMPDIR", temporary_before->c_str(), 1);
        else
            unsetenv("TMPDIR");
        AppFixture::TearDown();
    }
    void show() {
        open_demo(editor(), *demo);
        host->frame();
        host->frame();
    }
    std::string shown_level() { return document().level().mesh_path.parent_path().filename().string(); }
    // A walk of half a second, recorded; how it ended.
    std::uint64_t walk() {
        EXPECT_EQ(run("key F5\nwait 10\nhold W 20\nkey Escape\nfinish"), "");
        EXPECT_TRUE(editor().lab.unsaved);
        return editor().lab.sealed_tape().end_hash.value_or(0);
    }

    const DemoInfo* demo = &demo_table().front();
    std::optional<std::string> temporary_before;
};

TEST_F(DemoScenes, UnsavedChangesAreAskedAboutAndTheTapeComesAfterTheAnswer) {
    ASSERT_EQ(run("select faces 0-3\nkey 2\nkey L\nexpect dirty yes"), "");
    show();
    ASSERT_TRUE(editor().unsaved);
    EXPECT_EQ(document().level().mesh_path, obj);
    ASSERT_EQ(run("click \"Unsaved/Cancel\""), "");
    EXPECT_EQ(document().level().mesh_path, obj);
    EXPECT_TRUE(document().dirty());

    show();
    ASSERT_EQ(run("click \"Unsaved/Save\""), "");
    EXPECT_EQ(shown_level(), demo->name);
    EXPECT_EQ(editor().status, sentences_of(*demo));
    EXPECT_EQ(editor().lab.name(), demo->title);
    EXPECT_EQ(editor().lab.runs().size(), 3u) << "as recorded, now, and with the switch off";
    ASSERT_EQ(run("open grid.obj\nexpect count ice 4"), "");

    ASSERT_EQ(run("select faces 9\nkey 2\nkey L"), "");
    show();
    ASSERT_EQ(run("click \"Unsaved/Don't save\""), "");
    EXPECT_EQ(shown_level(), demo->name);
    ASSERT_EQ(run("open grid.obj\nexpect count ice 4"), "");
}

TEST_F(DemoScenes, ARecordedRunComesBackWithItsLevel) {
    const std::uint64_t end = walk();
    show();
    EXPECT_EQ(editor().lab.name(), demo->title);
    ASSERT_EQ(editor().stored_tapes.size(), 1u);
    request_open(editor(), obj);
    host->frame();
    EXPECT_EQ(editor().lab.name(), "Playtest");
    EXPECT_THAT(editor().status, EndsWith("the run recorded here is back in the lab"));
    EXPECT_TRUE(editor().stored_tapes.empty());
    EXPECT_TRUE(editor().lab.unsaved);
    ASSERT_EQ(run("finish"), "");
    EXPECT_EQ(editor().lab.sealed_tape().end_hash, end);
    EXPECT_EQ(editor().lab.repeats(), true);
}

TEST_F(DemoScenes, AWalkThatIsGoingOnIsKeptToo) {
    ASSERT_EQ(run("key F5\nhold W 20"), "");
    const std::size_t ticks = editor().playtest->tape().tick_count();
    ASSERT_GT(ticks, 10u);
    editor().document->paint(std::vector<FaceId>{5}, ice);
    show();
    ASSERT_TRUE(editor().unsaved);
    EXPECT_TRUE(editor().playtest) << "the question ends nothing";
    ASSERT_EQ(run("click \"Unsaved/Save\""), "");
    EXPECT_EQ(shown_level(), demo->name);
    EXPECT_FALSE(editor().playtest);
    ASSERT_EQ(editor().stored_tapes.size(), 1u);
    EXPECT_GE(editor().stored_tapes[0].tape.tick_count(), ticks);
    ASSERT_EQ(run("open grid.obj"), "");
    EXPECT_EQ(editor().lab.name(), "Playtest");
}

TEST_F(DemoScenes, ARunThatIsSavedIsNotKept) {
    walk();
    save_tape(editor(), folder / "walk.tape");
    EXPECT_FALSE(editor().lab.unsaved);
    show();
    EXPECT_TRUE(editor().stored_tapes.empty());
}

TEST_F(DemoScenes, WhatWasSavedOverADemoStays) {
    show();
    const auto first = document().level().mesh_path;
    show();
    EXPECT_EQ(document().level().mesh_path, first) << "unchanged files are used again";
    editor().document->paint(std::vector<FaceId>{0}, ladder);
    ASSERT_EQ(run("command file.save"), "");
    const std::string saved = read_text(document().level().file_path);
    show();
    EXPECT_NE(document().level().mesh_path, first);
    EXPECT_EQ(shown_level(), std::string(demo->name) + "-2");
    EXPECT_EQ(read_text(level_file_for(first)), saved);
    // Saving as the answer to the question does not lose it either.
    editor().document->paint(std::vector<FaceId>{1}, ladder);
    const auto second = document().level().file_path;
    show();
    ASSERT_EQ(run("click \"Unsaved/Save\""), "");
    EXPECT_EQ(shown_level(), std::string(demo->name) + "-3");
    EXPECT_THAT(read_text(second), HasSubstr("\"type\": \"ladder\""));
    std::size_t folders = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "slipface-demos"))
        folders += entry.is_directory() ? 1 : 0;
    EXPECT_EQ(folders, 3u) << "nothing half made is left behind";
}

TEST_F(DemoScenes, ShowTheirDifference) {
    for (const DemoInfo& info : demo_table()) {
        SCOPED_TRACE(info.name);
        demo = &info;
        show();
        ASSERT_EQ(shown_level(), info.name);
        EXPECT_EQ(run("finish\nexpect parts 2 yes"), "");
    }
}

// The menu has the lecture's order, first half first; a demo plays from its first tick to its last, with its
// card beside it, which leads to the next.
TEST_F(DemoScenes, PlayAtOnceInTheMenusOrder) {
    std::vector<std::string> listed;
    for (const Command& command : commands())
        if (std::string_view(command.menu) == "Lab/Demos") listed.emplace_back(command.label);
    ASSERT_EQ(listed.size(), demo_table().size());
    EXPECT_STREQ(find_commands(editor(), "step up").front()->id, "movement.step_up") << "the switch first";
    EXPECT_EQ(listed.front(), "Bounce scalar");
    EXPECT_EQ(listed[7], "Static friction");
    for (std::size_t i = 0; i < listed.size(); ++i)
        EXPECT_EQ(listed[i], demo_table()[i].title);

    ASSERT_EQ(run("menu \"Lab/Demos/Bounce scalar\""), "");
    EXPECT_EQ(shown_demo(editor()), find_demo("bounce-scalar"));
    EXPECT_EQ(editor().lab.motion, LabMotion::forward);
    const std::size_t before = editor().lab.cursor();
    EXPECT_LT(before, 150u);
    ASSERT_EQ(run("wait 20"), "");
    EXPECT_GT(editor().lab.cursor(), before + 10);
    ASSERT_EQ(run("wait 400"), "");
    EXPECT_EQ(editor().lab.motion, LabMotion::paused);
    EXPECT_EQ(editor().lab.cursor() + 1, editor().lab.ticks());
    ASSERT_EQ(run("click \"Card/Next\""), "");
    EXPECT_EQ(shown_demo(editor()), find_demo("one-slide"));
}

// The players of all runs are in the view, as far as they are in the level, and reach across it one way.
TEST_F(DemoScenes, FillTheView) {
    for (const DemoInfo& info : demo_table()) {
        SCOPED_TRACE(info.name);
        demo = &info;
        show();
        const Camera camera = editor().view.camera();
        const Vec2 size(editor().view_aspect, 1.0);
        const Aabb level = document().collision().bounds();
        const Vec3 body = document().level().movement.radii;
        Vec2 low(1.0, 1.0), high(0.0, 0.0);
        for (const LabRun& each : editor().lab.runs())
            for (const TickSample& sample : each.run.samples())
                for (int side = 0; side < 6; ++side) {
                    Vec3 at = sample.position;
                    at[side / 2] += (side % 2 == 0 ? 1.0 : -1.0) * body[side / 2];
                    at = at.cwiseMax(level.min - body).cwiseMin(level.max + 3.0 * body);
                    const Vec3 pixel = project(camera, at, size);
                    ASSERT_GT(pixel.z(), 0.0);
                    const Vec2 fraction(pixel.x() / size.x(), pixel.y());
                    low = low.cwiseMin(fraction);
                    high = high.cwiseMax(fraction);
                }
        EXPECT_GE(low.minCoeff(), 0.0);
        EXPECT_LE(high.maxCoeff(), 1.0);
        EXPECT_GT((high - low).maxCoeff(), 0.6) << "a small scene";
    }
}

TEST_F(DemoScenes, CardsLeadFromOneToTheNext) {
    const std::string card = "Movement/Static friction/";
    ASSERT_EQ(
        run("only movement 350\nclick \"" + card + "About\"\nclick \"" + card + "Card/Next\"\nclick \"" +
            card + "Card/Next\"\nclick \"" + card + "Card/Previous\"\nclick \"" + card + "Card/Open demo\""),
        "");
    EXPECT_EQ(shown_level(), "ground-velocity");
}

TEST_F(DemoScenes, WhereNoFilesCanBeWrittenTheLevelStays) {
    write_text(folder / "file", "");
    setenv("TMPDIR", (folder / "file").c_str(), 1);
    walk();
    show();
    ASSERT_TRUE(editor().message);
    EXPECT_THAT(editor().message->title, HasSubstr(demo->title));
    EXPECT_EQ(document().level().mesh_path, obj);
    EXPECT_EQ(editor().lab.name(), "Playtest");
}

}  // namespace
}  // namespace slipface
