// slipface_large_worlds [COUNT [FIRST [TRIANGLES]]]: COUNT random worlds of up to TRIANGLES triangles, from
// seed FIRST on, against worlds of eight triangles. Faults are listed with their seeds.
#include "large_worlds.h"

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
    using namespace slipface;
    const auto number = [&](int i, std::uint64_t otherwise) {
        return argc > i ? static_cast<std::uint64_t>(std::strtoull(argv[i], nullptr, 10)) : otherwise;
    };
    const std::uint64_t count = number(1, 100), begin = number(2, 1);
    std::size_t faults = 0, triangles = 0, hits = 0;
    for (std::uint64_t seed = begin; seed < begin + count; ++seed) {
        scenes::LargeWorld world(seed, number(3, 100'000), 30);
        const std::string fault = world.fault();
        triangles += world.triangles();
        hits += world.hits();
        if (fault.empty()) continue;
        ++faults;
        fmt::print("seed {}: {} triangles: {}\n", seed, world.triangles(), fault);
        std::fflush(stdout);
    }
    fmt::print("{} worlds of {} triangles on average, {} triangles hit, {} worlds with faults\n", count,
               triangles / std::max<std::uint64_t>(count, 1), hits, faults);
    return faults == 0 ? 0 : 1;
}
