// slipface_reach_world SECONDS [EDGE_M [SEED]]: a generated world, EDGE_M (1500) metres wide, and the
// fraction of its walkable area that a search of so many seconds of processor time reaches (docs/reach.md).
#include <fmt/core.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "shapes.h"
#include "slipface/level/find_start.h"
#include "slipface/reach/report.h"
#include "timing.h"

namespace slipface::bench {
namespace {

constexpr double quad_m = 3.0;

class World {
  public:
    World(double edge, std::uint64_t seed)
        : random_(seed), edge_(edge), count_(static_cast<int>(edge / quad_m)) {
        for (int z = 0; z <= count_; ++z)
            for (int x = 0; x <= count_; ++x)
                heights_.push_back(hills(quad_m * x, quad_m * z));
        const auto places = static_cast<int>(edge * edge / 4000.0);
        for (int i = 0; i < places; ++i) {
            const Vec3 at = level_ground(in(20, edge - 20), in(20, edge - 20));
            if (i % 4 < 2)
                house(at);
            else if (i % 4 == 2)
                tower(at);
            else
                shapes_.box(at - Vec3(0.2, 1, 8), at + Vec3(0.2, 4, 8));  // a wall
        }
        for (int z = 0; z < count_; ++z)
            for (int x = 0; x < count_; ++x)
                shapes_.polygon({corner(x, z), corner(x, z + 1), corner(x + 1, z + 1)})
                    .polygon({corner(x, z), corner(x + 1, z + 1), corner(x + 1, z)});
        for (const double side : {0.0, edge}) {
            shapes_.box({side - 0.5, -80, 0}, {side + 0.5, 80, edge});
            shapes_.box({0, -80, side - 0.5}, {edge, 80, side + 0.5});
        }
    }
    Level level() {
        Level level = shapes_.level();
        level.movement = MovementSettings{};
        level.spawn = level_ground(0.5 * edge_, 0.5 * edge_) + Vec3(0, 1, 0);
        return level;
    }

  private:
    double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
    static double hills(double x, double z) {
        return 14.0 * std::sin(x / 47.0) * std::cos(z / 53.0) + 6.0 * std::sin(x / 17.0 + z / 23.0) +
               2.0 * std::cos(x / 5.0 - z / 7.0);
    }
    double& height(int x, int z) { return heights_[static_cast<std::size_t>(z * (count_ + 1) + x)]; }
    Vec3 corner(int x, int z) { return {quad_m * x, height(x, z), quad_m * z}; }
    // Makes the ground level within 12 m, and gives its middle.
    Vec3 level_ground(double x, double z) {
        const int column = static_cast<int>(x / quad_m), row = static_cast<int>(z / quad_m);
        const double here = height(column, row);
        for (int k = std::max(0, row - 4); k <= std::min(count_, row + 4); ++k)
            for (int i = std::max(0, column - 4); i <= std::min(count_, column + 4); ++i)
                height(i, k) = here;
        return corner(column, row);
    }
    // Four walls, a door, a table, a flat roof and stairs up to it.
    void house(const Vec3& at) {
        const auto box = [&](double x0, double y0, double z0, double x1, double y1, double z1) {
            shapes_.box(at + Vec3(x0, y0, z0), at + Vec3(x1, y1, z1));
        };
        box(-5, -1, -4, -4.7, 3, 4);
        box(4.7, -1, -4, 5, 3, 4);
        box(-5, -1, -4, 5, 3, -3.7);
        box(-5, -1, 3.7, -0.7, 3, 4);
        box(0.7, -1, 3.7, 5, 3, 4);
        box(-0.7, 2.2, 3.7, 0.7, 3, 4);
        box(-5, 3, -4, 5, 3.2, 4);
        box(-3, 0, -2, -1, 0.8, -1);
        shapes_.stairs(at + Vec3(5, 0, 4), 1.5, 10, 0.32, 0.5);
    }
    // Platforms, each a jump higher than the one before.
    void tower(const Vec3& at) {
        for (int i = 0; i < 6; ++i) {
            const Vec3 low = at + Vec3(3.0 * (i % 2), 1.1 * (i + 1) - 0.2, 2.5 * (i % 3));
            shapes_.box(low, low + Vec3(2, 0.2, 2));
        }
    }

    std::mt19937_64 random_;
    double edge_;
    int count_;
    std::vector<double> heights_;
    Shapes shapes_;
};

double process_seconds() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

int measure(double duration, double edge, std::uint64_t seed) {
    Level level = World(edge, seed).level();
    const Result<Start> start = settle_start(level);
    if (!start) return fmt::print(stderr, "{}\n", start.error().text()), 1;
    Result<ReachSearch> search = ReachSearch::begin(level, start->position, {});
    if (!search) return fmt::print(stderr, "{}\n", search.error().text()), 1;
    const std::vector<FaceId> walkable = walkable_faces(level);
    double area = 0.0;
    for (const FaceId face : walkable)
        area += face_area(*level.mesh, face);
    fmt::print("{} triangles, {} walkable faces, {:.0f} m2 of them, cells of {:.2f} m\n",
               level.mesh.triangle_count(), walkable.size(), area, search->cell_m());
    fmt::print("| processor, s | steps, M | cells | walkable faces | of the area | memory, MB |\n");
    fmt::print("|---:|---:|---:|---:|---:|---:|\n");
    const double begin = process_seconds();
    for (double next = duration / 20.0; next < 1.01 * duration && !search->exhausted();
         next += duration / 20.0) {
        while (process_seconds() - begin < next && !search->exhausted()) {
            ReachLimits limits;
            limits.rounds = search->rounds().size() + 8;
            search->run(limits);
        }
        std::size_t faces = 0;
        double reached = 0.0;
        for (const FaceId face : walkable) {
            if (!search->faces()[face].found()) continue;
            ++faces;
            reached += face_area(*level.mesh, face);
        }
        fmt::print("| {:.0f} | {:.1f} | {} | {} | {:.1f} % | {:.0f} |\n", process_seconds() - begin,
                   static_cast<double>(search->steps()) / 1e6, search->archive().cell_count(), faces,
                   100.0 * reached / area, static_cast<double>(search->archive().bytes()) / 1e6);
        std::fflush(stdout);
    }
    return 0;
}

}  // namespace
}  // namespace slipface::bench

int main(int count, char** words) {
    return slipface::bench::measure(count > 1 ? std::atof(words[1]) : 60.0,
                                    count > 2 ? std::atof(words[2]) : 1500.0,
                                    count > 3 ? std::strtoull(words[3], nullptr, 10) : 1);
}
