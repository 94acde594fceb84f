// Autosaves: when they are written, what they hold, and what a crash leaves behind.
#include <fcntl.h>
#include <sys/file.h>

#include <random>

#include "document/autosave.h"
#include "level_fixture.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

class AutosaveTest : public LevelFixture {
  protected:
    void SetUp() override {
        LevelFixture::SetUp();
        store = folder / "state";
    }
    std::vector<fs::path> files() const {
        std::vector<fs::path> found;
        for (const fs::directory_entry& entry : fs::directory_iterator(store))
            if (entry.path().extension() == ".autosave") found.push_back(entry.path());
        return found;
    }
    static void paint(Document& document, FaceId face, SurfaceId surface) {
        document.paint(std::span(&face, 1), surface);
    }
    // Lets an autosave come due and finish.
    static void autosave_now(AutosaveSession& session, const Document& document, double& now) {
        session.tick(document, now);
        now += 30.0;
        session.tick(document, now);
        ASSERT_TRUE(session.finish().ok()) << session.finish().error().text();
    }
    fs::path store;
    double now = 100.0;
};

TEST_F(AutosaveTest, IsDueAfterAQuietMomentAndOnlyWhenSomethingChanged) {
    AutosaveSession session(store, {.quiet_s = 3.0, .longest_s = 20.0});
    ASSERT_TRUE(session.active());
    auto document = open();
    session.tick(*document, now);
    EXPECT_FALSE(session.due_in(*document, now).has_value()) << "nothing changed";
    document->select({1, 2});
    session.tick(*document, now);
    EXPECT_EQ(session.written(), 0u) << "selecting is nothing to lose";

    paint(*document, 0, ice);
    EXPECT_EQ(session.due_in(*document, now), 0.0) << "the change has not been seen yet";
    session.tick(*document, now);
    EXPECT_EQ(session.due_in(*document, now), 3.0);
    session.tick(*document, now + 2.9);
    EXPECT_EQ(session.written(), 0u);
    session.tick(*document, now + 3.0);
    EXPECT_EQ(session.written(), 1u);
    ASSERT_TRUE(session.finish().ok());
    session.tick(*document, now + 60.0);
    EXPECT_EQ(session.written(), 1u) << "nothing changed since";
}

TEST_F(AutosaveTest, SomebodyWhoNeverPausesIsSavedAllTheSame) {
    AutosaveSession session(store, {.quiet_s = 3.0, .longest_s = 20.0});
    auto document = open();
    for (int i = 0; i <= 20; ++i) {
        paint(*document, 0, static_cast<SurfaceId>(1 + i % 2));
        session.tick(*document, now + i);
    }
    EXPECT_EQ(session.written(), 1u);
}

TEST_F(AutosaveTest, NeverWritesInTheMiddleOfAStroke) {
    AutosaveSession session(store);
    auto document = open();
    document->begin("Stroke");
    paint(*document, 0, ice);
    session.tick(*document, now);
    session.tick(*document, now + 100.0);
    EXPECT_EQ(session.written(), 0u);
    document->commit();
    session.tick(*document, now + 101.0);
    session.tick(*document, now + 130.0);
    EXPECT_EQ(session.written(), 1u);
}

TEST_F(AutosaveTest, ACrashLeavesWhatWasDone) {
    auto document = open();
    {
        AutosaveSession session(store);
        paint(*document, 3, ice);
        paint(*document, 5, ladder);
        autosave_now(session, *document, now);
        session.abandon();
    }
    AutosaveSession next(store);
    const auto found = next.recoverable();
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].mesh_path, obj);
    EXPECT_EQ(found[0].level_path, level_file);
    EXPECT_EQ(found[0].steps, (std::vector<std::string>{"Paint ice", "Paint ladder"}));

    const Result<Autosave> autosave = read_autosave(found[0].file);
    ASSERT_TRUE(autosave.ok()) << autosave.error().text();
    const Result<Recovered> opened = open_recovered(*autosave);
    ASSERT_TRUE(opened.ok()) << opened.error().text();
    const auto* const recovered = &opened->document;
    EXPECT_EQ(level_to_json((*recovered)->level()), level_to_json(document->level()));
    EXPECT_TRUE((*recovered)->dirty());
    EXPECT_EQ((*recovered)->resolved().surface[3], ice);
    EXPECT_EQ((*recovered)->collision().face_surface(3), ice);
    (*recovered)->undo();
    EXPECT_FALSE((*recovered)->dirty());
    EXPECT_EQ(level_to_json((*recovered)->level()), level_to_json(open()->level()));

    next.discard(found[0]);
    EXPECT_TRUE(next.recoverable().empty());
    EXPECT_TRUE(files().empty());
}

