// The frame of a program with verbs.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace slipface::cli {

struct VerbProgram {
    std::string name, description, footer;
    // Adds verbs and options. A verb that ran sets the exit code.
    std::function<void(CLI::App&, int& exit_code)> add;
    std::function<int()> without_verb;  // what to do then; empty: a verb is required
};

// Parses the command line and runs its verb. Returns the exit code, also where something throws or the output
// could not be written.
int run_program(const VerbProgram& program, std::vector<std::string> arguments);

}  // namespace slipface::cli
