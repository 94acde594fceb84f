// The same sweeps through Bullet 3.
#include <benchmark/benchmark.h>

#include "bullet_level.h"

namespace slipface::bench {
namespace {

const BulletLevel& bullet_level(std::int64_t triangles) {
    static std::map<std::int64_t, BulletLevel> levels;
    return levels.try_emplace(triangles, level(triangles).soup).first->second;
}

void bullet_sweep(benchmark::State& state) {
    const BulletLevel& bullet = bullet_level(state.range(0));
    const bool ellipsoid = state.range(2) != 0;
    const auto list =
        queries(level(state.range(0)), radii_of(ellipsoid), static_cast<double>(state.range(1)) / 1000);
    const auto shape = bullet_shape(ellipsoid);
    std::size_t i = 0;
    std::size_t hits = 0;
    for (auto _ : state)
        hits += bullet.sweep(*shape, list[i++ & 4095]);
    state.counters["hits"] = static_cast<double>(hits) / static_cast<double>(state.iterations());
}
BENCHMARK(bullet_sweep)->Apply(sweep_arguments);

}  // namespace
}  // namespace slipface::bench
