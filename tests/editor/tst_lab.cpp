// The lab without a window: what is recorded, where the cursor goes, which runs are made, and when.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "app_fixture.h"
#include "slipface/base/files.h"
#include "slipface/sim/channels.h"
#include "slipface/sim/simulate.h"
#include "slipface/sim/tape_edit.h"
#include "tools/commands/commands.h"
#include "tools/lab/audit_job.h"
#include "tools/lab/lab_actions.h"
#include "tools/lab/link.h"
#include "tools/lab/run_file.h"
#include "tools/lab/run_link.h"

namespace slipface {
namespace {

using testing::HasSubstr;

bool is_inside_folder(const std::filesystem::path& file, const std::filesystem::path& folder) {
    return !file.lexically_relative(folder).generic_string().starts_with("..");
}

class LabTest : public LevelFixture {
  protected:
    void SetUp() override {
        LevelFixture::SetUp();
        open_level(editor, obj);
        editor.document->set_spawn({Vec3(2, 0.95, 2), 0.0});
    }
    // Walks over the floor with a jump on the way, against the wall at x = 8.
    void record(int ticks = 120) {
        start_playtest(editor);
        editor.playtest->yaw = -1.5707963267948966;  // +X
        for (int i = 0; i < ticks; ++i)
            editor.playtest->advance(
                editor.lab.scene(*editor.document), editor.document->level().movement,
                {.stick = i < 10 ? Vec2(0, 0) : Vec2(0, 1), .buttons = {Button::jump, i >= 30 && i < 35}},
                Playtest::tick_s);
        stop_playtest(editor);
        finish();
    }
    void finish() {
        while (lab.frame(*editor.document, 0.0)) {
        }
    }
    void set(const char* assignment) { apply_setting(editor, assignment); }