TEST_F(AutosaveTest, AnOrderlyEndAndASaveLeaveNothing) {
    auto document = open();
    {
        AutosaveSession session(store);
        paint(*document, 3, ice);
        autosave_now(session, *document, now);
        EXPECT_EQ(files().size(), 1u);
        ASSERT_TRUE(document->save().ok());
        session.forget(*document);
        EXPECT_TRUE(files().empty());
        paint(*document, 4, ice);
        autosave_now(session, *document, now);
        EXPECT_EQ(files().size(), 1u);
    }
    EXPECT_TRUE(files().empty());
}

TEST_F(AutosaveTest, ARunningSessionIsNotOfferedForRecovery) {
    auto document = open();
    AutosaveSession session(store);
    paint(*document, 3, ice);
    autosave_now(session, *document, now);
    AutosaveSession other(store);
    EXPECT_TRUE(other.recoverable().empty());
    session.abandon();
    EXPECT_EQ(other.recoverable().size(), 1u);
}

TEST_F(AutosaveTest, KeepsTheNewestFew) {
    auto document = open();
    AutosaveSession session(store);
    for (int i = 0; i < 9; ++i) {
        paint(*document, static_cast<FaceId>(i), ice);
        autosave_now(session, *document, now);
    }
    EXPECT_EQ(files().size(), AutosaveSession::max_for_each_level);
    session.abandon();
    const auto found = AutosaveSession(store).recoverable();
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].steps.size(), 9u) << "the newest is offered";
    EXPECT_EQ(found[0].older, AutosaveSession::max_for_each_level - 1);
}

TEST_F(AutosaveTest, OddFilesInTheFolderStopNothing) {
    fs::create_directories(store / "folder.autosave");
    write_text(store / "readme.txt", "hello");
    write_text(store / "a-b-c.autosave", "junk");
    write_text(store / "a-b-18446744073709551616.autosave", "junk");
    write_text(store / ("x-y-1.autosave"), "slipface-autosave 1\nmesh /none\nbytes 5 0000000000000000\nabc");
    write_text(store / "q.lock", "");
    fs::create_symlink("nowhere", store / "l-m-2.autosave");
    auto document = open();
    AutosaveSession session(store);
    paint(*document, 3, ice);
    autosave_now(session, *document, now);
    EXPECT_EQ(session.written(), 1u);
    session.abandon();
    EXPECT_EQ(AutosaveSession(store).recoverable().size(), 1u);
}

TEST_F(AutosaveTest, ANewestFileThatIsCutShortGivesWayToTheOneBefore) {
    auto document = open();
    AutosaveSession session(store);
    paint(*document, 3, ice);
    autosave_now(session, *document, now);
    const fs::path first = files().front();
    paint(*document, 4, ice);
    autosave_now(session, *document, now);
    session.abandon();
    for (const fs::path& file : files())
        if (file != first) write_text(file, read_text(file).substr(0, 300));
    const auto found = AutosaveSession(store).recoverable();
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].file, first);
}

TEST_F(AutosaveTest, EveryCutAndEveryFlippedByteIsRefused) {
    Autosave autosave;
    autosave.info.mesh_path = "/somewhere/a b.obj";
    autosave.info.steps = {"Paint\nice"};
    autosave.json = "{\"version\": 1}\n";
    const std::string text = autosave_text(autosave);
    const Result<Autosave> read = parse_autosave(text, "x");
    ASSERT_TRUE(read.ok()) << read.error().text();
    EXPECT_EQ(read->json, autosave.json);
    EXPECT_EQ(read->info.mesh_path, autosave.info.mesh_path);
    EXPECT_EQ(read->info.steps, autosave.info.steps);
    for (std::size_t length = 0; length < text.size(); ++length)
        EXPECT_FALSE(parse_autosave(text.substr(0, length), "x").ok()) << length;
    for (std::size_t i = text.size() - autosave.json.size(); i < text.size(); ++i) {
        std::string changed = text;
        changed[i] = static_cast<char>(changed[i] ^ 1);
        EXPECT_FALSE(parse_autosave(changed, "x").ok()) << i;
    }
}

// A path may hold any byte but 0.
TEST_F(AutosaveTest, EveryPathComesBack) {
    std::mt19937 random(11);
    constexpr std::string_view bytes = "\n\r\\ nr/a.\xc3\xa4";
    for (int i = 0; i < 2000; ++i) {
        std::string path = "/";
        for (auto length = random() % 12; length > 0; --length)
            path += bytes[random() % bytes.size()];
        Autosave autosave;
        autosave.info.mesh_path = path + "x";
        autosave.info.level_path = path;
        autosave.info.steps = {path};
        const Result<Autosave> read = parse_autosave(autosave_text(autosave), "x");
        ASSERT_TRUE(read.ok()) << read.error().text();
        EXPECT_EQ(read->info.mesh_path, autosave.info.mesh_path);
        EXPECT_EQ(read->info.level_path, autosave.info.level_path);
        EXPECT_EQ(read->info.steps, autosave.info.steps);
    }
}

