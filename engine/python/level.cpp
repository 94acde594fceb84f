#include <nlohmann/json.hpp>

#include "module.h"
#include "slipface/level/find_start.h"
#include "slipface/level/level_file.h"
#include "slipface/reach/report.h"
#include "slipface/sim/audit.h"
#include "slipface/sim/channels.h"

namespace slipface::python {
namespace {

struct OpenLevel : World {};

// A run of a tape, with the level that it ran in.
struct Run {
    std::shared_ptr<OpenLevel> world;
    std::optional<TapeRun> run;
    PlayerState final_state;
};

py::object python_of(const std::string& json) {
    return py::module_::import("json").attr("loads")(json);
}

std::shared_ptr<OpenLevel> open(const std::string& path) {
    LoadedLevel loaded = value_or_raise(load_level(path));
    auto world = std::make_shared<OpenLevel>();
    world->level = std::make_unique<Level>(std::move(loaded.level));
    world->scene.emplace(value_or_raise(LevelScene::build(*world->level)));
    return world;
}

// A level of its own for work that takes long and lets other Python threads run.
Level copy_of(const World& world, const std::optional<MovementSettings>& settings) {
    Level level = *world.level;
    if (settings) level.movement = *settings;
    return level;
}

Run run_tape(const std::shared_ptr<OpenLevel>& world, const std::string& tape_or_path,
             const std::optional<MovementSettings>& settings) {
    const bool is_text = tape_or_path.starts_with("slipface-tape");
    auto tape = std::make_shared<Tape>(
        value_or_raise(is_text ? parse_tape(tape_or_path, "tape") : load_tape(tape_or_path)));
    MovementSettings chosen = world->level->movement;
    if (const Status status = apply_tape_settings(chosen, *tape, "tape"); !status) raise(status.error());
    if (settings) chosen = *settings;
    const Vec3 start = tape->start
                           ? *tape->start
                           : value_or_raise(find_start(*world->level, *world->scene, chosen)).position;
    Run made{world, {}, {}};
    const Change change(*world);
    const TickScene scene(*world->scene);
    made.run.emplace(settings ? TapeRun::under(tape, chosen, start) : TapeRun(tape, chosen, start));
    made.run->advance(scene, TapeRun::max_ticks);
    made.final_state = made.run->state_before(scene, made.run->samples().size());
    return made;
}

// Every channel as an array, for plots and data frames.
py::dict columns(const Run& of) {
    const TapeRun& run = *of.run;
    const auto ticks = static_cast<py::ssize_t>(run.samples().size());
    py::dict all;
    py::array_t<double> time(ticks);
    py::array_t<double> position({ticks, py::ssize_t{3}});
    for (py::ssize_t tick = 0; tick < ticks; ++tick) {
        time.mutable_at(tick) = static_cast<double>(tick + 1) * run.dt();
        for (py::ssize_t k = 0; k < 3; ++k)
            position.mutable_at(tick, k) = run.samples()[static_cast<std::size_t>(tick)].position[k];
    }
    all["time_s"] = time;
    for (const RunChannel& channel : run_channels()) {
        py::array_t<double> values(ticks);
        for (py::ssize_t tick = 0; tick < ticks; ++tick)
            values.mutable_at(tick) = channel.value(run, static_cast<std::size_t>(tick));
        all[channel.name] = values;
    }
    all["position"] = position;
    return all;
}

py::list trace_of(const Run& of, std::size_t tick) {
    if (tick >= of.run->samples().size())
        throw py::index_error("found the tick " + std::to_string(tick) + ", expected one below " +
                              std::to_string(of.run->samples().size()));
    const Change change(*of.world);
    const TickScene scene(*of.world->scene);
    py::list list;
    for (const TraceRecord& record : of.run->trace(scene, tick).records)
        list.append(record_dict(record));
    return list;
}

py::object audit(const World& world, std::uint32_t walkers, double seconds, std::uint64_t seed,
                 const std::optional<MovementSettings>& settings) {
    AuditOptions options;
    options.walkers = walkers;
    options.duration_s = seconds;
    options.seed = seed;
    Level level = copy_of(world, settings);
    std::string json;
    {
        const py::gil_scoped_release others;
        value_or_raise(settle_start(level));
        json = audit_to_json(value_or_raise(run_audit(level, options)));
    }
    return python_of(json);
}

py::object reach(const World& world, double seconds, std::optional<std::uint64_t> rounds, std::uint64_t seed,
                 const std::optional<MovementSettings>& settings) {
    Level level = copy_of(world, settings);
    std::string json;
    {
        const py::gil_scoped_release others;
        const Start start = value_or_raise(settle_start(level));
        ReachSearch search = value_or_raise(ReachSearch::begin(level, start.position, {.seed = seed}));
        search.run({.rounds = rounds, .seconds = rounds ? 0.0 : seconds});
        json = reach_to_json(make_reach_report(search), false);
    }
    return python_of(json);
}

}  // namespace

void add_level(py::module_& module) {
    py::class_<Run>(module, "Run", "The result of a tape, tick by tick.")
        .def_property_readonly("ticks", [](const Run& of) { return of.run->samples().size(); })
        .def_property_readonly(
            "hash", [](const Run& of) { return of.run->hash(); },
            "Of all states; the same in every build and language")
        .def_property_readonly("final", [](const Run& of) { return of.final_state; })
        .def_property_readonly(
            "events",
            [](const Run& of) {
                py::list list;
                for (const SimulationEvent& event : of.run->events())
                    list.append(py::make_tuple(event.tick, event.kind, event.detail));
                return list;
            },
            "(tick, kind, detail) of each")
        .def("columns", &columns, "Arrays with a number per tick, by name; position (ticks, 3)")
        .def(
            "frame",
            [](const Run& of) {
                py::dict all = columns(of);
                all.attr("pop")("position");
                return py::module_::import("pandas").attr("DataFrame")(all);
            },
            "The same as a pandas.DataFrame")
        .def("trace", &trace_of, py::arg("tick"), "What happened in a tick, a dictionary for each record");

    using namespace py::literals;
    py::class_<OpenLevel, World, std::shared_ptr<OpenLevel>>(
        module, "Level", "A level file, or geometry in any format that the editor opens. It is a World, too.")
        .def(py::init(&open), "path"_a)
        .def_property_readonly(
            "settings", [](const OpenLevel& level) { return level.level->movement; },
            "A copy of the level's settings")
        .def_property_readonly("face_count",
                               [](const OpenLevel& level) { return level.level->mesh.face_count(); })
        .def(
            "face_type",
            [](const OpenLevel& level, FaceId face) {
                if (face >= level.level->mesh.face_count()) throw py::index_error("found no such face");
                return level.level->surfaces[resolve_surfaces(*level.level).surface[face]].name;
            },
            "face"_a)
        .def(
            "spawn",
            [](OpenLevel& level, const std::string& name) {
                const Start start =
                    value_or_raise(find_start(*level.level, *level.scene, level.level->movement, name));
                return tuple(Vec3(start.position + level.scene->offset()));
            },
            "name"_a = "", "Where a player starts")
        .def("run", &run_tape, "tape"_a, "settings"_a = py::none(),
             "Runs a tape, the path of one or its text, under its settings or under these")
        .def("audit", &audit, "walkers"_a = 100, "seconds"_a = 60.0, "seed"_a = 1, "settings"_a = py::none(),
             "Random walkers: the report as a dictionary")
        .def("reach", &reach, "seconds"_a = 10.0, "rounds"_a = py::none(), "seed"_a = 1,
             "settings"_a = py::none(), "Searches for what the player can reach: the report as a dictionary")
        .def(
            "save",
            [](const OpenLevel& level, const std::string& path) {
                if (const Status status = save_level(*level.level, path); !status) raise(status.error());
            },
            "path"_a, "Writes the level file");
}

}  // namespace slipface::python
