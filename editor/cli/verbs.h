// The verbs that answer with data (info, sweep, simulate, doctor) and those that exchange files with other
// programs (import, bake, export). Results go to `out`; errors and warnings go to `err`, one a line, as
// "slipface: PLACE: message". Each returns an exit code.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "cli/exit_codes.h"
#include "cli/tape_on_level.h"
#include "slipface/base/result.h"
#include "slipface/base/types.h"
#include "slipface/mesh/import.h"

// CLI/CLI.hpp takes a compiler seconds wherever it is included, so only who defines options does.
namespace CLI {
class App;
}

namespace slipface::cli {

// What a LEVEL on the command line may be: every format that can be read, for --help.
std::string level_help();

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

// Runs a probe's test (slipface/sim/probe_test.h): exit_fine if it holds, else a line a difference and
// exit_check_failed.
int run_sweep_test(const std::filesystem::path& level, const std::filesystem::path& test, std::ostream& out,
                   std::ostream& err);

// The first contact of each query. One row of output a row of `queries`; if any row is bad, none and the
// row's line as error.
int run_sweep(const SweepOptions& options, std::ostream& out, std::ostream& err);

struct SimulateOptions {
    std::filesystem::path level;
    std::filesystem::path tape;
    std::vector<std::string> settings = {};  // "name=value"; after the level's and the tape's, so they win
    bool json = false;
    std::string spawn = {};                    // instead of the main one, and of the tape's start
    std::optional<std::string> preset = {};    // name or file; instead of the level's and the tape's settings
    bool csv = false;                          // the run's numbers, a row a tick, instead of the report
    std::optional<std::size_t> describe = {};  // instead of the report what happened in that tick, from 0
};

// Runs the tape: final state, a hash a second, distance, events. Fails if the tape names the hash that its
// end has (`end HASH`), no setting is changed here, and another comes out.
int run_simulate(const SimulateOptions& options, std::ostream& out, std::ostream& err);

struct WhyOptions {
    TapeOptions tape;
    bool json = false;
};

// What stopped the tape's player, and what would have let it pass (slipface/sim/cures.h).
int run_why(const WhyOptions& options, std::ostream& out, std::ostream& err);

struct CompareOptions {
    TapeOptions tape;
    std::vector<std::string> presets = {};  // names or files; none: all that ship with Slipface
    bool json = false;
};

// The tape under several presets, a row each: distance, stops, time in the air, falls.
int run_compare(const CompareOptions& options, std::ostream& out, std::ostream& err);

// slipface why LEVEL, slipface compare LEVEL.
void add_why_verbs(CLI::App& app, int& exit_code);

// slipface demo [NAME], slipface preset [NAME].
void add_demo_verbs(CLI::App& app, int& exit_code);

// slipface audit LEVEL, slipface audit merge REPORTS.
void add_audit_verb(CLI::App& app, int& exit_code);

struct DoctorOptions {
    std::filesystem::path level;
    bool json = false;
};

// What in the geometry makes movement go wrong. exit_check_failed if anything does.
int run_doctor(const DoctorOptions& options, std::ostream& out, std::ostream& err);

// Moves painted types into the material names of the level's OBJ file and saves the level file.
int run_bake(const std::filesystem::path& level, std::ostream& out, std::ostream& err);

struct ExportOptions {
    std::filesystem::path level;
    std::optional<std::filesystem::path> obj, gltf, flat;  // at least one
};
int run_export(const ExportOptions& options, std::ostream& out, std::ostream& err);

// Takes rules from other programs' files, and how to take the geometry's coordinates; saves the level file.
struct ImportVerbOptions {
    std::filesystem::path level;
    std::vector<std::filesystem::path> rules;
    std::optional<double> scale;
    std::optional<UpAxis> up;
};
int run_import(const ImportVerbOptions& options, std::ostream& out, std::ostream& err);

// slipface import, bake and export.
void add_exchange_verbs(CLI::App& app, int& exit_code);

// slipface bake-light LEVEL: bakes the level's light into a picture beside its level file.
void add_bake_light_verb(CLI::App& app, int& exit_code);

// Adds the subcommands to `app`. The one that is parsed runs on standard output and error and sets
// `exit_code`.
void add_data_verbs(CLI::App& app, int& exit_code);

void print_error(std::ostream& err, const Error& error);
void print_warnings(std::ostream& err, const Warnings& warnings);

}  // namespace slipface::cli
