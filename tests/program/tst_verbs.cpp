// The data verbs through the real program, against numbers derived by hand.
#include <gtest/gtest.h>

#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "program/run_program.h"

namespace slipface::test {
namespace {

// A floor of 20 x 20 m at y = 0, facing up.
const std::string floor_obj = "v -10 0 10\nv 10 0 10\nv 10 0 -10\nv -10 0 -10\nf 1 2 3 4\n";

TEST(Info, CountsFacesAndTriangles) {
    const ScratchFolder folder;
    const ProgramRun run = run_program("info " + folder.write("floor.obj", floor_obj) + " --json");
    ASSERT_EQ(run.exit_code, 0) << run.output;
    const auto json = nlohmann::json::parse(run.output);
    EXPECT_EQ(json.at("faces"), 1);
    EXPECT_EQ(json.at("triangles"), 2);
}

TEST(NameMaterials, TheFormerNameOfTheVerbSaysTheNewOne) {
    const ProgramRun run = run_program("bake level.obj");
    EXPECT_EQ(run.exit_code, 64);
    EXPECT_NE(run.output.find("is called name-materials now"), std::string::npos) << run.output;
}

TEST(Sweep, FallsOntoTheFloor) {
    const ScratchFolder folder;
    const std::string level = folder.write("floor.obj", floor_obj);
    // An ellipsoid of half-height 0.9 that falls 4 m from y = 2.9 touches after 2.9 - 0.9 = 2 m: t = 0.5,
    // straight below.
    const ProgramRun run =
        run_program("sweep " + level + " --radii 0.4,0.9,0.4 --from 1,2.9,2 --move 0,-4,0 --json");
    ASSERT_EQ(run.exit_code, 0) << run.output;
    const auto json = nlohmann::json::parse(run.output);
    EXPECT_NEAR(json.at("t").get<double>(), 0.5, 1e-12);
    EXPECT_EQ(json.at("feature"), "interior");
    EXPECT_EQ(json.at("face"), 0);
}

TEST(Sweep, AnswersEachRowOfACsv) {
    const ScratchFolder folder;
    const std::string level = folder.write("floor.obj", floor_obj);
    const std::string queries = folder.write("q.csv", "ox,oy,oz,dx,dy,dz\n0,2,0,0,-4,0\n0,2,0,0,4,0\n");
    const ProgramRun run = run_program("sweep " + level + " --radii 1,1,1 --queries " + queries + " --csv");
    ASSERT_EQ(run.exit_code, 0) << run.output;
    std::istringstream lines(run.output);
    std::string header, hit, miss;
    std::getline(lines, header);
    std::getline(lines, hit);
    std::getline(lines, miss);
    EXPECT_EQ(header.substr(0, 3), "hit");
    EXPECT_EQ(hit[0], '1');
    EXPECT_EQ(miss[0], '0');
}

TEST(Simulate, TheSameTapeGivesTheSameHashes) {
    const ScratchFolder folder;
    const std::string level = folder.write("floor.obj", floor_obj);
    const std::string tape = folder.write(
        "t.tape", "slipface-tape 1\ndt 1/60\nstart 0,2,0\n90 wish 0,-1\n1 wish 0,0 jump\n60 wish 1,0\n");
    const std::string arguments = "simulate " + level + " --tape " + tape + " --json";
    const ProgramRun first = run_program(arguments), second = run_program(arguments);
    ASSERT_EQ(first.exit_code, 0) << first.output;
    EXPECT_EQ(first.output, second.output);
    const ProgramRun other = run_program(arguments + " --set walk_speed=5");
    EXPECT_NE(first.output, other.output);
    EXPECT_EQ(run_program(arguments + " --set walk_sped=5").exit_code, 2);
}

// Two metres below the spawn point, which is the origin. Walkers leave it, which is no finding.
// What a run printed less the warnings on standard error.
std::string without_warnings(const std::string& output) {
    std::istringstream lines(output);
    std::string kept;
    for (std::string line; std::getline(lines, line);)
        if (!line.starts_with("slipface: warning:")) kept += line + "\n";
    return kept;
}

const std::string low_floor_obj = "v -10 -2 10\nv 10 -2 10\nv 10 -2 -10\nv -10 -2 -10\nf 1 2 3 4\n";

TEST(Audit, IsTheSameForAnyNumberOfThreads) {
    const ScratchFolder folder;
    const std::string level = folder.write("floor.obj", low_floor_obj);
    const std::string arguments = "audit " + level + " --walkers 6 --seconds 3 --seed 7 --json --threads ";
    const ProgramRun one = run_program(arguments + "1"), two = run_program(arguments + "2");
    ASSERT_EQ(one.exit_code, 0) << one.output;
    EXPECT_EQ(one.output, two.output);
    const auto json = nlohmann::json::parse(without_warnings(one.output));
    EXPECT_EQ(json.at("steps"), 6 * 3 * 60);
    EXPECT_EQ(json.at("seed"), 7);
}

TEST(Audit, ItsPartsMakeTheWhole) {
    const ScratchFolder folder;
    const std::string level = folder.write("floor.obj", low_floor_obj);
    const std::string arguments = "audit " + level + " --walkers 6 --seconds 2 --json";
    const std::string first = (folder / "first.json").string(), second = (folder / "second.json").string();
    const ProgramRun whole = run_program(arguments);
    ASSERT_EQ(run_program(arguments + " --shard 1/2 --out " + first).exit_code, 0);
    ASSERT_EQ(run_program(arguments + " --shard 2/2 --out " + second).exit_code, 0);
    const ProgramRun merged = run_program("audit merge " + first + " " + second + " --json");
    ASSERT_EQ(merged.exit_code, 0) << merged.output;
    EXPECT_EQ(merged.output, without_warnings(whole.output));
    const ProgramRun half = run_program("audit merge " + second);
    EXPECT_EQ(half.exit_code, 2);
    EXPECT_NE(half.output.find("1 of 2 parts missing: 1/2"), std::string::npos) << half.output;
    folder.write("second.json", "{\"slipface_audit\": 3");
    EXPECT_EQ(run_program("audit merge " + first + " " + second).exit_code, 2);
}

TEST(Audit, WalksWithAPreset) {
    const ScratchFolder folder;
    const std::string arguments =
        "audit " + folder.write("floor.obj", low_floor_obj) + " --walkers 2 --seconds 2 --json";
    const ProgramRun plain = run_program(arguments), momentum = run_program(arguments + " --preset momentum");
    ASSERT_EQ(momentum.exit_code, 0) << momentum.output;
    EXPECT_NE(plain.output, momentum.output);
    EXPECT_EQ(run_program(arguments + " --preset nothing").exit_code, 2);
}

// Two ledges with a gap of 3 m between them, then a step nobody can jump onto.
const std::string ledges_obj =
    "v -2 -1 4\nv 2 -1 4\nv 2 -1 0\nv -2 -1 0\nv -2 -1 -3\nv 2 -1 -3\nv 2 -1 -6\nv -2 -1 -6\n"
    "v -2 5 -6\nv 2 5 -6\nv 2 5 -9\nv -2 5 -9\nf 1 2 3 4\nf 5 6 7 8\nf 9 10 11 12\n"
    "f 8 7 10 9\n";

TEST(Reach, ProvesItsYesAndSaysItsNo) {
    const ScratchFolder folder;
    const std::string level = folder.write("ledges.obj", ledges_obj);
    folder.write("ledges.slipface.json",
                 R"({"slipface": 1, "mesh": "ledges.obj", "spawn": {"position": [0, -0.05, 3]}})");
    const std::string reach = "reach " + level + " --rounds 25", tape = (folder / "way.tape").string(),
                      out = (folder / "search").string();
    const ProgramRun one = run_program(reach + " --json --threads 1 --out " + out),
                     two = run_program(reach + " --json --threads 2");
    ASSERT_EQ(one.exit_code, 0) << one.output;
    EXPECT_EQ(one.output, two.output);
    const auto json = nlohmann::json::parse(without_warnings(one.output));
    EXPECT_EQ(json.at("reached_faces"), nlohmann::json({0, 1}));
    EXPECT_EQ(json.at("unreached_walkable_faces"), nlohmann::json({2}));
    EXPECT_FALSE(json.at("exits").empty());

    // The proof stands on the face that it was asked for.
    const ProgramRun how =
        run_program("reach " + level + " --resume " + out + " --how face:1 --tape " + tape);
    ASSERT_EQ(how.exit_code, 0) << how.output;
    const ProgramRun run = run_program("simulate " + level + " --tape " + tape + " --json");
    ASSERT_EQ(run.exit_code, 0) << run.output;
    EXPECT_EQ(nlohmann::json::parse(without_warnings(run.output)).at("final_state").at("ground_face"), 1);

    const ProgramRun miss = run_program("reach " + level + " --resume " + out + " --how face:2 --json");
    EXPECT_EQ(miss.exit_code, 1);
    const auto no = nlohmann::json::parse(without_warnings(miss.output));
    EXPECT_FALSE(no.at("reached"));
    EXPECT_GT(no.at("short_m"), 1.0);

    const std::string slow = (folder / "slow").string();
    ASSERT_EQ(run_program(reach + " --set walk_speed=1 --out " + slow).exit_code, 0);
    const ProgramRun diff = run_program("reach diff " + out + " " + slow + " --json");
    EXPECT_EQ(diff.exit_code, 1);
    EXPECT_EQ(nlohmann::json::parse(diff.output).at("lost_faces"), nlohmann::json({1}));
}

TEST(Reach, GoesOnFromItsCheckpointAndRefusesOthers) {
    const ScratchFolder folder;
    const std::string level = folder.write("ledges.obj", ledges_obj);
    folder.write("ledges.slipface.json",
                 R"({"slipface": 1, "mesh": "ledges.obj", "spawn": {"position": [0, -0.05, 3]}})");
    const auto bytes = [&](const char* name) {
        std::ifstream stream(folder / name, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(stream), {});
    };
    const auto search = [&](const std::string& rounds, const std::string& more, const char* out) {
        return run_program("reach " + level + " --rounds " + rounds + more + " --out " +
                           (folder / out).string());
    };
    const std::string checkpoint = " --checkpoint " + (folder / "checkpoint").string();
    ASSERT_EQ(search("9", "", "whole").exit_code, 0);
    ASSERT_EQ(search("5", checkpoint + " --every 2", "half").exit_code, 0);
    EXPECT_EQ(bytes("checkpoint"), bytes("half"));
    ASSERT_EQ(search("9", checkpoint, "rest").exit_code, 0);
    EXPECT_TRUE(bytes("rest") == bytes("whole"));

    const std::string before = bytes("checkpoint");
    const auto refused = [&](const std::string& more, const char* why) {
        const ProgramRun run = search("12", more, "other");
        EXPECT_EQ(run.exit_code, 2) << run.output;
        EXPECT_NE(run.output.find(why), std::string::npos) << run.output;
    };
    refused(checkpoint + " --seed 2", "expected --seed 2");
    refused(checkpoint + " --cell 0.9", "expected --seed 1 --cell 0.9");
    refused(checkpoint + " --set gravity=9", "of other settings");
    EXPECT_TRUE(bytes("checkpoint") == before);
    refused(" --checkpoint " + folder.write("short", before.substr(0, before.size() / 2)), "damaged data");
    refused(" --checkpoint " + folder.write("empty", ""), "is empty");
    // A folder that cannot be written: the search itself goes on.
    const ProgramRun full = search("9", " --every 2 --checkpoint /proc/checkpoint", "despite");
    EXPECT_EQ(full.exit_code, 0) << full.output;
    EXPECT_NE(full.output.find("the search goes on"), std::string::npos) << full.output;
    EXPECT_TRUE(bytes("despite") == bytes("whole"));
}

TEST(Reach, ChecksTheGoalsAndNamesTheSettingThatBreaksOne) {
    const ScratchFolder folder;
    const std::string level = folder.write("ledges.obj", ledges_obj);
    folder.write("ledges.slipface.json",
                 R"({"slipface": 1, "mesh": "ledges.obj", "spawn": {"position": [0, -0.05, 3]},
                     "goals": [{"name": "over", "position": [0, 0, -4.5]},
                               {"name": "roof", "kind": "never", "position": [0, 6, -7]}]})");
    const std::string check = "reach " + level + " --rounds 25 --check";
    const ProgramRun fine = run_program(check);
    EXPECT_EQ(fine.exit_code, 0) << fine.output;
    const ProgramRun broken = run_program(check + " --set walk_speed=1 --set gravity=21");
    EXPECT_EQ(broken.exit_code, 1) << broken.output;
    EXPECT_NE(broken.output.find("over: not reached"), std::string::npos) << broken.output;
    EXPECT_NE(broken.output.find("holds with walk_speed=6\n"), std::string::npos) << broken.output;
}

TEST(Reach, NamesWhatOfALevelBrokeAGoal) {
    const ScratchFolder folder;
    // A bridge of 10 m between two ledges.
    const std::string bridge_obj =
        "v -2 -1 4\nv 2 -1 4\nv 2 -1 0\nv -2 -1 0\nv -2 -1 -10\nv 2 -1 -10\nv 2 -1 -14\nv -2 -1 -14\n"
        "f 1 2 3 4\nf 4 3 6 5\nf 5 6 7 8\n";
    const auto write = [&](const std::string& name, const std::string& obj, const std::string& more) {
        folder.write(name + ".slipface.json", R"({"slipface": 1, "mesh": ")" + name +
                                                  R"(.obj", "spawn": {"position": [0, -0.05, 3]},
                         "goals": [{"name": "over", "position": [0, 0, -13], "within_s": 10}])" +
                                                  more + "}");
        return folder.write(name + ".obj", obj);
    };
    const std::string before = write("before", bridge_obj, "");
    const auto check = [&](const std::string& level) {
        return run_program("reach " + level + " --rounds 25 --check --before " + before);
    };
    EXPECT_EQ(check(before).exit_code, 0);
    const ProgramRun slow = check(write("slow", bridge_obj, R"(, "movement": {"walk_speed": 1})"));
    EXPECT_EQ(slow.exit_code, 1) << slow.output;
    EXPECT_NE(slow.output.find("holds with walk_speed=6\n"), std::string::npos) << slow.output;
    std::string gone = bridge_obj;
    gone.erase(gone.find("f 4 3 6 5\n"), 10);
    const ProgramRun hole = check(write("hole", gone, ""));
    EXPECT_EQ(hole.exit_code, 1) << hole.output;
    EXPECT_NE(hole.output.find("face 1 of before, at (0.00, -1.00, -5.00) m, is gone\n"), std::string::npos)
        << hole.output;
    std::string painted = bridge_obj;
    painted.insert(painted.find("f 4 3 6 5\n"), "usemtl bridge__hazard\n");
    const ProgramRun paint = check(write("paint", painted, ""));
    EXPECT_EQ(paint.exit_code, 1) << paint.output;
    EXPECT_NE(paint.output.find("is hazard and was default\n"), std::string::npos) << paint.output;
}

