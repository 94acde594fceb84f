// Snapshots of another program: the rows of a suite with "command" and "images".
#include <gtest/gtest.h>

#include <utility>

#include "program/run_program.h"

namespace slipface::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* square_obj =
    "v -3 0 3\nv 3 0 3\nv 3 0 -3\nv -3 0 -3\no floor\nusemtl floor\nf 1 2 3 4\n";

class OtherPrograms : public testing::Test {
  protected:
    void SetUp() override {
        fs::create_directories(folder_ / "goldens");
        fs::create_directories(folder_ / "shots/town");
        fs::create_directories(folder_ / "levels");
        folder_.write("boxes.txt", "10 10 40 20\n80 30 30 30\n");
        folder_.write("levels/floor.obj", square_obj);
        suite(SLIPFACE_DRAW_FRAMES " ../boxes.txt");
        draw_shots();
        unsetenv("CI");
        unsetenv("GITHUB_ACTIONS");
    }
    void TearDown() override {
        for (const char* name : {"SHIFT", "EXTRA", "FAIL", "LOST"})
            unsetenv(name);
    }
    void suite(const std::string& command, const std::string& more = "") const {
        folder_.write("goldens/scenes.json",
                      R"({"version": 1, "defaults": {"profile": "ui"}, "scenes": [
            {"name": "game", "command": ")" +
                          command + R"(", "frames": ["menu", "map"])" + more + R"(},
            {"name": "shots", "images": "../shots"},
            {"name": "floor", "level": "../levels/floor.obj", "size": [64, 64]}]})");
    }
    // The program by itself, as a build job runs it.
    void draw_shots() const {
        setenv("SLIPFACE_CAPTURE", (folder_ / "shots/town").c_str(), 1);
        run_program((folder_ / "boxes.txt").string(), 60, SLIPFACE_DRAW_FRAMES);
        unsetenv("SLIPFACE_CAPTURE");
    }
    ProgramRun snapshot(const std::string& words) const {
        return run_program("snapshot " + words + " --goldens " + (folder_ / "goldens").string() + " ");
    }
    ProgramRun check(const std::string& more = "") const {
        return snapshot("check --quiet --out " + (folder_ / "out").string() + " " + more);
    }

    ScratchFolder folder_;
};

bool says(const ProgramRun& run, const std::string& text) {
    return run.output.find(text) != std::string::npos;
}

TEST_F(OtherPrograms, CommandFromNothingToApprovedToChanged) {
    EXPECT_TRUE(says(check(), "0 same, 6 failed"));
    ASSERT_EQ(snapshot("approve --jobs 2").exit_code, 0);
    EXPECT_TRUE(fs::exists(folder_ / "goldens/game/menu.png"));
    const ProgramRun same = check("--twice --jobs 2");
    ASSERT_EQ(same.exit_code, 0) << same.output;

    // The program draws otherwise, then counts otherwise: nobody touched its inputs.
    setenv("SHIFT", "3", 1);
    const ProgramRun moved = check("--jobs 2");
    EXPECT_EQ(moved.exit_code, 1);
    EXPECT_TRUE(says(moved, "no input changed, so the program did: interface: `box 0` moved by 3, 0 pixels"))
        << moved.output;
    EXPECT_TRUE(says(moved, "2 images: game/map, game/menu")) << moved.output;
    unsetenv("SHIFT");
    setenv("LOST", "1", 1);
    EXPECT_TRUE(says(check(), "the program did: number `boxes` was 2, is 3"));
    unsetenv("LOST");
    EXPECT_EQ(check().exit_code, 0);

    // Its input is another one; that is approved from the report, and is green.
    folder_.write("boxes.txt", "10 10 40 20\n80 30 30 36\n");
    const ProgramRun changed = check();
    EXPECT_EQ(changed.exit_code, 1);
    EXPECT_TRUE(says(changed, "the file boxes.txt changed")) << changed.output;
    EXPECT_FALSE(says(changed, "the program did")) << changed.output;
    const std::string report = (folder_ / "out/report.json").string();
    EXPECT_EQ(snapshot("approve --from " + report + " --act '*boxes.txt*'").exit_code, 0);
    const ProgramRun approved = check();
    EXPECT_EQ(approved.exit_code, 0) << approved.output;

    // A mask hides what moves by itself, and is itself a change to approve.
    suite(SLIPFACE_DRAW_FRAMES " ../boxes.txt", R"(, "masks": [[5, 5, 60, 30]])");
    EXPECT_TRUE(says(check(), "a mask was added"));
    ASSERT_EQ(snapshot("approve").exit_code, 0);
    setenv("SHIFT", "3", 1);
    EXPECT_EQ(check().exit_code, 0);
}

