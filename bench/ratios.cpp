// Prints how fast the engine is compared with Bullet 3, Embree 3, and ODE and FCL if they are there: the same
// queries on the same mesh in the same run, in alternation, so that disturbances affect both. Each engine
// first makes the queries of a round once unmeasured, because a game queries it every tick. Each figure is
// the median over the rounds of processor time of one thread, and each ratio the median of the ratios of the
// rounds. Only builds on two threads are measured in elapsed time.
#include <fmt/core.h>
#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "bullet_level.h"
#include "embree_scene.h"
#ifdef SLIPFACE_FCL
#include "fcl_level.h"
#endif
#ifdef SLIPFACE_ODE
#include "ode_level.h"
#endif
#include "slipface/base/parallel.h"
#include "slipface/collision/simd.h"
#include "timing.h"

namespace slipface::bench {
namespace {

constexpr int rounds = 5;

volatile double sink = 0.0;

template <class Answer>
auto over(const std::vector<Query>& list, Answer&& answer) {
    return [&list, answer] {
        double sum = 0.0;
        for (const Query& query : list)
            sum += answer(query);
        sink = sum;
    };
}

// Fewer of the long queries, which are slow in Bullet.
std::vector<Query> some_queries(const Level& level, const Vec3& radii, double length) {
    std::vector<Query> list = queries(level, radii, length);
    list.resize(length > 2.0 ? 1024 : 2048);
    return list;
}

// Nanoseconds per query.
template <class Work>
double clock(std::size_t count, Work&& work, double (*now)() = seconds) {
    work();
    const double start = now();
    work();
    return 1e9 * (now() - start) / static_cast<double>(count);
}

struct Pair {
    double mine;  // nanoseconds
    double other;
    double ratio;  // other / mine
};

template <class Mine, class Other>
Pair race(std::size_t count, Mine&& mine, Other&& other, double (*now)() = seconds) {
    std::vector<double> a;
    std::vector<double> b;
    std::vector<double> ratio;
    for (int round = 0; round < rounds; ++round) {
        a.push_back(clock(count, mine, now));
        b.push_back(clock(count, other, now));
        ratio.push_back(b.back() / a.back());
    }
    return {median(a), median(b), median(ratio)};
}

// Single sweeps, and a batch on the same thread.
void sweeps(Kind kind, bool ellipsoid) {
    // A batch uses all available threads; here it may use one.
    const ThreadLimit one(1);
    const Vec3 radii = radii_of(ellipsoid);
    fmt::print("\n{}, sweeps of {}: ns one by one and as a batch, and how many times Bullet's rate\n\n",
               kind == Kind::rooms ? "Rooms" : "Open ground", ellipsoid ? "an ellipsoid" : "a sphere");
    fmt::print("| triangles |");
    for (const double length : lengths)
        fmt::print(" {:>26} |", fmt::format("{} m", length));
    fmt::print("\n|----------:|");
    for ([[maybe_unused]] const double length : lengths)
        fmt::print("---------------------------:|");
    fmt::print("\n");
    double alone_logs[4] = {};
    double batch_logs[4] = {};
    const auto shape = bullet_shape(ellipsoid);
    for (const std::int64_t size : sizes) {
        const Level& scene = level(size, kind);
        const BulletLevel bullet(scene.soup);
        fmt::print("| {:>9} |", scene.soup.triangles.size());
        for (std::size_t k = 0; k < 4; ++k) {
            const auto list = some_queries(scene, radii, lengths[k]);
            std::vector<Sweep> batch;
            for (const Query& query : list)
                batch.push_back({radii, query.from, query.move});
            std::vector<std::optional<Contact>> contacts(batch.size());
            const auto alone = over(list, [&](const Query& q) {
                const auto c = sweep_ellipsoid(scene.world, radii, q.from, q.move);
                return c ? c->t : 1.0;
            });
            const auto theirs =
                over(list, [&](const Query& q) { return bullet.sweep(*shape, q) ? 1.0 : 0.0; });
            std::vector<double> a, b, a_ratio, b_ratio;
            for (int round = 0; round < rounds; ++round) {
                a.push_back(clock(list.size(), alone));
                b.push_back(clock(list.size(), [&] { sweep_ellipsoids(scene.world, batch, contacts); }));
                const double other = clock(list.size(), theirs);
                a_ratio.push_back(other / a.back());
                b_ratio.push_back(other / b.back());
            }
            alone_logs[k] += std::log(median(a_ratio)) / static_cast<double>(std::size(sizes));
            batch_logs[k] += std::log(median(b_ratio)) / static_cast<double>(std::size(sizes));
            fmt::print(" {:>5.0f} {:>6.1f}x {:>5.0f} {:>6.1f}x |", median(a), median(a_ratio), median(b),
                       median(b_ratio));
            std::fflush(stdout);
        }
        fmt::print("\n");
    }
    fmt::print("| geo. mean |");
    for (std::size_t k = 0; k < 4; ++k)
        fmt::print(" {:>12.1f}x {:>12.1f}x |", std::exp(alone_logs[k]), std::exp(batch_logs[k]));
    fmt::print("\n");
}

// A batch beside the same sweeps one by one. SLIPFACE_SIMD chooses the instruction set.
void batches() {
    const ThreadLimit one(1);
    fmt::print("\nTime of a batch over that of single sweeps, sphere\n\n| level | triangles |");
    for (const double length : lengths)
        fmt::print(" {} m |", length);
    fmt::print("\n|---|---:|---:|---:|---:|---:|\n");
    const Vec3 radii = radii_of(false);
    for (const auto kind : {Kind::rooms, Kind::ground}) {
        for (const std::int64_t size : sizes) {
            const Level& scene = level(size, kind);
            fmt::print("| {} | {} |", kind == Kind::rooms ? "rooms" : "ground", scene.soup.triangles.size());
            for (const double length : lengths) {
                const auto list = queries(scene, radii, length);
                std::vector<Sweep> batch;
                for (const Query& query : list)
                    batch.push_back({radii, query.from, query.move});
                std::vector<std::optional<Contact>> contacts(batch.size());
                const Pair pair = race(
                    list.size(), [&] { sweep_ellipsoids(scene.world, batch, contacts); },
                    over(list, [&](const Query& q) {
                        const auto c = sweep_ellipsoid(scene.world, radii, q.from, q.move);
                        return c ? c->t : 1.0;
                    }));
                fmt::print(" {:.2f} |", 1.0 / pair.ratio);
                std::fflush(stdout);
            }
            fmt::print("\n");
        }
    }
}

void rays() {
    fmt::print(
        "\nClosest-hit rays: ns, our time over Embree's, and over Embree's in robust mode\n\n| triangles |");
    for (const double length : lengths)
        fmt::print(" {:>20} |", fmt::format("{} m", length));
    fmt::print("\n|----------:|");
    for ([[maybe_unused]] const double length : lengths)
        fmt::print("---------------------:|");
    fmt::print("\n");
    for (const std::int64_t size : sizes) {
        const Level& scene = level(size);
        const EmbreeScene embree(scene.soup);
        const EmbreeScene robust(scene.soup, true);
        fmt::print("| {:>9} |", scene.soup.triangles.size());
        for (const double length : lengths) {
            const auto list = some_queries(scene, radii_of(false), length);
            const auto mine = over(list, [&](const Query& q) {
                const auto hit = cast_ray(scene.world, q.from, q.move, 1.0);
                return hit ? hit->t : 1.0;
            });
            const Pair pair =
                race(list.size(), mine, over(list, [&](const Query& q) { return double{embree.ray(q)}; }));
            const Pair robust_pair =
                race(list.size(), mine, over(list, [&](const Query& q) { return double{robust.ray(q)}; }));
            fmt::print(" {:>6.0f} {:>5.2f}x {:>5.2f}x |", pair.mine, 1.0 / pair.ratio,
                       1.0 / robust_pair.ratio);
            std::fflush(stdout);
        }
        fmt::print("\n");
    }
}

// How many times the time of ours another takes, or a dash where it is not there.
template <class Engine, class Ours, class Theirs>
void print_peer(const scenes::Soup& soup, std::size_t count, const Ours& ours, const Theirs& theirs) {
    const Engine engine(soup);
    fmt::print(" {:>6.1f}x |", race(count, ours, theirs(engine)).ratio);
    std::fflush(stdout);
}

// What the engines that sweep nothing have in common with ours.
void touches() {
    fmt::print(
        "\nA sphere that touches the level or not, and closest-hit rays of 20 m: ns, and how many times the "
        "rate of others\n\n"
        "| level | triangles | touch, ns | Bullet | ODE | FCL | ray, ns | ODE |\n"
        "|---|---:|---:|---:|---:|---:|---:|---:|\n");
    const Vec3 radii = radii_of(false);
    for (const auto kind : {Kind::rooms, Kind::ground}) {
        for (const std::int64_t size : {10000, 100000, 1000000}) {
            const Level& scene = level(size, kind);
            // From free places by 1 m: some touch and some do not.
            const auto list = some_queries(scene, radii, 1.0);
            const auto touch = over(list, [&](const Query& q) {
                return overlaps_any(scene.world, radii, q.from + q.move) ? 1.0 : 0.0;
            });
            const auto touches_of = [&list](const auto& engine) {
                return over(
                    list, [&engine](const Query& q) { return engine.overlaps(q.from + q.move) ? 1.0 : 0.0; });
            };
            fmt::print("| {} | {} | {:.0f} |", kind == Kind::rooms ? "rooms" : "ground",
                       scene.soup.triangles.size(), clock(list.size(), touch));
            print_peer<BulletLevel>(scene.soup, list.size(), touch, touches_of);
#ifdef SLIPFACE_ODE
            print_peer<OdeLevel>(scene.soup, list.size(), touch, touches_of);
#else
            fmt::print(" - |");
#endif
#ifdef SLIPFACE_FCL
            print_peer<FclLevel>(scene.soup, list.size(), touch, touches_of);
#else
            fmt::print(" - |");
#endif
            const auto long_list = some_queries(scene, radii, 20.0);
            const auto ray = over(long_list, [&](const Query& q) {
                const auto hit = cast_ray(scene.world, q.from, q.move, 1.0);
                return hit ? hit->t : 1.0;
            });
            fmt::print(" {:.0f} |", clock(long_list.size(), ray));
#ifdef SLIPFACE_ODE
            print_peer<OdeLevel>(scene.soup, long_list.size(), ray, [&long_list](const OdeLevel& engine) {
                return over(long_list, [&engine](const Query& q) { return engine.ray(q); });
            });
#else
            fmt::print(" - |");
#endif
            fmt::print("\n");
        }
    }
}

// Both use the same number of threads.
Pair build_race(const Level& scene, int threads) {
    const ThreadLimit limit(threads);
    tbb::task_arena arena(threads);
    return arena.execute([&] {
        return race(
            1,
            [&] {
                const auto world = CollisionWorld::build(scene.soup.view());
                sink = world->bounds().min.x();
            },
            [&] {
                const EmbreeScene embree(scene.soup, false, threads);
                sink = double{embree.ray({Vec3::Zero(), Vec3::UnitX()})};
            },
            threads == 1 ? seconds : wall_seconds);
    });
}

void builds() {
    fmt::print(
        "\nBuild: ms, our time over Embree's (medium) on one thread and on two; bytes per triangle\n\n"
        "| triangles | 1 thread |  Embree |  ratio | 2 threads |  Embree |  ratio |  bytes |"
        " closest point, ns | overlap, ns |\n"
        "|----------:|---------:|--------:|-------:|----------:|--------:|-------:|-------:|"
        "------------------:|------------:|\n");
    for (const std::int64_t size : sizes) {
        const Level& scene = level(size);
        const Pair one = build_race(scene, 1);
        const Pair two = build_race(scene, 2);
        const auto list = some_queries(scene, radii_of(true), 1);
        const Pair rest =
            race(list.size(),
                 over(list, [&](const Query& q) { return closest_point(scene.world, q.from)->distance; }),
                 over(list, [&](const Query& q) {
                     return overlaps_any(scene.world, radii_of(true), q.from) ? 1.0 : 0.0;
                 }));
        const BvhStatistics statistics = scene.world.statistics();
        fmt::print(
            "| {:>9} | {:>8.2f} | {:>7.2f} | {:>5.2f}x | {:>9.2f} | {:>7.2f} | {:>5.2f}x | {:>6.1f} |"
            " {:>17.0f} | {:>11.0f} |\n",
            statistics.triangles, one.mine * 1e-6, one.other * 1e-6, 1.0 / one.ratio, two.mine * 1e-6,
            two.other * 1e-6, 1.0 / two.ratio,
            static_cast<double>(statistics.bytes) / static_cast<double>(statistics.triangles), rest.mine,
            rest.other);
        std::fflush(stdout);
    }
}

}  // namespace
}  // namespace slipface::bench

// Without arguments all tables, otherwise the named ones: sweeps, batches, rays, touches, builds.
int main(int count, char** arguments) {
    using namespace slipface::bench;
    const auto wanted = [&](std::string_view table) {
        return count == 1 || std::find(arguments + 1, arguments + count, table) != arguments + count;
    };
    fmt::print("SIMD: {}\n", slipface::simd_path());
    for (const auto kind : {Kind::rooms, Kind::ground}) {
        if (!wanted("sweeps")) break;
        sweeps(kind, false);
        sweeps(kind, true);
    }
    if (wanted("batches")) batches();
    if (wanted("rays")) rays();
    if (wanted("touches")) touches();
    if (wanted("builds")) builds();
    return 0;
}
