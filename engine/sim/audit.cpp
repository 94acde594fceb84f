#include "slipface/sim/audit.h"

#include <fmt/format.h>

#include <atomic>
#include <cmath>

#include "audit_checks.h"
#include "audit_walker.h"
#include "slipface/base/hash.h"
#include "slipface/base/parallel.h"
#include "slipface/sim/simulate.h"

namespace slipface {
namespace {

constexpr double stuck_window_s = 2.0;
constexpr double stuck_distance = 0.01;
constexpr double near_ground = 0.05;
constexpr std::uint64_t max_steps = 1'000'000'000'000ULL;

struct Arena {
    MovementScene scene;
    MovementSettings settings;
    Vec3 spawn;
    Aabb bounds;  // leaving it is leaving the level
    bool closed;
};

// The contacts of a step, for the heat map.
class HeatSink final : public TraceSink {
  public:
    HeatSink(std::vector<FaceHeat>& heat, double dt) : heat_(heat), dt_(dt) {}
    void add(const TraceRecord& record) override {
        const auto* response = std::get_if<ResponseRecord>(&record);
        if (!response || response->face >= heat_.size()) return;
        const double lost = (response->leftover_before.norm() - response->leftover_after.norm()) / dt_;
        if (lost > 0.0) heat_[response->face].lost_mm_s += static_cast<std::uint64_t>(1000.0 * lost);
    }

  private:
    std::vector<FaceHeat>& heat_;
    double dt_;
};

// Asked to move all the time and came nowhere.
class StuckWatch {
  public:
    explicit StuckWatch(double dt) : window_(static_cast<std::uint64_t>(stuck_window_s / dt)) {}

    void begin(const Vec3& position) {
        anchor_ = position;
        ticks_ = 0;
        was_free_ = false;
    }
    // True when the window is over and the walker did not get out of it.
    bool tick(const Arena& arena, const PlayerState& state, const PlayerInput& input) {
        const bool held_on_purpose = state.stuck;
        if (held_on_purpose || (state.position - anchor_).norm() >= stuck_distance) {
            begin(state.position);
            return false;
        }
        ++ticks_;
        // Looking is expensive, and a walker who stands still for a moment is no news.
        if (ticks_ * 2 >= window_ && !was_free_) {
            was_free_ = way_is_free(arena.scene, arena.settings, state.position, input.wish);
        }
        if (ticks_ < window_) return false;
        const bool stuck = was_free_;
        begin(state.position);
        return stuck;
    }

  private:
    std::uint64_t window_;
    Vec3 anchor_ = Vec3::Zero();
    std::uint64_t ticks_ = 0;
    bool was_free_ = false;
};

// One walker's whole run.
class Run {
  public:
    Run(const Arena& arena, const AuditOptions& options, std::uint32_t number, std::atomic<bool>& stop)
        : arena_(arena), options_(options), number_(number), stop_(stop), watch_(options.dt) {}

    void walk(std::vector<FaceHeat>* heat);

    std::uint64_t steps = 0, lives = 0, hazards = 0, left = 0, hash = 0;
    std::vector<AuditFinding> findings;

  private:
    void begin_life();
    void check(const PlayerState& before, const PlayerInput& input);
    void find(FindingKind kind, double amount, FaceId face);
    void add_heat(std::vector<FaceHeat>& heat, const PlayerState& before, const PlayerInput& input) const;

