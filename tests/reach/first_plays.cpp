// slipface_first_plays [COUNT [FIRST]]: drawn levels without a spawn from seed FIRST on, and what a player
// reaches from the start that find_start() chooses, of what is reached from the best start
// (docs/levels.md, "Where a player begins").
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <map>

#include "drawn_levels.h"
#include "slipface/base/parallel.h"

int main(int argc, char** argv) {
    using namespace slipface;
    using namespace slipface::test;
    const int count = argc > 1 ? std::atoi(argv[1]) : 200;
    const auto first = static_cast<std::uint64_t>(argc > 2 ? std::atoll(argv[2]) : 1);
    struct Row {
        int levels = 0, right = 0, in_solid = 0, none = 0;
        double least = 1.0;
    };
    std::map<std::string_view, Row> rows;
    Row all, thick;
    for (int i = 0; i < count; ++i) {
        const std::uint64_t seed = first + static_cast<std::uint64_t>(i);
        const DrawnLevel drawn = drawn_level(seed);
        const FirstPlay play = first_play(drawn, seed, 30, 60);
        const auto add = [&](Row& row) {
            ++row.levels;
            row.right += play.right() ? 1 : 0;
            row.in_solid += play.in_solid ? 1 : 0;
            row.none += play.start.stands ? 0 : 1;
            row.least = std::min(row.least, play.fraction());
        };
        add(rows[drawn.kind]);
        add(all);
        if (drawn.thick) add(thick);
        if (play.right()) continue;
        const Vec3& at = play.start.position;
        fmt::print(stderr, "seed {}, {}: {} of {} m2 from ({:.2f}, {:.2f}, {:.2f}){}: {}\n", seed, drawn.kind,
                   play.reached, play.most, at.x(), at.y(), at.z(), play.in_solid ? ", in a solid" : "",
                   play.start.note);
    }
    rows["all thick solids"] = thick;
    rows["all"] = all;
    fmt::print("| levels | drawn | right | in a solid | nowhere | least |\n|---|---:|---:|---:|---:|---:|\n");
    for (const auto& [name, row] : rows)
        fmt::print("| {} | {} | {} | {} | {} | {:.0f} % |\n", name, row.levels, row.right, row.in_solid,
                   row.none, 100.0 * row.least);
}
