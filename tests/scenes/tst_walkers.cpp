// A few random walkers in every shipped level and every demo: nobody comes inside geometry or through it.
// scripts/prove_never_inside.sh sends many more.
#include <gtest/gtest.h>

#include "slipface/level/level_file.h"
#include "slipface/scenes/demo.h"
#include "slipface/sim/audit.h"

namespace slipface {
namespace {

// Walking, running and sprinting for 10 s each.
AuditOptions a_few_walkers(std::uint64_t seed) {
    AuditOptions options;
    options.walkers = 9;
    options.duration_s = 10.0;
    options.speeds = {6.0, 20.0, 60.0};
    options.seed = seed;
    return options;
}

void expect_nobody_inside(const Level& level, const AuditOptions& options) {
    const Result<AuditReport> report = run_audit(level, options);
    ASSERT_TRUE(report.ok()) << report.error().text();
    EXPECT_EQ(report->steps, 9u * 600u);
    for (const AuditFinding& finding : report->findings) {
        // Who is stuck breaks no promise.
        EXPECT_EQ(finding.kind, FindingKind::stuck)
            << finding.text << ", tick " << finding.tick << " at " << finding.position.transpose();
    }
    EXPECT_EQ(report->count(FindingKind::passed_through), 0u);
    EXPECT_EQ(report->count(FindingKind::left_level), 0u);
    EXPECT_EQ(report->count(FindingKind::overlap), 0u);
}

class WalkersInLevel : public testing::TestWithParam<const char*> {};

TEST_P(WalkersInLevel, ComeThroughNothingAndEndInsideNothing) {
    const auto folder = std::filesystem::path(SLIPFACE_SOURCE_DIR) / "assets/levels";
    const auto loaded = load_level(folder / (std::string(GetParam()) + ".obj"));
    ASSERT_TRUE(loaded.ok()) << loaded.error().text();
    for (const std::uint64_t seed : {1u, 2u})
        expect_nobody_inside(loaded->level, a_few_walkers(seed));
}

TEST_P(WalkersInLevel, DoSoWithEveryHackOn) {
    const auto folder = std::filesystem::path(SLIPFACE_SOURCE_DIR) / "assets/levels";
    auto loaded = load_level(folder / (std::string(GetParam()) + ".obj"));
    ASSERT_TRUE(loaded.ok()) << loaded.error().text();
    Level& level = loaded->level;
    set_switches(level.movement, true);
    level.movement.push_out = PushOut::analytic;
    expect_nobody_inside(level, a_few_walkers(3));
}

INSTANTIATE_TEST_SUITE_P(All, WalkersInLevel, testing::Values("easy", "hard", "island", "playground"),
                         [](const auto& test) { return std::string(test.param); });

TEST(WalkersInLevels, AreInEveryShippedOne) {
    std::size_t shipped = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(SLIPFACE_SOURCE_DIR) / "assets/levels"))
        shipped += entry.path().extension() == ".obj" ? 1 : 0;
    EXPECT_EQ(shipped, 4u);
}

TEST(WalkersInDemos, ComeThroughNothingAndEndInsideNothing) {
    for (const DemoInfo& info : demo_table()) {
        SCOPED_TRACE(info.name);
        const std::string name = info.name;
        const Level level = make_demo(info).level;
        // Two demos begin inside geometry, because that is what they show, and no audit begins there.
        const bool begins_inside = name == "push-out" || name == "nudge";
        EXPECT_EQ(run_audit(level, a_few_walkers(4)).ok(), !begins_inside);
        // In one the floor rises with platforms switched off: it enters a player that stands on it.
        if (begins_inside || name == "seam-filter") continue;
        expect_nobody_inside(level, a_few_walkers(4));
    }
}

}  // namespace
}  // namespace slipface
