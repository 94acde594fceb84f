// Another state in the place of the open one, opening beside the window, files that change, preferences.
#include <thread>

#include "document/background.h"
#include "document/file_watch.h"
#include "document/preferences.h"
#include "level_fixture.h"

namespace slipface {
namespace {

using Beside = LevelFixture;

TEST_F(Beside, AnotherThreadOpensAndCanBeStopped) {
    using Opened = Result<std::unique_ptr<Document>>;
    std::atomic<bool> explained = false;
    Background<Opened> job([this](Progress& progress) { return Document::open(obj, &progress); },
                           [&] { explained = true; });
    Opened document = job.take();
    ASSERT_TRUE(document.ok());
    EXPECT_EQ((*document)->face_count(), face_count);
    EXPECT_TRUE(job.ready());
    EXPECT_TRUE(explained);

    Background<Opened> endless(
        [](Progress& progress) -> Opened {
            while (!progress.cancelled())
                std::this_thread::yield();
            return cancelled_error("level.obj");
        },
        {});
    endless.cancel();
    EXPECT_FALSE(endless.take().ok());
    Progress cancelled;
    cancelled.cancel();
    EXPECT_FALSE(Document::open(obj, &cancelled).ok());
}

TEST_F(Beside, RestoringTakesOverEverythingButTheNames) {
    auto document = open();
    auto other = open();
    const FaceId painted[] = {2, 40};
    document->paint(painted, ice);
    document->set_spawn({Vec3(1, 2, 3), 0.5});
    Level level = document->snapshot();
    const std::string wanted = level_to_json(level), before = level_to_json(other->level());
    Level elsewhere = level;
    other->restore(elsewhere, "Recover");
    EXPECT_EQ(level_to_json(other->level()), before) << "of another mesh";
    level.mesh = other->level().mesh;
    other->restore(level, "Recover");
    ASSERT_TRUE(other->save_as(folder / "other.slipface.json").ok());
    EXPECT_EQ(other->collision().face_surface(40), ice);
    other->undo();
    EXPECT_EQ(other->level().file_path, folder / "other.slipface.json");
    EXPECT_EQ(other->collision().face_surface(40), default_surface);
    other->redo();
    EXPECT_EQ(other->level().spawn, Vec3(1, 2, 3));
}

TEST_F(Beside, AChangedFileIsNoticedOnceAndOnlyWhenItIsAtRest) {
    FileWatch watch;
    EXPECT_FALSE(watch.poll());
    watch.start(obj, level_file, true);
    EXPECT_FALSE(watch.poll());
    EXPECT_FALSE(watch.poll());
    write_text(obj, floor_and_wall_obj(4));
    EXPECT_FALSE(watch.poll()) << "it may still be growing";
    EXPECT_TRUE(watch.poll());
    EXPECT_TRUE(watch.mesh_changed());
    EXPECT_FALSE(watch.poll()) << "reported once";
    write_text(level_file, "{}");
    EXPECT_FALSE(watch.poll());
    EXPECT_TRUE(watch.poll());
    std::filesystem::remove(obj);
    EXPECT_FALSE(watch.poll());
    EXPECT_FALSE(watch.poll()) << "a tool that replaces the file takes it away for a moment";
    write_text(obj, floor_and_wall_obj(3));
    EXPECT_FALSE(watch.poll());
    EXPECT_TRUE(watch.poll());
}

TEST_F(Beside, PreferencesKeepWhatTheyDoNotKnow) {
    const std::filesystem::path file = folder / "config" / "preferences";
    {
        Preferences preferences(file);
        preferences.set("zoom", 1.25);
        preferences.set("theme", "light");
        preferences.set("tour.done", true);
        preferences.set("odd", "two\nlines = here");
        preferences.save();
    }
    write_text(file, read_text(file) + "from the future = 7\nno equals sign\n# theme = dark\n = nothing\n");
    Preferences preferences(file);
    EXPECT_EQ(preferences.number("zoom", 1.0, 0.5, 2.0), 1.25);
    EXPECT_EQ(preferences.number("zoom", 1.0, 0.5, 1.1), 1.1) << "kept within what is allowed";
    EXPECT_EQ(preferences.number("theme", 3.0, 0.0, 9.0), 3.0);
    EXPECT_EQ(preferences.text("theme"), "light");
    EXPECT_TRUE(preferences.flag("tour.done", false));
    EXPECT_EQ(preferences.text("odd"), "two lines = here");
    preferences.remove("zoom");
    preferences.save();
    EXPECT_EQ(read_text(file).find("zoom"), std::string::npos);
    EXPECT_NE(read_text(file).find("from the future = 7"), std::string::npos);
}

}  // namespace
}  // namespace slipface
