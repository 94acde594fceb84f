// slipface_audit_rate LEVEL...: compares the steps per second of an audit with those of bare steps: the same
// number of walkers with the same wishes, on one thread, in alternation, so that disturbances affect both.
// Each figure is the median of processor time over the rounds; the fraction is the median of the fractions of
// the rounds.
#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "slipface/base/parallel.h"
#include "slipface/level/level_file.h"
#include "slipface/level/level_scene.h"
#include "slipface/sim/audit.h"
#include "slipface/sim/simulate.h"
#include "timing.h"

namespace slipface::bench {
namespace {

constexpr int rounds = 5;

using Wishes = std::vector<std::vector<PlayerInput>>;  // [walker][tick]

Wishes wishes_of(const Level& level, const AuditOptions& options) {
    const auto ticks = static_cast<std::uint64_t>(std::llround(options.duration_s / options.dt));
    Wishes wishes;
    for (std::uint32_t walker = 0; walker < options.walkers; ++walker) {
        std::vector<PlayerInput>& list = wishes.emplace_back();
        const Tape tape = audit_tape(level, options, {.walker = walker, .tick = ticks});
        for (const TapeSegment& segment : tape.segments)
            list.insert(list.end(), static_cast<std::size_t>(segment.ticks), segment.input);
    }
    return wishes;
}

// Makes only steps; a walker that leaves the level continues from the spawn point. If something in the level
// moves, all walkers advance tick by tick together, as in audits. Returns the number of steps.
double only_step(const Level& level, LevelScene& moving, const AuditOptions& options, const Wishes& wishes) {
    const TickScene scene(moving);
    const PlayerState spawn = scene.player_at(level.spawn);
    const Aabb bounds = scene.at(0, options.dt).collision.bounds();
    const std::size_t together = moving.is_static() ? 1 : wishes.size();
    double steps = 0.0;
    for (std::size_t first = 0; first < wishes.size(); first += together) {
        std::vector<PlayerState> states(together, spawn);
        for (std::size_t tick = 0; tick < wishes[first].size(); ++tick) {
            const MovementScene now = scene.at(tick, options.dt);
            for (std::size_t i = 0; i < together; ++i) {
                PlayerState& state = states[i];
                state = step(now, level.movement, state, wishes[first + i][tick], options.dt).state;
                const Vec3 at = position_in_scene(now, state);
                const bool left = (at.array() < bounds.min.array() - 2.0).any() ||
                                  (at.array() > bounds.max.array() + 2.0).any();
                if (left || state.hazard) state = spawn;
            }
        }
        steps += static_cast<double>(together * wishes[first].size());
    }
    return steps;
}

int measure(const char* path) {
    const Result<LoadedLevel> loaded = load_level(path);
    if (!loaded) return fmt::print(stderr, "{}\n", loaded.error().text()), 1;
    const Level& level = loaded->level;
    AuditOptions options;
    options.walkers = 64;
    options.duration_s = 60.0;
    Result<LevelScene> scene = LevelScene::build(level);
    if (!scene) return fmt::print(stderr, "{}\n", scene.error().text()), 1;
    const Wishes wishes = wishes_of(level, options);
    std::vector<double> audits, steps, fractions;
    for (int round = 0; round <= rounds; ++round) {
        const double start = seconds();
        const Result<AuditReport> report = run_audit(level, options);
        const double middle = seconds();
        const double made = only_step(level, *scene, options, wishes);
        const double end = seconds();
        if (!report) return fmt::print(stderr, "{}\n", report.error().text()), 1;
        if (round == 0) continue;  // warms the caches
        audits.push_back(static_cast<double>(report->steps) / (middle - start));
        steps.push_back(made / (end - middle));
        fractions.push_back(audits.back() / steps.back());
    }
    fmt::print("| {} | {:.2f} | {:.2f} | {:.0f} % |\n", level.mesh_path.stem().string(), median(steps) / 1e6,
               median(audits) / 1e6, 100.0 * median(fractions));
    std::fflush(stdout);
    return 0;
}

}  // namespace
}  // namespace slipface::bench

int main(int count, char** words) {
    const slipface::ThreadLimit one(1);
    fmt::print("| level | steps, M/s | audit, M/s | share |\n|---|---:|---:|---:|\n");
    int failed = 0;
    for (int i = 1; i < count; ++i)
        failed |= slipface::bench::measure(words[i]);
    return failed;
}
