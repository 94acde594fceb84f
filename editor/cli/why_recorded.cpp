#include <fmt/format.h>

#include "cli/format.h"
#include "cli/verbs.h"
#include "slipface/level/preset.h"
#include "slipface/sim/recorded_faults.h"

namespace slipface::cli {
namespace {

OutputJson fault_json(const RecordedFault& fault, const RecordedRun& run) {
    OutputJson json{{"kind", fault_name(fault.kind)},          {"first", fault.first},   {"last", fault.last},
                    {"time_s", run.ticks[fault.first].time_s}, {"lost", fault.lost_m_s}, {"text", fault.text},
                    {"position", vector_json(fault.position)}};
    json["face"] = fault.face == no_id ? OutputJson() : OutputJson(fault.face);
    json["other"] = fault.other == no_id ? OutputJson() : OutputJson(fault.other);
    json["slipface_passes"] = fault.slipface_passes;
    json["differs_at"] = fault.differs_at ? OutputJson(*fault.differs_at) : OutputJson();
    return json;
}

}  // namespace

int run_why_recorded(const WhyOptions& options, std::ostream& out, std::ostream& err) {
    const Result<RecordedRun> run = read_recorded_run(*options.run);
    if (!run) return cli::bad_input(err, run.error());
    const Result<LoadedLevel> loaded = load_level(options.tape.level);
    if (!loaded) return cli::bad_input(err, loaded.error());
    print_warnings(err, loaded->warnings);
    MovementSettings settings = loaded->level.movement;
    if (options.tape.preset) {
        const Result<Preset> preset = find_preset(*options.tape.preset);
        if (!preset) return cli::bad_input(err, {"--preset", preset.error().text()});
        settings = preset->settings;
    }
    for (const std::string& assignment : options.tape.settings)
        if (const Status status = set_setting(settings, assignment); !status.ok())
            return cli::bad_input(err, {"--set " + assignment, status.error().message});
    Result<LevelScene> scene = LevelScene::build(loaded->level, settings);
    if (!scene) return cli::bad_input(err, scene.error());

    const std::vector<RecordedFault> faults = find_recorded_faults(loaded->level, *scene, *run, settings);
    if (options.json) {
        OutputJson json{{"ticks", run->ticks.size()}, {"faults", OutputJson::array()}};
        for (const RecordedFault& fault : faults)
            json["faults"].push_back(fault_json(fault, *run));
        print_json(out, json);
        return exit_fine;
    }
    if (faults.empty()) out << "Nothing disturbed the player\n";
    for (const RecordedFault& fault : faults)
        out << fmt::format("at {:.2f} s (tick {}, {}): {}\n    {}\n", run->ticks[fault.first].time_s,
                           fault.first, fault_name(fault.kind), fault.text, compared_text(fault));
    return exit_fine;
}

}  // namespace slipface::cli