TEST_F(AutosaveTest, AnAutosaveOfTheVersionBeforeIsReadAsItWasWritten) {
    Autosave autosave;
    autosave.info.mesh_path = "/a/b.obj";
    std::string text = autosave_text(autosave);
    text.replace(text.find("autosave 3"), 10, "autosave 1");
    text.replace(text.find("/a/b.obj"), 8, R"(/a\n\.obj)");
    const Result<Autosave> read = parse_autosave(text, "x");
    ASSERT_TRUE(read.ok()) << read.error().text();
    EXPECT_EQ(read->info.mesh_path, R"(/a\n\.obj)");
    text.replace(text.find("autosave 1"), 10, "autosave 4");
    EXPECT_FALSE(parse_autosave(text, "x").ok());
}

TEST_F(AutosaveTest, ALevelInAFolderWithALineEndInItsNameIsRecovered) {
    const fs::path odd = folder / "two\nlines";
    fs::create_directory(odd);
    obj = odd / "grid.obj";
    write_text(obj, floor_and_wall_obj(n));
    auto document = open();
    {
        AutosaveSession session(store);
        paint(*document, 3, ice);
        autosave_now(session, *document, now);
        session.abandon();
    }
    const auto found = AutosaveSession(store).recoverable();
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].mesh_path, obj);
    const Result<Autosave> read = read_autosave(found[0].file);
    ASSERT_TRUE(read.ok()) << read.error().text();
    const auto recovered = open_recovered(*read);
    ASSERT_TRUE(recovered) << recovered.error().text();
    EXPECT_EQ(recovered->document->resolved().surface[3], ice);
}

TEST_F(AutosaveTest, AFolderThatCannotBeMadeMeansNoAutosaves) {
    write_text(folder / "file", "");
    AutosaveSession session(folder / "file" / "below");
    EXPECT_FALSE(session.active());
    auto document = open();
    paint(*document, 3, ice);
    session.tick(*document, now);
    session.tick(*document, now + 100.0);
    EXPECT_EQ(session.written(), 0u);
}

// A folder that cannot be written is said, and tried again after growing pauses until it can.
TEST_F(AutosaveTest, AFailureStaysKnownAndIsTriedAgain) {
    fs::create_directories(store);
    const fs::path moved = folder / "moved";
    AutosaveSession session(store);
    ASSERT_TRUE(session.active());
    ASSERT_TRUE(session.problem());
    auto document = open();
    paint(*document, 3, ice);
    fs::rename(store, moved);
    write_text(store, "a file in its place");
    std::vector<double> attempts;
    std::size_t before = 0;
    for (double at = now; at < now + 100.0; at += 0.5) {
        session.tick(*document, at);
        static_cast<void>(session.finish());
        if (session.written() > before) attempts.push_back(at);
        before = session.written();
        ASSERT_EQ(session.problem().ok(), attempts.empty()) << "said as long as it lasts";
    }
    ASSERT_GE(attempts.size(), 4u);
    ASSERT_LE(attempts.size(), 6u);
    for (std::size_t i = 2; i < attempts.size(); ++i)
        EXPECT_GT(attempts[i] - attempts[i - 1], attempts[i - 1] - attempts[i - 2]);
    fs::remove(store);
    fs::rename(moved, store);
    for (double at = now + 100.0; at < now + 300.0; at += 0.5)
        session.tick(*document, at);
    ASSERT_TRUE(session.finish());
    EXPECT_TRUE(session.problem());
    EXPECT_EQ(files().size(), 1u);
}

TEST_F(AutosaveTest, AFolderThatCanBeMadeLaterIsUsedThen) {
    write_text(folder / "file", "");
    AutosaveSession session(folder / "file" / "below");
    EXPECT_FALSE(session.problem());
    auto document = open();
    paint(*document, 3, ice);
    session.tick(*document, now);
    session.tick(*document, now + 10.0);
    EXPECT_FALSE(session.problem());
    fs::remove(folder / "file");
    session.tick(*document, now + 100.0);
    ASSERT_TRUE(session.finish());
    EXPECT_TRUE(session.problem());
    EXPECT_EQ(session.written(), 1u);
}

}  // namespace
}  // namespace slipface
