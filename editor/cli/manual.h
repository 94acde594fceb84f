// Manual pages, docs/command-line.md and shell completion, made from the same table of verbs that parses the
// command line.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace slipface::cli {

struct ManualPage {
    std::string file;  // "slipface.1", "slipface-info.1"
    std::string text;  // troff, for man(1)
};

// One page for the program and one for each verb in --help.
std::vector<ManualPage> manual_pages(const CLI::App& app, const std::string& version);

std::string command_line_markdown(const CLI::App& app);  // docs/command-line.md

// A script for bash that completes verbs, their options, and file names.
std::string bash_completion(const CLI::App& app);

}  // namespace slipface::cli
