// `slipface snapshot` as a user runs it: goldens appear only by approval, every kind of failure has its exit
// code, and shards come together.
#include <gtest/gtest.h>

#include <iterator>
#include <nlohmann/json.hpp>

#include "program/run_program.h"

namespace slipface::test {
namespace {

namespace fs = std::filesystem;

std::string room(double top) {
    return "v -3 0 3\nv 3 0 3\nv 3 0 -3\nv -3 0 -3\nv -3 " + std::to_string(top) + " -3\nv 3 " +
           std::to_string(top) +
           " -3\no floor\nusemtl floor__ice\nf 1 2 3 4\no wall\nusemtl wall\nf 4 3 6 5\n";
}

class SnapshotVerb : public testing::Test {
  protected:
    void SetUp() override {
        fs::create_directories(folder_ / "goldens");
        folder_.write("room.obj", room(2.0));
        folder_.write("goldens/scenes.json",
                      R"({"version": 1, "defaults": {"size": [160, 90], "style": "plain overlay"},
            "scenes": [{"name": "a", "level": "../room.obj"},
                       {"name": "b", "level": "../room.obj", "cameras": ["auto:map", "auto:turntable:2"]}]})");
        unsetenv("CI");
        unsetenv("GITHUB_ACTIONS");
    }
    ProgramRun snapshot(const std::string& words) const {
        return run_program("snapshot " + words + " --goldens " + (folder_ / "goldens").string() + " ");
    }
    ProgramRun check(const std::string& more = "") const {
        return snapshot("check --out " + (folder_ / "out").string() + " " + more);
    }
    std::size_t goldens() const {
        std::size_t count = 0;
        for (const auto& entry : fs::recursive_directory_iterator(folder_ / "goldens"))
            count += entry.path().extension() == ".png" ? 1U : 0U;
        return count;
    }

