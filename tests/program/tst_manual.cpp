// What `slipface docs` writes for an installation, held against what --help says.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <sstream>
#include <vector>

#include "program/run_program.h"
#include "slipface/base/files.h"
#include "slipface/base/text.h"

namespace slipface::test {
namespace {

std::vector<std::string> all_matches(const std::string& text, const std::regex& pattern) {
    std::vector<std::string> found;
    for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match)
        found.push_back((*match)[1]);
    return found;
}

std::vector<std::string> verbs_of_help(const std::string& command) {
    const std::string help = run_program(command + " --help").output;
    const auto list = to_lower(help).find("subcommands:\n");  // capitals in later versions of CLI11
    if (list == std::string::npos) return {};
    return all_matches(help.substr(list), std::regex("\n  ([a-z-]+) "));
}

std::vector<std::string> options_of_help(const std::string& command) {
    return all_matches(run_program(command + " --help").output, std::regex("[ ,](--[a-z-]+)"));
}

// A manual page as it reads: hyphens are escaped in it.
std::string page(const ScratchFolder& folder, const std::string& name) {
    std::ifstream file(folder / name);
    std::stringstream text;
    text << file.rdbuf();
    return std::regex_replace(text.str(), std::regex("\\\\-"), "-");
}

TEST(Manual, NamesEachVerbAndOptionOfTheHelp) {
    const ScratchFolder folder;
    ASSERT_EQ(run_program("docs --man " + (folder / "").string()).exit_code, 0);
    const std::vector<std::string> verbs = verbs_of_help("");
    EXPECT_GE(verbs.size(), 10u);
    for (const std::string& verb : verbs) {
        EXPECT_NE(page(folder, "slipface.1").find("slipface-" + verb + " (1)"), std::string::npos) << verb;
        const std::string text = page(folder, "slipface-" + verb + ".1");
        std::vector<std::string> commands{verb};
        for (const std::string& part : verbs_of_help(verb))
            commands.push_back(verb + " " + part);
        for (const std::string& command : commands)
            for (const std::string& option : options_of_help(command))
                EXPECT_NE(text.find(option), std::string::npos) << command << " " << option;
    }
}

TEST(Manual, CommandLinePageIsWhatTheProgramWrites) {
    const ScratchFolder folder;
    ASSERT_EQ(run_program("docs " + (folder / "").string()).exit_code, 0);
    const Result<std::string> written = read_file(folder / "command-line.md");
    const Result<std::string> page = read_file(SLIPFACE_SOURCE_DIR "/docs/command-line.md");
    ASSERT_TRUE(written.ok() && page.ok());
    EXPECT_EQ(*written, *page) << "run: slipface docs";
}

std::string completed(const std::string& script, const std::string& words, int current) {
    return run_program("-c '. " + script + "; COMP_WORDS=(" + words + "); COMP_CWORD=" +
                           std::to_string(current) + "; _slipface; echo \" ${COMPREPLY[*]} \"'",
                       60, "bash")
        .output;
}

TEST(Completion, KnowsVerbsTheirPartsAndTheirOptions) {
    const ScratchFolder folder;
    const std::string script = (folder / "completion").string();
    ASSERT_EQ(run_program("docs --completion " + script).exit_code, 0);
    for (const std::string& verb : verbs_of_help("")) {
        EXPECT_NE(completed(script, "slipface " + verb.substr(0, 2), 1).find(" " + verb + " "),
                  std::string::npos)
            << verb;
        for (const std::string& option : options_of_help(verb))
            EXPECT_NE(completed(script, "slipface " + verb + " --", 2).find(" " + option + " "),
                      std::string::npos)
                << verb << " " << option;
    }
    EXPECT_NE(completed(script, "slipface snapshot ch", 2).find(" check "), std::string::npos);
    EXPECT_EQ(completed(script, "slipface info --ta", 2).find("--tape"), std::string::npos);
    EXPECT_NE(completed(script, "slipface simulate x.obj --ta", 3).find(" --tape "), std::string::npos);
}

}  // namespace
}  // namespace slipface::test
