#include "cli/verbs.h"

#include <iostream>
#include <memory>

#include "cli/guarded.h"
#include "cli/options.h"
#include "slipface/base/system.h"
#include "slipface/base/text.h"
#include "slipface/mesh/formats.h"

namespace slipface::cli {

std::string level_help() {
    return "Level file, or geometry named " + mesh_formats_text();
}

namespace {

// The options' texts, until the command line is complete.
struct SweepWords {
    std::string level, radii, from, move, queries, test;
    bool json = false, csv = false;
};

std::string vector_check(const std::string& text) {
    return parse_vec3(text) ? std::string() : "found " + text + ", expected three finite numbers as x,y,z";
}

std::string radii_check(const std::string& text) {
    const std::optional<Vec3> radii = parse_vec3(text);
    return radii && radii->minCoeff() > 0.0 ? std::string()
                                            : "found " + text + ", expected three numbers above 0 as x,y,z";
}

void add_info(CLI::App& app, int& exit_code) {
    CLI::App* verb = app.add_subcommand("info", "Describe a level");
    auto options = std::make_shared<InfoOptions>();
    add_path(*verb, "LEVEL", options->level, level_help())->required();
    verb->add_flag("--json", options->json, "Print JSON");
    verb->callback([options, &exit_code] {
        exit_code = guarded([&] { return run_info(*options, std::cout, std::cerr); });
    });
}

SweepOptions sweep_options(const SweepWords& words) {
    SweepOptions options;
    options.level = path_of(words.level);
    options.radii = parse_vec3(words.radii).value_or(Vec3::Zero());
    if (!words.from.empty()) options.from = parse_vec3(words.from);
    if (!words.move.empty()) options.move = parse_vec3(words.move);
    if (!words.queries.empty()) options.queries = path_of(words.queries);
    options.format = words.json ? SweepFormat::json : words.csv ? SweepFormat::csv : SweepFormat::text;
    return options;
}

void add_sweep(CLI::App& app, int& exit_code) {
    CLI::App* verb =
        app.add_subcommand("sweep", "Sweep an ellipsoid through a level and report its first contact");
    auto words = std::make_shared<SweepWords>();
    verb->add_option("LEVEL", words->level, level_help())->required();
    CLI::Option* test = verb->add_option("--test", words->test, "Run a test copied from the editor's probe")
                            ->type_name("FILE");
    verb->add_option("--radii", words->radii, "Half-axes of the ellipsoid, metres")
        ->excludes(test)
        ->type_name("rx,ry,rz")
        ->check(radii_check);
    CLI::Option* from = verb->add_option("--from", words->from, "Centre at the start, metres")
                            ->type_name("x,y,z")
                            ->check(vector_check);
    CLI::Option* move = verb->add_option("--move", words->move, "Displacement, metres")
                            ->type_name("x,y,z")
                            ->check(vector_check);
    CLI::Option* queries =
        verb->add_option("--queries", words->queries, "Many sweeps: CSV with the header ox,oy,oz,dx,dy,dz")
            ->type_name("FILE.csv");
    from->needs(move);
    move->needs(from);
    queries->excludes(from)->excludes(move);
    CLI::Option* json = verb->add_flag("--json", words->json, "Print JSON");
    verb->add_flag("--csv", words->csv, "Print CSV")->excludes(json);
    verb->callback([words, &exit_code] {
        if (!words->test.empty()) {
            exit_code = guarded([&] {
                return run_sweep_test(path_of(words->level), path_of(words->test), std::cout, std::cerr);
            });
            return;
        }
        if (words->radii.empty()) throw CLI::RequiredError("--radii");
        exit_code = guarded([&] { return run_sweep(sweep_options(*words), std::cout, std::cerr); });
    });
}

void add_simulate(CLI::App& app, int& exit_code) {
    CLI::App* verb = app.add_subcommand("simulate", "Run a tape of inputs through a level");
    auto options = std::make_shared<SimulateOptions>();
    add_path(*verb, "LEVEL", options->level, level_help() + "; or a capsule")->required();
    add_path(*verb, "--tape", options->tape, "Inputs, tick by tick; a capsule has its own")
        ->type_name("FILE");
    verb->add_option("--spawn", options->spawn, "Start at this spawn of the level")->type_name("NAME");
    verb->add_option("--preset", options->preset,
                     "Settings instead of the level's and the tape's; a name or a file")
        ->type_name("PRESET");
    add_set_option(*verb, options->settings);
    CLI::Option* json = verb->add_flag("--json", options->json, "Print JSON");
    CLI::Option* csv = verb->add_flag("--csv", options->csv, "Print the run's numbers, one row per tick");
    csv->excludes(json);
    verb->add_option("--describe", options->describe, "Describe that tick and its decisions; the first is 0")
        ->type_name("TICK")
        ->check(CLI::NonNegativeNumber)
        ->excludes(json)
        ->excludes(csv);
    verb->callback([options, &exit_code] {
        if (options->tape.empty() && !brings_tape(options->level)) throw CLI::RequiredError("--tape");
        exit_code = guarded([&] { return run_simulate(*options, std::cout, std::cerr); });
    });
}

void add_doctor(CLI::App& app, int& exit_code) {
    CLI::App* verb = app.add_subcommand("doctor", "Find geometry that disturbs movement");
    auto options = std::make_shared<DoctorOptions>();
    add_path(*verb, "LEVEL", options->level, level_help())->required();
    verb->add_flag("--json", options->json, "Print JSON");
    verb->add_flag("--grade", options->grade,
                   "Also grade ledges and gaps by what the player can jump; these are no problems");
    verb->callback([options, &exit_code] {
        exit_code = guarded([&] { return run_doctor(*options, std::cout, std::cerr); });
    });
}

}  // namespace

void print_error(std::ostream& err, const Error& error) {
    err << "slipface: " << error.text() << '\n';
}

int bad_input(std::ostream& err, const Error& error) {
    print_error(err, error);
    return exit_bad_input;
}

void print_warnings(std::ostream& err, const Warnings& warnings) {
    for (const Diagnostic& warning : warnings)
        err << "slipface: warning: " << warning.text() << '\n';
}

void add_data_verbs(CLI::App& app, int& exit_code) {
    add_info(app, exit_code);
    add_sweep(app, exit_code);
    add_simulate(app, exit_code);
    add_why_verbs(app, exit_code);
    add_audit_verb(app, exit_code);
    add_reach_verb(app, exit_code);
    add_demo_verbs(app, exit_code);
    add_grade_verb(app, exit_code);
    add_doctor(app, exit_code);
    add_exchange_verbs(app, exit_code);
    add_bake_light_verb(app, exit_code);
    add_serve_verb(app, exit_code);
}

}  // namespace slipface::cli
