// Whatever cannot write a file ends with exit code 2 and says why, and leaves the files as they were.
#include <gtest/gtest.h>

#include <iterator>
#include <map>

#include "program/run_program.h"

namespace slipface::test {
namespace {

namespace fs = std::filesystem;

// As on a full disk: no file may grow.
const std::string without_room = std::string("sh -c 'ulimit -f 0; exec \"$0\" \"$@\"' ") + SLIPFACE_PROGRAM;

class RefusedWrites : public testing::Test {
  protected:
    void SetUp() override {
        level = folder.write(
            "floor.obj",
            "mtllib floor.mtl\nusemtl stone\nv -10 -1 10\nv 10 -1 10\nv 10 -1 -10\nv -10 -1 -10\n"
            "f 1 2 3 4\n");
        folder.write("floor.mtl", "newmtl stone\nKd 1 1 1\n");
        folder.write("rules.txt", "stone ice\n");
        folder.write("t.tape", "slipface-tape 1\ndt 1/60\nstart 0,2,0\n9 wish 0,-1\n");
        const std::string paint =
            folder.write("paint", "select faces 0\ncommand edit.fill_selection\ncommand file.save\n");
        ASSERT_EQ(run_program("edit " + level + " --script " + paint).exit_code, 0);
        fs::create_directory(folder / "in-the-way");
        fs::create_directory(folder / "out");
        before = files();
    }
    std::string path(const std::string& name) const { return (folder / name).string(); }

    std::map<std::string, std::string> files() const {
        std::map<std::string, std::string> found;
        for (const auto& entry : fs::recursive_directory_iterator(folder / "")) {
            if (!entry.is_regular_file() || entry.path().extension() == ".script") continue;
            std::ifstream file(entry.path(), std::ios::binary);
            found[entry.path().string()] = {std::istreambuf_iterator<char>(file), {}};
        }
        return found;
    }
    void expect_refusal(const std::string& arguments, const std::string& program = SLIPFACE_PROGRAM) const {
        const ProgramRun run = run_program(arguments, 60, program);
        EXPECT_EQ(run.exit_code, 2) << arguments << ": " << run.output;
        EXPECT_NE(run.output.find("slipface: "), std::string::npos) << arguments << ": " << run.output;
        EXPECT_EQ(files(), before) << arguments;
    }
    std::string script(const std::string& text) const { return folder.write("a.script", text); }

    ScratchFolder folder;
    std::string level;
    std::map<std::string, std::string> before;
};

TEST_F(RefusedWrites, WithoutRoomEveryVerbSaysSo) {
    for (const std::string& arguments :
         {"export " + level + " --obj " + path("out/a.obj"),
          "export " + level + " --gltf " + path("out/a.gltf"),
          "export " + level + " --gltf " + path("out/a.glb"), "export " + level + " --flat " + path("out/a"),
          "bake-light " + level + " --rays 1", "name-materials " + level,
          "import " + level + " --rules " + path("rules.txt"), "import " + level + " --scale 2",
          "preset platformer --out " + path("out/p.json"), "demo --out " + path("out") + " 1",
          "docs " + path("out"), "docs --completion " + path("out/c"),
          "audit " + level + " --walkers 1 --seconds 1 --out " + path("out/a.json"),
          "reach " + level + " --rounds 1 --out " + path("out/r.json"),
          "reach " + level + " --rounds 1 --links " + path("out/l.gltf"),
          "edit " + level + " --screenshot " + path("out/s.png")})
        expect_refusal(arguments, without_room);
}

TEST_F(RefusedWrites, WithoutRoomEveryLineOfAScriptSaysSo) {
    for (const std::string& line :
         {std::string("select faces 0\nreplace default ice\ncommand file.save\nsay done"),
          std::string("key Ctrl+S"), std::string("menu File/Save"),
          std::string("command file.name_materials"), "export obj " + path("out/a.obj"),
          "export gltf " + path("out/a.gltf"), "export game " + path("out/a"),
          "preset save " + path("out/p.json"), "screenshot " + path("out/s.png")})
        expect_refusal("edit " + level + " --script " + script(line + "\n"), without_room);
}

TEST_F(RefusedWrites, AFolderInTheWayAMissingFolderALongName) {
    const std::string long_name = path(std::string(300, 'n'));
    for (const std::string& target :
         {path("in-the-way"), path("missing/x"), long_name, std::string("/dev/full")}) {
        for (const char* kind : {"--obj ", "--gltf ", "--flat "})
            expect_refusal("export " + level + " " + kind + target);
        expect_refusal("edit " + level + " --script " + script("export obj " + target + "\n"));
    }
}

TEST_F(RefusedWrites, AScriptMayExpectIt) {
    const std::string text =
        "export obj " + path("missing/x.obj") +
        "\nexpect message \"Cannot export x.obj*\"\nwait 2\nclick \"Message/OK\"\nsay done\n";
    const ProgramRun run = run_program("edit " + level + " --script " + script(text));
    EXPECT_EQ(run.exit_code, 0) << run.output;
    EXPECT_NE(run.output.find("done"), std::string::npos);
}

}  // namespace
}  // namespace slipface::test