    Editor editor;
    Lab& lab = editor.lab;
};

TEST_F(LabTest, EveryPlaytestBecomesATapeThatRepeats) {
    record();
    ASSERT_TRUE(lab.has_tape());
    EXPECT_EQ(lab.ticks(), 120u);
    EXPECT_EQ(lab.cursor(), 119u);
    EXPECT_EQ(lab.repeats(), true);
    EXPECT_EQ(lab.doubt(), "");
    EXPECT_TRUE(editor.layout.shown(PanelId::timeline));
    EXPECT_FALSE(lab.divergence(1)) << "the settings are those that were recorded";
}

// The level's changes travel with the run, as a step that can be undone.
TEST_F(LabTest, ALinkOpensTheSameTickInTheSameLevelElsewhere) {
    set("walk_speed=5.123456789");
    record();
    lab.seek(57);
    const std::uint64_t hash = lab.runs()[0].run.hash();
    const std::string link = link_to_run(editor);
    ASSERT_FALSE(link.empty());

    Editor other;
    EXPECT_THAT(open_link(other, link).error().text(), HasSubstr("grid.obj, which is not here"));
    open_level(other, obj);
    const Status opened = open_link(other, "#" + link);
    ASSERT_TRUE(opened) << opened.error().text();
    EXPECT_EQ(other.lab.cursor(), 57u);
    EXPECT_EQ(other.lab.repeats(), true);
    EXPECT_EQ(other.lab.runs()[0].run.hash(), hash);
    EXPECT_TRUE(other.layout.shown(PanelId::why));
    EXPECT_EQ(other.document->level().movement.walk_speed, 5.123456789);
    other.document->undo();
    EXPECT_NE(other.document->level().movement.walk_speed, 5.123456789);
    other.document->redo();
    EXPECT_THAT(open_link(other, link).error().text(), HasSubstr("unsaved changes"));
    EXPECT_THAT(open_link(other, "demo=none").error().text(), HasSubstr("no demo \"none\""));
    EXPECT_EQ(other.lab.cursor(), 57u) << "what fails changes nothing";
}

// Of a level that comes with the program a link holds only what differs.
TEST_F(LabTest, ALinkToAShippedLevelIsShort) {
    const std::filesystem::path shipped = std::filesystem::path(SLIPFACE_SOURCE_DIR) / "assets/levels";
    open_level(editor, shipped / "playground.obj");
    editor.session.shipped_levels = shipped;
    record();
    EXPECT_LT(link_to_run(editor).size(), 600u);
    set("walk_speed=5.123456789");
    editor.document->paint(std::array<FaceId, 3>{10, 700, 701}, SurfaceId{2});
    record();
    const std::uint64_t hash = lab.runs()[0].run.hash();
    const std::string link = link_to_run(editor);
    EXPECT_LT(link.size(), 1000u);

    Editor other;
    open_level(other, shipped / "playground.obj");
    const std::string before = level_to_json(other.document->level());
    other.session.shipped_levels = folder;
    EXPECT_THAT(open_link(other, link).error().text(), HasSubstr("this program came without it"));
    ASSERT_TRUE(write_file_atomic(folder / "playground.slipface.json", before + " "));
    EXPECT_THAT(open_link(other, link).error().text(),
                HasSubstr("another version of the level playground.obj"));
    EXPECT_EQ(level_to_json(other.document->level()), before);
    other.session.shipped_levels = shipped;
    ASSERT_TRUE(write_file_atomic(folder / "run.link", "https://example.org/slipface/#" + link + "\n"));
    const Status opened = open_link(other, (folder / "run.link").string());
    ASSERT_TRUE(opened) << opened.error().text();
    EXPECT_EQ(other.lab.runs()[0].run.hash(), hash);
    EXPECT_EQ(level_to_json(other.document->level()), level_to_json(editor.document->level()));
}

// A view for a page of the documents. What is wrong anywhere in it changes nothing.
TEST_F(LabTest, ALinkOpensAViewByItsParts) {
    const std::string before = level_to_json(editor.document->level());
    EXPECT_THAT(open_link(editor, "level=none").error().text(), HasSubstr("there are: easy, hard, island"));
    for (const char* const bad : {"level=easy&probe=1,2,3", "level=easy&camera=1,2,3,4,5,x",
                                  "level=easy&camera=inside", "level=easy&reach=0", "level=easy&only=nothing",
                                  "level=easy&x=1", "level=easy&", "easy", "", "#"}) {
        EXPECT_FALSE(open_link(editor, bad)) << bad;
        EXPECT_EQ(level_to_json(editor.document->level()), before) << bad;
    }
    editor.document->undo();
    ASSERT_TRUE(open_link(editor, "level=easy&camera=1,2,3,4,5,6&probe=0,1,0,0,1,-2.5&reach=0.2&only=probe"));
    EXPECT_EQ(editor.document->level().mesh_path.filename(), "easy.obj");
    EXPECT_TRUE(editor.probe.placed && editor.tool == Tool::probe);
    EXPECT_EQ(editor.probe.move, Vec3(0, 0, -2.5));
    EXPECT_LT((editor.view.camera().eye - Vec3(1, 2, 3)).norm(), 1e-9);
    EXPECT_EQ(editor.layout.focused, PanelId::probe);
    EXPECT_TRUE(editor.reach);
    for (const LinkPart& part : link_parts())
        EXPECT_TRUE(is_link("https://example.org/#" + std::string(part.name) + "=x")) << part.name;
    EXPECT_FALSE(is_link("levels/demo#1.obj"));
}

TEST_F(LabTest, ATapeIsSavedAndOpenedAgainWithTheSameBits) {
    set("walk_speed=5.123456789");
    record();
    const std::uint64_t hash = lab.runs()[0].run.hash();
    const auto file = folder / "run.tape";
    save_tape(editor, file);
    ASSERT_FALSE(editor.message) << editor.message->text;
    set("walk_speed=3");  // the level's settings do not matter
    open_tape(editor, file);
    ASSERT_FALSE(editor.message) << editor.message->text;
    finish();
    EXPECT_EQ(lab.runs()[0].run.hash(), hash);
    EXPECT_EQ(lab.repeats(), true);
    EXPECT_TRUE(lab.divergence(1)) << "but the settings are others now";
    EXPECT_LT(std::filesystem::file_size(file), 1500u);
}

// Each of the shipped levels, with heights, light and textures, and one of the test's own.
TEST_F(LabTest, ACapsuleRepeatsTheRunInAnEmptyFolder) {
    const std::filesystem::path shipped = std::filesystem::path(SLIPFACE_SOURCE_DIR) / "assets/levels";
    for (const std::filesystem::path& level :
         {obj, shipped / "easy.obj", shipped / "hard.obj", shipped / "island.obj"}) {
        SCOPED_TRACE(level.string());
        open_level(editor, level);
        editor.document->paint(std::array<FaceId, 3>{1, 2, 3}, SurfaceId{1});
        set("walk_speed=5.123456789");
        record();
        lab.seek(57);
        const std::filesystem::path file = folder / (level.stem().string() + ".capsule");
        save_capsule(editor, file);
        ASSERT_FALSE(editor.message) << editor.message->text;

        Editor other;
        other.session.recordings = Recordings(folder / "elsewhere" / "recordings");
        request_open(other, file);
        ASSERT_FALSE(other.message) << other.message->text;
        ASSERT_TRUE(other.lab.has_tape());
        EXPECT_EQ(other.lab.cursor(), 57u);
        EXPECT_EQ(other.lab.repeats(), true);
        EXPECT_EQ(other.lab.doubt(), "");
        EXPECT_EQ(other.lab.runs()[0].run.hash(), lab.runs()[0].run.hash());
        EXPECT_EQ(other.document->surface_of(2), SurfaceId{1});
        EXPECT_EQ(other.document->level().movement.walk_speed, 5.123456789);
        EXPECT_TRUE(is_inside_folder(other.document->level().mesh_path, folder / "elsewhere"));
    }
    write_text(folder / "bad.capsule", "no archive");
    const std::string before = level_to_json(editor.document->level());
    request_open(editor, folder / "bad.capsule");
    ASSERT_TRUE(editor.message);
    EXPECT_THAT(editor.message->text, HasSubstr("is no gzip file"));
    EXPECT_EQ(level_to_json(editor.document->level()), before);
}

TEST_F(LabTest, ATapeOpensItsLevel) {
    record();
    save_tape(editor, folder / "run.tape");
    Editor other;
    request_open(other, folder / "run.tape");
    ASSERT_FALSE(other.message) << other.message->text;
    ASSERT_TRUE(other.lab.has_tape());
    while (other.lab.frame(*other.document, 0.0)) {
    }
    EXPECT_EQ(other.lab.repeats(), true);
    write_text(folder / "lost.tape", "slipface-tape 1\nlevel gone.obj\n1\n");
    Editor third;
    request_open(third, folder / "lost.tape");
    ASSERT_TRUE(third.message);
    EXPECT_THAT(third.message->text, HasSubstr("was recorded in gone.obj, which is not beside it"));
}

// Each change of the inputs is a step among those of the level.
TEST_F(LabTest, InputsAreChangedAndUndoneInOrder) {
    record();
    const ButtonSet jump = Button::jump;
    const auto presses = [&] { return presses_of(lab.tape(), jump); };
    const auto undo = [&] { run_command(editor, "edit.undo"); };
    const auto redo = [&] { run_command(editor, "edit.redo"); };
    const std::uint64_t hash = lab.runs()[0].run.hash();
    lab.seek(50);
    ASSERT_EQ(presses(), (std::vector<TickRange>{{30, 35}}));
    ASSERT_TRUE(lab.edit(*editor.document, move_press(lab.tape(), jump, {30, 35}, {36, 41})));
    ASSERT_TRUE(lab.edit(*editor.document, move_press(lab.tape(), jump, {36, 41}, {40, 45}), true));
    finish();
    EXPECT_NE(lab.runs()[0].run.hash(), hash);
    EXPECT_EQ(lab.cursor(), 50u);
    EXPECT_TRUE(lab.unsaved);
    set("walk_speed=4");
    ASSERT_TRUE(lab.edit(*editor.document, with_buttons(lab.tape(), 60, 62, jump, true)));
    undo();
    EXPECT_EQ(presses(), (std::vector<TickRange>{{40, 45}}));
    EXPECT_EQ(editor.document->level().movement.walk_speed, 4.0);
    undo();
    EXPECT_NE(editor.document->level().movement.walk_speed, 4.0);
    undo();
    EXPECT_EQ(presses(), (std::vector<TickRange>{{30, 35}}));
    finish();
    EXPECT_EQ(lab.runs()[0].run.hash(), hash);
    redo();
    redo();
    redo();
    EXPECT_EQ(presses(), (std::vector<TickRange>{{40, 45}, {60, 62}}));
    EXPECT_EQ(editor.document->level().movement.walk_speed, 4.0);

    const Tape before = lab.tape();
    Tape empty = before;
    empty.segments.clear();
    EXPECT_THAT(lab.edit(*editor.document, empty).error().text(), HasSubstr("no ticks"));
    EXPECT_EQ(tape_to_text(lab.tape()), tape_to_text(before));
}

TEST_F(LabTest, AnotherTapeWalksBesideTheOpenOne) {
    record();
    save_tape(editor, folder / "first.tape");
    record(80);
    add_tape(editor, folder / "first.tape");
    ASSERT_FALSE(editor.message) << editor.message->text;
    finish();
    ASSERT_EQ(lab.runs().size(), 3u);
    EXPECT_EQ(lab.runs()[2].name, "first.tape");
    EXPECT_EQ(lab.runs()[2].run.length(), 120u);
    EXPECT_EQ(lab.ticks(), 80u);
    const std::uint64_t hash = lab.runs()[2].run.hash();
    ASSERT_TRUE(lab.edit(*editor.document, with_stick(lab.tape(), 0, 80, {0, 1})));
    finish();
    EXPECT_EQ(lab.runs()[2].run.hash(), hash) << "it keeps its inputs";
    lab.explain(2);
    EXPECT_FALSE(lab.story(*editor.document).empty());
    lab.unpin(2);
    EXPECT_EQ(lab.runs().size(), 2u);
}

TEST_F(LabTest, WalkingOnKeepsTheOldRun) {
    record();
    const std::uint64_t hash = lab.runs()[0].run.hash();
    lab.seek(60);
    resume_from_cursor(editor);
    ASSERT_TRUE(editor.playtest);
    for (int i = 0; i < 10; ++i)
        editor.playtest->advance(editor.lab.scene(*editor.document), editor.document->level().movement, {},
                                 Playtest::tick_s);
    stop_playtest(editor);
    finish();
    EXPECT_EQ(lab.ticks(), 70u);
    ASSERT_EQ(lab.runs().size(), 3u);
    EXPECT_EQ(lab.runs()[2].run.hash(), hash);
}

TEST_F(LabTest, ATapeThatChangesOnDiskIsReadAgain) {
    record();
    const auto file = folder / "run.tape";
    save_tape(editor, file);
    open_tape(editor, file);
    lab.seek(40);
    const auto look = [&] {
        for (int i = 0; i < 3; ++i)
            look_at_tape_file(editor);
    };
    Tape changed = with_buttons(lab.tape(), 70, 75, Button::jump, true);
    write_text(file, tape_to_text(changed));
    look();
    EXPECT_EQ(presses_of(lab.tape(), Button::jump).size(), 2u);
    EXPECT_EQ(lab.cursor(), 40u);
    EXPECT_FALSE(lab.unsaved);
    write_text(file, "slipface-tape 1\nhop\n");
    look();
    EXPECT_THAT(editor.status, HasSubstr("cannot be read"));
    EXPECT_EQ(presses_of(lab.tape(), Button::jump).size(), 2u);
    // What was changed here is not lost.
    ASSERT_TRUE(lab.edit(*editor.document, with_stick(lab.tape(), 0, 5, {1, 0})));
    write_text(file, tape_to_text(changed) + "# and more\n");
    look();
    EXPECT_THAT(editor.status, HasSubstr("your changes stay"));
    EXPECT_EQ(stick_spans(lab.tape()).front().wish, Vec2(1, 0));
}

TEST_F(LabTest, AWrongTapeIsReportedAndTheLabStays) {
    record();
    write_text(folder / "bad.tape", "slipface-tape 1\nhop\n");
    open_tape(editor, folder / "bad.tape");
    ASSERT_TRUE(editor.message);
    EXPECT_THAT(editor.message->text, HasSubstr("bad.tape:2"));
    EXPECT_EQ(lab.ticks(), 120u);
    editor.message.reset();
    write_text(folder / "empty.tape", "slipface-tape 1\n");
    open_tape(editor, folder / "empty.tape");
    ASSERT_TRUE(editor.message);
    EXPECT_EQ(lab.ticks(), 120u);
}

TEST_F(LabTest, ATapeOfAnotherLevelRaisesADoubt) {
    write_text(folder / "other.tape",
               "slipface-tape 1\nlevel a.obj 0123456789abcdef\n10\nend 0123456789abcdef\n");
    open_tape(editor, folder / "other.tape");
    finish();
    EXPECT_EQ(lab.doubt(), "The geometry has changed since the recording");
    EXPECT_EQ(lab.repeats(), false);
    write_text(folder / "paint.tape", "slipface-tape 1\nsurfaces 0123456789abcdef\n10\n");
    open_tape(editor, folder / "paint.tape");
    EXPECT_EQ(lab.doubt(), "Recorded with other surface types");
    EXPECT_FALSE(lab.repeats()) << "it does not say how it ends";
}

TEST_F(LabTest, PaintingTheLevelUnderATapeIsSaidAndUndoTakesItBack) {
    record();
    EXPECT_EQ(lab.doubt(), "");
    const FaceId face = 3;
    editor.document->paint(std::span(&face, 1), ice);
    finish();
    EXPECT_EQ(lab.doubt(), "Recorded with other surface types");
    editor.document->undo();
    finish();
    EXPECT_EQ(lab.doubt(), "");
}

TEST_F(LabTest, TheCursorStepsSeeksPlaysAndLoops) {
    record();
    lab.seek(5);
    lab.step(1);
    EXPECT_EQ(lab.cursor(), 6u);
    lab.step(-10);
    EXPECT_EQ(lab.cursor(), 0u);
    lab.seek(1000);
    EXPECT_EQ(lab.cursor(), 119u);

    lab.seek(10);
    lab.motion = LabMotion::forward;
    for (int i = 0; i < 30; ++i)
        lab.frame(*editor.document, 1.0 / 60.0);
    EXPECT_NEAR(static_cast<double>(lab.cursor()), 40.0, 1.0);
    lab.motion = LabMotion::backward;
    lab.speed = 2.0;
    for (int i = 0; i < 10; ++i)
        lab.frame(*editor.document, 1.0 / 60.0);
    EXPECT_NEAR(static_cast<double>(lab.cursor()), 20.0, 1.0);
    for (int i = 0; i < 30; ++i)
        lab.frame(*editor.document, 1.0 / 60.0);
    EXPECT_EQ(lab.cursor(), 0u);
    EXPECT_EQ(lab.motion, LabMotion::paused);

    lab.loop = true;
    lab.speed = 1.0;
    lab.seek(110);
    lab.motion = LabMotion::forward;
    lab.frame(*editor.document, 20.5 / 60.0);  // past the end by ten
    EXPECT_EQ(lab.cursor(), 10u);
    EXPECT_EQ(lab.motion, LabMotion::forward);
}

TEST_F(LabTest, EventsAreFoundFromAnywhere) {
    record();
    lab.seek(0);
    std::vector<std::size_t> found;
    for (std::size_t last = 1000; lab.cursor() != last && found.size() < 20;) {
        last = lab.cursor();
        lab.next_event();
        if (lab.cursor() != last) found.push_back(lab.cursor());
    }
    for (const SimulationEvent& event : lab.runs()[0].run.events())
        EXPECT_TRUE(event.tick == 0 || std::count(found.begin(), found.end(), event.tick)) << event.kind;
    const std::size_t last = found.back();
    lab.previous_event();
    EXPECT_LT(lab.cursor(), last);
}

TEST_F(LabTest, TheGhostFollowsASliderAndPartsWhereTheRunsFirstDiffer) {
    record();
    editor.document->begin("Drag");
    for (const char* value : {"walk_speed=5.5", "walk_speed=5", "walk_speed=4"}) {
        set(value);
        lab.frame(*editor.document, 0.0);
        ASSERT_TRUE(lab.complete()) << "120 ticks are run anew within one frame";
        ASSERT_TRUE(lab.divergence(1));
    }
    editor.document->commit();
    const Divergence& parts = *lab.divergence(1);
    const auto recorded = lab.runs()[0].run.samples(), now = lab.runs()[1].run.samples();
    for (std::size_t tick = 0; tick < parts.first; ++tick)
        ASSERT_EQ(recorded[tick].position, now[tick].position);
    EXPECT_NE(recorded[parts.first].velocity, now[parts.first].velocity);
    EXPECT_EQ(lab.runs()[1].settings.walk_speed, 4.0);
    editor.document->undo();
    lab.frame(*editor.document, 0.0);
    EXPECT_FALSE(lab.divergence(1));
}

TEST_F(LabTest, PaintingRunsTheTapeAnew) {
    record();
    const std::uint64_t before = lab.runs()[0].run.hash();
    std::vector<FaceId> floor(wall);
    for (FaceId face = 0; face < wall; ++face)
        floor[face] = face;
    editor.document->paint(floor, ice);
    finish();
    EXPECT_NE(lab.runs()[0].run.hash(), before);
    EXPECT_EQ(lab.repeats(), false);
}

TEST_F(LabTest, PinnedGhostsStayAndGo) {
    record();
    set("jump_speed=4");
    EXPECT_TRUE(run_command(editor, "lab.pin"));
    set("jump_speed=8");
    finish();
    ASSERT_EQ(lab.runs().size(), 3u);
    EXPECT_EQ(lab.runs()[2].name, "Jump speed 4");
    EXPECT_FALSE(lab.divergence(1));
    EXPECT_TRUE(lab.divergence(2));
    lab.explain(2);
    lab.unpin(1);  // not a pinned one
    EXPECT_EQ(lab.runs().size(), 3u);
    lab.unpin(2);
    EXPECT_EQ(lab.runs().size(), 2u);
    EXPECT_LT(lab.explained(), 2u);
    for (int i = 0; i < 20; ++i)
        lab.pin(MovementSettings{});
    EXPECT_EQ(lab.runs().size(), Lab::max_runs);
    EXPECT_FALSE(run_command(editor, "lab.pin"));
}

TEST_F(LabTest, TheStoryIsThatOfTheCursorAndTheDescribedRun) {
    record();
    lab.seek(119);
    const std::string recorded = story_text(lab.story(*editor.document));
    EXPECT_THAT(recorded, HasSubstr("Begins: "));
    lab.seek(5);
    EXPECT_NE(story_text(lab.story(*editor.document)), recorded);
    const TickTrace again = lab.runs()[0].run.trace(lab.scene(*editor.document), 5);
    EXPECT_EQ(story_text(lab.story(*editor.document)), story_text(describe(again, editor.document->level())));
    lab.seek(119);
    set("walk_speed=2");
    finish();
    lab.explain(1);
    EXPECT_NE(story_text(lab.story(*editor.document)), recorded);
}

TEST_F(LabTest, ALineOfTheStoryBringsTheCameraThere) {
    record();
    lab.seek(20);
    const auto& story = lab.story(*editor.document);
    const auto line =
        std::find_if(story.begin(), story.end(), [](const StoryLine& l) { return l.triangle != no_id; });
    ASSERT_NE(line, story.end());
    const Vec3 position = *line->position;
    const auto index = static_cast<std::size_t>(line - story.begin());
    look_at_story_line(editor, index);
    EXPECT_EQ(lab.lit_line, index);
    const Camera camera = editor.view.camera();
    EXPECT_LT((camera.target - camera.eye).normalized().cross((position - camera.eye).normalized()).norm(),
              1e-6);
    EXPECT_LT((camera.eye - position).norm(), 4.0);
    EXPECT_FALSE(cast_ray(editor.document->collision(), camera.eye, position - camera.eye, 0.98))
        << "it can be seen";
    lab.step(1);
    EXPECT_FALSE(lab.lit_line);
}

TEST_F(LabTest, WalkingOnFromATickKeepsWhatCameBefore) {
    record();
    const std::vector<TickSample> before(lab.runs()[0].run.samples().begin(),
                                         lab.runs()[0].run.samples().end());
    lab.seek(60);
    resume_from_cursor(editor);
    ASSERT_TRUE(editor.playtest);
    EXPECT_EQ(editor.playtest->tape().tick_count(), 60u);
    for (int i = 0; i < 30; ++i)
        editor.playtest->advance(lab.scene(*editor.document), editor.document->level().movement, {},
                                 Playtest::tick_s);
    stop_playtest(editor);
    finish();
    ASSERT_EQ(lab.ticks(), 90u);
    EXPECT_EQ(lab.repeats(), true);
    for (std::size_t tick = 0; tick < 60; ++tick)
        ASSERT_EQ(lab.runs()[0].run.samples()[tick].position, before[tick].position) << tick;
    EXPECT_NE(lab.runs()[0].run.samples()[89].position, before[89].position);
}

TEST_F(LabTest, TheRunIsExportedAndCopied) {
    record();
    save_run_csv(editor, folder / "run.csv");
    ASSERT_FALSE(editor.message) << editor.message->text;
    EXPECT_EQ(read_text(folder / "run.csv"), run_csv(lab.runs()[0].run, editor.document->level().surfaces));
    EXPECT_TRUE(run_command(editor, "lab.copy_tape"));
    ASSERT_TRUE(editor.clipboard);
    EXPECT_EQ(*editor.clipboard, tape_to_text(lab.sealed_tape()));
    save_tape(editor, folder / "none" / "run.tape");
    EXPECT_TRUE(editor.message);
}

TEST_F(LabTest, ZoomKeepsTheTickUnderTheMouse) {
    record();
    lab.zoom(0.5, 30.0);
    EXPECT_NEAR(lab.shown_last() - lab.shown_first(), 60.0, 1e-9);
    EXPECT_NEAR((30.0 - lab.shown_first()) / 60.0, 30.0 / 120.0, 1e-9);
    lab.seek(119);
    EXPECT_GE(lab.shown_last(), 120.0);
    for (int i = 0; i < 20; ++i)
        lab.zoom(2.0, 60.0);
    EXPECT_EQ(lab.shown_first(), 0.0);
    EXPECT_EQ(lab.shown_last(), 120.0);
}

TEST_F(LabTest, AnotherLevelClosesTheTape) {
    record();
    write_text(folder / "other.obj", read_text(obj));
    open_level(editor, folder / "other.obj");
    EXPECT_FALSE(lab.has_tape());
    EXPECT_FALSE(run_command(editor, "lab.play"));
    EXPECT_TRUE(lab.story(*editor.document).empty());
    open_level(editor, obj);
    EXPECT_TRUE(lab.has_tape()) << "it was in no file";
    lab_actions::close_tape(editor);
    open_level(editor, obj);
    EXPECT_FALSE(lab.has_tape()) << "what is closed by hand does not come back";
}

TEST_F(LabTest, AnAuditRunsBesideTheEditorAndOpensWhatItFinds) {
    AuditSettings settings;
    settings.walkers = 4;
    settings.duration_s = 10;
    editor.audit = AuditJob::start(*editor.document, settings);
    while (editor.audit->running())
        std::this_thread::yield();
    ASSERT_NE(editor.audit->report(), nullptr) << editor.audit->problem();
    const AuditReport& report = *editor.audit->report();
    EXPECT_GT(report.steps, 0u);
    const std::vector<float>& heat = editor.audit->heat(*editor.document, HeatKind::visited);
    ASSERT_EQ(heat.size(), face_count);
    EXPECT_EQ(*std::max_element(heat.begin(), heat.end()), 1.0f);
    for (std::size_t i = 0; i < report.findings.size(); ++i) {
        open_finding(editor, i);
        ASSERT_FALSE(editor.message) << editor.message->text;
        EXPECT_EQ(lab.ticks(), report.findings[i].tick);
        EXPECT_EQ(lab.repeats(), true);
    }
    editor.document->paint(std::vector<FaceId>{0}, ice);
    EXPECT_FALSE(editor.audit->fits(*editor.document));
    EXPECT_TRUE(editor.audit->heat(*editor.document, HeatKind::visited).empty());
}

// Carried up 1 m by a lift, then asked to walk too slowly to be seen moving: the tape opens where the audit
// was, a tick before.
TEST_F(LabTest, AFindingOnAMovingPlatformOpensWhereTheAuditMetIt) {
    write_text(folder / "lift.obj",
               "g floor\nv -9 0 -9\nv -9 0 9\nv 9 0 9\nv 9 0 -9\nf 1 2 3 4\n"
               "g lift\nv -2 0.1 -2\nv -2 0.1 2\nv 2 0.1 2\nv 2 0.1 -2\nf 5 6 7 8\n");
    write_text(folder / "lift.slipface.json",
               R"({"slipface": 1, "platforms": [{"name": "lift", "group": "lift", "repeat": "once",
                   "path": [{"offset": [0, 0, 0], "speed": 1}, {"offset": [0, 1, 0], "speed": 1}]}]})");
    open_level(editor, folder / "lift.obj");
    ASSERT_FALSE(editor.message) << editor.message->text;
    editor.document->set_spawn({Vec3(0, 1.01, 0), 0.0});
    set("walk_speed=0.001");
    set("jump_speed=0");
    AuditSettings settings;
    settings.walkers = 2;
    settings.duration_s = 5;
    editor.audit = AuditJob::start(*editor.document, settings);
    while (editor.audit->running())
        std::this_thread::yield();
    ASSERT_NE(editor.audit->report(), nullptr) << editor.audit->problem();
    const AuditReport& report = *editor.audit->report();
    ASSERT_EQ(report.findings.size(), 2u);
    for (std::size_t i = 0; i < report.findings.size(); ++i) {
        const AuditFinding& finding = report.findings[i];
        EXPECT_NEAR(finding.position.y(), 2.0, 0.01);
        open_finding(editor, i);
        ASSERT_FALSE(editor.message) << editor.message->text;
        EXPECT_EQ(lab.cursor(), finding.tick - 2) << "the state before the bad one";
        EXPECT_EQ(lab.repeats(), true);
        EXPECT_EQ(lab.runs()[0].run.samples().back().position, finding.position);
    }
}

