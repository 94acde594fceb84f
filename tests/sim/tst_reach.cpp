// Reach: closed forms of jumps on a flat floor.
#include <gtest/gtest.h>

#include "slipface/sim/reach.h"

namespace slipface::test {
namespace {

constexpr double tick = 1.0 / 60.0;

TEST(Reach, AHeldJumpIsAsHighAndAsFarAsTheClosedForm) {
    MovementSettings settings = basic_settings();
    settings.jump_speed = 8.0;
    settings.gravity = 20.0;
    settings.walk_speed = 6.0;
    const Reach reach = measure_reach(settings, tick);
    // v*v/(2g) = 1.6 m high, 2v/g = 0.8 s long, 4.8 m far; the landing is found to the tick.
    EXPECT_NEAR(reach.standing.height_m, 1.6, 0.02);
    EXPECT_NEAR(reach.running.height_m, 1.6, 0.02);
    EXPECT_NEAR(reach.running.duration_s, 0.8, 2.5 * tick);
    EXPECT_NEAR(reach.running.distance_m, 4.8, 6.0 * 2.5 * tick);
    EXPECT_NEAR(reach.standing.distance_m, 0.0, 1e-9);
    EXPECT_NEAR(reach.top_speed, 6.0, 1e-6);
    EXPECT_LT(reach.stopping_m, 0.7);
    EXPECT_GT(reach.stopping_m, 0.1);
}

TEST(Reach, NoJumpReachesNothing) {
    MovementSettings settings = basic_settings();
    settings.jump_speed = 0.0;
    const Reach reach = measure_reach(settings, tick);
    EXPECT_LT(reach.running.height_m, 0.01);
    EXPECT_EQ(reach.coyote_ticks, 0);
}

}  // namespace
}  // namespace slipface::test
