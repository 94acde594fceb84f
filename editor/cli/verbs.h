// The verbs that print data (info, sweep, simulate, doctor) and those that exchange files with other programs
// (import, name-materials, export). Results go to `out`; errors and warnings go to `err`, one per line, as
// "slipface: LOCATION: message". Each returns an exit code.
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
#include "slipface/exchange/export.h"
#include "slipface/mesh/import.h"

// CLI/CLI.hpp takes seconds to compile, so only files that define options include it.
namespace CLI {
class App;
}

namespace slipface {
class Team;  // slipface/base/team.h
}

namespace slipface::cli {

// The formats of LEVEL on the command line, for --help.
std::string level_help();

struct InfoOptions {
    std::filesystem::path level;
    bool json = false;
};

// Prints counts of faces, triangles and faces per type, bounds, warnings, times of loading and of building
// the BVH, and its size in bytes.
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

// Runs a probe's test (slipface/sim/probe_test.h). exit_fine if it holds; otherwise prints one line per
// difference and returns exit_check_failed.
int run_sweep_test(const std::filesystem::path& level, const std::filesystem::path& test, std::ostream& out,
                   std::ostream& err);

// The first contact of each query, one row of output per row of `queries`. If any row is bad, prints no rows,
// only an error with the row's line.
int run_sweep(const SweepOptions& options, std::ostream& out, std::ostream& err);

struct SimulateOptions {
    std::filesystem::path level;
    std::filesystem::path tape;
    std::vector<std::string> settings = {};  // "name=value"; override the level's and the tape's
    bool json = false;
    std::string spawn = {};                  // instead of the main one and of the tape's start
    std::optional<std::string> preset = {};  // name or file; replaces the level's and the tape's settings
    bool csv = false;  // print the run's numbers, one row per tick, instead of the report
    std::optional<std::size_t> describe = {};  // print the events of that tick, from 0, instead of the report
};

// Runs the tape and prints final state, one hash per second, distance and events. Fails if the tape contains
// its final hash (`end HASH`), no setting is changed here, and the hash differs.
int run_simulate(const SimulateOptions& options, std::ostream& out, std::ostream& err);

struct WhyOptions {
    TapeOptions tape;                               // without a tape if there is a run
    std::optional<std::filesystem::path> run = {};  // of another controller (docs/recorded-runs.md)
    bool events = false;
    bool json = false;
};

// What stopped the tape's player, and what would have prevented it (slipface/sim/cures.h).
int run_why(const WhyOptions& options, std::ostream& out, std::ostream& err);
// The same of a run that another controller made, from its positions: options.run is there.
int run_why_recorded(const WhyOptions& options, std::ostream& out, std::ostream& err);

struct CompareOptions {
    TapeOptions tape;
    std::vector<std::string> presets = {};  // names or files; none: all shipped ones
    bool json = false;
};

// The tape under several presets, one row each: distance, stops, time in the air, falls.
int run_compare(const CompareOptions& options, std::ostream& out, std::ostream& err);

// slipface why LEVEL, slipface compare LEVEL.
void add_why_verbs(CLI::App& app, int& exit_code);

struct GradeOptions {
    std::filesystem::path level;               // its goals, settings and spawns decide
    std::vector<std::filesystem::path> files;  // tapes, and runs of other controllers
    std::vector<std::string> settings = {};    // "name=value"; graded under these in place of the level's
    std::vector<std::string> allow = {};       // settings that a tape may change, and "mover"
};

// One row per file. exit_fine if each is at every goal to reach and at none never to be at, and was made
// under the graded settings from a spawn of the level.
int run_grade(const GradeOptions& options, std::ostream& out, std::ostream& err);

// slipface grade LEVEL RUN...
void add_grade_verb(CLI::App& app, int& exit_code);

// slipface serve: steps players for another program (docs/course.md).
void add_serve_verb(CLI::App& app, int& exit_code);

// slipface demo [NAME], slipface preset [NAME].
void add_demo_verbs(CLI::App& app, int& exit_code);

// slipface audit LEVEL, slipface audit merge REPORTS. With a team only the former, divided among its
// processes.
void add_audit_verb(CLI::App& app, int& exit_code, Team* team = nullptr);

// slipface reach LEVEL, slipface reach diff A B. With a team only the former, divided among its processes.
void add_reach_verb(CLI::App& app, int& exit_code, Team* team = nullptr);

struct DoctorOptions {
    std::filesystem::path level;
    bool json = false;
    bool grade = false;  // ledges and gaps, too; they are notes, not problems
};

// What in the geometry makes movement fail. Returns exit_check_failed if there is anything.
int run_doctor(const DoctorOptions& options, std::ostream& out, std::ostream& err);

// Moves painted types into the material names of the level's OBJ file and saves the level file.
int run_name_materials(const std::filesystem::path& level, std::ostream& out, std::ostream& err);

struct ExportOptions {
    std::filesystem::path level;
    ExportTargets targets;  // at least one
};
int run_export(const ExportOptions& options, std::ostream& out, std::ostream& err);

// Reads rules from other programs' files and sets the import's scale and axis; saves the level file.
struct ImportVerbOptions {
    std::filesystem::path level;
    std::vector<std::filesystem::path> rules;
    std::optional<double> scale;
    std::optional<UpAxis> up;
    std::optional<bool> flip;
};
int run_import(const ImportVerbOptions& options, std::ostream& out, std::ostream& err);

// slipface import, name-materials and export.
void add_exchange_verbs(CLI::App& app, int& exit_code);

// slipface bake-light LEVEL: bakes the level's light into an image next to its level file.
void add_bake_light_verb(CLI::App& app, int& exit_code);

// Adds the subcommands to `app`. The parsed one writes to standard output and error and sets `exit_code`.
void add_data_verbs(CLI::App& app, int& exit_code);

void print_error(std::ostream& err, const Error& error);
int bad_input(std::ostream& err, const Error& error);  // prints it; returns exit_bad_input
void print_warnings(std::ostream& err, const Warnings& warnings);

}  // namespace slipface::cli
