// Files that are no levels, opened over a painted level that is not saved: each is refused in a dialog that
// names the file and the place, and the level stays as it was, with its history. What can be opened in spite
// of a fault is opened, and the fault listed.
#include <gmock/gmock.h>

#include <chrono>
#include <random>

#include "app_fixture.h"
#include "slipface/level/level_file.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

// For one file, twice; what takes longer hangs. The address sanitizer slows the longest to 6 s.
#if defined(__SANITIZE_ADDRESS__)
constexpr double longest_s = 60.0;
#else
constexpr double longest_s = 5.0;
#endif

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 0 -1\nv 0 0 -1\n";
const std::string good_obj = square + "usemtl a\nf 1 2 3 4\n";

std::string random_bytes(std::size_t count) {
    std::mt19937 random(7);
    std::string bytes(count, '\0');
    for (char& byte : bytes)
        byte = static_cast<char>(random() & 0xffU);
    return bytes;
}

std::string many_groups(int count) {
    std::string text = square;
    for (int i = 0; i < count; ++i)
        text += "g " + std::to_string(i) + "\nf 1 2 3\n";
    return text;
}

struct File {
    std::string name;
    std::string bytes;
};

struct BadLevel {
    const char* what;
    std::vector<File> files;            // all are written before
    std::string open;                   // the name that the user chooses
    std::vector<std::string> expected;  // parts of the dialog's text: the file, the place, what is wrong
};

BadLevel bad_obj(const char* what, std::string bytes, std::string location, std::string message) {
    return {what, {{"bad.obj", std::move(bytes)}}, "bad.obj", {std::move(location), std::move(message)}};
}

BadLevel bad_json(const char* what, std::string bytes, std::string location, std::string message) {
    return {what,
            {{"bad.obj", good_obj}, {"bad.slipface.json", std::move(bytes)}},
            "bad.obj",
            {std::move(location), std::move(message)}};
}

