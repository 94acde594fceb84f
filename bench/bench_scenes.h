// The levels and queries that every engine is measured on.
#pragma once

#include <map>

#include "collision/scenes.h"

namespace slipface::bench {

// Of the same density at every size: a building of furnished rooms, or rolling ground with boxes on it.
enum class Kind { rooms, ground };

struct Level {
    scenes::Soup soup;
    CollisionWorld world;
};

inline scenes::Soup make_soup(Kind kind, std::int64_t triangles) {
    scenes::Random random(1);
    const auto count = static_cast<double>(triangles);
    if (kind == Kind::ground) {
        const double cells = std::sqrt(count / (2.0 + 10.0 / 30.0));
        return scenes::terrain(random, static_cast<std::size_t>(cells), 1.0);
    }
    const std::size_t floors = triangles < 100000 ? 2 : 5;
    const double rooms = std::sqrt(count / (242.0 * static_cast<double>(floors)));
    return std::move(scenes::Rooms(random, static_cast<std::size_t>(std::lround(rooms)), floors).soup);
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

// Starts in free space within a metre of a surface, random directions.
inline std::vector<Query> queries(const Level& level, const Vec3& radii, double length) {
    scenes::Random random(2);
    std::vector<Query> list;
    while (list.size() < 4096) {
        const auto corners =
            level.world.triangle(static_cast<TriangleId>(random.below(level.world.triangle_count())));
        const Vec3 at = (corners[0] + corners[1] + corners[2]) / 3;
        const Vec3 from = at + random.uniform(0, 1.0 + radii.maxCoeff()) * random.direction();
        if (overlaps_any(level.world, radii, from)) continue;
        // Where there is no ground there is nothing to play.
        if (!cast_ray(level.world, from, {0, -1, 0})) continue;
        list.push_back({from, length * random.direction()});
    }
    return list;
}

// Arguments of a sweep benchmark: triangles, length in millimetres, ellipsoid or sphere.
template <class Benchmark>
void sweep_arguments(Benchmark* benchmark) {
    benchmark->ArgNames({"triangles", "mm", "ellipsoid"});
    for (const std::int64_t triangles : {1000, 10000, 30000, 100000, 1000000}) {
        for (const std::int64_t length : {20, 200, 2000, 20000}) {
            for (const std::int64_t ellipsoid : {0, 1})
                benchmark->Args({triangles, length, ellipsoid});
        }
    }
}

}  // namespace slipface::bench
