// slipface-mpi: `audit` and `reach` on the ranks of an MPI job. Options, output and bytes are those of
// `slipface`.
#include <fmt/format.h>
#include <mpi.h>
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>

#include "cli/verbs.h"
#include "mpi/mpi_team.h"
#include "slipface/mesh/scene_child.h"

namespace slipface {
namespace {

// The argument by which the program runs itself to read a file of another program (scene_child.h).
constexpr const char* read_scene_word = "read-scene";

void print_traffic(const MpiTeam& team) {
    rusage used{};
    ::getrusage(RUSAGE_SELF, &used);
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    const MpiTeam::Traffic& traffic = team.traffic();
    const double calls = static_cast<double>(std::max<std::uint64_t>(1, traffic.calls));
    const double all_s = seconds(used.ru_utime) + seconds(used.ru_stime);
    fmt::print(stderr,
               "{}: {:.2f} s of processors beside exchanges, {:.1f} MB of memory at most; {} exchanges, "
               "{:.1f} kB sent "
               "and {:.1f} kB received in each, {:.2f} s in them\n",
               team.name_of(team.rank()), all_s - traffic.processor_s,
               static_cast<double>(used.ru_maxrss) / 1024.0, traffic.calls,
               1e-3 * static_cast<double>(traffic.sent) / calls,
               1e-3 * static_cast<double>(traffic.received) / calls, traffic.seconds);
}

int run(int argument_count, char** arguments) {
    read_scenes_in_child({"/proc/self/exe", read_scene_word});
    MpiTeam team;
    CLI::App app("Slipface's audits and searches on the ranks of an MPI job", "slipface-mpi");
    app.set_version_flag("--version", std::string("slipface-mpi ") + SLIPFACE_VERSION);
    app.footer(
        "Run it with mpirun or srun. The bytes are those of `slipface`, for any number of ranks and "
        "threads.");
    bool timing = false;
    app.add_flag("--timing", timing, "Each rank reports its time, memory and messages");
    int exit_code = cli::exit_fine;
    cli::add_audit_verb(app, exit_code, &team);
    cli::add_reach_verb(app, exit_code, &team);
    app.require_subcommand(1);
    try {
        app.parse(argument_count, arguments);
    } catch (const CLI::ParseError& error) {
        // Ranks may have arguments of their own. Those whose arguments are fine are in the verb's first
        // agree() now.
        std::ostream nowhere(nullptr);
        const int code = team.rank() == 0 ? app.exit(error) : app.exit(error, nowhere, nowhere);
        (void)agree(team, code == 0 ? Status() : Error{"", error.what()});
        return code == 0 || team.rank() != 0 ? cli::exit_fine : cli::exit_bad_usage;
    }
    if (timing) print_traffic(team);
    return exit_code;
}

}  // namespace
}  // namespace slipface

int main(int argument_count, char** arguments) {
    using namespace slipface;
    if (argument_count > 1 && std::string(arguments[1]) == read_scene_word)
        return read_scene_as_child({arguments + 2, arguments + argument_count});
    std::signal(SIGCHLD, SIG_DFL);  // as in the program itself
    // Threads compute; only the main one calls MPI.
    int provided = 0;
    MPI_Init_thread(&argument_count, &arguments, MPI_THREAD_FUNNELED, &provided);
    int code = cli::exit_bad_input;
    try {
        code = run(argument_count, arguments);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "slipface-mpi: %s\n", error.what());
        MPI_Abort(MPI_COMM_WORLD, cli::exit_bad_input);
    }
    std::cout.flush();
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0 || !std::cout) {
        std::fprintf(stderr, "slipface-mpi: the output could not be written\n");
        code = cli::exit_bad_input;
    }
    MPI_Finalize();
    return code;
}
