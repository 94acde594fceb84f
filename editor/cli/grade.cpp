// slipface grade: whether runs that were handed in reach a level's goals. The grader's level decides
// geometry, settings and start; a run brings inputs, and the settings that the grader allows.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <limits>
#include <memory>

#include "cli/format.h"
#include "cli/guarded.h"
#include "cli/options.h"
#include "cli/verbs.h"
#include "slipface/base/files.h"
#include "slipface/base/system.h"
#include "slipface/level/find_start.h"
#include "slipface/sim/recorded_run.h"

namespace slipface::cli {
namespace {

// Where a run was: before its first tick at time 0, then after each tick.
struct Place {
    double time_s = 0.0;
    Vec3 position = Vec3::Zero();  // of the player's centre, in the level
};
struct HandedIn {
    std::vector<Place> places;
    std::string refused;  // why it does not count, or empty
};

// What of a tape's settings differs from the graded ones, at any tick, and is not allowed.
std::string not_allowed(const TapeOnLevel& run, const GradeOptions& options, const MovementSettings& graded) {
    const auto allowed = [&](std::string_view name) {
        return std::find(options.allow.begin(), options.allow.end(), name) != options.allow.end();
    };
    if (run.tape.mover != nullptr && !allowed("mover"))
        return fmt::format("is moved by {}", run.tape.mover->name);
    MovementSettings now = run.settings;
    for (std::size_t change = 0;; ++change) {
        for (const SettingInfo& info : settings_table())
            if (get_setting(now, info) != get_setting(graded, info) && !allowed(info.name))
                return fmt::format("has {}={}, expected {}", info.name, setting_text(now, info),
                                   setting_text(graded, info));
        if (change == run.tape.changes.size()) return {};
        (void)set_setting(now, run.tape.changes[change].setting);
    }
}

Result<HandedIn> tape_run(const std::filesystem::path& file, const GradeOptions& options) {
    const Result<TapeOnLevel> run = load_tape_on_level({.level = options.level, .tape = file});
    if (!run) return run.error();
    MovementSettings graded = run->loaded->level.movement;
    for (const std::string& assignment : options.settings)
        if (const Status status = set_setting(graded, assignment); !status.ok())
            return Error{"--set " + assignment, status.error().message};
    LevelScene level = std::move(LevelScene::build(run->loaded->level, run->settings).value());
    const TickScene scene(level);
    const SimulationReport report =
        simulate(scene, run->settings, run->start, run->tape, {.keep_states = true});
    HandedIn result{.places = {{0.0, run->start}}, .refused = not_allowed(*run, options, graded)};
    for (const PlayerState& state : report.states)
        result.places.push_back(
            {static_cast<double>(result.places.size()) * run->tape.dt, scene.to_level(state)});
    if (run->tape.level_fingerprint.value_or(run->loaded->level.mesh.fingerprint()) !=
        run->loaded->level.mesh.fingerprint())
        result.refused = "was recorded on other geometry";
    if (run->tape.end_hash && *run->tape.end_hash != report.end_hash)
        result.refused = "does not repeat: the run ends with another hash than its tape";
    return result;
}

Result<HandedIn> recorded_run(const std::filesystem::path& file) {
    const Result<RecordedRun> run = read_recorded_run(file);
    if (!run) return run.error();
    HandedIn result;
    for (const RecordedTick& tick : run->ticks)
        result.places.push_back({tick.time_s, tick.feet + Vec3(0, 0.5 * run->height, 0)});
    return result;
}

// What a run does to a goal; `passes` if it holds.
std::string judge(const Goal& goal, const std::vector<Place>& places, bool& passes) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& [time_s, position] : places) {
        const double apart = (position - goal.position).norm();
        nearest = std::min(nearest, apart);
        if (apart > goal.radius) continue;
        passes = goal.kind == GoalKind::reach && time_s <= goal.within_s.value_or(time_s);
        return fmt::format("{} at {:.2f} s{}", goal.name, time_s,
                           passes ? ""
                           : goal.kind == GoalKind::never
                               ? ", where it must never be"
                               : fmt::format(", too late after {} s", *goal.within_s));
    }
    passes = goal.kind == GoalKind::never;
    return passes ? goal.name + " never entered"
                  : fmt::format("{} missed by {:.2f} m", goal.name, nearest - goal.radius);
}

Result<bool> grade(const std::filesystem::path& file, const Level& level, const GradeOptions& options,
                   std::ostream& out) {
    const Result<std::string> text = read_file(file, std::uint64_t{64} << 20);
    if (!text) return text.error();
    Result<HandedIn> run = text->starts_with("slipface-tape") ? tape_run(file, options) : recorded_run(file);
    if (!run) return run.error();
    // A recording of another engine may begin after its first tick, on its way down to the floor.
    constexpr double near_m = 0.25;
    std::vector<Spawn> spawns = all_spawns(level);
    if (spawns.empty()) spawns.push_back({.position = level.spawn});
    if (run->refused.empty() && std::none_of(spawns.begin(), spawns.end(), [&](const Spawn& spawn) {
            return (run->places.front().position - spawn.position).norm() <= near_m;
        }))
        run->refused =
            "begins at " + vector_text(run->places.front().position) + ", at no spawn of the level";
    bool all = run->refused.empty();
    std::string why = run->refused;
    for (const Goal& goal : level.goals) {
        if (!run->refused.empty()) break;
        bool passes = false;
        why += (why.empty() ? "" : "; ") + judge(goal, run->places, passes);
        all = all && passes;
    }
    print_row(out, all ? "passes" : "fails", file.string() + ": " + why);
    return all;
}

}  // namespace

int run_grade(const GradeOptions& options, std::ostream& out, std::ostream& err) {
    const Result<LoadedLevel> loaded = load_level(options.level);
    if (!loaded) return bad_input(err, loaded.error());
    if (loaded->level.goals.empty())
        return bad_input(err, {options.level.string(), "has no goals, expected at least one to grade by"});
    for (const std::string& name : options.allow)
        if (name != "mover" && find_setting(name) == nullptr)
            return bad_input(err,
                             {"--allow", "found " + name + ", expected the name of a setting, or mover"});
    bool all = true;
    for (const std::filesystem::path& file : options.files) {
        const Result<bool> passes = grade(file, loaded->level, options, out);
        if (!passes) return bad_input(err, passes.error());
        all = all && *passes;
    }
    return all ? exit_fine : exit_check_failed;
}

void add_grade_verb(CLI::App& app, int& exit_code) {
    CLI::App* verb = app.add_subcommand("grade", "Grade runs that were handed in by the level's goals");
    struct Words {
        GradeOptions options;
        std::vector<std::string> files;
    };
    auto words = std::make_shared<Words>();
    add_path(*verb, "LEVEL", words->options.level, level_help())->required();
    verb->add_option("RUN", words->files, "Tapes, and runs of other controllers (docs/recorded-runs.md)")
        ->required();
    add_set_option(*verb, words->options.settings);
    verb->add_option("--allow", words->options.allow,
                     "Settings that a tape may change, by name; mover: another mover")
        ->delimiter(',')
        ->type_name("NAME");
    verb->callback([words, &exit_code] {
        for (const std::string& file : words->files)
            words->options.files.push_back(path_of(file));
        exit_code = guarded([&] { return run_grade(words->options, std::cout, std::cerr); });
    });
}

}  // namespace slipface::cli
