// The levels and queries that every engine is measured with.
#pragma once

#include <map>

#include "collision/scenes.h"

namespace slipface::bench {

// Each kind has the same density at every size: a building of furnished rooms, or rolling ground with boxes.
enum class Kind { rooms, ground };

// The rows and columns of the tables in docs/performance-tables.md: approximate numbers of triangles, and
// moves in metres.
inline constexpr std::int64_t sizes[] = {3000, 10000, 30000, 100000, 300000, 1000000};
inline constexpr double lengths[] = {0.02, 0.2, 2, 20};

struct Level {
    scenes::Soup soup;
    CollisionWorld world;
};

// A building has at least `triangles`, ground a few per cent more or fewer.
inline scenes::Soup make_soup(Kind kind, std::int64_t triangles) {
    scenes::Random random(1);
    const auto count = static_cast<double>(triangles);
    if (kind == Kind::ground) {
        const double cells = std::sqrt(count / (2.0 + 10.0 / 30.0));
        return scenes::terrain(random, static_cast<std::size_t>(cells), 1.0);
    }
    const std::size_t floors = triangles < 100000 ? 2 : 5;
    const double rooms = std::sqrt(count / (242.0 * static_cast<double>(floors)));
    return std::move(scenes::Rooms(random, static_cast<std::size_t>(std::ceil(rooms)), floors).soup);
}

inline const Level& level(std::int64_t triangles, Kind kind = Kind::rooms) {
    static std::map<std::pair<std::int64_t, Kind>, Level> levels;
    const std::pair key(triangles, kind);
    const auto found = levels.find(key);
    if (found != levels.end()) return found->second;
    scenes::Soup soup = make_soup(kind, triangles);
    CollisionWorld world = soup.world();
    return levels.emplace(key, Level{std::move(soup), std::move(world)}).first->second;
}

struct Query {
    Vec3 from;
    Vec3 move;
};

inline Vec3 radii_of(bool ellipsoid) {
    return ellipsoid ? Vec3(0.4, 0.9, 0.4) : Vec3(0.5, 0.5, 0.5);
}

// 4096 queries that start in free space within a metre of a surface, in random directions.
inline std::vector<Query> queries(const Level& level, const Vec3& radii, double length) {
    scenes::Random random(2);
    std::vector<Query> list;
    while (list.size() < 4096) {
        const auto corners =
            level.world.triangle(static_cast<TriangleId>(random.below(level.world.triangle_count())));
        const Vec3 at = (corners[0] + corners[1] + corners[2]) / 3;
        const Vec3 from = at + random.uniform(0, 1.0 + radii.maxCoeff()) * random.direction();
        if (overlaps_any(level.world, radii, from)) continue;
        // Positions without ground below are outside the level.
        if (!cast_ray(level.world, from, {0, -1, 0})) continue;
        list.push_back({from, length * random.direction()});
    }
    return list;
}

// The arguments of the Google Benchmark programs: the sizes and lengths of the tables.
inline std::vector<std::int64_t> size_arguments() {
    return {std::begin(sizes), std::end(sizes)};
}
inline std::vector<std::int64_t> length_arguments() {
    std::vector<std::int64_t> list;
    for (const double length : lengths)
        list.push_back(std::lround(1000 * length));
    return list;
}
template <class Benchmark>
void sweep_arguments(Benchmark* benchmark) {
    benchmark->ArgNames({"triangles", "mm", "ellipsoid", "ground"})
        ->ArgsProduct({size_arguments(), length_arguments(), {0, 1}, {0, 1}});
}
template <class Benchmark>
void ray_arguments(Benchmark* benchmark) {
    benchmark->ArgNames({"triangles", "mm"})->ArgsProduct({size_arguments(), length_arguments()});
}
template <class Benchmark>
void build_arguments(Benchmark* benchmark) {
    benchmark->ArgNames({"triangles", "threads"})->ArgsProduct({size_arguments(), {1, 2}});
}

// The task that the arguments of a sweep benchmark describe.
struct SweepTask {
    const Level& scene;
    Vec3 radii;
    std::vector<Query> list;  // 4096

    template <class State>
    explicit SweepTask(const State& state)
        : scene(level(state.range(0), state.range(3) != 0 ? Kind::ground : Kind::rooms)),
          radii(radii_of(state.range(2) != 0)),
          list(queries(scene, radii, static_cast<double>(state.range(1)) / 1000)) {}
};

}  // namespace slipface::bench
