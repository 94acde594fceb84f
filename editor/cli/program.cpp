#include "cli/program.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <iostream>

#include "cli/exit_codes.h"
#include "slipface/base/version.h"

namespace slipface::cli {
namespace {

int run(const VerbProgram& program, std::vector<std::string> arguments) {
    CLI::App app(program.description, program.name);
    app.allow_windows_style_options(false);  // /x is a path on every system
    app.set_version_flag("--version", program.name + " " + program_version());
    app.footer(program.footer);
    int exit_code = exit_fine;
    program.add(app, exit_code);
    app.require_subcommand(program.without_verb ? 0 : 1, 1);
    try {
        // CLI11 takes them from the end, without the program's name.
        if (!arguments.empty()) arguments.erase(arguments.begin());
        std::reverse(arguments.begin(), arguments.end());
        app.parse(std::move(arguments));
    } catch (const CLI::ParseError& error) {
        const int code = app.exit(error);
        return code == 0 ? exit_fine : exit_bad_usage;
    }
    return app.get_subcommands().empty() ? program.without_verb() : exit_code;
}

}  // namespace

int run_program(const VerbProgram& program, std::vector<std::string> arguments) {
    try {
        const int code = run(program, std::move(arguments));
        // With a full disk or a closed pipe the program must not report success.
        std::cout.flush();
        if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0 || !std::cout) {
            std::fprintf(stderr, "%s: the output could not be written\n", program.name.c_str());
            return exit_bad_input;
        }
        return code;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s: %s\n", program.name.c_str(), error.what());
        return exit_bad_input;
    }
}

}  // namespace slipface::cli