std::vector<BadLevel> bad_levels() {
    const std::string head = R"({"slipface": 1, )";
    return {
        bad_obj("empty", "", "bad.obj", "is empty"),
        bad_obj("binary junk", random_bytes(100'000), "bad.obj:", "is not text"),
        bad_obj("no faces", square, "bad.obj", "no faces"),
        bad_obj("index too large", square + "f 1 2 3\nf 1 2 9\n", "bad.obj:6", "9"),
        bad_obj("index zero", square + "f 0 1 2\n", "bad.obj:5", "0"),
        bad_obj("index too negative", square + "f -1 -2 -9\n", "bad.obj:5", "-9"),
        bad_obj("index of twenty digits", square + "f 1 2 99999999999999999999\n", "bad.obj:5",
                "99999999999999999999"),
        bad_obj("not a number", "v 0 nan 0\n" + square + "f 1 2 3\n", "bad.obj:1", "nan"),
        bad_obj("infinite", square + "v inf 0 0\nf 1 2 3\n", "bad.obj:5", "inf"),
        bad_obj("too far away", square + "v 1e38 0 0\nf 1 2 5\n", "bad.obj:5", "1e38"),
        bad_obj("a line of ten million characters", square + "v " + std::string(10'000'000, '1') + " 0 0\n",
                "bad.obj:5", "characters"),
        {"a folder", {{"bad.obj/inside.txt", ""}}, "bad.obj", {"bad.obj", "directory"}},
        {"nothing there", {}, "gone.obj", {"gone.obj", "no such file"}},
        {"no level file there", {}, "gone.slipface.json", {"gone.slipface.json", "no such file"}},
        bad_json("empty level file", "", "bad.slipface.json:1:1", "not valid JSON"),
        bad_json("binary level file", random_bytes(5'000), "bad.slipface.json:1:", "not valid JSON"),
        bad_json("cut off", head + R"("rules": [)", "bad.slipface.json:1:", "not valid JSON"),
        bad_json("another version", R"({"slipface": 99})", "bad.slipface.json:/slipface", "99"),
        bad_json("no version", R"({"rules": []})", "bad.slipface.json:/", "slipface"),
        bad_json("a version in words", R"({"slipface": "one"})", "bad.slipface.json:/slipface", "one"),
        bad_json("a list's place taken by a word", head + R"("rules": "ice"})", "bad.slipface.json:/rules",
                 "ice"),
        bad_json("a number's place taken by a word",
                 head + R"("surfaces": [{"name": "default"}, {"name": "ice", "friction": "low"}]})",
                 "bad.slipface.json:/surfaces/", "friction"),
        bad_json("a key twice", head + R"("rules": [], "rules": []})", "bad.slipface.json:/rules",
                 "duplicate key"),
        bad_json("not an object", "[1, 2, 3]", "bad.slipface.json:/", "expected an object"),
        bad_json("a hundred thousand brackets", std::string(100'000, '['), "bad.slipface.json:/0/0",
                 "at most 64 levels"),
        bad_json("a number beyond double", head + R"("spawn": {"position": [1e999, 0, 0], "yaw": 0}})",
                 "bad.slipface.json:1:", "1e999"),
        bad_json("cut off in ten million characters", head + R"("a": ")" + std::string(10'000'000, 'x'),
                 "bad.slipface.json:1:", "not valid JSON"),
        bad_json("a key of a million characters twice",
                 head + '"' + std::string(1'000'000, 'k') + R"(": 1, ")" + std::string(1'000'000, 'k') +
                     R"(": 2})",
                 "bad.slipface.json:/kkk", "duplicate key"),
        {"another version, opened by its level file",
         {{"bad.slipface.json", R"({"slipface": 99})"}},
         "bad.slipface.json",
         {"bad.slipface.json:/slipface", "99"}},
        {"a level file of a mesh that is gone",
         {{"bad.slipface.json", head + R"("mesh": "gone.obj"})"}},
         "bad.slipface.json",
         {"bad.slipface.json", "gone.obj"}},
        {"a level file of a mesh elsewhere",
         {{"bad.slipface.json", head + R"("mesh": "../../etc/passwd"})"}},
         "bad.slipface.json",
         {"bad.slipface.json:/mesh", "passwd"}},
    };
}

// All that must survive of the open document.
struct Kept {
    const Document* document;
    std::uint64_t revision;
    std::vector<std::optional<SurfaceId>> overrides;
    std::vector<std::string> steps;
    std::size_t cursor;
    std::string text;  // as it would be saved
    fs::path mesh_path;
    bool dirty;
    friend bool operator==(const Kept&, const Kept&) = default;
};

Kept kept(const Document& document) {
    std::vector<std::string> steps;
    for (const HistoryStep& step : document.history())
        steps.push_back(step.name);
    const Level& level = document.level();
    return {&document,       document.revision(),       level.overrides,
            steps,           document.history_cursor(), level_to_json(level),
            level.mesh_path, document.dirty()};
}

class BadFiles : public AppFixture {
  protected:
    void SetUp() override {
        AppFixture::SetUp();
        look_down();
        // Painted twice, and one of the steps undone: there is something to lose on both sides.
        ASSERT_EQ(run("key 1\nkey 2\nkey B\nviewport drag @1.5,0,1.5 @3.5,0,1.5\nkey 3\nviewport click "
                      "@5.5,0,5.5\nkey Ctrl+Z"),
                  "");
    }

    void write(const std::vector<File>& files) {
        for (const File& file : files) {
            fs::create_directories((folder / file.name).parent_path());
            write_text(folder / file.name, file.bytes);
        }
    }
    void remove(const std::string& name) { fs::remove_all(folder / name); }

    // As a user does it: the command, the path, the button; unsaved changes are given up on.
    std::string choose(const std::string& name) {
        return run("command file.open\nclick \"File dialog/Path\"\nkey Ctrl+A\ntype \"" +
                   (folder / name).string() +
                   "\"\nclick \"File dialog/Open\"\nwait 2\nclick \"Unsaved/Don't save\"\nwait 1");
    }
    std::string drop(const std::string& name) {
        return run("drop " + name + "\nclick \"Unsaved/Don't save\"");
    }

    // The dialog names the file in its title and says what is expected of its text; then it is closed.
    void expect_dialog(const BadLevel& bad) {
        ASSERT_TRUE(editor().message) << "no dialog";
        const MessageDialog message = *editor().message;
        EXPECT_EQ(message.title, "Cannot open " + bad.open);
        for (const std::string& part : bad.expected)
            EXPECT_THAT(message.text, testing::HasSubstr(part));
        EXPECT_LT(message.text.size(), 1000u) << "a message must stay readable";
        ASSERT_EQ(run("expect widget \"Message/OK\"\nclick \"Message/OK\"\nexpect message \"\"\nexpect "
                      "no_widget \"Message/OK\""),
                  "");
    }
};

TEST_F(BadFiles, EachIsRefusedInADialogAndTheOpenLevelStaysAsItIs) {
    const Kept before = kept(document());
    ASSERT_TRUE(before.dirty);
    ASSERT_TRUE(document().can_undo() && document().can_redo());
    for (const BadLevel& bad : bad_levels()) {
        SCOPED_TRACE(bad.what);
        write(bad.files);
        const auto start = std::chrono::steady_clock::now();
        // The browser takes no folder and nothing that is not there; those come by dropping or from a list.
        const bool is_file = fs::is_regular_file(folder / bad.open);
        ASSERT_EQ(is_file ? choose(bad.open) : drop(bad.open), "");
        expect_dialog(bad);
        // By the script's verb too, which asks nothing.
        ASSERT_EQ(run("open " + bad.open), "");
        expect_dialog(bad);
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        EXPECT_LT(took.count(), longest_s);
        EXPECT_EQ(kept(document()), before);
        EXPECT_FALSE(fs::exists(level_file)) << "nothing was saved that nobody asked for";
        for (const char* name : {"bad.obj", "bad.slipface.json"})
            remove(name);
    }

    // The history still works in both directions, and the level can be saved.
    ASSERT_EQ(
        run("command edit.redo\nexpect count ladder 9\ncommand edit.undo\nexpect count ladder 8\n"
            "command edit.undo\nexpect dirty no\ncommand edit.redo\ncommand file.save\nexpect dirty no"),
        "");
    EXPECT_TRUE(fs::exists(level_file));
}

TEST_F(BadFiles, TheBrowserStaysOpenForWhatIsNotThere) {
    const Kept before = kept(document());
    ASSERT_EQ(run("command file.open\nclick \"File dialog/Path\"\nkey Ctrl+A\ntype \"" +
                  (folder / "gone.obj").string() + "\"\nclick \"File dialog/Open\""),
              "");
    ASSERT_EQ(run("expect widget \"File dialog/Problem\"\nclick \"File dialog/Cancel\""), "");
    EXPECT_FALSE(editor().unsaved);
    EXPECT_EQ(kept(document()), before);
}

struct FaultyLevel {
    const char* what;
    std::vector<File> files;
    std::string open;
    std::vector<std::string> listed;  // parts of warnings, one each
    bool by_drawing = false;          // known when the level is drawn, else when it was read
};

std::vector<FaultyLevel> faulty_levels() {
    const std::string textured = "mtllib bad.mtl\n" + square + "usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\n";
    return {
        {"textures missing and corrupt",
         {{"bad.obj", textured},
          {"bad.mtl", "newmtl a\nmap_Kd missing.png\nnewmtl b\nmap_Kd corrupt.png\n"},
          {"corrupt.png", "\x89PNG not really"}},
         "bad.obj",
         {"missing.png", "corrupt.png"},
         true},
        {"a texture that is a folder",
         {{"bad.obj", textured},
          {"bad.mtl", "newmtl a\nmap_Kd corrupt.png\nnewmtl b\n"},
          {"corrupt.png/inside.txt", ""}},
         "bad.obj",
         {"corrupt.png"},
         true},
        {"no material library", {{"bad.obj", textured}}, "bad.obj", {"bad.mtl"}},
        {"a library of junk", {{"bad.obj", textured}, {"bad.mtl", random_bytes(5'000)}}, "bad.obj", {"bad."}},
        {"unknown keys",
         {{"bad.obj", good_obj}, {"bad.slipface.json", R"({"slipface": 1, "studio_note": "keep me"})"}},
         "bad.obj",
         {"studio_note"}},
        {"a rule of an unknown type",
         {{"bad.obj", good_obj},
          {"bad.slipface.json", R"({"slipface": 1, "rules": [{"pattern": "a", "type": "lava"}]})"}},
         "bad.obj",
         {"lava"}},
        {"terrain that is not there",
         {{"bad.obj", good_obj},
          {"bad.slipface.json", R"({"slipface": 1, "heightfield": {"file": "gone.png"}})"}},
         "bad.obj",
         {"gone.png"}},
        {"a million groups", {{"bad.obj", many_groups(1'000'000)}}, "bad.obj", {}},
    };
}

TEST_F(BadFiles, WhatCanBeOpenedInSpiteOfAFaultIsOpenedAndTheFaultListed) {
    for (const FaultyLevel& faulty : faulty_levels()) {
        SCOPED_TRACE(faulty.what);
        write(faulty.files);
        ASSERT_EQ(run("open " + faulty.open), "");
        ASSERT_FALSE(editor().message) << editor().message->text;
        EXPECT_EQ(document().level().mesh_path.filename(), faulty.open);
        const Warnings& warnings = faulty.by_drawing ? editor().texture_warnings : document().warnings();
        for (const std::string& part : faulty.listed)
            EXPECT_TRUE(std::any_of(
                warnings.begin(), warnings.end(),
                [&](const Diagnostic& warning) { return warning.text().find(part) != std::string::npos; }))
                << part << " is in none of " << warnings.size() << " warnings";
        if (!faulty.listed.empty()) {
            ASSERT_EQ(run("wait 2\nexpect widget \"Warnings/Copy all\""), "");
        }
        for (const char* name : {"bad.obj", "bad.mtl", "corrupt.png", "bad.slipface.json"})
            remove(name);
        ASSERT_EQ(run("open grid.obj"), "");
        EXPECT_TRUE(document().warnings().empty());
        host->frame();
        EXPECT_TRUE(editor().texture_warnings.empty()) << "the warnings of the level before are gone";
    }
}

}  // namespace
}  // namespace slipface