    const Arena& arena_;
    const AuditOptions& options_;
    std::uint32_t number_;
    std::atomic<bool>& stop_;
    StuckWatch watch_;
    PlayerState state_;
    std::uint64_t tick_ = 0;  // of this life
    std::array<bool, finding_names.size()> found_{};
};

void Run::begin_life() {
    ++lives;
    tick_ = 0;
    found_ = {};
    state_ = PlayerState{};
    state_.position = arena_.spawn;
    watch_.begin(state_.position);
}

void Run::find(FindingKind kind, double amount, FaceId face) {
    bool& found = found_[static_cast<std::size_t>(kind)];
    if (found) return;
    found = true;
    findings.push_back(
        {kind, number_, static_cast<std::uint32_t>(lives - 1), tick_, state_.position, amount, face});
}

void Run::check(const PlayerState& before, const PlayerInput& input) {
    if (state_.position != before.position) {
        if (const auto passed =
                passed_through(arena_.scene, arena_.settings, before, input, options_.dt, state_.position)) {
            find(FindingKind::escape, passed->amount, passed->face);
        }
        if (const auto overlap = overlaps_deeply(arena_.scene, arena_.settings, state_.position)) {
            find(FindingKind::overlap, overlap->amount, overlap->face);
        }
    }
    if (watch_.tick(arena_, state_, input)) {
        find(FindingKind::stuck, (state_.position - before.position).norm(), state_.ground_face);
    }
}

void Run::add_heat(std::vector<FaceHeat>& heat, const PlayerState& before, const PlayerInput& input) const {
    const bool held = state_.grounded || state_.climbing || state_.stuck;
    if (held && state_.ground_face < heat.size()) {
        FaceHeat& face = heat[state_.ground_face];
        ++face.visited;
        const double asked = input.wish.norm() * arena_.settings.walk_speed * options_.dt;
        if ((state_.position - before.position).norm() < 0.1 * asked) ++face.stuck;
    }
    if (!held && before.velocity.y() <= 0.0) {
        const auto below = sweep_ellipsoid(arena_.scene.collision, arena_.settings.radii, state_.position,
                                           Vec3(0.0, -near_ground, 0.0));
        if (below && below->face < heat.size() && below->normal.y() >= std::cos(arena_.settings.max_slope)) {
            ++heat[below->face].missed_ground;
        }
    }
}

void Run::walk(std::vector<FaceHeat>* heat) {
    const auto ticks = static_cast<std::uint64_t>(std::llround(options_.duration_s / options_.dt));
    const auto second = static_cast<std::uint64_t>(std::max(1.0, 1.0 / options_.dt));
    std::optional<HeatSink> sink;
    if (heat) sink.emplace(*heat, options_.dt);
    begin_life();
    Walker walker(options_.seed, number_, 0, options_.dt);
    while (steps < ticks && !stop_) {
        const PlayerInput input = walker.next();
        const PlayerState before = state_;
        state_ =
            step(arena_.scene, arena_.settings, before, input, options_.dt, sink ? &*sink : nullptr).state;
        ++steps;
        ++tick_;
        check(before, input);
        if (heat) add_heat(*heat, before, input);
        hash = state_hash(state_, hash);
        if (state_.hazard) {  // as simulate() does
            ++hazards;
            state_ = PlayerState{};
            state_.position = arena_.spawn;
            state_.jump_held = input.jump;
            watch_.begin(state_.position);
        }
        const Vec3& at = state_.position;
        const bool outside =
            (at.array() < arena_.bounds.min.array()).any() || (at.array() > arena_.bounds.max.array()).any();
        if (outside) {
            arena_.closed ? find(FindingKind::escape, (at - before.position).norm(), no_id) : void(++left);
            begin_life();
            walker = Walker(options_.seed, number_, static_cast<std::uint32_t>(lives - 1), options_.dt);
        }
        if (options_.progress && steps % second == 0 && !options_.progress(second)) stop_ = true;
    }
}

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
    const std::string place = "audit";
    if (level.mesh->triangle_count() == 0) return Error{place, "the level has no triangles"};
    if (options.walkers < 1 || options.walkers > 10'000'000)
        return Error{place, fmt::format("found {} walkers, expected 1 to 10000000", options.walkers)};
    if (!(options.dt >= 1e-4 && options.dt <= 0.25))
        return Error{place, fmt::format("found a step of {} s, expected 0.0001 to 0.25", options.dt)};
    if (!(options.duration_s >= options.dt &&
          options.duration_s / options.dt * options.walkers <= double(max_steps)))
        return Error{place,
                     fmt::format("found {} s a walker, expected at least one step and at most {} in all",
                                 options.duration_s, max_steps)};
    if (options.shard.count < 1 || options.shard.index >= options.shard.count)
        return Error{place, fmt::format("found shard {} of {}, expected an index below the count",
                                        options.shard.index, options.shard.count)};
    for (const double speed : options.speeds) {
        if (!(speed > 0.0 && speed <= find_setting("walk_speed")->maximum))
            return Error{place, fmt::format("found a speed of {} m/s, expected above 0 and at most {}", speed,
                                            find_setting("walk_speed")->maximum)};
    }
    return {};
}

}  // namespace

