// The verbs behind a command line.
#include <gmock/gmock.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/verbs.h"
#include "scratch.h"

namespace slipface::test {
namespace {

class CommandLine : public Scratch {
  protected:
    // The exit code; what was printed is in `out` and `err`.
    int run(const std::vector<std::filesystem::path>& typed) {
        std::vector<std::string> words;
        for (const std::filesystem::path& word : typed)
            words.push_back(word.string());
        CLI::App app;
        int exit_code = cli::exit_fine;
        cli::add_data_verbs(app, exit_code);
        testing::internal::CaptureStdout();
        testing::internal::CaptureStderr();
        std::reverse(words.begin(), words.end());
        try {
            app.parse(words);
        } catch (const CLI::ParseError& error) {
            exit_code = error.get_exit_code() == 0 ? cli::exit_fine : cli::exit_bad_usage;
        }
        out = testing::internal::GetCapturedStdout();
        err = testing::internal::GetCapturedStderr();
        return exit_code;
    }
    std::string out, err;
};

TEST_F(CommandLine, RunsEachVerb) {
    const std::string tape = write("run.tape", "slipface-tape 1\n5\n").string();
    const std::string csv = write("q.csv", "ox,oy,oz,dx,dy,dz\n5,2.9,2,0,-4,0\n").string();
    EXPECT_EQ(run({"info", level}), cli::exit_fine);
    EXPECT_EQ(run({"info", level, "--json"}), cli::exit_fine);
    EXPECT_EQ(nlohmann::json::parse(out)["faces"], 2);
    EXPECT_EQ(
        run({"sweep", level, "--radii", "0.4,0.9,0.4", "--from", "-.5,2.9,2", "--move", "-1,-4,0", "--json"}),
        0);
    EXPECT_EQ(nlohmann::json::parse(out)["face"], 0);
    EXPECT_EQ(run({"sweep", level, "--radii", "1,1,1", "--queries", csv, "--csv"}), cli::exit_fine);
    EXPECT_EQ(out.substr(0, 6), "hit,t,");
    EXPECT_EQ(
        run({"simulate", level, "--tape", tape, "--set", "gravity=10", "--set", "skin=0.003", "--json"}), 0)
        << err;
    EXPECT_EQ(nlohmann::json::parse(out)["ticks"], 5);
    EXPECT_EQ(run({"simulate", "--set", "gravity=10", level, "--tape", tape}), cli::exit_fine) << err;
}

TEST_F(CommandLine, BadUsageIs64) {
    EXPECT_EQ(run({"info"}), cli::exit_bad_usage);
    EXPECT_EQ(run({"info", level, "--nonsense"}), cli::exit_bad_usage);
    EXPECT_EQ(run({"sweep", level}), cli::exit_bad_usage);
    EXPECT_EQ(run({"sweep", level, "--radii", "1,1,1"}), cli::exit_bad_usage);
    EXPECT_EQ(run({"sweep", level, "--radii", "1,1", "--from", "0,0,0", "--move", "0,1,0"}),
              cli::exit_bad_usage);
    EXPECT_EQ(run({"sweep", level, "--radii", "1,-1,1", "--from", "0,0,0", "--move", "0,1,0"}),
              cli::exit_bad_usage);
    EXPECT_EQ(run({"sweep", level, "--radii", "1,1,1", "--from", "0,0,0"}), cli::exit_bad_usage);
    EXPECT_EQ(run({"sweep", level, "--radii", "1,1,1", "--from", "0,0,0", "--move", "0,nan,0"}),
              cli::exit_bad_usage);
    EXPECT_EQ(
        run({"sweep", level, "--radii", "1,1,1", "--from", "0,0,0", "--move", "0,1,0", "--queries", "q"}),
        64);
    EXPECT_EQ(run({"sweep", level, "--radii", "1,1,1", "--queries", "q", "--csv", "--json"}),
              cli::exit_bad_usage);
    EXPECT_EQ(run({"simulate", level}), cli::exit_bad_usage);
}

TEST_F(CommandLine, BadInputIs2) {
    EXPECT_EQ(run({"info", (folder / "missing.obj").string()}), cli::exit_bad_input);
    EXPECT_THAT(err, testing::StartsWith("slipface: "));
    EXPECT_EQ(run({"simulate", level, "--tape", (folder / "missing.tape").string()}), cli::exit_bad_input);
}

TEST_F(CommandLine, HelpIsFine) {
    EXPECT_EQ(run({"info", "--help"}), cli::exit_fine);
    EXPECT_EQ(run({"sweep", "--help"}), cli::exit_fine);
}

}  // namespace
}  // namespace slipface::test
