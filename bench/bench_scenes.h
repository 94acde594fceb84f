// The levels and queries that every engine is measured on.
#pragma once

#include <map>

#include "collision/scenes.h"

namespace slipface::bench {

// Rolling ground with boxes on it, the same density at every size.
struct Level {
    scenes::Soup soup;
    CollisionWorld world;
};

inline const Level& level(std::int64_t triangles) {
    static std::map<std::int64_t, Level> levels;
    const auto found = levels.find(triangles);
    if (found != levels.end()) return found->second;
    scenes::Random random(1);
    const double cells = std::sqrt(static_cast<double>(triangles) / (2.0 + 10.0 / 30.0));
    scenes::Soup soup = scenes::terrain(random, static_cast<std::size_t>(cells), 1.0);
    CollisionWorld world = soup.world();
    return levels.emplace(triangles, Level{std::move(soup), std::move(world)}).first->second;
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
        // Below the ground there is nothing to play.
        const auto ground = cast_ray(level.world, from + Vec3(0, 1e4, 0), {0, -1, 0});
        if (!ground || ground->point.y() > from.y()) continue;
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