TEST(Reach, WritesLinksForEngines) {
    const ScratchFolder folder;
    const std::string level = folder.write("ledges.obj", ledges_obj);
    folder.write("ledges.slipface.json",
                 R"({"slipface": 1, "mesh": "ledges.obj", "spawn": {"position": [0, -0.05, 3]}})");
    const std::string out = (folder / "search").string();
    ASSERT_EQ(run_program("reach " + level + " --rounds 25 --out " + out).exit_code, 0);
    const auto write = [&](const char* name) {
        const std::string file = (folder / name).string();
        EXPECT_EQ(run_program("reach " + level + " --resume " + out + " --links " + file).exit_code, 0);
        std::ifstream stream(file);
        return std::string(std::istreambuf_iterator<char>(stream), {});
    };
    const auto json = nlohmann::json::parse(write("links.json"));
    const auto& links = json.at("links");
    ASSERT_GE(links.size(), 2u);
    EXPECT_TRUE(links[0].at("two_way"));
    // Its tape ends on the face that it names.
    const std::string tape = folder.write("link.tape", links[0].at("tape").get<std::string>());
    const ProgramRun run = run_program("simulate " + level + " --tape " + tape + " --json");
    ASSERT_EQ(run.exit_code, 0) << run.output;
    EXPECT_EQ(nlohmann::json::parse(without_warnings(run.output)).at("final_state").at("ground_face"),
              links[0].at("to_face"));
    const auto gltf = nlohmann::json::parse(write("links.gltf"));
    // The level's object and its body come first.
    ASSERT_EQ(gltf.at("nodes").size(), 2 + links.size());
    EXPECT_EQ(gltf.at("nodes")[2].at("extras").at("slipface_link"), links[0]);
    EXPECT_EQ(gltf.at("scenes")[0].at("nodes").size(), 1 + links.size());
    const std::string gset = write("links.gset");
    EXPECT_EQ(gset.rfind("f ledges.obj\nc ", 0), 0u) << gset;
    EXPECT_EQ(run_program("reach " + level + " --rounds 1 --links links.txt").exit_code, 64);
}

