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

// The drop onto a step ends the move: nothing falls once more afterwards.
TEST(Kerb, TheDropTakesThePlaceOfTheVerticalPart) {
    Lab lab;
    lab.floor();
    lab.wall({2, -5}, {2, 5}, 0.0, 0.2);
    lab.polygon({{2, 0.2, -5}, {2, 0.2, 5}, {9, 0.2, 5}, {9, 0.2, -5}});
    lab.ready();
    const MovementSettings s = every_hack();
    PlayerState state = run(lab, s, at({0, 0.902, 0}), {}, 5);
    int climbed = 0;
    for (int i = 0; i < 60; ++i) {
        TraceRecorder trace;
        state = step(lab.scene(), s, state, wish(1, 0), tick, &trace).state;
        if (decisions_of(trace, Decision::stepped_up).empty()) continue;
        ++climbed;
        for (const TraceRecord& record : trace.records) {
            const auto* sweep = std::get_if<SweepRecord>(&record);
            EXPECT_FALSE(sweep != nullptr && sweep->pass == Pass::vertical);
        }
    }
    EXPECT_GT(climbed, 0);
    EXPECT_NEAR(state.position.y(), 1.102, 1e-6);
}

// The foot comes down beside the edge of a table, as steep as a wall there. What would make a step of it is
// switched off, so nothing looks for one.
TEST(Kerb, NoRimIsLookedForWithoutStepUpAndSnapDown) {
    for (const bool on : {true, false}) {
        Lab lab;
        lab.polygon({{-5, 0, -5}, {-5, 0, 5}, {0, 0, 5}, {0, 0, -5}});
        lab.floor(-0.6);
        lab.ready();
        MovementSettings s = basic_settings();
        s.step_up = on;
        TraceRecorder trace;
        PlayerState state = at({0.37, 0.85, 0});
        for (int i = 0; i < 30; ++i)
            state = step(lab.scene(), s, state, {}, tick, &trace).state;
        std::size_t looked = 0;
        for (const TraceRecord& record : trace.records) {
            const auto* decision = std::get_if<DecisionRecord>(&record);
            if (decision == nullptr) continue;
            const std::string_view sentence = decision_info(decision->kind).sentence;
            if (sentence.find("im of a step") != sentence.npos) ++looked;
        }
        EXPECT_EQ(looked > 0, on);
    }
}

// Two narrow treads below the player's centre, each a step of 0.3 m, lead to the rim that the foot comes down
// on, 0.25 m ahead and 0.8 m above the ground below the centre. They are as wide as a sixteenth of the way.
TEST(Kerb, ARimBehindTreadsOfASixteenthOfTheWayIsStoodOn) {
    for (const double first : {0.008, 0.2}) {
        Lab lab;
        const auto tread = [&](double from, double to, double height) {
            lab.polygon({{from, height, -5}, {from, height, 5}, {to, height, 5}, {to, height, -5}});
        };
        tread(-5, 0.008, 0.0);
        // Without the lower tread the rise of 0.6 m is no step.
        if (first == 0.008) tread(first, 0.023, 0.3);
        tread(0.023, 0.25, 0.6);
        tread(0.25, 5, 0.8);
        lab.ready();
        MovementSettings s = basic_settings();
        s.step_up = true;
        s.step_height = 0.35;
        TraceRecorder trace;
        PlayerState state = at({0, 1.6, 0});
        const auto decided = [&](Decision kind) { return !decisions_of(trace, kind).empty(); };
        for (int i = 0; i < 30 && !decided(Decision::step_rim) && !decided(Decision::step_rim_no_steps); ++i)
            state = step(lab.scene(), s, state, {}, tick, &trace).state;
        EXPECT_EQ(decided(Decision::step_rim), first == 0.008);
        EXPECT_EQ(decided(Decision::step_rim_no_steps), first != 0.008);
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
