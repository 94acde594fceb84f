// The sweeps of bench_sweep.cpp through Bullet 3.
#include <benchmark/benchmark.h>

#include "bullet_level.h"

namespace slipface::bench {
namespace {

const BulletLevel& bullet_level(const Level& level) {
    static std::map<const Level*, BulletLevel> levels;
    return levels.try_emplace(&level, level.soup).first->second;
}

void bullet_sweep(benchmark::State& state) {
    const SweepTask task(state);
    const BulletLevel& bullet = bullet_level(task.scene);
    const auto shape = bullet_shape(state.range(2) != 0);
    std::size_t i = 0;
    std::size_t hits = 0;
    for (auto _ : state)
        hits += bullet.sweep(*shape, task.list[i++ & 4095]);
    state.counters["hits"] = static_cast<double>(hits) / static_cast<double>(state.iterations());
}
BENCHMARK(bullet_sweep)->Apply(sweep_arguments);

}  // namespace
}  // namespace slipface::bench
