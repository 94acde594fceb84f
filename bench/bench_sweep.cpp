#include <benchmark/benchmark.h>

#include "bench_scenes.h"

namespace slipface::bench {
namespace {

void slipface_sweep(benchmark::State& state) {
    const Level& scene = level(state.range(0));
    const Vec3 radii = radii_of(state.range(2) != 0);
    const auto list = queries(scene, radii, static_cast<double>(state.range(1)) / 1000);
    std::size_t i = 0;
    std::size_t hits = 0;
    for (auto _ : state) {
        const Query& query = list[i++ & 4095];
        const auto contact = sweep_ellipsoid(scene.world, radii, query.from, query.move);
        hits += contact.has_value();
        benchmark::DoNotOptimize(contact);
    }
    state.counters["hits"] = static_cast<double>(hits) / static_cast<double>(state.iterations());
}
BENCHMARK(slipface_sweep)->Apply(sweep_arguments);

void slipface_overlap(benchmark::State& state) {
    const Level& scene = level(state.range(0));
    const Vec3 radii = radii_of(true);
    const auto list = queries(scene, radii, 1);
    std::size_t i = 0;
    for (auto _ : state)
        benchmark::DoNotOptimize(overlaps_any(scene.world, radii, list[i++ & 4095].from));
}
BENCHMARK(slipface_overlap)->ArgName("triangles")->Arg(30000)->Arg(1000000);

void slipface_closest(benchmark::State& state) {
    const Level& scene = level(state.range(0));
    const auto list = queries(scene, radii_of(true), 1);
    std::size_t i = 0;
    for (auto _ : state)
        benchmark::DoNotOptimize(closest_point(scene.world, list[i++ & 4095].from));
}
BENCHMARK(slipface_closest)->ArgName("triangles")->Arg(30000)->Arg(1000000);

void slipface_ray(benchmark::State& state) {
    const Level& scene = level(state.range(0));
    const auto list = queries(scene, radii_of(false), static_cast<double>(state.range(1)) / 1000);
    std::size_t i = 0;
    for (auto _ : state) {
        const Query& query = list[i++ & 4095];
        benchmark::DoNotOptimize(cast_ray(scene.world, query.from, query.move, 1.0));
    }
}
BENCHMARK(slipface_ray)->ArgNames({"triangles", "mm"})->ArgsProduct({{30000, 1000000}, {200, 2000, 20000}});

void slipface_build(benchmark::State& state) {
    const Level& scene = level(state.range(0));
    for (auto _ : state) {
        auto world = CollisionWorld::build(scene.soup.view());
        benchmark::DoNotOptimize(world);
    }
    const BvhStatistics statistics = scene.world.statistics();
    const auto triangles = static_cast<double>(statistics.triangles);
    state.counters["bytes_a_triangle"] = static_cast<double>(statistics.bytes) / triangles;
    state.counters["depth"] = statistics.depth;
    state.counters["nodes_a_1000"] = 1000 * static_cast<double>(statistics.nodes) / triangles;
}
BENCHMARK(slipface_build)
    ->ArgName("triangles")
    ->Arg(30000)
    ->Arg(1000000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace slipface::bench
