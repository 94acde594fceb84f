#include "slipface/sim/simulate.h"

#include <fmt/format.h>

#include "cli/format.h"
#include "cli/verbs.h"
#include "slipface/base/text.h"
#include "slipface/level/level_file.h"
#include "slipface/level/preset.h"
#include "slipface/sim/channels.h"
#include "slipface/sim/story.h"

namespace slipface::cli {
namespace {

struct Run {
    LoadedLevel loaded;
    Tape tape;
    SimulationReport report;
    std::string text;  // instead of the report, if it was asked for
    Warnings warnings;
    bool as_recorded = true;  // nothing was changed on the command line
};

Result<Run> run_tape(const SimulateOptions& options) {
    Run run;
    Result<Tape> tape = load_tape(options.tape);
    if (!tape) return tape.error();
    run.tape = std::move(*tape);
    Result<LoadedLevel> loaded = load_level(options.level);
    if (!loaded) return loaded.error();
    run.loaded = std::move(*loaded);
    run.warnings = run.loaded.warnings;

    const Level& level = run.loaded.level;
    const auto& recorded = run.tape.level_fingerprint;
    if (recorded && *recorded != level.mesh->fingerprint) {
        run.warnings.push_back(
            {options.tape.string(), fmt::format("was recorded on geometry {}, found {}; the run may differ",
                                                hash_text(*recorded), hash_text(level.mesh->fingerprint))});
    }
    MovementSettings settings = level.movement;
    if (Status status = apply_tape_settings(settings, run.tape, options.tape.string()); !status.ok()) {
        return status.error();
    }
    if (options.preset) {
        const Result<Preset> preset = find_preset(*options.preset);
        if (!preset) return Error{"--preset", preset.error().text()};
        settings = preset->settings;
    }
    for (const std::string& assignment : options.settings) {
        if (Status status = set_setting(settings, assignment); !status.ok()) {
            return Error{"--set " + assignment, status.error().message};
        }
    }
    Result<LevelScene> built = LevelScene::build(level, settings);
    if (!built) return built.error();
    const TickScene scene(*built);
    const auto& surfaces = run.tape.surfaces_fingerprint;
    if (surfaces && *surfaces != scene_fingerprint(built->at(0.0))) {
        run.warnings.push_back(
            {options.tape.string(),
             "was recorded with other surface types, or with other faces painted; the run may differ"});
    }
    run.as_recorded = options.settings.empty() && !options.preset;
    const Vec3 start = run.tape.start.value_or(level.spawn);
    run.report = simulate(scene, settings, start, run.tape);
    if (options.csv || options.tell) {
        TapeRun samples(std::make_shared<const Tape>(run.tape), settings, start);
        if (run.tape.tick_count() > TapeRun::max_ticks) {
            return Error{options.tape.string(),
                         fmt::format("found {} ticks, expected at most {} for --csv and --tell",
                                     run.tape.tick_count(), TapeRun::max_ticks)};
        }
        samples.advance(scene, TapeRun::max_ticks);
        if (options.csv) run.text = run_csv(samples, level.surfaces);
        if (options.tell) {
            const std::size_t ticks = samples.samples().size();
            if (*options.tell >= ticks)
                return Error{"--tell", fmt::format("found tick {}, expected one from 0 to {}", *options.tell,
                                                   ticks == 0 ? 0 : ticks - 1)};
            run.text = story_text(tell(samples.trace(scene, *options.tell), level.surfaces));
        }
    }
    return run;
}

std::string ground_name(const Run& run) {
    const PlayerState& state = run.report.final_state;
    const bool held = state.grounded || state.climbing || state.stuck;
    return held ? run.loaded.level.surfaces[state.ground_surface].name : std::string();
}

void print_report_json(const Run& run, std::ostream& out) {
    const SimulationReport& report = run.report;
    const PlayerState& state = report.final_state;
    OutputJson json;
    json["ticks"] = report.ticks;
    json["duration_s"] = static_cast<double>(report.ticks) * run.tape.dt;
    json["distance"] = report.distance;
    json["end_hash"] = hash_text(report.end_hash);
    json["final_state"] = {{"position", vector_json(state.position)},
                           {"velocity", vector_json(state.velocity)},
                           {"grounded", state.grounded},
                           {"climbing", state.climbing},
                           {"stuck", state.stuck},
                           {"surface", ground_name(run)}};
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
                                       : "in the air";
    if (const std::string ground = ground_name(run); !ground.empty()) how += " on " + ground;
    print_row(out, "ticks", fmt::format("{} of {} s", report.ticks, run.tape.dt_text));
    print_row(out, "distance", fmt::format("{:.3f} m", report.distance));
    print_row(out, "position", vector_text(state.position) + "  m");
    print_row(out, "velocity", vector_text(state.velocity) + "  m/s");
    print_row(out, "state", how);
    out << "\nhashes\n";
    for (std::size_t i = 0; i < report.second_hashes.size(); ++i) {
        const double whole = static_cast<double>(i + 1);
        const double time = std::min(whole, static_cast<double>(report.ticks) * run.tape.dt);
        out << fmt::format("{:>10.3f} s  {}\n", time, hash_text(report.second_hashes[i]));
    }
    out << "\nevents\n";
    for (const SimulationEvent& event : report.events) {
        const double time = static_cast<double>(event.tick + 1) * run.tape.dt;
        out << fmt::format("{:>10.3f} s  {:<13} {}\n", time, event.kind, event.detail);
    }
    if (report.events.empty()) out << "            none\n";
}

}  // namespace

int run_simulate(const SimulateOptions& options, std::ostream& out, std::ostream& err) {
    const Result<Run> run = run_tape(options);
    if (!run) {
        print_error(err, run.error());
        return exit_bad_input;
    }
    print_warnings(err, run->warnings);
    if (options.csv || options.tell)
        out << run->text;
    else
        options.json ? print_report_json(*run, out) : print_report_text(*run, out);
    if (run->tape.end_hash && run->as_recorded && *run->tape.end_hash != run->report.end_hash) {
        print_error(err, {options.tape.string(),
                          fmt::format("the run ends with hash {}, expected {}: it does not repeat what was "
                                      "recorded",
                                      hash_text(run->report.end_hash), hash_text(*run->tape.end_hash))});
        return exit_check_failed;
    }
    return exit_fine;
}

}  // namespace slipface::cli
