// The levels and queries of docs/performance-tables.md as Google Benchmark programs: single sweeps, batches
// on one thread, rays, points, and builds on one and two threads.
#include <benchmark/benchmark.h>

#include "bench_scenes.h"
#include "slipface/base/parallel.h"

namespace slipface::bench {
namespace {

void slipface_sweep(benchmark::State& state) {
    const SweepTask task(state);
    std::size_t i = 0;
    std::size_t hits = 0;
    for (auto _ : state) {
        const Query& query = task.list[i++ & 4095];
        const auto contact = sweep_ellipsoid(task.scene.world, task.radii, query.from, query.move);
        hits += contact.has_value();
        benchmark::DoNotOptimize(contact);
    }
    state.counters["hits"] = static_cast<double>(hits) / static_cast<double>(state.iterations());
}
BENCHMARK(slipface_sweep)->Apply(sweep_arguments);

// All queries per iteration; items_per_second counts single sweeps.
void slipface_sweep_batch(benchmark::State& state) {
    const SweepTask task(state);
    const ThreadLimit one(1);
    std::vector<Sweep> sweeps;
    for (const Query& query : task.list)
        sweeps.push_back({task.radii, query.from, query.move});
    std::vector<std::optional<Contact>> contacts(sweeps.size());
    for (auto _ : state) {
        sweep_ellipsoids(task.scene.world, sweeps, contacts);
        benchmark::DoNotOptimize(contacts.data());
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(sweeps.size()));
}
BENCHMARK(slipface_sweep_batch)->Apply(sweep_arguments);

void slipface_overlap(benchmark::State& state) {
    const Level& scene = level(state.range(0));
    const Vec3 radii = radii_of(true);
    const auto list = queries(scene, radii, 1);
    std::size_t i = 0;
    for (auto _ : state)
        benchmark::DoNotOptimize(overlaps_any(scene.world, radii, list[i++ & 4095].from));
}
BENCHMARK(slipface_overlap)->ArgName("triangles")->ArgsProduct({size_arguments()});

void slipface_closest(benchmark::State& state) {
    const Level& scene = level(state.range(0));
    const auto list = queries(scene, radii_of(true), 1);
    std::size_t i = 0;
    for (auto _ : state)
        benchmark::DoNotOptimize(closest_point(scene.world, list[i++ & 4095].from));
}
BENCHMARK(slipface_closest)->ArgName("triangles")->ArgsProduct({size_arguments()});

void slipface_ray(benchmark::State& state) {
    const Level& scene = level(state.range(0));
    const auto list = queries(scene, radii_of(false), static_cast<double>(state.range(1)) / 1000);
    std::size_t i = 0;
    for (auto _ : state) {
        const Query& query = list[i++ & 4095];
        benchmark::DoNotOptimize(cast_ray(scene.world, query.from, query.move, 1.0));
    }
}
BENCHMARK(slipface_ray)->Apply(ray_arguments);

void slipface_build(benchmark::State& state) {
    const Level& scene = level(state.range(0));
    const ThreadLimit limit(static_cast<int>(state.range(1)));
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
BENCHMARK(slipface_build)->Apply(build_arguments)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace slipface::bench