TEST(Audit, StartsWhereASearchGets) {
    const ScratchFolder folder;
    const std::string level = folder.write("ledges.obj", ledges_obj);
    folder.write("ledges.slipface.json",
                 R"({"slipface": 1, "mesh": "ledges.obj", "spawn": {"position": [0, -0.05, 3]}})");
    const std::string audit = "audit " + level + " --walkers 8 --seconds 2 --heat --starts ";
    const ProgramRun one = run_program(audit + "reached:10 --json --threads 1"),
                     two = run_program(audit + "reached:10 --json --threads 2");
    EXPECT_EQ(without_warnings(one.output), without_warnings(two.output));
    EXPECT_EQ(nlohmann::json::parse(without_warnings(one.output)).at("starts"), 8);
    const std::string search = (folder / "search").string(), out = " --json --out ";
    ASSERT_EQ(run_program("reach " + level + " --rounds 10 --out " + search).exit_code, 0);
    EXPECT_EQ(without_warnings(run_program(audit + search + " --json").output), without_warnings(one.output));
    const std::string a = (folder / "a.json").string(), b = (folder / "b.json").string();
    run_program(audit + "reached:10 --shard 1/2 --json --out " + a);
    run_program(audit + "reached:10 --shard 2/2 --json --out " + b);
    EXPECT_EQ(run_program("audit merge " + a + " " + b + " --json").output, without_warnings(one.output));
    EXPECT_EQ(run_program(audit + "reached:0").exit_code, 2);
    EXPECT_EQ(run_program(audit + "nowhere").exit_code, 2);
}

