// slipface_reach_coverage SECONDS LEVEL...: what a search of so many seconds of processor time reaches on one
// thread, when it had 95 and 100 % of that, what random walkers reach by as many steps, and the step rate of
// the search beside nothing but the steps of the ways that it found.
#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "slipface/base/parallel.h"
#include "slipface/level/find_start.h"
#include "slipface/level/level_file.h"
#include "slipface/reach/report.h"
#include "slipface/sim/audit.h"
#include "timing.h"

namespace slipface::bench {
namespace {

// Steps per second of the ways to all faces, and nothing else.
double bare_rate(const ReachSearch& search) {
    LevelScene scene = LevelScene::build(search.level()).value();
    const TickScene ticks(scene);
    const RunStart start = run_start(ticks, search.start());
    const double begin = seconds();
    double steps = 0.0;
    for (std::size_t face = 0; face < search.faces().size() && seconds() - begin < 3.0; face += 7) {
        if (!search.faces()[face].found()) continue;
        PlayerState state = start.player;
        std::size_t tick = 0;
        for (const Press& press : search.archive().way_to(search.faces()[face].node)) {
            for (std::uint16_t i = 0; i < press.ticks; ++i, ++tick, ++steps)
                state = step(ticks.at(tick, search.options().dt), search.level().movement, state,
                             input_of(press), search.options().dt)
                            .state;
        }
    }
    return steps / (seconds() - begin);
}

std::size_t walkers_reach(const Level& level, std::uint64_t steps, const std::vector<FaceId>& walkable) {
    AuditOptions options;
    options.duration_s = 60.0;
    options.walkers = static_cast<std::uint32_t>(std::max<std::uint64_t>(1, steps / 3600));
    options.heat = true;
    const Result<AuditReport> report = run_audit(level, options);
    std::size_t reached = 0;
    for (const FaceId face : walkable)
        reached += report && report->heat[face].stood > 0 ? 1 : 0;
    return reached;
}

int measure(const char* path, double duration) {
    Result<LoadedLevel> loaded = load_level(path);
    if (!loaded) return fmt::print(stderr, "{}\n", loaded.error().text()), 1;
    Level& level = loaded->level;
    const Result<Start> start = settle_start(level);
    if (!start) return fmt::print(stderr, "{}\n", start.error().text()), 1;
    Result<ReachSearch> search = ReachSearch::begin(level, start->position, {});
    if (!search) return fmt::print(stderr, "{}\n", search.error().text()), 1;
    std::vector<std::pair<double, std::size_t>> curve;  // time, faces
    const double begin = seconds();
    std::size_t faces = 0;
    while (seconds() - begin < duration && !search->exhausted()) {
        ReachLimits limits;
        limits.rounds = search->rounds().size() + 1;
        search->run(limits);
        faces += search->rounds().back().faces;
        curve.emplace_back(seconds() - begin, faces);
    }
    const double took = seconds() - begin;
    const auto when = [&](double fraction) {
        for (const auto& [time, count] : curve)
            if (static_cast<double>(count) >= fraction * static_cast<double>(faces)) return time;
        return took;
    };
    const ReachReport report = make_reach_report(*search);
    const std::size_t reached = report.walkable.size() - report.unreached.size();
    const double rate = static_cast<double>(search->steps()) / took, bare = bare_rate(*search);
    const double beside = static_cast<double>(report.bytes) / static_cast<double>(report.nodes) -
                          static_cast<double>(sizeof(PlayerState));
    fmt::print(
        "| {} | {} of {} | {} | {:.1f} | {:.0f} s | {:.0f} s | {:.2f} | {:.2f} | {:.0f} % | {:.0f} |\n",
        level.mesh_path.stem().string(), reached, report.walkable.size(),
        walkers_reach(level, search->steps(), report.walkable), static_cast<double>(search->steps()) / 1e6,
        when(0.95), when(0.99), rate / 1e6, bare / 1e6, 100.0 * rate / bare, beside);
    std::fflush(stdout);
    return 0;
}

}  // namespace
}  // namespace slipface::bench

int main(int count, char** words) {
    const slipface::ThreadLimit one(1);
    fmt::print(
        "| level | walkable faces reached | by random walkers | steps, M | 95 % after | 99 % after | search, "
        "M/s | bare, M/s | search / bare | bytes |\n|---|---|---:|---:|---:|---:|---:|---:|---:|---:|\n");
    int failed = 0;
    for (int i = 2; i < count; ++i)
        failed |= slipface::bench::measure(words[i], std::atof(words[1]));
    return failed;
}
