#include "slipface/sim/simulate.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/format.h"
#include "cli/tape_on_level.h"
#include "cli/verbs.h"
#include "slipface/sim/channels.h"
#include "slipface/sim/run_events.h"
#include "slipface/sim/story.h"

namespace slipface::cli {
namespace {

struct Run {
    TapeOnLevel base;
    SimulationReport report = {};
    Vec3 end = Vec3::Zero();  // where the player ended, in the level's coordinates
    std::string text = {};    // replaces the report if not empty
    bool as_recorded = true;  // nothing was changed on the command line
};

Result<Run> run_tape(const SimulateOptions& options) {
    Result<TapeOnLevel> loaded = load_tape_on_level({.level = options.level,
                                                     .tape = options.tape,
                                                     .settings = options.settings,
                                                     .preset = options.preset,
                                                     .spawn = options.spawn});
    if (!loaded) return loaded.error();
    Run run{.base = std::move(*loaded)};
    TapeOnLevel& base = run.base;
    const Level& level = base.loaded->level;
    const TickScene scene(base.scene);
    run.as_recorded = options.settings.empty() && !options.preset && options.spawn.empty();
    run.report = simulate(scene, base.settings, base.start, base.tape);
    run.end = scene.to_level(run.report.final_state);
    if (options.csv || options.describe) {
        TapeRun samples(std::make_shared<const Tape>(base.tape), base.settings, base.start);
        if (base.tape.tick_count() > TapeRun::max_ticks) {
            return Error{base.source,
                         fmt::format("found {} ticks, expected at most {} for --csv and --describe",
                                     base.tape.tick_count(), TapeRun::max_ticks)};
        }
        samples.advance(scene, TapeRun::max_ticks);
        if (options.csv) run.text = run_csv(samples, level.surfaces);
        if (options.describe) {
            const std::size_t ticks = samples.samples().size();
            if (*options.describe >= ticks)
                return Error{"--describe", fmt::format("found tick {}, expected one from 0 to {}",
                                                       *options.describe, ticks == 0 ? 0 : ticks - 1)};
            const TickTrace trace = samples.trace(scene, *options.describe);
            run.text = story_text(describe(trace, level)) + velocity_text(trace, level);
        }
    }
    return run;
}

std::string ground_name(const Run& run) {
    const PlayerState& state = run.report.final_state;
    const bool held = is_held(state);
    return held ? run.base.loaded->level.surfaces[state.ground_surface].name : std::string();
}

void print_report_json(const Run& run, std::ostream& out) {
    const SimulationReport& report = run.report;
    const PlayerState& state = report.final_state;
    OutputJson json;
    json["ticks"] = report.ticks;
    json["duration_s"] = static_cast<double>(report.ticks) * run.base.tape.dt;
    json["distance"] = report.distance;
    json["falls"] = report.falls;
    json["hazards"] = report.hazards;
    json["crushed"] = report.crushed;
    json["end_hash"] = hash_text(report.end_hash);
    json["final_state"] = {{"position", vector_json(run.end)},
                           {"velocity", vector_json(state.velocity)},
                           {"grounded", state.grounded},
                           {"climbing", state.climbing},
                           {"stuck", state.stuck},
                           {"hanging", state.hanging},
                           {"crouched", state.crouched},
                           {"wants_to_stand", state.wants_to_stand},
                           {"surface", ground_name(run)}};
    const bool held = is_held(state);
    json["final_state"]["ground_face"] =
        held && state.ground_face != no_id ? OutputJson(state.ground_face) : OutputJson(nullptr);
    json["hashes"] = OutputJson::array();
    for (const std::uint64_t hash : report.second_hashes)
        json["hashes"].push_back(hash_text(hash));
    json["events"] = OutputJson::array();
    for (const SimulationEvent& event : report.events) {
        json["events"].push_back({{"tick", event.tick}, {"kind", event.kind}, {"detail", event.detail}});
    }
    print_json(out, json);
}

void print_report_text(const Run& run, std::ostream& out) {
    const SimulationReport& report = run.report;
    const PlayerState& state = report.final_state;
    std::string how = state.grounded   ? "grounded"
                      : state.climbing ? "climbing"
                      : state.stuck    ? "stuck"
                      : state.hanging  ? "hanging"
                                       : "in the air";
    if (const std::string ground = ground_name(run); !ground.empty()) how += " on " + ground;
    print_row(out, "ticks", fmt::format("{} of {} s", report.ticks, run.base.tape.dt_text));
    print_row(out, "distance", fmt::format("{:.3f} m", report.distance));
    print_row(out, "position", vector_text(run.end) + "  m");
    print_row(out, "velocity", vector_text(state.velocity) + "  m/s");
    print_row(out, "state", how);
    if (report.falls > 0) print_row(out, "falls", fmt::format("{}, back to the start", report.falls));
    out << "\nhashes\n";
    for (std::size_t i = 0; i < report.second_hashes.size(); ++i) {
        const double whole = static_cast<double>(i + 1);
        const double time = std::min(whole, static_cast<double>(report.ticks) * run.base.tape.dt);
        out << fmt::format("{:>10.3f} s  {}\n", time, hash_text(report.second_hashes[i]));
    }
    out << "\nevents\n";
    for (const SimulationEvent& event : report.events) {
        const double time = static_cast<double>(event.tick + 1) * run.base.tape.dt;
        out << fmt::format("{:>10.3f} s  {:<13} {}\n", time, event.kind, event.detail);
    }
    if (report.events.empty()) out << "            none\n";
}

}  // namespace

int run_simulate(const SimulateOptions& options, std::ostream& out, std::ostream& err) {
    const Result<Run> run = run_tape(options);
    if (!run) return bad_input(err, run.error());
    print_warnings(err, run->base.warnings);
    if (options.csv || options.describe)
        out << run->text;
    else
        options.json ? print_report_json(*run, out) : print_report_text(*run, out);
    if (run->base.tape.end_hash && run->as_recorded && *run->base.tape.end_hash != run->report.end_hash) {
        print_error(err,
                    {run->base.source,
                     fmt::format("the run ends with hash {}, expected {}: it does not repeat the recording",
                                 hash_text(run->report.end_hash), hash_text(*run->base.tape.end_hash))});
        return exit_check_failed;
    }
    return exit_fine;
}

}  // namespace slipface::cli
