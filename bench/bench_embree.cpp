// Builds and closest-hit rays through Embree 3 on the same meshes.
#include <benchmark/benchmark.h>

#include "embree_scene.h"

namespace slipface::bench {
namespace {

void embree_ray(benchmark::State& state) {
    const Level& scene = level(state.range(0));
    const EmbreeScene embree(scene.soup);
    const auto list = queries(scene, radii_of(false), static_cast<double>(state.range(1)) / 1000);
    std::size_t i = 0;
    for (auto _ : state)
        benchmark::DoNotOptimize(embree.ray(list[i++ & 4095]));
}
BENCHMARK(embree_ray)->Apply(ray_arguments);

void embree_build(benchmark::State& state) {
    const Level& scene = level(state.range(0));
    for (auto _ : state) {
        const EmbreeScene embree(scene.soup, false, static_cast<int>(state.range(1)));
        benchmark::DoNotOptimize(&embree);
    }
}
BENCHMARK(embree_build)->Apply(build_arguments)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace slipface::bench
