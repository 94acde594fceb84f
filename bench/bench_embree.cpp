// Build and closest-hit rays through Embree 3 on the same mesh.
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
BENCHMARK(embree_ray)->ArgNames({"triangles", "mm"})->ArgsProduct({{30000, 1000000}, {200, 2000, 20000}});

void embree_build(benchmark::State& state) {
    const Level& scene = level(state.range(0));
    for (auto _ : state) {
        const EmbreeScene embree(scene.soup);
        benchmark::DoNotOptimize(&embree);
    }
}
BENCHMARK(embree_build)
    ->ArgName("triangles")
    ->Arg(30000)
    ->Arg(1000000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace slipface::bench
