#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/verbs.h"
#include "scratch.h"

namespace slipface::test {
namespace {

using testing::HasSubstr;

class Simulate : public Scratch {
  protected:
    int run(const std::string& tape, std::vector<std::string> settings = {}, bool json = true) {
        out.str("");
        err.str("");
        return cli::run_simulate(
            {level, write("run.tape", "slipface-tape 1\n" + tape), std::move(settings), json}, out, err);
    }
    nlohmann::json result() const { return nlohmann::json::parse(out.str()); }
    std::ostringstream out, err;
};

TEST_F(Simulate, JsonHoldsTheRun) {
    ASSERT_EQ(run("dt 1/60\n60\n1 jump\n29\n"), cli::exit_fine) << err.str();
    const auto json = result();
    EXPECT_EQ(json["ticks"], 90);
    EXPECT_NEAR(json["duration_s"].get<double>(), 1.5, 1e-12);
    EXPECT_EQ(json["hashes"].size(), 2u);
    EXPECT_EQ(json["hashes"][0].get<std::string>().size(), 16u);
    // The level's spawn, straight above it after the jump.
    EXPECT_NEAR(json["final_state"]["position"][0].get<double>(), -5.0, 1e-9);
    EXPECT_GT(json["final_state"]["position"][1].get<double>(), 1.0);
    EXPECT_EQ(json["final_state"]["grounded"], false);
    std::vector<std::string> kinds;
    for (const auto& event : json["events"])
        kinds.push_back(event["kind"].get<std::string>());
    EXPECT_THAT(kinds, testing::ElementsAre("land", "jump"));
    EXPECT_EQ(json["events"][1]["tick"], 60);
    EXPECT_TRUE(err.str().empty()) << err.str();
}

TEST_F(Simulate, TheSameTapeGivesTheSameText) {
    const std::string tape = "start 5,1,0\n100 wish 0.6,-0.8\n1 wish 0,1 jump\n60 wish -1,0\n";
    ASSERT_EQ(run(tape), cli::exit_fine) << err.str();
    const std::string first = out.str();
    ASSERT_EQ(run(tape), cli::exit_fine);
    EXPECT_EQ(out.str(), first);
    ASSERT_EQ(run(tape, {"walk_speed=5"}), cli::exit_fine);
    EXPECT_NE(out.str(), first);
}

// A preset is asked for by name, so it counts before what a tape that names all its settings recorded.
TEST_F(Simulate, APresetComesBeforeTheTapesSettings) {
    const std::string tape = "settings defaults\nstart 0,5,0\n30\n";
    const std::string path = write("preset.tape", "slipface-tape 1\n" + tape).string();
    ASSERT_EQ(run(tape), cli::exit_fine) << err.str();
    const auto fallen = result()["final_state"]["velocity"][1].get<double>();
    ASSERT_EQ(run(tape, {"gravity=9.81"}), cli::exit_fine) << err.str();
    const auto slower = result()["final_state"]["velocity"][1].get<double>();
    out.str("");
    ASSERT_EQ(
        cli::run_simulate({.level = level, .tape = path, .json = true, .preset = "simulation"}, out, err),
        cli::exit_fine)
        << err.str();
    EXPECT_NEAR(result()["final_state"]["velocity"][1].get<double>(), slower, 1e-9)
        << "gravity of that preset: 9.81";
    EXPECT_NE(slower, fallen);
    err.str("");
    EXPECT_EQ(cli::run_simulate({.level = level, .tape = path, .preset = ""}, out, err), cli::exit_bad_input);
    EXPECT_THAT(err.str(), HasSubstr("found no preset"));
}

TEST_F(Simulate, TellsWhatHappenedInATick) {
    const std::string path = write("tell.tape", "slipface-tape 1\ndt 1/60\n60\n1 jump\n9\n").string();
    const auto describe = [&](std::size_t tick) {
        out.str("");
        err.str("");
        return cli::run_simulate({.level = level, .tape = path, .describe = tick}, out, err);
    };
    ASSERT_EQ(describe(60), cli::exit_fine) << err.str();
    EXPECT_THAT(out.str(), HasSubstr("Begins: standing on"));
    EXPECT_THAT(out.str(), HasSubstr("jump pressed"));
    EXPECT_THAT(out.str(), HasSubstr("Jumped at "));
    EXPECT_THAT(out.str(), HasSubstr("Ends: in the air"));
    EXPECT_EQ(describe(70), cli::exit_bad_input);
    EXPECT_THAT(err.str(), HasSubstr("--describe: found tick 70, expected one from 0 to 69"));
}

TEST_F(Simulate, ATapeThatNamesItsEndIsATest) {
    const std::string tape = "settings defaults\n60 wish 1,0\n";
    ASSERT_EQ(run(tape), cli::exit_fine) << err.str();
    const auto hash = result()["end_hash"].get<std::string>();
    EXPECT_EQ(run(tape + "end " + hash + "\n"), cli::exit_fine) << err.str();
    EXPECT_EQ(run(tape + "end 0123456789abcdef\n"), cli::exit_check_failed);
    EXPECT_THAT(err.str(), HasSubstr("expected 0123456789abcdef"));
    EXPECT_THAT(err.str(), HasSubstr(hash));
    // Other settings give another run, and no check.
    EXPECT_EQ(run(tape + "end " + hash + "\n", {"walk_speed=3"}), cli::exit_fine) << err.str();
}

TEST_F(Simulate, OtherSurfacesThanRecordedAreAWarning) {
    EXPECT_EQ(run("surfaces 0123456789abcdef\n1\n"), cli::exit_fine);
    EXPECT_THAT(err.str(), HasSubstr("other surface types"));
}

TEST_F(Simulate, CsvHasARowATickWithTheRunsNumbers) {
    const std::string text = write("run.tape", "slipface-tape 1\n30\n30 wish 1,0\n").string();
    ASSERT_EQ(cli::run_simulate({.level = level, .tape = text, .settings = {}, .json = false, .csv = true},
                                out, err),
              cli::exit_fine)
        << err.str();
    std::istringstream lines(out.str());
    std::string line, last;
    std::getline(lines, line);
    EXPECT_THAT(line, testing::StartsWith("tick,time_s,x,y,z,vx,vy,vz,speed,"));
    EXPECT_THAT(line, HasSubstr(",surface,"));
    EXPECT_THAT(line, HasSubstr(",static_friction"));
    const auto commas = std::count(line.begin(), line.end(), ',');
    int rows = 0;
    for (; std::getline(lines, line); last = line, ++rows)
        ASSERT_EQ(std::count(line.begin(), line.end(), ','), commas) << line;
    EXPECT_EQ(rows, 60);
    EXPECT_THAT(last, testing::StartsWith("59,1,"));
    EXPECT_THAT(last, HasSubstr(",6,"));  // walking speed
}

TEST_F(Simulate, TheTapesSettingsAndThenTheCommandLinesCount) {
    // On flat ground for 2 s; the first quarter is enough to reach full speed, so the last second is that
    // speed.
    const auto speed = [&](const std::string& tape, std::vector<std::string> settings) {
        EXPECT_EQ(run(tape + "120 wish 0,-1\n", std::move(settings)), cli::exit_fine) << err.str();
        return -result()["final_state"]["velocity"][2].get<double>();
    };
    EXPECT_NEAR(speed("", {}), 6.0, 1e-6);
    EXPECT_NEAR(speed("set walk_speed=3\n", {}), 3.0, 1e-6);
    EXPECT_NEAR(speed("set walk_speed=3\n", {"walk_speed=2", "walk_speed=1"}), 1.0, 1e-6);
    write(
        "floor.slipface.json",
        R"({"slipface": 1, "mesh": "floor.obj", "spawn": {"position": [-5, 1, 0]}, "movement": {"walk_speed": 4}})");
    EXPECT_NEAR(speed("", {}), 4.0, 1e-6);
}

TEST_F(Simulate, TextIsARowAFact) {
    ASSERT_EQ(run("60\n", {}, false), cli::exit_fine) << err.str();
    EXPECT_THAT(out.str(), HasSubstr("ticks           60 of 1/60 s\n"));
    EXPECT_THAT(out.str(), HasSubstr("state           grounded on default\n"));
    EXPECT_THAT(out.str(), HasSubstr("\nhashes\n     1.000 s  "));
    EXPECT_THAT(out.str(), HasSubstr("land          default\n"));
}

TEST_F(Simulate, ATapeOfOtherGeometryIsAWarning) {
    ASSERT_EQ(run("level floor.obj 0123456789abcdef\n1\n"), cli::exit_fine);
    EXPECT_THAT(err.str(), HasSubstr("slipface: warning: " + (folder / "run.tape").string() + ": "));
    EXPECT_THAT(err.str(), HasSubstr("0123456789abcdef"));
}

TEST_F(Simulate, BadInputIsNamed) {
    EXPECT_EQ(run("60 hop=3\n"), cli::exit_bad_input);
    EXPECT_THAT(err.str(), testing::StartsWith("slipface: " + (folder / "run.tape").string() + ":2: "));
    EXPECT_EQ(run("60\n", {"walk_sped=5"}), cli::exit_bad_input);
    EXPECT_THAT(err.str(), HasSubstr("walk_speed"));
    EXPECT_EQ(run("60\n", {"gravity"}), cli::exit_bad_input);
    EXPECT_TRUE(out.str().empty());
    level = folder / "missing.obj";
    EXPECT_EQ(run("60\n"), cli::exit_bad_input);
    EXPECT_THAT(err.str(), HasSubstr("missing.obj"));
}

TEST_F(Simulate, WhyNamesWhatStoppedThePlayerAndWhatWouldCureIt) {
    // A kerb of 0.25 m across the way.
    const std::string kerb = write("kerb.obj",
                                   "o floor\nv -9 0 9\nv 9 0 9\nv 9 0 -3\nv -9 0 -3\nf 1 2 3 4\n"
                                   "o kerb\nv -9 0.25 -3\nv 9 0.25 -3\nv 9 0.25 -30\nv -9 0.25 -30\n"
                                   "f 4 3 6 5\nf 5 6 7 8\n")
                                 .string();
    const std::string tape = write("kerb.tape",
                                   "slipface-tape 1\nsettings defaults\nset step_up=off\nset snap_down=off\n"
                                   "start 0,0.902,0\n10\n90 wish 0,-1\n")
                                 .string();
    const cli::TapeOptions options{.level = kerb, .tape = tape};
    out.str("");
    ASSERT_EQ(cli::run_why({.tape = options}, out, err), cli::exit_fine) << err.str();
    EXPECT_THAT(out.str(), testing::StartsWith("The 0.25 m edge of `kerb` (face "));
    EXPECT_THAT(out.str(), HasSubstr("stopped you: Step up is off\n"));
    EXPECT_THAT(out.str(), HasSubstr("Stops in this run (1)"));
    EXPECT_THAT(out.str(), HasSubstr("+ Step up on: "));
    out.str("");
    ASSERT_EQ(cli::run_why({.tape = options, .json = true}, out, err), cli::exit_fine) << err.str();
    const auto json = result();
    ASSERT_EQ(json["stops"].size(), 1U);
    EXPECT_EQ(json["headline"], json["stops"][0]["headline"]);
    EXPECT_EQ(json["stops"][0]["cause"], "step");
    EXPECT_EQ(json["stops"][0]["cures"][0]["settings"][0], "step_up=on");
    EXPECT_FALSE(json["stops"][0]["held_by"].empty());
    EXPECT_TRUE(json["events"].is_array());
    const std::string jump =
        write("jump.tape", "slipface-tape 1\nsettings defaults\nstart 0,0.902,0\n10\n80 wish 0,0 jump\n")
            .string();
    out.str("");
    ASSERT_EQ(cli::run_why({.tape = {.level = kerb, .tape = jump}, .events = true}, out, err),
              cli::exit_fine);
    EXPECT_THAT(out.str(), HasSubstr("at 0.17 s  jumped        Jumped at 8 m/s"));
    EXPECT_THAT(out.str(), HasSubstr("the button was held, and a jump starts when it is pressed"));
    // With the cure there is nothing to tell.
    out.str("");
    ASSERT_EQ(cli::run_why({.tape = {.level = kerb, .tape = tape, .settings = {"step_up=on"}}}, out, err),
              cli::exit_fine);
    EXPECT_EQ(out.str(), "Nothing stopped the player\n");

    out.str("");
    ASSERT_EQ(cli::run_compare({.tape = options, .presets = {"lecture", "precise-platformer"}, .json = true},
                               out, err),
              cli::exit_fine)
        << err.str();
    const auto rows = result();
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_EQ(rows[0]["stops"], 1);
    EXPECT_EQ(rows[1]["name"], "lecture");
    EXPECT_EQ(rows[2]["stops"], 0);
    EXPECT_GT(rows[2]["distance_m"].get<double>(), rows[0]["distance_m"].get<double>() + 2.0);
    EXPECT_EQ(cli::run_compare({.tape = options, .presets = {"nothing"}}, out, err), cli::exit_bad_input);
}

}  // namespace
}  // namespace slipface::test
