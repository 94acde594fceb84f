#include "slipface/sim/audit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "audit_checks.h"
#include "audit_run.h"
#include "finding_text.h"
#include "slipface/base/hash.h"
#include "slipface/base/parallel.h"
#include "slipface/base/version.h"
#include "slipface/level/level_scene.h"
#include "slipface/level/shown_mesh.h"
#include "slipface/movement/first_contact.h"
#include "slipface/sim/level_fingerprint.h"
#include "slipface/sim/story.h"

namespace slipface {
namespace {

constexpr std::uint64_t max_steps = 1'000'000'000'000ULL;

std::uint64_t settings_hash_of(const MovementSettings& settings) {
    Hasher hasher;
    for (const SettingInfo& info : settings_table()) {
        hasher.text(info.name);
        hasher.f64(get_setting(settings, info));
    }
    return hasher.value();
}

double speed_of(const AuditOptions& options, const MovementSettings& settings, std::uint32_t walker) {
    return options.speeds.empty() ? settings.walk_speed : options.speeds[walker % options.speeds.size()];
}

Status check_options(const Level& level, const AuditOptions& options) {
    const std::string location = "audit";
    if (level.mesh.triangle_count() == 0) return Error{location, "the level has no triangles"};
    if (options.walkers < 1 || options.walkers > 10'000'000)
        return Error{location, fmt::format("found {} walkers, expected 1 to 10000000", options.walkers)};
    if (!(options.dt >= 1e-4 && options.dt <= 0.25))
        return Error{location, fmt::format("found a step of {} s, expected 0.0001 to 0.25", options.dt)};
    if (!(options.duration_s >= options.dt &&
          options.duration_s / options.dt * options.walkers <= double(max_steps)))
        return Error{location,
                     fmt::format("found {} s per walker, expected at least one step and at most {} in total",
                                 options.duration_s, max_steps)};
    if (options.shard.number < 1 || options.shard.number > options.shard.count)
        return Error{location,
                     fmt::format("found shard {}, expected 1/{} to {}/{}", shard_text(options.shard),
                                 options.shard.count, options.shard.count, options.shard.count)};
    for (const double speed : options.speeds) {
        if (!(speed > 0.0 && speed <= find_setting("walk_speed")->maximum))
            return Error{location, fmt::format("found a speed of {} m/s, expected above 0 and at most {}",
                                               speed, find_setting("walk_speed")->maximum)};
    }
    return {};
}

// What two parts of one audit must have in common beside geometry and settings.
std::uint64_t scene_fingerprint_of(const Level& level, const MovementScene& at_first) {
    Hasher hasher;
    hasher.u64(level_fingerprint(level, at_first));
    for (int axis = 0; axis < 3; ++axis)
        hasher.f64(level.spawn[axis]);
    return hasher.value();
}

// Why no life can begin there; nothing if one can.
std::optional<std::string> problem_of(const Level& level, const TickScene& scene, const RunStart& start,
                                      double dt) {
    const MovementScene at_first = scene.at(0, 0.0);
    const Vec3 at = position_in_scene(at_first, start.player);
    if (const auto inside = overlaps_deeply(at_first, level.movement, at))
        return fmt::format("lies inside face {}; every walker would start stuck", inside->face);
    PlayerState state = start.player;
    const Vec3& radii = level.movement.radii;
    const std::size_t crowd = crowd_in(at_first, {at - radii, at + radii});
    // Among very many triangles a second takes too long.
    const std::size_t ticks = 4'000'000 / std::max<std::size_t>(crowd, 1);
    for (std::size_t tick = 0; static_cast<double>(tick) * dt < 1.0 && tick < ticks; ++tick) {
        const TickResult result = play_tick(scene.at(tick, dt), level.movement, state, {}, dt, start);
        if (result.respawn == Respawn::hazard)
            return fmt::format("is deadly: a player who stands still is killed after {:.2f} s on {}",
                               static_cast<double>(tick + 1) * dt,
                               thing_text(level, result.stepped.ground_face));
        state = result.state;
    }
    return std::nullopt;
}

std::uint64_t starts_hash_of(const std::vector<Vec3>& starts) {
    if (starts.empty()) return 0;
    Hasher hasher;
    for (const Vec3& start : starts)
        for (int axis = 0; axis < 3; ++axis)
            hasher.f64(start[axis]);
    return hasher.value();
}

// What holds the level wherever its platforms are. Scene coordinates.
Aabb level_bounds(const Level& level, const TickScene& scene) {
    Aabb bounds = scene.at(0, 0.0).collision.bounds();
    const std::vector<std::uint32_t> platforms = face_platforms(level);
    std::vector<Aabb> rest(level.platforms.size());
    if (platforms.empty()) return bounds;
    const Mesh& mesh = *level.mesh;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        const std::uint32_t platform = platforms[mesh.triangle_face[t]];
        for (std::size_t k = 0; platform != no_id && k < 3; ++k)
            rest[platform].add(mesh.positions[mesh.corner_vertex[mesh.triangles[t][k]]].cast<double>());
    }
    for (std::size_t i = 0; i < rest.size(); ++i) {
        const Aabb reach = platform_reach(level.platforms[i], rest[i]);
        if (reach.empty()) continue;
        bounds.add(reach.min + scene.offset());
        bounds.add(reach.max + scene.offset());
    }
    return bounds;
}

// A walker who is outside of this has left the level: farther from it than his own size.
Aabb walk_bounds(Aabb bounds, const MovementSettings& settings, bool closed) {
    const double margin = settings.radii.maxCoeff() + 1.0;
    bounds.min.array() -= margin;
    bounds.max.array() += margin;
    if (!closed) bounds.max.y() += 1000.0;  // a jump from the highest roof leaves nothing
    return bounds;
}

// How many walkers walk side by side. Where something moves, many: moving the platforms then costs each of
// them little. Fewer where that would leave a thread without work. Where nothing moves, one after another is
// fastest. No result depends on it.
std::size_t crowd_of(const LevelScene& scene, std::size_t walkers) {
    constexpr std::size_t least = 32, maximum = 256;
    if (scene.is_static()) return 1;
    const auto threads = static_cast<std::size_t>(parallel_threads());
    return std::clamp((walkers + threads - 1) / threads, least, maximum);
}

}  // namespace

