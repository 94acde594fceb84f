#include <fmt/format.h>

#include <iostream>

#include "cli/format.h"
#include "cli/guarded.h"
#include "cli/options.h"
#include "cli/tape_on_level.h"
#include "cli/verbs.h"
#include "slipface/level/preset.h"
#include "slipface/repair/repairs.h"
#include "slipface/sim/run_events.h"
#include "slipface/sim/summary.h"

namespace slipface::cli {
namespace {

Result<TapeRun> complete_run(const TapeOnLevel& base, const TickScene& scene) {
    if (base.tape.tick_count() > TapeRun::max_ticks)
        return Error{base.source, fmt::format("found {} ticks, expected at most {}", base.tape.tick_count(),
                                              TapeRun::max_ticks)};
    TapeRun run(std::make_shared<const Tape>(base.tape), base.settings, base.start);
    run.advance(scene, TapeRun::max_ticks);
    return run;
}

OutputJson cure_json(const Cure& cure) {
    OutputJson json{{"text", cure.text},         {"passes", cure.passes},
                    {"gained_m", cure.gained_m}, {"cost", cure.cost},
                    {"settings", cure.settings}, {"repairs_geometry", cure.mesh != nullptr}};
    if (!cure.faces.empty()) {
        json["faces"] = cure.faces;
        json["type"] = cure.type.name;
    }
    return json;
}

OutputJson stop_json(const Stop& stop, const std::vector<Cure>& cures, double dt) {
    OutputJson json{{"tick", stop.worst},
                    {"first", stop.first},
                    {"last", stop.last},
                    {"time_s", static_cast<double>(stop.first) * dt},
                    {"lost_s", stop.lost_s},
                    {"lost_m", stop.lost_m},
                    {"cause", stop_cause_name(stop.loss.cause)},
                    {"headline", stop.headline}};
    json["face"] = stop.loss.face == no_id ? OutputJson() : OutputJson(stop.loss.face);
    json["held_by"] = stop.held_by;
    json["position"] = vector_json(stop.loss.position);
    json["cures"] = OutputJson::array();
    for (const Cure& cure : cures)
        json["cures"].push_back(cure_json(cure));
    return json;
}

OutputJson event_json(const RunEvent& event, double dt) {
    OutputJson json{{"word", event.word},
                    {"first", event.first},
                    {"last", event.last},
                    {"time_s", static_cast<double>(event.first) * dt},
                    {"text", event.text}};
    json["face"] = event.face == no_id ? OutputJson() : OutputJson(event.face);
    json["position"] = vector_json(event.position);
    return json;
}

}  // namespace

int run_why(const WhyOptions& options, std::ostream& out, std::ostream& err) {
    Result<TapeOnLevel> base = load_tape_on_level(options.tape);
    if (!base) return bad_input(err, base.error());
    print_warnings(err, base->warnings);
    const Level& level = base->loaded->level;
    const TickScene scene(base->scene);
    const Result<TapeRun> run = complete_run(*base, scene);
    if (!run) return bad_input(err, run.error());

    const std::vector<Stop> stops = find_stops(scene, *run, level);
    const Stop* headline = headline_stop(stops);
    OutputJson json{{"headline", headline ? OutputJson(headline->headline) : OutputJson()},
                    {"stops", OutputJson::array()}};
    if (!options.json) {
        out << (headline ? headline->headline : std::string("Nothing stopped the player")) << '\n';
        if (headline) out << fmt::format("\nStops in this run ({})\n", stops.size());
    }
    for (const Stop& stop : stops) {
        const std::vector<Cure> cures = find_cures_and_repairs(level, *run, stop);
        if (options.json) {
            json["stops"].push_back(stop_json(stop, cures, run->dt()));
            continue;
        }
        out << stops_text(std::span(&stop, 1), run->dt());
        for (const Cure& cure : cures)
            out << (cure.passes ? "  + " : "    ") << cure_text(cure) << '\n';
    }
    if (!options.json && !options.events) return exit_fine;
    const std::vector<RunEvent> events = find_events(scene, *run, level);
    if (!options.json) {
        out << fmt::format("\nEvents in this run ({})\n", events.size()) << events_text(events, run->dt());
        return exit_fine;
    }
    json["events"] = OutputJson::array();
    for (const RunEvent& event : events)
        json["events"].push_back(event_json(event, run->dt()));
    print_json(out, json);
    return exit_fine;
}

int run_compare(const CompareOptions& options, std::ostream& out, std::ostream& err) {
    Result<TapeOnLevel> base = load_tape_on_level(options.tape);
    if (!base) return bad_input(err, base.error());
    print_warnings(err, base->warnings);
    std::vector<NamedSettings> sets{{"this level", base->settings}};
    if (options.presets.empty()) {
        for (const ShippedPreset& shipped : shipped_presets())
            sets.push_back({shipped.id, shipped.preset.settings});
    }
    for (const std::string& name : options.presets) {
        const Result<Preset> preset = find_preset(name);
        if (!preset) return bad_input(err, {"--presets", preset.error().text()});
        sets.push_back({name, preset->settings});
    }
    if (base->tape.tick_count() > TapeRun::max_ticks)
        return bad_input(err, {base->source, fmt::format("found {} ticks, expected at most {}",
                                                         base->tape.tick_count(), TapeRun::max_ticks)});
    const std::vector<SummaryRow> rows =
        compare_settings(base->loaded->level, std::make_shared<const Tape>(base->tape), base->start, sets);
    if (options.json) {
        OutputJson json = OutputJson::array();
        for (const SummaryRow& row : rows) {
            const RunSummary& s = row.summary;
            json.push_back({{"name", row.name},
                            {"distance_m", s.distance_m},
                            {"advanced_m", s.advanced_m},
                            {"stops", s.stops},
                            {"lost_s", s.lost_s},
                            {"air_s", s.air_s},
                            {"falls", s.falls},
                            {"hazards", s.hazards},
                            {"top_speed_m_s", s.top_speed_m_s}});
        }
        print_json(out, json);
        return exit_fine;
    }
    out << fmt::format("{:<22}{:>11}{:>7}{:>10}{:>10}{:>7}{:>9}{:>12}\n", "", "distance", "stops", "lost",
                       "in air", "falls", "hazards", "top speed");
    for (const SummaryRow& row : rows) {
        const RunSummary& s = row.summary;
        out << fmt::format("{:<22}{:>9.2f} m{:>7}{:>8.2f} s{:>8.2f} s{:>7}{:>9}{:>8.2f} m/s\n", row.name,
                           s.distance_m, s.stops, s.lost_s, s.air_s, s.falls, s.hazards, s.top_speed_m_s);
    }
    return exit_fine;
}

namespace {

// The options of every verb that runs a tape on a level.
CLI::Option* add_tape_options(CLI::App& verb, TapeOptions& tape) {
    add_path(verb, "LEVEL", tape.level, "OBJ or level file, or a capsule")->required();
    add_set_option(verb, tape.settings);
    return add_path(verb, "--tape", tape.tape, "Inputs, tick by tick; a capsule has its own")
        ->type_name("FILE");
}

}  // namespace

void add_why_verbs(CLI::App& app, int& exit_code) {
    CLI::App* why = app.add_subcommand("why", "Report what stopped a tape's player, and what would cure it");
    auto requested = std::make_shared<WhyOptions>();
    CLI::Option* const tape = add_tape_options(*why, requested->tape);
    auto run = std::make_shared<std::filesystem::path>();
    add_path(*why, "--run", *run, "Positions of another controller (docs/recorded-runs.md) instead of a tape")
        ->type_name("FILE")
        ->excludes(tape);
    why->add_option("--preset", requested->tape.preset, "Settings instead of the level's; a name or a file")
        ->type_name("PRESET");
    why->add_flag("--events", requested->events, "List jumps, landings, slides and what else happened, too");
    why->add_flag("--json", requested->json, "Print JSON, with the events");
    why->callback([requested, run, &exit_code] {
        if (!run->empty()) requested->run = *run;
        if (!requested->run && requested->tape.tape.empty() && !brings_tape(requested->tape.level))
            throw CLI::RequiredError("--tape or --run");
        exit_code = guarded([&] {
            return requested->run ? run_why_recorded(*requested, std::cout, std::cerr)
                                  : run_why(*requested, std::cout, std::cerr);
        });
    });

    CLI::App* compare =
        app.add_subcommand("compare", "Run a tape under several presets and compare the runs");
    auto options = std::make_shared<CompareOptions>();
    add_tape_options(*compare, options->tape);
    compare->add_option("--presets", options->presets, "Names or files; default: all shipped presets")
        ->type_name("A,B")
        ->delimiter(',');
    compare->add_flag("--json", options->json, "Print JSON");
    compare->callback([options, &exit_code] {
        if (options->tape.tape.empty() && !brings_tape(options->tape.level))
            throw CLI::RequiredError("--tape");
        exit_code = guarded([&] { return run_compare(*options, std::cout, std::cerr); });
    });
}

}  // namespace slipface::cli
