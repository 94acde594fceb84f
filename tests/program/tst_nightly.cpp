// `slipface nightly` as a user runs it.
#include <gtest/gtest.h>

#include <iterator>
#include <nlohmann/json.hpp>

#include "program/run_program.h"

namespace slipface::test {
namespace {

namespace fs = std::filesystem;

// A floor with a hole in it: walkers fall below the level's end, and the doctor sees its edges.
std::string floor_with(double side) {
    return "v -9 0 9\nv 9 0 9\nv 9 0 -9\nv -9 0 -9\nv -9 " + std::to_string(side) + " -9\nv 9 " +
           std::to_string(side) + " -9\nusemtl floor\nf 1 2 3 4\nusemtl wall\nf 4 3 6 5\n";
}

std::string text_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

class Nightly : public testing::Test {
  protected:
    void SetUp() override {
        fs::create_directories(folder_ / "levels");
        folder_.write("levels/a.obj", floor_with(3.0));
        folder_.write("levels/b & c.obj", floor_with(0.3));
        // Its goal lies 50 m above the floor.
        folder_.write("levels/b & c.slipface.json",
                      R"({"slipface": 1, "mesh": "b & c.obj", "spawn": {"position": [0, 1, 0]},
                          "goals": [{"name": "<roof>", "position": [0, 50, 0], "radius": 1}]})");
        write_project(R"("audit": "--walkers 4 --seconds 2", "reach": "--rounds 1", "doctor": "")");
    }
    void write_project(const std::string& checks) {
        folder_.write("project.json", R"({"slipface_nightly": 1, "levels": ["levels/*.obj"],
            "presets": ["level", "momentum"], "checks": {)" +
                                          checks + "}}");
    }
    ProgramRun nightly(const std::string& out, const std::string& more = "") const {
        return run_program("nightly " + (folder_ / "project.json").string() + " --out " +
                           (folder_ / out).string() + " " + more);
    }
    ProgramRun merge(const std::string& files) const {
        return run_program("nightly merge --project " + (folder_ / "").string() + " --out " +
                           (folder_ / "merged").string() + files);
    }
    std::string report(const std::string& out) const { return (folder_ / out / "report.json").string(); }

    ScratchFolder folder_;
};

// However the file is named, what it names lies in its folder.
TEST_F(Nightly, PatternsStartInTheFolderOfTheFile) {
    folder_.write("levels/project.json",
                  R"({"slipface_nightly": 1, "levels": ["*.obj", "?.obj"], "checks": {"doctor": ""}})");
    const std::string here = "cd '" + (folder_ / "levels").string() + "' && ";
    std::string expected;
    for (const std::string& name :
         {std::string("project.json"), std::string("./project.json"), std::string("../levels/project.json"),
          (folder_ / "levels/project.json").string()}) {
        const ProgramRun run = run_program(
            "-c \"" + here + SLIPFACE_PROGRAM + " nightly '" + name + "' --fresh --out out\"", 60, "sh");
        EXPECT_EQ(run.exit_code, 0) << name << ": " << run.output;
        EXPECT_NE(run.output.find("b & c.obj: doctor"), std::string::npos) << run.output;
        if (expected.empty()) expected = text_of(folder_ / "levels/out/junit.xml");
        EXPECT_EQ(text_of(folder_ / "levels/out/junit.xml"), expected) << name;
    }
}

TEST_F(Nightly, ReportsWorstFirstWithTapesThatRepeat) {
    const ProgramRun run = nightly("out");
    EXPECT_EQ(run.exit_code, 1) << run.output;
    const auto json = nlohmann::json::parse(text_of(report("out")));
    EXPECT_EQ(json.at("results").size(), 8u) << "2 levels x 2 presets audited, 1 x 2 searched, 2 examined";
    std::size_t goals = 0;
    for (const auto& result : json.at("results")) {
        EXPECT_NE(result.at("state"), "failed") << result;
        for (const auto& finding : result.at("findings")) {
            if (finding.at("kind") != "goal") continue;
            ++goals;
            const fs::path tape = folder_ / "out" / result.at("folder").get<std::string>() /
                                  finding.at("tape").get<std::string>();
            const ProgramRun replay = run_program("simulate '" + (folder_ / "levels/b & c.obj").string() +
                                                  "' --tape '" + tape.string() + "'");
            EXPECT_EQ(replay.exit_code, 0) << replay.output;
        }
    }
    EXPECT_EQ(goals, 2u);
    const std::string page = text_of(folder_ / "out/report.html");
    EXPECT_NE(page.find("&lt;roof&gt;: not reached"), std::string::npos);
    EXPECT_NE(page.find("slipface reach --check 'levels/b &amp; c.obj'"), std::string::npos) << page;
    EXPECT_EQ(page.find("<roof>"), std::string::npos);
    const std::string junit = text_of(folder_ / "out/junit.xml");
    EXPECT_NE(junit.find("tests=\"8\""), std::string::npos) << junit;
    EXPECT_LT(junit.find("reach"), junit.find("doctor")) << "goals are worse than problems";
}

TEST_F(Nightly, TakesWhatDidNotChangeFromTheLastReport) {
    ASSERT_EQ(nightly("out").exit_code, 1);
    const std::string before = text_of(report("out"));
    const ProgramRun again = nightly("out");
    EXPECT_EQ(again.exit_code, 1);
    const auto count = [](const std::string& text, const std::string& word) {
        std::size_t number = 0;
        for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
            ++number;
        return number;
    };
    EXPECT_EQ(count(again.output, "unchanged"), 8u) << again.output;
    EXPECT_EQ(text_of(report("out")), before);
    // A level, then options, then a lost tape.
    folder_.write("levels/a.obj", floor_with(3.5));
    EXPECT_EQ(count(nightly("out").output, "unchanged"), 5u);
    write_project(R"("audit": "--walkers 5 --seconds 2", "reach": "--rounds 1", "doctor": "")");
    EXPECT_EQ(count(nightly("out").output, "unchanged"), 4u);
    fs::remove(folder_ / "out/items/levels/b & c.obj/level/reach/goal-1.tape");
    EXPECT_EQ(count(nightly("out").output, "unchanged"), 7u);
    EXPECT_EQ(count(nightly("other", "--last " + (folder_ / "out").string()).output, "unchanged"), 8u);
    EXPECT_EQ(text_of(report("other")), text_of(report("out")));
    EXPECT_EQ(count(nightly("out", "--fresh").output, "unchanged"), 0u);
}

TEST_F(Nightly, ShardsMergeToTheWholeOrNotAtAll) {
    ASSERT_EQ(nightly("whole").exit_code, 1);
    for (const char* const part : {"1", "2", "3"})
        EXPECT_LE(nightly(std::string("part") + part, std::string("--shard ") + part + "/3").exit_code, 1);
    const std::string one = " " + report("part1"), two = " " + report("part2"), three = " " + report("part3");
    EXPECT_EQ(merge(three + one + two).exit_code, 1);
    EXPECT_EQ(text_of(report("merged")), text_of(report("whole")));
    EXPECT_TRUE(fs::exists(folder_ / "merged/items/levels/b & c.obj/momentum/reach/goal-1.tape"));

    const auto refused = [&](const std::string& files, const char* why) {
        const ProgramRun run = merge(files);
        EXPECT_EQ(run.exit_code, 2) << files;
        EXPECT_NE(run.output.find(why), std::string::npos) << run.output;
    };
    refused(one + three, "1 of 3 parts missing: 2/3");
    refused(one + one + three, "is part 1/3, as");
    refused(one + two + three + " " + report("whole"), "is part 1/1, but");
    folder_.write("levels/a.obj", floor_with(2.0));
    EXPECT_LE(nightly("part2", "--shard 2/3").exit_code, 1);
    refused(one + two + three, "they differ in levels");
    std::string damaged = text_of(report("part3"));
    damaged.replace(damaged.find("clean"), 5, "klean");
    folder_.write("part3/report.json", damaged);
    refused(one + three, "damaged");
    folder_.write("part3/report.json", damaged.substr(0, damaged.size() / 2));
    refused(one + three, "damaged");
    EXPECT_EQ(nightly("out", "--shard 0/3").exit_code, 64);
    EXPECT_EQ(nightly("out", "--shard 4/3").exit_code, 64);
}

TEST_F(Nightly, ADoctorNoticesTextures) {
    write_project(R"("doctor": "")");
    EXPECT_LE(nightly("out").exit_code, 1);
    folder_.write("levels/more.mtl", "newmtl floor\nmap_Kd gone.png\n");
    EXPECT_EQ(nightly("out").output.find("unchanged"), std::string::npos);
    EXPECT_NE(nightly("out").output.find("unchanged"), std::string::npos);
}

// Started by a program that ignores the end of its children, as some supervisors do.
TEST_F(Nightly, EndsWhereChildrenAreIgnored) {
    write_project(R"("doctor": "")");
    const ProgramRun run =
        run_program("nightly " + (folder_ / "project.json").string() + " --out " + (folder_ / "out").string(),
                    60, "sh -c 'trap \"\" CHLD; exec \"$0\" \"$@\"' " + std::string(SLIPFACE_PROGRAM));
    EXPECT_LT(run.exit_code, 2) << run.output;
    EXPECT_TRUE(fs::exists(report("out"))) << run.output;
}

TEST_F(Nightly, NamesWhatCannotRunAndGoesOn) {
    folder_.write("levels/broken.obj", "v 1 2\nf 1 2 3\n");
    const ProgramRun run = nightly("out");
    EXPECT_EQ(run.exit_code, 2) << run.output;
    EXPECT_NE(run.output.find("3 failed to run"), std::string::npos) << run.output;
    EXPECT_NE(text_of(folder_ / "out/report.html").find("broken.obj:1"), std::string::npos);
}

TEST_F(Nightly, RefusesBadProjects) {
    const auto refused = [&](const std::string& text, const char* why) {
        folder_.write("project.json", text);
        const ProgramRun run = nightly("out");
        EXPECT_EQ(run.exit_code, 2) << text;
        EXPECT_NE(run.output.find(why), std::string::npos) << run.output;
    };
    refused("", "is no project");
    refused(R"({"slipface_nightly": 2})", "is no project");
    refused(R"({"slipface_nightly": 1, "level": []})", "/level: expected");
    refused(R"({"slipface_nightly": 1, "levels": ["levels/*.glb"], "checks": {"audit": ""}})",
            "found \"levels/*.glb\"");
    refused(R"({"slipface_nightly": 1, "levels": [7], "checks": {"audit": ""}})", "expected a list of texts");
    refused(R"({"slipface_nightly": 1, "levels": ["levels/*.obj"], "checks": {"walk": ""}})", "/checks/walk");
    refused(R"({"slipface_nightly": 1, "levels": ["levels/*.obj"], "checks": {"reach": "--seconds 3"}})",
            "found --seconds");
    refused(
        R"({"slipface_nightly": 1, "levels": ["levels/*.obj"], "presets": ["none"], "checks": {"audit": ""}})",
        "found \"none\"");
    EXPECT_EQ(run_program("nightly").exit_code, 64);
}

}  // namespace
}  // namespace slipface::test
