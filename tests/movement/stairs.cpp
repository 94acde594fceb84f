// slipface_stairs [COUNT [FIRST]]: COUNT random stairs of each kind from seed FIRST on (docs/movement.md,
// "Every stair"). Failures are listed with their seeds.
#include <fmt/format.h>

#include <cstdlib>

#include "random_stairs.h"

namespace {

using namespace slipface;
using namespace slipface::test;

constexpr int max_shown = 40;

struct Row {
    int cases = 0, arrived = 0, loose = 0, overlaps = 0;
    long ticks = 0, airborne = 0;
    double slowest = 0.0;
};

}  // namespace

int main(int argc, char** argv) {
    const int count = argc > 1 ? std::atoi(argv[1]) : 1000;
    const auto first = static_cast<std::uint64_t>(argc > 2 ? std::atoll(argv[2]) : 1);
    int shown = 0;
    fmt::print("| stairs | walks | arrived | grounded | airborne over 2 % | overlaps | slowest / ideal |\n");
    for (const bool steep : {false, true}) {
        std::array<Row, 2> rows;
        for (int i = 0; i < count; ++i) {
            const Stair stair = random_stair(first + static_cast<std::uint64_t>(i), steep);
            const StairWalk walk = walk_stair(stair);
            Row& row = rows[stair.down ? 1 : 0];
            ++row.cases;
            row.arrived += walk.arrived ? 1 : 0;
            row.overlaps += walk.overlaps;
            row.ticks += walk.ticks;
            row.airborne += walk.airborne;
            const bool loose = walk.airborne > 0.02 * walk.ticks;
            row.loose += loose ? 1 : 0;
            if (walk.arrived) row.slowest = std::max(row.slowest, walk.seconds / walk.ideal_seconds);
            const bool good = walk.arrived && walk.overlaps == 0 && (steep || !loose);
            if (good || ++shown > max_shown) continue;
            fmt::print(stderr, "{}: {}; {} of {} ticks airborne, {:.2f} s\n",
                       walk.arrived ? "airborne" : "stopped", text_of(stair), walk.airborne, walk.ticks,
                       walk.seconds);
        }
        for (const std::size_t down : {std::size_t{0}, std::size_t{1}}) {
            const Row& r = rows[down];
            const double ticks = static_cast<double>(std::max(r.ticks, 1L));
            fmt::print("| {}, {} | {} | {} | {:.3f} % | {} | {} | {:.2f} |\n",
                       steep ? "45 to 68 degrees" : "18 to 45 degrees", down == 1 ? "down" : "up", r.cases,
                       r.arrived, 100.0 * (1.0 - static_cast<double>(r.airborne) / ticks), r.loose,
                       r.overlaps, r.slowest);
        }
    }
    fmt::print("\n| barriers | walks | climbed or hung on to | overlaps |\n");
    for (std::size_t k = 0; k < barrier_names.size(); ++k) {
        int beaten = 0;
        int overlaps = 0;
        for (int i = 0; i < count; ++i) {
            const auto kind = static_cast<Barrier>(k);
            const std::uint64_t seed = first + static_cast<std::uint64_t>(i);
            const Stair barrier = random_barrier(seed, kind);
            const BarrierWalk walk = walk_barrier(barrier, kind);
            beaten += walk.beaten ? 1 : 0;
            overlaps += walk.overlaps;
            if (walk.beaten && ++shown <= max_shown)
                fmt::print(stderr, "{} {}: {}\n", barrier_names[k], seed, text_of(barrier));
        }
        fmt::print("| {} | {} | {} | {} |\n", barrier_names[k], count, beaten, overlaps);
    }
}