Result<AuditReport> run_audit(const Level& level, const AuditOptions& options) {
    if (Status status = check_options(level, options); !status.ok()) return status.error();
    const Result<CollisionWorld> world = build_collision_world(level);
    if (!world) return world.error();
    const MovementScene scene{*world, level.surfaces};
    if (const auto inside = overlaps_deeply(scene, level.movement, level.spawn))
        return Error{
            "audit",
            fmt::format("the spawn point lies inside face {}; every walker would begin stuck", inside->face)};

    AuditReport report;
    report.level_name = level.mesh_path.filename().string();
    report.level_fingerprint = level.mesh->fingerprint;
    report.settings_hash = settings_hash_of(level.movement);
    report.walkers = options.walkers;
    report.duration_s = options.duration_s;
    report.seed = options.seed;
    report.dt_text = options.dt_text;
    report.speeds = options.speeds;
    report.shard_count = options.shard.count;
    report.shards = {options.shard.index};
    report.closed = level_is_closed(*world, level.spawn);

    Aabb bounds = world->bounds();
    const double margin = level.movement.radii.maxCoeff() + 1.0;
    bounds.min.array() -= margin;
    bounds.max.array() += margin;
    if (!report.closed) bounds.max.y() += 1000.0;  // a jump from the highest roof leaves nothing

    const std::uint32_t count =
        (options.walkers + options.shard.count - 1 - options.shard.index) / options.shard.count;
    std::atomic<bool> stop = false;
    std::vector<Run> runs;
    std::vector<Arena> arenas;
    runs.reserve(count);
    arenas.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t number = options.shard.index + i * options.shard.count;
        MovementSettings settings = level.movement;
        settings.walk_speed = speed_of(options, settings, number);
        arenas.push_back({scene, settings, level.spawn, bounds, report.closed});
        runs.emplace_back(arenas.back(), options, number, stop);
    }
    // Heat is summed a block of walkers at a time: sums of whole numbers do not depend on the blocks.
    const std::size_t blocks = std::min<std::size_t>(count, 16);
    std::vector<std::vector<FaceHeat>> heats(options.heat ? blocks : 0);
    parallel_for(blocks, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t block = begin; block < end; ++block) {
            std::vector<FaceHeat>* heat = options.heat ? &heats[block] : nullptr;
            if (heat) heat->resize(level.mesh->face_count());
            for (std::size_t i = block; i < count; i += blocks)
                runs[i].walk(heat);
        }
    });

    for (const Run& run : runs) {
        report.steps += run.steps;
        report.lives += run.lives;
        report.hazards += run.hazards;
        report.left += run.left;
        report.hash += run.hash;
        for (const AuditFinding& finding : run.findings) {
            ++report.counts[static_cast<std::size_t>(finding.kind)];
            report.findings.push_back(finding);
        }
    }
    if (options.heat) report.heat.resize(level.mesh->face_count());
    for (const std::vector<FaceHeat>& heat : heats) {
        for (std::size_t face = 0; face < heat.size(); ++face) {
            report.heat[face].visited += heat[face].visited;
            report.heat[face].stuck += heat[face].stuck;
            report.heat[face].missed_ground += heat[face].missed_ground;
            report.heat[face].lost_mm_s += heat[face].lost_mm_s;
        }
    }
    report.cancelled = stop;
    return report;
}

Tape audit_tape(const Level& level, const AuditOptions& options, const AuditFinding& finding) {
    Tape tape;
    tape.level_name = level.mesh_path.filename().string();
    tape.level_fingerprint = level.mesh->fingerprint;
    tape.dt = options.dt;
    tape.dt_text = options.dt_text;
    tape.start = level.spawn;
    MovementSettings settings = level.movement;
    settings.walk_speed = speed_of(options, settings, finding.walker);
    for (const SettingInfo& info : settings_table())
        tape.settings.push_back(fmt::format("{}={}", info.name, setting_text(settings, info)));
    Walker walker(options.seed, finding.walker, finding.life, options.dt);
    for (std::uint64_t tick = 0; tick < finding.tick; ++tick)
        append_tick(tape, walker.next());
    return tape;
}

}  // namespace slipface
