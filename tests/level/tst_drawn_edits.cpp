// Paint after edits of drawn levels: whatever a tool did, no type is wrong in silence.
#include "level/drawn_edits.h"

namespace slipface::test::edits {
namespace {

constexpr std::uint64_t seeds = 8;  // of each kind

TEST(DrawnEdits, NoTypeIsWrongInSilence) {
    std::uint64_t number = 0;
    for (const Kind& kind : kinds()) {
        Tally sum;
        ++number;
        // Not proved yet: equal tiles in triangles look alike in any order (docs/matching.md, "What falls
        // short").
        if (std::string(kind.name) == "regenerated, in triangles") continue;
        for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
            Draw draw(977 * seed + number);
            Scene before = kind.level(draw);
            paint(draw, before);
            Scene after = before;
            kind.edit(after, draw);
            const Tally one = tally(before, after, read_back(level_to_json(painted_level(before)), after));
            EXPECT_EQ(one.silent(), 0u) << kind.name << ", seed " << seed << ": " << one.wrong << " wrong, "
                                        << one.strangers << " strangers, " << one.lost << " lost";
            sum.add(one);
        }
        EXPECT_TRUE(!kind.ordered || 100 * sum.right >= 99 * sum.painted)
            << kind.name << ": " << sum.right << " of " << sum.painted << " right";
    }
}

}  // namespace
}  // namespace slipface::test::edits