TEST(Reach, RefusesWhatItCannotDo) {
    const ScratchFolder folder;
    const std::string level = folder.write("ledges.obj", ledges_obj);
    const auto code = [&](const std::string& rest) { return run_program("reach " + rest).exit_code; };
    EXPECT_EQ(code(""), 64);
    EXPECT_EQ(code(level + " --rounds -1"), 64);
    EXPECT_EQ(code(level + " --cell 0"), 64);
    EXPECT_EQ(code(level + " --how nowhere"), 64);
    EXPECT_EQ(code(level + " --rounds 1 --how face:4"), 2);
    EXPECT_EQ(code(level + " --check"), 2);
    EXPECT_EQ(code(level + " --resume " + folder.write("bad", "slipface-reach 1 x")), 2);
    EXPECT_EQ(code("diff " + level + " " + level), 2);
    EXPECT_EQ(code(level + " --rounds 1 --set walk_sped=1"), 2);
}

TEST(Demo, MakesTheFolderThatItWritesInto) {
    const ScratchFolder folder;
    const std::string out = (folder / "new/below").string();
    EXPECT_EQ(run_program("demo static-friction --out " + out).exit_code, 0);
    EXPECT_TRUE(std::filesystem::exists(out));
    folder.write("file", "x");
    EXPECT_EQ(run_program("demo static-friction --out " + (folder / "file").string()).exit_code, 2);
}