TEST_F(OtherPrograms, ImagesOfAFolderAndShards) {
    ASSERT_EQ(snapshot("approve --jobs 2").exit_code, 0);
    EXPECT_TRUE(fs::exists(folder_ / "goldens/shots/town/map.png"));
    std::string reports;
    const auto shards = [&] {
        reports.clear();
        for (const char* part : {"1", "2"}) {
            const std::string out = (folder_ / (std::string("part") + part)).string();
            snapshot("check --shard " + std::string(part) + "/2 --out " + out);
            reports += " " + out + "/report.json";
        }
        return run_program("snapshot merge --out " + (folder_ / "all").string() + reports);
    };
    EXPECT_TRUE(says(shards(), "6 same, 0 failed"));
    setenv("SHIFT", "5", 1);
    draw_shots();
    unsetenv("SHIFT");
    const ProgramRun red = shards();
    EXPECT_EQ(red.exit_code, 1);
    EXPECT_TRUE(says(red, "2 images: shots/town/map, shots/town/menu")) << red.output;
    EXPECT_TRUE(says(red, "interface: `box 0` moved by 5, 0 pixels")) << red.output;
    ASSERT_EQ(snapshot("approve 'shots/*'").exit_code, 0);
    EXPECT_EQ(shards().exit_code, 0);
    // One that is gone is red, too.
    fs::remove(folder_ / "shots/town/map.png");
    EXPECT_TRUE(says(check(), "no snapshot makes this"));
}

// A level that the command names has the facts of a level.
TEST_F(OtherPrograms, LevelsThatACommandReads) {
    suite(SLIPFACE_DRAW_FRAMES " ../boxes.txt && test -f ../levels/floor.obj");
    ASSERT_EQ(snapshot("approve").exit_code, 0);
    std::string text = square_obj;
    text.replace(0, 7, "v -3 1 ");
    folder_.write("levels/floor.obj", text);
    const ProgramRun run = check();
    EXPECT_TRUE(says(run, "a vertex of `floor` moved 1 m")) << run.output;
}

TEST_F(OtherPrograms, WhatACommandCanDoWrong) {
    ASSERT_EQ(snapshot("approve").exit_code, 0);
    const auto red = [&](const std::string& text) {
        const ProgramRun run = check("--only 'game/*' --jobs 1");
        EXPECT_EQ(run.exit_code, 1);
        EXPECT_TRUE(says(run, text)) << run.output;
    };
    setenv("FAIL", "1", 1);
    red("scenes.json:/scenes/0/command: the process ended with code 3: no such boxes");
    unsetenv("FAIL");
    setenv("EXTRA", "1", 1);
    red("wrote credits.png, which \"frames\" does not name");
    unsetenv("EXTRA");
    suite("sleep 30", R"(, "seconds": 1)");
    red("takes longer than 1 s");
    suite("true");
    red("wrote no map.png");
    suite("kill -11 $$");
    red("the process ended by signal 11");
    suite("python3 -c 'a = bytearray(40 << 30)'");
    red("the process ended with code 1: MemoryError");
    suite(SLIPFACE_DRAW_FRAMES " ../boxes.txt; echo '{\\\"numbers\\\": 5}' > $SLIPFACE_CAPTURE/map.json");
    red("map.json: expected JSON with the objects");
    for (const auto& [row, where] :
         {std::pair(R"("command": "a", "level": "b")", "/scenes/0/level"),
          std::pair(R"("images": "nowhere")", "/scenes/0/images"), std::pair(R"("command": " ")", "/command"),
          std::pair(R"("command": "a", "frames": ["a b"])", "/frames/0")}) {
        folder_.write("goldens/scenes.json",
                      std::string(R"({"version": 1, "scenes": [{"name": "a", )") + row + "}]}");
        const ProgramRun run = check();
        EXPECT_EQ(run.exit_code, 2);
        EXPECT_TRUE(says(run, where)) << run.output;
    }
}

}  // namespace
}  // namespace slipface::test
