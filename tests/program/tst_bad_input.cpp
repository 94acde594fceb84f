// Hostile files through the real program: each gives a clear message with its place and exit code 2 or a
// warning; nothing crashes, nothing hangs. The same loader serves the editor's dialogs.
#include <gtest/gtest.h>

#include <iterator>

#include "program/run_program.h"

namespace slipface::test {
namespace {

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 0 -1\nv 0 0 -1\n";

struct BadFile {
    const char* name;
    std::string bytes;
    std::string expected;  // must be in the message
};

void PrintTo(const BadFile& file, std::ostream* out) {
    *out << file.name;
}

class BadObj : public testing::TestWithParam<BadFile> {};

TEST_P(BadObj, IsRefusedWithItsLocation) {
    const ScratchFolder folder;
    const std::string path = folder.write("bad.obj", GetParam().bytes);
    const ProgramRun run = run_program("info " + path);
    EXPECT_EQ(run.exit_code, 2) << run.output;
    EXPECT_NE(run.output.find("bad.obj"), std::string::npos) << run.output;
    EXPECT_NE(run.output.find(GetParam().expected), std::string::npos) << run.output;
    EXPECT_LT(run.output.size(), 4000u) << "a message must stay readable";
}

std::string binary_junk() {
    std::string bytes;
    unsigned state = 12345;
    for (int i = 0; i < 100'000; ++i) {
        state = state * 1664525u + 1013904223u;
        bytes.push_back(static_cast<char>(state >> 24));
    }
    return bytes;
}

INSTANTIATE_TEST_SUITE_P(
    Files, BadObj,
    testing::Values(BadFile{"Empty", "", "bad.obj"}, BadFile{"NoFaces", square, "face"},
                    BadFile{"BinaryJunk", binary_junk(), "bad.obj"},
                    BadFile{"IndexTooLarge", square + "f 1 2 3\nf 1 2 9\n", "bad.obj:6"},
                    BadFile{"IndexZero", square + "f 0 1 2\n", "bad.obj:5"},
                    BadFile{"IndexTooNegative", square + "f -1 -2 -9\n", "bad.obj:5"},
                    BadFile{"IndexBeyond64Bits", square + "f 1 2 99999999999999999999999\n", "bad.obj:5"},
                    BadFile{"NotANumber", "v 0 nan 0\n" + square + "f 1 2 3\n", "bad.obj:1"},
                    BadFile{"Infinite", square + "v inf 0 0\nf 1 2 3\n", "bad.obj:5"},
                    BadFile{"Huge", square + "v 1e38 0 0\nf 1 2 3\n", "bad.obj:5"},
                    BadFile{"LongLine", square + "v " + std::string(10'000'000, '1') + " 0 0\nf 1 2 3\n",
                            "bad.obj:5"}),
    [](const auto& case_) { return std::string(case_.param.name); });

TEST(BadPath, MissingFile) {
    const ProgramRun run = run_program("info missing/level.obj");
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_NE(run.output.find("missing/level.obj"), std::string::npos) << run.output;
}

TEST(BadPath, Directory) {
    const ScratchFolder folder;
    std::filesystem::create_directory(folder / "folder.obj");
    const ProgramRun run = run_program("info " + (folder / "folder.obj").string());
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_NE(run.output.find("directory"), std::string::npos) << run.output;
}

TEST(BadObjWarning, AMillionGroupsOpenWithinSeconds) {
    std::string text = square;
    for (int i = 0; i < 1'000'000; ++i)
        text += "g " + std::to_string(i) + "\n";
    text += "f 1 2 3 4\n";
    const ScratchFolder folder;
    const ProgramRun run = run_program("info " + folder.write("groups.obj", text), 20);
    EXPECT_EQ(run.exit_code, 0) << run.output;
}

TEST(BadObjWarning, MissingAndCorruptTexturesAreWarnings) {
    const ScratchFolder folder;
    folder.write("m.mtl", "newmtl a\nmap_Kd missing.png\nnewmtl b\nmap_Kd corrupt.png\n");
    folder.write("corrupt.png", "\x89PNG not really");
    const std::string level =
        folder.write("m.obj", "mtllib m.mtl\n" + square + "usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\n");
    folder.write("look.script", "wait 1\n");
    const ProgramRun run =
        run_program("edit " + level + " --headless --script " + (folder / "look.script").string() +
                    " --screenshot " + (folder / "out.png").string());
    EXPECT_EQ(run.exit_code, 0) << run.output;
    EXPECT_NE(run.output.find("missing.png"), std::string::npos) << run.output;
    EXPECT_NE(run.output.find("corrupt.png"), std::string::npos) << run.output;
    EXPECT_TRUE(std::filesystem::exists(folder / "out.png"));
}

class BadLevelFile : public testing::TestWithParam<BadFile> {};

TEST_P(BadLevelFile, IsRefusedWithItsLocation) {
    const ScratchFolder folder;
    const std::string level = folder.write("level.obj", square + "f 1 2 3 4\n");
    folder.write("level.slipface.json", GetParam().bytes);
    const ProgramRun run = run_program("info " + level);
    EXPECT_EQ(run.exit_code, 2) << run.output;
    EXPECT_NE(run.output.find("level.slipface.json"), std::string::npos) << run.output;
    EXPECT_NE(run.output.find(GetParam().expected), std::string::npos) << run.output;
}

INSTANTIATE_TEST_SUITE_P(
    Files, BadLevelFile,
    testing::Values(BadFile{"Empty", "", "level.slipface.json"},
                    BadFile{"Truncated", R"({"slipface": 1, "rules": [)", ":1"},
                    BadFile{"WrongVersion", R"({"slipface": 99})", "99"},
                    BadFile{"NoVersion", R"({"rules": []})", "slipface"},
                    BadFile{"WrongType", R"({"slipface": 1, "rules": "ice"})", "/rules"},
                    BadFile{"DuplicateKey", R"({"slipface": 1, "rules": [], "rules": []})", "rules"},
                    BadFile{"NotAnObject", "[1, 2, 3]", "object"},
                    BadFile{"DeepNesting", std::string(100'000, '['), "level.slipface.json"},
                    BadFile{"NumberTooLarge",
                            R"({"slipface": 1, "spawn": {"position": [1e999, 0, 0], "yaw": 0}})",
                            "level.slipface.json"}),
    [](const auto& case_) { return std::string(case_.param.name); });

TEST(LevelFileWarning, UnknownKeysWarnAndStay) {
    const ScratchFolder folder;
    const std::string level = folder.write("level.obj", square + "f 1 2 3 4\n");
    folder.write("level.slipface.json", R"({"slipface": 1, "studio_note": "keep me"})");
    folder.write("save.script", "command file.save\n");
    const ProgramRun run =
        run_program("edit " + level + " --headless --script " + (folder / "save.script").string());
    EXPECT_EQ(run.exit_code, 0) << run.output;
    std::ifstream file(folder / "level.slipface.json");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    EXPECT_NE(text.find("keep me"), std::string::npos) << text;
}

TEST(Usage, UnknownVerbsAndOptionsExitWith64) {
    EXPECT_EQ(run_program("info").exit_code, 64);
    EXPECT_EQ(run_program("info a.obj --nonsense").exit_code, 64);
    EXPECT_EQ(run_program("sweep a.obj --radii 1,1,1").exit_code, 64);
    EXPECT_EQ(run_program("--help").exit_code, 0);
}

struct OddLevel {
    const char* name;
    std::string obj;
    bool implausible;  // `info` says that no player fits in
};

// Levels that are geometry, and nothing that anybody could walk in: every verb ends with a word, and what is
// wrong with the size is said.
TEST(OddLevels, EveryVerbEndsWithAWord) {
    const OddLevel levels[] = {
        {"one", "v 0 0 0\nv 0 0 5\nv 5 0 0\nf 1 2 3\n", false},
        {"degenerate", "v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n", false},
        {"ten_km", "v -5000 0 -5000\nv -5000 0 5000\nv 5000 0 5000\nv 5000 0 -5000\nf 1 2 3 4\n", true},
        {"one_mm", "v 0 0 0\nv 0 0 0.001\nv 0.001 0 0.001\nv 0.001 0 0\nf 1 2 3 4\n", true},
        {"vertical", "v 0 0 0\nv 0 5 0\nv 5 5 0\nv 5 0 0\nf 1 2 3 4\nf 4 3 2 1\n", false},
        {"upside_down", "v -9 0 -9\nv 9 0 -9\nv 9 0 9\nv -9 0 9\nf 1 2 3 4\n", false}};
    for (const OddLevel& level : levels) {
        const ScratchFolder folder;
        const std::string path = folder.write(std::string(level.name) + ".obj", level.obj);
        const ProgramRun info = run_program("info " + path);
        EXPECT_EQ(info.exit_code, 0) << level.name << info.output;
        EXPECT_EQ(info.output.find("for a player") != std::string::npos, level.implausible)
            << level.name << info.output;
        const std::string tape =
            folder.write("run.tape", "slipface-tape 1\nlevel x.obj\ndt 1/60\n60 wish 0,-1\n");
        for (const std::string& verb : {"audit " + path + " --walkers 2 --seconds 1", "doctor " + path,
                                        "simulate " + path + " --tape " + tape}) {
            const ProgramRun run = run_program(verb);
            EXPECT_LE(run.exit_code, 2) << verb << run.output;
            EXPECT_FALSE(run.output.empty()) << verb;
        }
    }
}

TEST(OddLevels, AScaleThatIsNoneIsRefusedAndNothingIsWritten) {
    const ScratchFolder folder;
    const std::string path = folder.write("level.obj", square + "f 1 2 3 4\n");
    for (const char* scale : {"0", "-1", "nan", "inf", "1e9", "big"}) {
        const ProgramRun run = run_program("import " + path + " --scale " + scale);
        EXPECT_TRUE(run.exit_code == 2 || run.exit_code == 64) << run.output;
        EXPECT_NE(run.output.find("range"), std::string::npos) << run.output;
        EXPECT_FALSE(std::filesystem::exists(folder / "level.slipface.json")) << scale;
    }
}

}  // namespace
}  // namespace slipface::test
