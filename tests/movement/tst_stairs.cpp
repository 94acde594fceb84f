// Random stairs and random barriers; slipface_stairs walks thousands of the same.
#include "random_stairs.h"

namespace slipface::test {

TEST(Stairs, OfAnySizeAreClimbedAndDescendedOnTheGround) {
    for (std::uint64_t seed = 1; seed <= 400; ++seed) {
        const Stair stair = random_stair(seed);
        const StairWalk walk = walk_stair(stair);
        EXPECT_TRUE(walk.arrived) << text_of(stair);
        EXPECT_EQ(walk.overlaps, 0) << text_of(stair);
        EXPECT_LE(walk.airborne, 0.02 * walk.ticks) << text_of(stair);
    }
}

// Found by search: rims beside which the foot came down again, within the skin that the plain move kept.
TEST(Stairs, ThatWereStoppedAtBySlowAndSlantingMovesAreClimbed) {
    for (const std::uint64_t seed :
         std::initializer_list<std::uint64_t>{437, 1143, 1265, 1293, 1315, 1976, 2114, 6759, 6815}) {
        const Stair stair = random_stair(seed);
        EXPECT_TRUE(walk_stair(stair).arrived) << text_of(stair);
    }
}

TEST(Stairs, SteeperThan45DegreesAreClimbedAsFarAsNoRimAboveAStepIsHitFirst) {
    int arrived = 0;
    int walks = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        const Stair stair = random_stair(seed, true);
        const StairWalk walk = walk_stair(stair);
        arrived += walk.arrived ? 1 : 0;
        EXPECT_EQ(walk.overlaps, 0) << text_of(stair);
        ++walks;
    }
    EXPECT_GE(arrived, walks * 99 / 100);
}

TEST(Stairs, AreWallsWithoutStepUp) {
    // The rims are higher than the round foot walks over, so nothing but step up gets onto them.
    int tried = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        const Stair stair = random_stair(seed);
        if (stair.down || stair.rise < 1.05 * foot_height(stair)) continue;
        MovementSettings off = settings_of(stair);
        off.step_up = off.snap_down = false;
        const StairWalk walk = walk_stair(stair, off);
        EXPECT_LT(walk.highest, 0.01) << text_of(stair);
        ++tried;
    }
    EXPECT_GT(tried, 50);
}

TEST(Stairs, AreClimbedInTheLecturesFormToo) {
    int arrived = 0;
    int walks = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        Stair stair = random_stair(seed);
        stair.form = StepForm::every_move;
        const StairWalk walk = walk_stair(stair);
        EXPECT_EQ(walk.overlaps, 0) << text_of(stair);
        arrived += walk.arrived ? 1 : 0;
        ++walks;
    }
    EXPECT_GE(arrived, walks * 95 / 100);
}

TEST(Barriers, AreNeitherClimbedNorHungOnTo) {
    for (std::size_t k = 0; k < barrier_names.size(); ++k) {
        const auto kind = static_cast<Barrier>(k);
        for (std::uint64_t seed = 1; seed <= 60; ++seed) {
            const Stair barrier = random_barrier(seed, kind);
            const BarrierWalk walk = walk_barrier(barrier, kind);
            EXPECT_FALSE(walk.beaten) << barrier_names[k] << ", " << text_of(barrier);
            EXPECT_EQ(walk.overlaps, 0) << barrier_names[k] << ", " << text_of(barrier);
        }
    }
}

// Found by search: rims higher than a step that were climbed all the same. They are no steps: the skin holds
// the foot up, so that it meets them where it is flat enough to stand on, and it walks over them without step
// up as well. Nearer to the floor than they are high it meets them where it is too steep, and stops.
TEST(Barriers, ThatTheFootWalksOverBecauseTheSkinHoldsItUpAreNoSteps) {
    struct Found {
        Barrier kind;
        std::uint64_t seed;
        double above_foot;  // of a foot on the floor itself, m
    };
    for (const Found& found : {Found{Barrier::kerbs, 3833, 0.00172}, Found{Barrier::kerbs, 11526, 0.00158},
                               Found{Barrier::planks, 769, 0.00182}, Found{Barrier::planks, 3640, 0.0018},
                               Found{Barrier::planks, 4211, 0.00181}}) {
        Stair barrier = random_barrier(found.seed, found.kind);
        MovementSettings settings = settings_of(barrier);
        barrier.rise = foot_height(barrier) - settings.skin + found.above_foot;
        ASSERT_GT(barrier.rise, 1.01 * barrier.step_height);
        ASSERT_GT(settings.skin, found.above_foot);
        EXPECT_TRUE(walk_barrier(barrier, found.kind, settings).beaten) << text_of(barrier);
        settings.step_up = settings.snap_down = false;
        EXPECT_TRUE(walk_barrier(barrier, found.kind, settings).beaten) << text_of(barrier);
        settings.step_up = settings.snap_down = true;
        settings.skin = 0.5 * found.above_foot;
        EXPECT_FALSE(walk_barrier(barrier, found.kind, settings).beaten) << text_of(barrier);
    }
}

TEST(Kerb, OfExactlyTheStepHeightIsClimbedAtAnyRate) {
    for (const double rate : {30.0, 60.0, 144.0, 360.0}) {
        Stair kerb;
        kerb.rise = kerb.step_height;
        kerb.steps = 1;
        kerb.rate = rate;
        EXPECT_TRUE(walk_stair(kerb).arrived) << rate;
        kerb.rise = 1.01 * kerb.step_height;
        EXPECT_FALSE(walk_stair(kerb).arrived) << rate;
    }
}

// Under a lintel that leaves room for the player but not for a lifted one, the lecture's form stops.
TEST(StepForm, EveryMoveNeedsRoomForAStepOverheadAndWhenBlockedDoesNot) {
    Lab lab;
    lab.floor();
    lab.wall({4, -5}, {4, 5}, 1.95, 6.0);
    lab.ready();
    MovementSettings s = every_hack();
    const PlayerState start = run(lab, s, at({0, 0.902, 0}), {}, 5);
    EXPECT_GT(run(lab, s, start, wish(1, 0), 90).position.x(), 6.0);
    s.step_form = StepForm::every_move;
    const PlayerState stopped = run(lab, s, start, wish(1, 0), 90);
    EXPECT_LT(stopped.position.x(), 4.0);
    TraceRecorder trace;
    step(lab.scene(), s, stopped, wish(1, 0), tick, &trace);
    EXPECT_TRUE(has_decision(trace, "step_up", true, "Lifted, moved and dropped"));
}

}  // namespace slipface::test