Result<AuditReport> run_audit(const Level& level, const AuditOptions& options) {
    if (Status status = check_options(level, options); !status.ok()) return status.error();
    Result<LevelScene> level_scene = LevelScene::build(level);
    if (!level_scene) return level_scene.error();
    const TickScene first(*level_scene);
    std::vector<RunStart> starts;
    for (const Vec3& start : options.starts)
        starts.push_back(run_start(first, start));
    const RunStart spawn = run_start(first, level.spawn);
    if (starts.empty()) starts.push_back(spawn);
    for (std::size_t i = 0; i < starts.size(); ++i) {
        const std::string name = options.starts.empty() ? "the spawn point" : fmt::format("start {}", i + 1);
        if (const auto problem = problem_of(level, first, starts[i], options.dt))
            return Error{"audit", name + " " + *problem};
    }
    const MovementScene at_first = first.at(0, 0.0);
    // A door may be open at another time: only what stands still closes a level.
    const bool closed = level_is_closed(at_first.collision, position_in_scene(at_first, spawn.player));
    const std::uint64_t fingerprint = scene_fingerprint_of(level, at_first);

    AuditReport report;
    report.level_name = level.mesh_path.filename().string();
    report.level_fingerprint = level.mesh.fingerprint();
    report.scene_fingerprint = fingerprint;
    report.program = program_version();
    report.settings_hash = settings_hash_of(level.movement);
    report.walkers = options.walkers;
    report.duration_s = options.duration_s;
    report.seed = options.seed;
    report.dt_text = options.dt_text;
    report.speeds = options.speeds;
    report.starts = options.starts.size();
    report.starts_hash = starts_hash_of(options.starts);
    report.shard = options.shard;
    report.closed = closed;

    const Aabb bounds = level_bounds(level, first);
    AuditArena arena{.options = options,
                     .starts = std::move(starts),
                     .level_bounds = bounds,
                     .bounds = walk_bounds(bounds, level.movement, closed),
                     .closed = closed,
                     .ticks = static_cast<std::uint64_t>(std::llround(options.duration_s / options.dt))};
    const std::size_t count =
        (options.walkers + options.shard.count - options.shard.number) / options.shard.count;
    std::vector<AuditRun> runs;
    runs.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t number = options.shard.number - 1 + i * options.shard.count;
        MovementSettings settings = level.movement;
        settings.walk_speed = speed_of(options, settings, number);
        runs.emplace_back(arena, settings, number);
    }
    // Heat is summed a block of walkers at a time: sums of whole numbers do not depend on the blocks.
    const std::size_t side_by_side = crowd_of(*level_scene, count);
    const std::size_t blocks = std::min<std::size_t>((count + side_by_side - 1) / side_by_side, 16);
    std::vector<std::vector<FaceHeat>> heats(options.heat ? blocks : 0);
    parallel_for(blocks, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t block = begin; block < end; ++block) {
            LevelScene own = level_scene->for_another_thread();
            const TickScene scene(own);
            std::vector<FaceHeat>* heat = options.heat ? &heats[block] : nullptr;
            if (heat) heat->resize(level.mesh.face_count());
            const std::size_t last = count * (block + 1) / blocks;
            for (std::size_t i = count * block / blocks; i < last; i += side_by_side) {
                const std::size_t together = std::min(side_by_side, last - i);
                walk_side_by_side(scene, arena, std::span(runs).subspan(i, together), heat);
            }
        }
    });

    for (const AuditRun& run : runs)
        run.add_to(report);
    report.exits = summed_exits(std::move(report.exits));
    if (options.heat) report.heat.resize(level.mesh.face_count());
    for (const std::vector<FaceHeat>& heat : heats) {
        for (std::size_t face = 0; face < heat.size(); ++face)
            report.heat[face] += heat[face];
    }
    for (AuditFinding& finding : report.findings)
        finding.text = finding_text(level, options, finding);
    report.cancelled = arena.stopped;
    return report;
}

