// Grading: each demo's own tape passes its exercise and the tape with the problem does not; what is not a
// student's to choose is refused.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <sstream>

#include "cli/verbs.h"
#include "scratch.h"
#include "slipface/scenes/demo.h"
#include "slipface/sim/run.h"

namespace slipface::test {
namespace {

using testing::HasSubstr;

class Grade : public Scratch {
  protected:
    int run(const std::vector<std::string>& files, std::vector<std::string> allow = {},
            std::vector<std::string> settings = {}) {
        cli::GradeOptions options{.level = level, .files = {}};
        for (const std::string& file : files)
            options.files.push_back(folder / file);
        options.allow = std::move(allow);
        options.settings = std::move(settings);
        out.str("");
        err.str("");
        return cli::run_grade(options, out, err);
    }
    void goals(const std::string& list) {
        write("floor.slipface.json",
              R"({"slipface": 1, "mesh": "floor.obj", "spawn": {"position": [-5, 0.902, 0]}, "goals": [)" +
                  list + "]}");
    }
    std::ostringstream out, err;
};

TEST_F(Grade, PassesTheCureOfEveryDemoAndNotItsProblem) {
    for (const DemoInfo& info : demo_table()) {
        SCOPED_TRACE(info.name);
        ASSERT_TRUE(save_demo(info, folder).ok());
        const std::string name = info.name;
        level = folder / (name + ".obj");
        // The names that the exercise on the card allows.
        const std::string exercise = exercise_of(info), option = "--allow ";
        std::vector<std::string> allow{changed_by(info)};
        if (plays_lecture(info)) allow.emplace_back("mover");
        EXPECT_THAT(exercise.substr(exercise.find(option)), HasSubstr(allow.front()));
        EXPECT_EQ(run({name + ".tape"}, allow), cli::exit_fine) << out.str() << err.str();
        EXPECT_EQ(run({name + "-off.tape"}, allow), cli::exit_check_failed) << out.str() << err.str();
        // Without leave the problem's tape is not even looked at.
        EXPECT_EQ(run({name + "-off.tape"}), cli::exit_check_failed);
        EXPECT_THAT(out.str(), testing::ContainsRegex("has |is moved by "));
    }
}

TEST_F(Grade, GoesByGoalsOfBothKindsAndByTime) {
    goals(R"({"name": "east", "position": [0, 0.902, 0], "radius": 0.5, "within_s": 2})");
    write("east.tape", "slipface-tape 1\n60 wish 1,0\n");
    write("late.tape", "slipface-tape 1\n90\n60 wish 1,0\n");
    write("west.tape", "slipface-tape 1\n40 wish -1,0\n");
    EXPECT_EQ(run({"east.tape"}), cli::exit_fine) << out.str();
    EXPECT_EQ(run({"late.tape"}), cli::exit_check_failed);
    EXPECT_THAT(out.str(), HasSubstr("too late"));
    EXPECT_EQ(run({"east.tape", "west.tape"}), cli::exit_check_failed) << "one that fails fails all";
    EXPECT_THAT(out.str(), testing::ContainsRegex("passes.*east.tape.*\n.*fails.*west.tape.*missed by"));
    goals(R"({"name": "pit", "kind": "never", "position": [0, 0.902, 0], "radius": 0.5})");
    EXPECT_EQ(run({"east.tape"}), cli::exit_check_failed);
    EXPECT_THAT(out.str(), HasSubstr("never be"));
    EXPECT_EQ(run({"west.tape"}), cli::exit_fine) << out.str();
}

TEST_F(Grade, RefusesWhatTheGraderDecides) {
    goals(R"({"name": "east", "position": [0, 0.902, 0], "radius": 0.5})");
    write("fast.tape", "slipface-tape 1\nset walk_speed=9\n60 wish 1,0\n");
    write("later.tape", "slipface-tape 1\n10\nset walk_speed=9\n60 wish 1,0\n");
    write("there.tape", "slipface-tape 1\nstart 0,0.902,0\n10\n");
    write("other.tape", "slipface-tape 1\nlevel floor.obj 0123456789abcdef\n60 wish 1,0\n");
    write("hash.tape", "slipface-tape 1\n60 wish 1,0\nend 0123456789abcdef\n");
    for (const auto& [file, why] :
         {std::pair{"fast.tape", "has walk_speed=9, expected 6"}, std::pair{"later.tape", "has walk_speed=9"},
          std::pair{"there.tape", "at no spawn"}, std::pair{"other.tape", "other geometry"},
          std::pair{"hash.tape", "does not repeat"}}) {
        EXPECT_EQ(run({file}), cli::exit_check_failed) << file;
        EXPECT_THAT(out.str(), HasSubstr(why));
    }
    EXPECT_EQ(run({"fast.tape"}, {"walk_speed"}), cli::exit_fine) << out.str();
    EXPECT_EQ(run({"fast.tape"}, {}, {"walk_speed=9"}), cli::exit_fine) << "graded under these settings";
    EXPECT_EQ(run({"fast.tape"}, {"speed"}), cli::exit_bad_input);
    EXPECT_EQ(run({"none.tape"}), cli::exit_bad_input);
    goals("");
    EXPECT_EQ(run({"fast.tape"}), cli::exit_bad_input) << "nothing to grade by";
}

// A student's own mover hands in positions.
TEST_F(Grade, TakesRunsOfOtherControllers) {
    goals(R"({"name": "east", "position": [0, 0.902, 0], "radius": 0.5})");
    std::string east = "# position centre\nt,x,y,z\n", west = east;
    for (int i = 1; i <= 60; ++i) {
        east += fmt::format("{},{},0.902,0\n", i / 60.0, -5.0 + 0.1 * i);
        west += fmt::format("{},{},0.902,0\n", i / 60.0, -5.0 - 0.1 * i);
    }
    write("east.csv", east);
    write("west.csv", west);
    EXPECT_EQ(run({"east.csv"}), cli::exit_fine) << out.str() << err.str();
    EXPECT_EQ(run({"west.csv"}), cli::exit_check_failed) << out.str();
}

}  // namespace
}  // namespace slipface::test