    ScratchFolder folder_;
};

TEST_F(SnapshotVerb, FromNothingToApprovedToChanged) {
    // Missing goldens fail, and nothing is written among them.
    const ProgramRun missing = check("--jobs 2");
    EXPECT_EQ(missing.exit_code, 1) << missing.output;
    EXPECT_NE(missing.output.find("0 same, 5 failed"), std::string::npos) << missing.output;
    EXPECT_EQ(goldens(), 0U);
    EXPECT_EQ(check("--detailed-exit --jobs 1 --only a").exit_code, 2);

    // What was seen is approved without rendering; then all is the same, in one process or several.
    const std::string report = (folder_ / "out/report.json").string();
    EXPECT_EQ(check("--jobs 2").exit_code, 1);
    EXPECT_EQ(snapshot("approve --from " + report + " 'b@*'").exit_code, 0);
    EXPECT_EQ(goldens(), 3U);
    const ProgramRun rest = snapshot("approve --jobs 2");
    EXPECT_NE(rest.output.find("1 approved, 4 unchanged, 0 failed"), std::string::npos) << rest.output;
    const ProgramRun same = check("--jobs 2 --twice --timing");
    EXPECT_EQ(same.exit_code, 0) << same.output;
    EXPECT_NE(same.output.find("5 same, 0 failed"), std::string::npos) << same.output;

    // A higher wall is named, and the report is there.
    EXPECT_EQ(same.output.find("not reached"), std::string::npos);  // nothing runs here
    folder_.write("room.obj", room(2.25));
    const ProgramRun changed = check("--jobs 1");
    EXPECT_EQ(changed.exit_code, 1) << changed.output;
    EXPECT_NE(changed.output.find("level             2 vertices of `wall` moved by up to 0.25 m (room)"),
              std::string::npos)
        << changed.output;
    for (const char* name : {"report.html", "report.json", "junit.xml", "a.expected.png", "a.actual.json"})
        EXPECT_TRUE(fs::exists(folder_ / (std::string("out/") + name))) << name;
    // One row for all that the act changed, which is the first word of an annotation, too.
    EXPECT_EQ(changed.output.find("vertices"), changed.output.rfind("vertices")) << changed.output;
    setenv("GITHUB_ACTIONS", "true", 1);
    const std::string annotated = check("--jobs 1 --quiet").output;
    unsetenv("GITHUB_ACTIONS");
    EXPECT_NE(annotated.find(",title=Snapshots::level: 2 vertices of `wall` moved"), std::string::npos)
        << annotated;
    // The facts follow when no image that shows them is red.
    const ProgramRun one = snapshot("approve a --jobs 1");
    EXPECT_NE(one.output.find("kept              inputs/room"), std::string::npos) << one.output;
    EXPECT_NE(check("--only 'b@*' --jobs 1").output.find("2 vertices of `wall`"), std::string::npos);
    EXPECT_EQ(check("--jobs 1").exit_code, 1);
    EXPECT_EQ(snapshot("approve --jobs 1 --from " + report + " --act '*ceiling*'").exit_code, 2);
    const ProgramRun act = snapshot("approve --jobs 1 --from " + report + " --act '*wall*'");
    EXPECT_NE(act.output.find("0 failed"), std::string::npos) << act.output;
    EXPECT_EQ(check().exit_code, 0);
}

TEST_F(SnapshotVerb, ShardsComeTogether) {
    ASSERT_EQ(snapshot("approve --jobs 1").exit_code, 0);
    fs::copy_file(folder_ / "goldens/a.png", folder_ / "goldens/old.png");
    std::string reports;
    for (const char* part : {"1", "2"}) {
        const std::string out = (folder_ / (std::string("part") + part)).string();
        const ProgramRun run = snapshot("check --jobs 1 --shard " + std::string(part) + "/2 --out " + out);
        EXPECT_EQ(run.exit_code, part[0] == '1' ? 1 : 0) << run.output;  // the first reports the orphan
        reports += " " + out + "/report.json";
    }
    const ProgramRun merged =
        run_program("snapshot merge --detailed-exit --out " + (folder_ / "all").string() + reports);
    EXPECT_EQ(merged.exit_code, 2) << merged.output;  // nothing but an orphan
    EXPECT_NE(merged.output.find("5 same, 1 failed"), std::string::npos) << merged.output;
    EXPECT_EQ(snapshot("list --orphans").exit_code, 2);
    EXPECT_EQ(snapshot("approve --prune a").exit_code, 0);
    EXPECT_FALSE(fs::exists(folder_ / "goldens/old.png"));
    EXPECT_EQ(snapshot("check --shard 3/2").exit_code, 64);
    const ProgramRun from_zero = snapshot("check --shard 0/2");
    EXPECT_EQ(from_zero.exit_code, 64);
    EXPECT_NE(from_zero.output.find("counted from 1"), std::string::npos) << from_zero.output;

    // A part that rendered another level.
    folder_.write("room.obj", room(2.5));
    const std::string changed = (folder_ / "changed").string();
    EXPECT_NE(snapshot("check --jobs 1 --shard 2/2 --out " + changed).exit_code, 64);
    const ProgramRun mixed =
        run_program("snapshot merge --out " + (folder_ / "all").string() + " " +
                    (folder_ / "part1/report.json").string() + " " + changed + "/report.json");
    EXPECT_EQ(mixed.exit_code, 2);
    EXPECT_NE(mixed.output.find("other goldens, levels"), std::string::npos) << mixed.output;
    folder_.write("room.obj", room(2.0));

    // A part that is missing, there twice, damaged, or of another choice of snapshots.
    const std::string first = (folder_ / "part1/report.json").string(),
                      second = (folder_ / "part2/report.json").string();
    const auto merge = [&](const std::string& files) {
        return run_program("snapshot merge --out " + (folder_ / "all").string() + " " + files);
    };
    EXPECT_EQ(merge(first + " " + second).exit_code, 1);  // the orphan
    const ProgramRun half = merge(second);
    EXPECT_EQ(half.exit_code, 2);
    EXPECT_NE(half.output.find("1 of 2 parts missing: 1/2"), std::string::npos) << half.output;
    EXPECT_EQ(merge(first + " " + first).exit_code, 2);
    const std::string other = (folder_ / "other").string();
    EXPECT_EQ(snapshot("check --jobs 1 --only 'b@*' --shard 2/2 --out " + other).exit_code, 0);
    EXPECT_EQ(merge(first + " " + other + "/report.json").exit_code, 2);
    std::ifstream file(second);
    std::string text((std::istreambuf_iterator<char>(file)), {});
    text.replace(text.find("\"same\""), 6, "\"lost\"");
    folder_.write("part2/report.json", text);
    EXPECT_EQ(merge(first + " " + second).exit_code, 2);
}

// What changed a golden, commit by commit, and two branches that changed neighbouring members of its facts.
TEST_F(SnapshotVerb, HistoryAndMergesInGit) {
    const auto git = [&](const std::string& words) {
        return run_program("-C " + (folder_ / "").string() +
                               " -c user.name=a -c user.email=a@b -c core.hooksPath=/dev/null " + words,
                           60, "git");
    };
    const auto commit = [&](const std::string& subject) {
        ASSERT_EQ(git("add -A").exit_code, 0);
        const ProgramRun run = git("commit -m '" + subject + "'");
        ASSERT_EQ(run.exit_code, 0) << run.output;
    };
    ASSERT_EQ(git("init -b main").exit_code, 0);
    folder_.write(".gitattributes", "goldens/**/*.json merge=snapshot\n");
    git(std::string("config merge.snapshot.driver '") + SLIPFACE_PROGRAM +
        " snapshot merge-driver %O %A %B %P'");
    ASSERT_EQ(snapshot("approve --jobs 1").exit_code, 0);
    commit("Begin");
    folder_.write("room.obj", room(2.25));
    ASSERT_EQ(snapshot("approve --jobs 1").exit_code, 0);
    commit("Raise the wall");
    const ProgramRun history = snapshot("history a");
    EXPECT_EQ(history.exit_code, 0);
    for (const char* text :
         {" Raise the wall\n", "level: 2 vertices of `wall` moved by up to 0.25 m (room); ", " pixels\n",
          " Begin\n", "it was approved first"})
        EXPECT_NE(history.output.find(text), std::string::npos) << history.output;
    EXPECT_NE(snapshot("history inputs/room").output.find("2 vertices of `wall`"), std::string::npos);
    EXPECT_EQ(snapshot("history nothing").exit_code, 2);

    // The page has the commits of what differs.
    folder_.write("room.obj", room(2.5));
    EXPECT_EQ(check("--jobs 1").exit_code, 1);
    std::ifstream file(folder_ / "out/report.html");
    const std::string page((std::istreambuf_iterator<char>(file)), {});
    EXPECT_NE(page.find(" Raise the wall\""), std::string::npos);
    folder_.write("room.obj", room(2.25));

    const auto facts = [&](const char* one, const char* two) {
        folder_.write("goldens/inputs/x.json",
                      std::string("{\n  \"one\": ") + one + ",\n  \"two\": " + two + "\n}\n");
    };
    facts("1", "1");
    commit("Facts");
    git("checkout -b branch");
    facts("1", "2");
    commit("Two");
    git("checkout main");
    facts("2", "1");
    commit("One");
    const ProgramRun merge = git("merge branch -m both");
    EXPECT_EQ(merge.exit_code, 0) << merge.output;
    std::ifstream merged(folder_ / "goldens/inputs/x.json");
    EXPECT_EQ(nlohmann::json::parse(merged), nlohmann::json({{"one", 2}, {"two", 2}}));
    git("checkout branch");
    facts("3", "2");
    commit("One, otherwise");
    const ProgramRun both = git("merge main -m both");
    EXPECT_EQ(both.exit_code, 1);
    EXPECT_NE(both.output.find("goldens/inputs/x.json:/one: both sides changed it"), std::string::npos)
        << both.output;
}

TEST_F(SnapshotVerb, EveryFailureHasItsCode) {
    ASSERT_EQ(snapshot("approve --jobs 1").exit_code, 0);
    folder_.write("goldens/a.png", "version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 1\n");
    const ProgramRun pointer = check("--detailed-exit --only a");
    EXPECT_EQ(pointer.exit_code, 4);
    EXPECT_NE(pointer.output.find("git lfs pull"), std::string::npos) << pointer.output;
    // Pictures that were taken before, compared later.
    const std::string rendered = (folder_ / "rendered").string();
    EXPECT_EQ(snapshot("render --only 'b@*' --jobs 1 --sheet --out " + rendered).exit_code, 0);
    EXPECT_TRUE(fs::exists(rendered + "/sheet-01.png"));
    EXPECT_EQ(snapshot("compare --only 'b@*' --actual " + rendered + " --out " + rendered).exit_code, 0);
    EXPECT_EQ(snapshot("compare --only 'a' --actual " + rendered + " --out " + rendered).exit_code, 3);
    const std::string one = rendered + "/b@map.png", two = rendered + "/b@turntable-1.png";
    EXPECT_EQ(run_program("snapshot diff " + one + " " + one).exit_code, 0);
    const ProgramRun diff = run_program("snapshot diff --json " + one + " " + two);
    EXPECT_EQ(diff.exit_code, 1);
    EXPECT_GT(nlohmann::json::parse(diff.output).at("differing"), 100);
    // A level that cannot be read is that snapshot's failure, and the rest goes on.
    folder_.write("room.obj", "nonsense");
    EXPECT_EQ(check("--detailed-exit --only 'b@*' --jobs 2").exit_code, 3);
    EXPECT_EQ(check("--only 'b@*'").exit_code, 1);

    EXPECT_EQ(check("--only nothing").exit_code, 2);
    EXPECT_EQ(run_program("snapshot check --goldens " + (folder_ / "nowhere").string()).exit_code, 2);
    EXPECT_EQ(run_program("snapshot diff a").exit_code, 64);
    setenv("CI", "true", 1);
    EXPECT_EQ(snapshot("approve").exit_code, 64);
    unsetenv("CI");
}

}  // namespace
}  // namespace slipface::test