TEST_F(LabTest, AnAuditIsCancelled) {
    AuditSettings settings;
    settings.walkers = 2000;
    settings.duration_s = 600;
    editor.audit = AuditJob::start(*editor.document, settings);
    editor.audit->cancel();
    while (editor.audit->running())
        std::this_thread::yield();
    ASSERT_NE(editor.audit->report(), nullptr);
    EXPECT_TRUE(editor.audit->report()->cancelled);
}

class ImportedRuns : public AppFixture {
  protected:
    // Along the floor at 6 m/s, but for three ticks at a tenth of it.
    std::filesystem::path recorded() {
        std::string text = "# slipface-run 1\nt,x,y,z,wish_x,wish_z\n";
        double x = 1.0, speed = 0.0;
        for (int i = 0; i < 60; ++i) {
            speed = i / 3 == 10 ? 0.6 : std::min(6.0, speed + 1.0);
            x += speed / 60.0;
            text += fmt::format("{:.5f},{:.5f},0,3.5,1,0\n", (i + 1) / 60.0, x);
        }
        write_text(folder / "run.csv", text);
        return folder / "run.csv";
    }
};

TEST_F(ImportedRuns, ShowWhatDisturbedThemBesideSlipface) {
    EXPECT_EQ(run("run import " + recorded().string() + "\nwait 3\nexpect widget Why/Imported/0"), "");
    const std::vector<RecordedFault>* const faults = imported_faults(editor());
    ASSERT_NE(faults, nullptr);
    ASSERT_EQ(faults->size(), 1u);
    EXPECT_EQ(faults->front().kind, FaultKind::snag);
    EXPECT_TRUE(faults->front().slipface_passes);
    ASSERT_EQ(run("click Why/Imported/0"), "");
    EXPECT_NEAR(static_cast<double>(editor().lab.cursor()), 32.0, 3.0);
    // Slipface's mover has the run's speed and goes on.
    const TapeRun& own = editor().lab.runs().front().run;
    ASSERT_EQ(own.samples().size(), 59u);
    EXPECT_GT(own.samples().back().position.x(), 6.3);
    ASSERT_TRUE(run_command(editor(), "lab.close_tape"));
    EXPECT_EQ(imported_faults(editor()), nullptr);
}

TEST_F(ImportedRuns, AWrongFileChangesNothing) {
    write_text(folder / "wrong.csv", "t,x,y\n1,2\n");
    import_run(editor(), folder / "wrong.csv");
    ASSERT_TRUE(editor().message);
    EXPECT_NE(editor().message->text.find("wrong.csv"), std::string::npos);
    EXPECT_FALSE(editor().lab.has_tape());
    EXPECT_EQ(editor().imported.run, nullptr);
}

}  // namespace
}  // namespace slipface
