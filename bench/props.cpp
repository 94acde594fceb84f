// slipface_props [INSTANCES]: instances of 20 meshes beside the same triangles in one tree: memory, and the
// same queries in turns, in processor time of one thread (docs/performance-tables.md, "Props").
#include <fmt/core.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "collision/instanced.h"
#include "slipface/collision/neighbourhood.h"
#include "slipface/collision/simd.h"
#include "timing.h"

namespace slipface::bench {
namespace {

constexpr int rounds = 7;
volatile double sink = 0.0;

// A boulder: a sphere of rows x columns quads whose radius changes from place to place.
scenes::Soup boulder(scenes::Random& random, std::size_t rows, std::size_t columns) {
    scenes::Soup soup;
    const double a = random.uniform(1, 4), b = random.uniform(1, 4), deep = random.uniform(0.05, 0.3);
    const auto at = [&](std::size_t row, std::size_t column) {
        const double up =
            3.141592653589793 * static_cast<double>(row) / static_cast<double>(rows) - 1.5707963;
        const double around =
            6.283185307179586 * static_cast<double>(column % columns) / static_cast<double>(columns);
        const double radius = 1.0 + deep * std::sin(a * 3 * up) * std::cos(std::round(b) * around);
        return Vec3(radius * std::cos(up) * std::cos(around), radius * std::sin(up),
                    radius * std::cos(up) * std::sin(around));
    };
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = 0; column < columns; ++column)
            soup.add_quad(at(row, column), at(row + 1, column), at(row + 1, column + 1), at(row, column + 1));
    return scenes::dense(std::move(soup));
}

struct Query {
    Vec3 from, move;
};

template <class Answer>
double clock(const std::vector<Query>& list, const CollisionWorld& world, const Answer& answer) {
    double sum = 0.0;
    const double start = seconds();
    for (const Query& query : list)
        sum += answer(world, query);
    sink = sum;
    return (seconds() - start) / static_cast<double>(list.size());
}

template <class Answer>
void row(const char* name, const std::vector<Query>& list, const CollisionWorld& shared,
         const CollisionWorld& flat, const Answer& answer) {
    std::vector<double> a, b, ratios;
    for (int round = 0; round <= rounds; ++round) {
        const double mine = clock(list, shared, answer), other = clock(list, flat, answer);
        if (round == 0) continue;  // warms up
        a.push_back(mine);
        b.push_back(other);
        ratios.push_back(mine / other);
    }
    fmt::print("| {} | {:.0f} ns | {:.0f} ns | {:.2f} |\n", name, 1e9 * median(a), 1e9 * median(b),
               median(ratios));
}

double process_seconds() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// The same sweeps in a batch and one by one, in processor time of all threads.
void batch_row(const char* name, const std::vector<Query>& list, const CollisionWorld& world) {
    std::vector<Sweep> sweeps;
    for (const Query& query : list)
        sweeps.push_back({{0.4, 0.9, 0.4}, query.from, query.move});
    std::vector<std::optional<Contact>> out(sweeps.size());
    std::vector<double> a, b, ratios;
    for (int round = 0; round <= rounds; ++round) {
        const double start = process_seconds();
        sweep_ellipsoids(world, sweeps, out);
        const double middle = process_seconds();
        for (std::size_t i = 0; i < sweeps.size(); ++i)
            out[i] = sweep_ellipsoid(world, sweeps[i].radii, sweeps[i].from, sweeps[i].move);
        const double end = process_seconds();
        if (round == 0) continue;
        a.push_back((middle - start) / static_cast<double>(sweeps.size()));
        b.push_back((end - middle) / static_cast<double>(sweeps.size()));
        ratios.push_back(a.back() / b.back());
    }
    fmt::print("| {} | {:.0f} ns | {:.0f} ns | {:.2f} |\n", name, 1e9 * median(a), 1e9 * median(b),
               median(ratios));
}

int run(std::size_t instances) {
    scenes::Random random(81);
    std::vector<scenes::Soup> meshes;
    for (std::size_t i = 0; i < 20; ++i)
        meshes.push_back(boulder(random, 8 + i, 16 + i));
    scenes::Instanced scene({}, meshes);
    // In the open, one on about ten square metres.
    const double half = std::sqrt(10.0 * static_cast<double>(instances)) / 2;
    std::vector<Vec3> places;
    for (std::size_t i = 0; i < instances; ++i) {
        const Vec3 at(random.uniform(-half, half), random.uniform(-0.5, 1), random.uniform(-half, half));
        places.push_back(at);
        scene.add(i % meshes.size(), placement(at, random.in_box(3), scenes::random_scale(random, 1.7)));
    }
    const double begin = seconds();
    const CollisionWorld shared = scene.world();
    const double built = seconds();
    const CollisionWorld flat = scene.flat().world();
    const double both = seconds();
    std::size_t own = 0;
    for (const scenes::Soup& mesh : meshes)
        own += mesh.world().statistics().bytes;
    fmt::print("{} instances, {} triangles, {}\n", instances, flat.triangle_count(), simd_path());
    fmt::print("20 meshes alone {:.2f} MB, shared {:.2f} MB ({:.0f} bytes per instance), flat {:.0f} MB\n",
               1e-6 * static_cast<double>(own), 1e-6 * static_cast<double>(shared.statistics().bytes),
               static_cast<double>(shared.statistics().bytes - own) / static_cast<double>(instances),
               1e-6 * static_cast<double>(flat.statistics().bytes));
    fmt::print("built in {:.2f} s and {:.2f} s\n", built - begin, both - built);

    const auto list_of = [&](double length) {
        std::vector<Query> list;
        while (list.size() < 4000) {
            const Vec3 from = places[random.below(places.size())] + random.in_box(2.5);
            if (!overlaps_any(flat, {0.4, 0.9, 0.4}, from))
                list.push_back({from, length * random.direction()});
        }
        return list;
    };
    fmt::print("| query | instances | one tree | ratio |\n|---|---|---|---|\n");
    const auto sweep = [](const CollisionWorld& world, const Query& query) {
        const auto hit = sweep_ellipsoid(world, {0.4, 0.9, 0.4}, query.from, query.move);
        return hit ? hit->t : 0.0;
    };
    for (const double length : {0.2, 2.0, 20.0})
        row(fmt::format("sweep of {} m", length).c_str(), list_of(length), shared, flat, sweep);
    row("ray of 20 m", list_of(20.0), shared, flat, [](const CollisionWorld& world, const Query& query) {
        const auto hit = cast_ray(world, query.from, query.move, 1.0);
        return hit ? hit->t : 0.0;
    });
    const std::vector<Query> near = list_of(0.2);
    row("closest point", near, shared, flat, [](const CollisionWorld& world, const Query& query) {
        const auto found = closest_point(world, query.from);
        return found ? found->distance : 0.0;
    });
    row("neighbourhood and six sweeps", near, shared, flat,
        [](const CollisionWorld& world, const Query& query) {
            const Vec3 radii(0.4, 0.9, 0.4);
            const Neighbourhood around(world, radii, query.from, Vec3::Constant(0.5));
            double sum = 0.0;
            for (int i = 0; i < 6; ++i)
                if (const auto hit = sweep_ellipsoid(around, radii, query.from, query.move)) sum += hit->t;
            return sum;
        });
    fmt::print("| in a batch | batch | one by one | ratio |\n|---|---|---|---|\n");
    for (const double length : {0.2, 2.0, 20.0})
        batch_row(fmt::format("sweep of {} m", length).c_str(), list_of(length), shared);
    // With a floor of triangles of its own below the instances.
    scenes::Soup floor;
    for (int i = 0; i < 200; ++i)
        for (int k = 0; k < 200; ++k) {
            const double x = half * (i / 100.0 - 1), z = half * (k / 100.0 - 1), step = half / 100.0;
            floor.add_quad({x, 0, z}, {x, 0, z + step}, {x + step, 0, z + step}, {x + step, 0, z});
        }
    scenes::Instanced on_floor(std::move(floor), meshes);
    for (std::size_t i = 0; i < places.size(); ++i)
        on_floor.add(i % meshes.size(),
                     placement(places[i], random.in_box(3), scenes::random_scale(random, 1.7)));
    const CollisionWorld grounded = on_floor.world();
    batch_row("sweep of 2 m, with a floor", list_of(2.0), grounded);
    return 0;
}

}  // namespace
}  // namespace slipface::bench

int main(int argc, char** argv) {
    const long instances = argc > 1 ? std::strtol(argv[1], nullptr, 10) : 10'000;
    return slipface::bench::run(static_cast<std::size_t>(std::max(1L, instances)));
}
