// The verbs that answer with data: info, sweep, simulate. Results go to `out`; errors and warnings go to
// `err`, one a line, as "slipface: PLACE: message". Each returns an exit code.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "cli/exit_codes.h"
#include "slipface/base/result.h"
#include "slipface/base/types.h"

namespace slipface::cli {

struct InfoOptions {
    std::filesystem::path level;
    bool json = false;
};

// How many faces, triangles and faces a type, bounds, warnings, the durations of loading and of building the
// BVH, its bytes.
int run_info(const InfoOptions& options, std::ostream& out, std::ostream& err);

enum class SweepFormat { text, json, csv };

// Either `from` and `move`, or `queries`: a CSV file with the header ox,oy,oz,dx,dy,dz.
struct SweepOptions {
    std::filesystem::path level;
    Vec3 radii = Vec3::Zero();
    std::optional<Vec3> from;
    std::optional<Vec3> move;
    std::optional<std::filesystem::path> queries;
    SweepFormat format = SweepFormat::text;
};

// The first contact of each query. One row of output a row of `queries`; if any row is bad, none and the
// row's line as error.
int run_sweep(const SweepOptions& options, std::ostream& out, std::ostream& err);

struct SimulateOptions {
    std::filesystem::path level;
    std::filesystem::path tape;
    std::vector<std::string> settings;  // "name=value"; after the level's and the tape's, so they win
    bool json = false;
};

// Runs the tape: final state, a hash a second, distance, events.
int run_simulate(const SimulateOptions& options, std::ostream& out, std::ostream& err);

// Adds the three subcommands to `app`. The one that is parsed runs on standard output and error and sets
// `exit_code`.
void add_data_verbs(CLI::App& app, int& exit_code);

void print_error(std::ostream& err, const Error& error);
void print_warnings(std::ostream& err, const Warnings& warnings);

}  // namespace slipface::cli
