// Prints, for each family of hard sweeps, the worst difference between the engine and the 113-bit oracle.
#include <fmt/core.h>
#include <fmt/format.h>

#include <charconv>
#include <cstdio>
#include <cstring>

#include "collision/families.h"

int main(int argc, char** argv) {
    std::size_t queries = 20000;
    if (argc > 1) {
        const char* end = argv[1] + std::strlen(argv[1]);
        const auto [stop, error] = std::from_chars(argv[1], end, queries);
        if (argc > 2 || error != std::errc() || stop != end || queries == 0) {
            fmt::print(stderr, "usage: slipface_sweep_accuracy [QUERIES_A_FAMILY]\n");
            return 64;
        }
    }
    fmt::print(
        "{} queries a family; depths and gaps in radii, path and point in metres, normal in radians\n\n",
        queries);
    fmt::print("| {:<26} | {:>8} | {:>9} | {:>9} | {:>9} | {:>9} | {:>9} | {:>9} |\n", "family", "hits",
               "missed", "false", "path", "touch", "normal", "point");
    fmt::print("|{:-<28}|{:->10}|{:->11}|{:->11}|{:->11}|{:->11}|{:->11}|{:->11}|\n", "", ":", ":", ":", ":",
               ":", ":", ":");
    for (const auto& family : slipface::families::all) {
        const auto worst = slipface::families::run(family, queries, 1);
        fmt::print("| {:<26} | {:>8} | {:>9.1e} | {:>9.1e} | {:>9.1e} | {:>9.1e} | {:>9.1e} | {:>9.1e} |\n",
                   family.name, worst.hits, worst.missed_depth, worst.false_gap, worst.path_error,
                   worst.touch_error, worst.normal_error, worst.point_error);
        std::fflush(stdout);
    }
    return 0;
}