Result<std::vector<Vec3>> usable_starts(const Level& level, const std::vector<Vec3>& starts, double dt) {
    Result<LevelScene> level_scene = LevelScene::build(level);
    if (!level_scene) return level_scene.error();
    const TickScene scene(*level_scene);
    std::vector<Vec3> usable;
    for (const Vec3& start : starts)
        if (!problem_of(level, scene, run_start(scene, start), dt)) usable.push_back(start);
    return usable;
}

Tape audit_tape(const Level& level, const AuditOptions& options, const AuditFinding& finding) {
    Tape tape;
    tape.level_name = level.mesh_path.filename().string();
    tape.level_fingerprint = level.mesh.fingerprint();
    tape.dt = options.dt;
    tape.dt_text = options.dt_text;
    tape.start = options.starts.empty()
                     ? level.spawn
                     : options.starts[start_of(finding.walker, finding.life, options.starts.size())];
    MovementSettings settings = level.movement;
    settings.walk_speed = speed_of(options, settings, finding.walker);
    for (const SettingInfo& info : settings_table())
        tape.settings.push_back(fmt::format("{}={}", info.name, setting_text(settings, info)));
    Walker walker(options.seed, finding.walker, finding.life, options.dt, settings);
    for (std::uint64_t tick = 0; tick < finding.tick; ++tick)
        append_tick(tape, walker.next());
    tape.end_hash = finding.hash;
    return tape;
}

}  // namespace slipface