TEST(Audit, RefusesWhatItCannotDo) {
    const ScratchFolder folder;
    const std::string level = folder.write("floor.obj", low_floor_obj);
    const auto code = [&](const std::string& rest) { return run_program("audit " + level + rest).exit_code; };
    EXPECT_EQ(code(" --seed -1"), 64);
    EXPECT_EQ(code(" --seed 18446744073709551616"), 64);
    EXPECT_EQ(code(" --walkers -1"), 64);
    EXPECT_EQ(code(" --speeds fast"), 64);
    EXPECT_EQ(code(" --dt 0/0"), 64);
    EXPECT_EQ(code(" --shard 3/2"), 64);
    EXPECT_EQ(code(" --shard 0/2"), 64);
    EXPECT_EQ(code(" --set nothing=1"), 2);
    EXPECT_EQ(code(" --walkers 1 --seconds 0.1 --tapes " + level + "/below"), 2);
    EXPECT_EQ(run_program("audit " + level + ".missing").exit_code, 2);
}

TEST(Output, ThatCannotBeWrittenIsAFailure) {
    const ScratchFolder folder;
    const std::string level = folder.write("floor.obj", low_floor_obj);
    EXPECT_EQ(run_program("info " + level + " > /dev/full").exit_code, 2);
    EXPECT_EQ(run_program("audit " + level + " --walkers 1 --seconds 0.1 --json > /dev/full").exit_code, 2);
}

TEST(Samples, AreThoseOfTheSourceTree) {
    const ProgramRun run = run_program("samples");
    EXPECT_EQ(run.exit_code, 0);
    EXPECT_EQ(run.output.find(SLIPFACE_SOURCE_DIR "/assets/levels/easy.obj\n"), 0u) << run.output;
}

// An installed program finds what was installed with it, wherever its prefix is; one that lies alone says so.
TEST(Samples, AreThoseBesideTheProgram) {
    const ScratchFolder folder;
    std::filesystem::create_directories(folder / "bin");
    std::filesystem::copy_file(SLIPFACE_PROGRAM, folder / "bin/slipface");
    const std::string program = (folder / "bin/slipface").string();
    EXPECT_EQ(run_program("samples", 60, program).exit_code, 2);

    std::filesystem::create_directories(folder / "share/slipface/levels");
    const std::string level = folder.write("share/slipface/levels/one.obj", low_floor_obj);
    const ProgramRun run = run_program("samples", 60, program);
    EXPECT_EQ(run.exit_code, 0);
    EXPECT_EQ(run.output, level + "\n");
}

}  // namespace
}  // namespace slipface::test
