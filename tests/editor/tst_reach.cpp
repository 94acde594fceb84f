// The Reach panel: every switch and button does what it says, and every way that it opens is a proof.
#include <fmt/format.h>

#include "app_fixture.h"
#include "slipface/sim/simulate.h"
#include "tools/lab/audit_job.h"
#include "tools/lab/reach_job.h"

namespace slipface {
namespace {

class ReachPanel : public AppFixture {
  protected:
    void SetUp() override {
        AppFixture::SetUp();
        ASSERT_EQ(run("command panel.reach\nwait 3"), "");
        // The panel remembers what an earlier test asked for.
        ReachSettings settings;
        settings.duration_s = 1.0;
        editor().reach = ReachJob::start(document(), settings, {}, nullptr);
        ASSERT_EQ(run("finish\nwait 2\nclick \"Reach/Clear\""), "");
    }
    const ReachJob& job() { return *editor().reach; }
    // Where the lab's tape ends, run anew.
    PlayerState end_of_tape() {
        LevelScene scene = LevelScene::build(document().level()).value();
        const Tape& tape = editor().lab.tape();
        MovementSettings settings;
        EXPECT_TRUE(apply_tape_settings(settings, tape, "tape").ok());
        const SimulationReport report = simulate(TickScene(scene), settings, *tape.start, tape);
        EXPECT_EQ(report.end_hash, tape.end_hash);
        return report.final_state;
    }
};

TEST_F(ReachPanel, SearchesGoesOnAndClears) {
    ASSERT_EQ(run("click \"Reach/Search\"\nfinish\nexpect widget \"Reach/Clear\""), "");
    ASSERT_TRUE(job().report());
    EXPECT_EQ(job().report()->unreached.size(), 0u);
    const std::uint64_t steps = job().report()->steps;
    if (job().can_go_on(document())) {
        ASSERT_EQ(run("click \"Reach/Search on\"\nfinish"), "");
        EXPECT_GT(job().report()->steps, steps);
    }
    ASSERT_EQ(run("click \"Reach/Clear\"\nexpect no_widget \"Reach/Clear\""), "");
    EXPECT_FALSE(editor().reach);
}

TEST_F(ReachPanel, AnotherSeedAndDurationAreUsedAndASearchIsCancelled) {
    ASSERT_EQ(run("drag \"Reach/Seed\" 40 0\ndrag \"Reach/Duration\" 60 0\nclick \"Reach/Search\""), "");
    EXPECT_GT(job().settings.seed, 1);
    EXPECT_GT(job().settings.duration_s, 1.0);
    ASSERT_EQ(run("click \"Reach/Cancel\"\nfinish\nexpect no_widget \"Reach/Cancel\""), "");
    if (job().report()) {  // cancelled after its first round
        EXPECT_EQ(job().report()->seed, static_cast<std::uint64_t>(job().settings.seed));
    }
}

TEST_F(ReachPanel, TheMapIsSwitchedAndShowsTheFacesThatAreAskedFor) {
    ASSERT_EQ(run("click \"Reach/Search\"\nfinish\nexpect checked \"Reach/Show\" yes"), "");
    ASSERT_EQ(run("click \"Reach/Show\"\nexpect checked \"Reach/Show\" no"), "");
    EXPECT_FALSE(job().show);
    for (std::size_t view = reach_view_names.size(); view-- > 0;) {
        const std::string name = reach_view_names[view];
        ASSERT_EQ(run("click \"Reach/View\"\nclick \"Reach/View/" + name + "\""), "");
        EXPECT_EQ(job().view, static_cast<ReachView>(view)) << name;
        const auto coloured =
            std::count_if(job().heat().begin(), job().heat().end(), [](float heat) { return heat > 0.0f; });
        EXPECT_EQ(static_cast<std::size_t>(coloured), job().view == ReachView::time
                                                          ? job().report()->reached.size()
                                                          : job().faces_of(job().view).size());
    }
}

TEST_F(ReachPanel, AClickOnAFaceOpensItsWayAndTheWayStandsOnIt) {
    ASSERT_EQ(run("click \"Reach/Search\"\nfinish\nclick \"Reach/Paths by click\""), "");
    for (const FaceId face : {0u, 63u}) {
        ASSERT_EQ(run(fmt::format("select faces {0}\nwait 2\nexpect status \"Face {0} reached after*\"\n"
                                  "expect repeats yes",
                                  face)),
                  "");
        EXPECT_EQ(end_of_tape().ground_face, face);
    }
    ASSERT_EQ(run("click \"Tabs/Reach\"\nwait 2\nclick \"Reach/Paths by click\"\nselect faces 9\nwait 2"),
              "");
    EXPECT_EQ(end_of_tape().ground_face, 63u);
}

TEST_F(ReachPanel, WhatCannotBeReachedIsListedAndOpensTheNearestAttempt) {
    // A field of hazard, wider than a jump, beside the spawn.
    ASSERT_EQ(run("set walk_speed=3"), "");
    editor().document->set_spawn({Vec3(0.5, 0.91, 3.5), 0.0});
    const auto hazard = find_surface(document().level(), "hazard");
    ASSERT_TRUE(hazard);
    std::vector<FaceId> row;
    for (FaceId face = 8; face < 56; ++face)
        row.push_back(face);
    editor().document->paint(row, *hazard);
    ASSERT_EQ(run("click \"Reach/Search\"\nfinish\nclick \"Reach/View\"\n"
                  "click \"Reach/View/Never reached\""),
              "");
    ASSERT_FALSE(job().report()->unreached.empty());
    const FaceId face = job().report()->unreached.front();
    ASSERT_EQ(run(fmt::format("click \"Reach/Face/Face {0}\"\nexpect status \"Face {0} not reached: * m "
                              "short\"\nexpect selected 1",
                              face)),
              "");
    EXPECT_NE(end_of_tape().ground_face, face);
}

TEST_F(ReachPanel, AWayOutIsOpenedAndLeadsOut) {
    ASSERT_EQ(run("click \"Reach/Search\"\nfinish"), "");
    const std::vector<ReachReport::Exit>& exits = job().report()->exits;
    ASSERT_FALSE(exits.empty()) << "the floor has open sides";
    const Vec3 hole = exits[0].hole;
    ASSERT_EQ(run(fmt::format("click \"Reach/Exit/{:.1f}, {:.1f}, {:.1f} m after {:.1f} s\"\n"
                              "expect status \"Out of the level*\"",
                              hole.x(), hole.y(), hole.z(), exits[0].time_s)),
              "");
    EXPECT_FALSE(end_of_tape().grounded);
}

TEST_F(ReachPanel, FollowsChangesAndSaysWhatIsLost) {
    ASSERT_EQ(run("click \"Reach/Search\"\nfinish\nclick \"Reach/Follow changes\"\n"
                  "expect checked \"Reach/Follow changes\" yes"),
              "");
    const std::uint64_t hash = job().report()->hash;
    ASSERT_EQ(run("set walk_speed=2\nwait 3\nfinish"), "");
    ASSERT_TRUE(job().report());
    EXPECT_NE(job().report()->hash, hash);
    ASSERT_TRUE(job().difference());
    EXPECT_EQ(job().difference()->settings.front(), "walk_speed=2");
}

TEST_F(ReachPanel, GoalsAreAddedNamedChangedAndJudged) {
    ASSERT_EQ(run("camera eye 4,14,4.01 target 4,0,4\nclick \"Reach/Add goal\"\n"
                  "click \"Reach/Search\"\nfinish"),
              "");
    ASSERT_EQ(document().level().goals.size(), 1u);
    EXPECT_NE(goal_state(editor(), 0).find(" s"), std::string::npos);
    ASSERT_EQ(run("click \"Reach/Goal/Goal 1/Kind\"\nclick \"Reach/Goal/Goal 1/Kind/never\""), "");
    EXPECT_EQ(document().level().goals[0].kind, GoalKind::never);
    ASSERT_EQ(run("click \"Reach/Search\"\nfinish"), "");
    EXPECT_NE(goal_state(editor(), 0).find("broken"), std::string::npos);
    ASSERT_EQ(run("click \"Reach/Goal/Goal 1/Kind\"\nclick \"Reach/Goal/Goal 1/Kind/reach\"\n"
                  "wait 40\ndrag \"Reach/Goal/Goal 1/Within\" 20 0"),
              "");
    ASSERT_TRUE(document().level().goals[0].within_s);
    ASSERT_EQ(run("click \"Reach/Goal/Goal 1/Settings\"\ntype \"dash=off jump_speed=7\"\nkey Enter"), "");
    EXPECT_EQ(document().level().goals[0].settings, (std::vector<std::string>{"dash=off", "jump_speed=7"}));
    EXPECT_EQ(goal_state(editor(), 0), "by reach --check");
    ASSERT_EQ(run("hover \"Reach/Goal/Goal 1/Row\"\nclick \"Reach/Goal/Goal 1/Rename\"\n"
                  "expect widget \"Reach/Goal/Goal 1/Name\"\nkey Ctrl+A\n"
                  "type \"roof\"\nkey Enter"),
              "");
    EXPECT_EQ(document().level().goals[0].name, "roof");
    ASSERT_EQ(run("command select.none\ncamera eye 2,14,2.01 target 2,0,2\nhover \"Reach/Goal/roof/Row\"\n"
                  "click \"Reach/Goal/roof/Replace\""),
              "");
    EXPECT_NEAR(document().level().goals[0].position.x(), 2.0, 0.1);
    ASSERT_EQ(run("hover \"Reach/Goal/roof/Row\"\nclick \"Reach/Goal/roof/Delete\""), "");
    EXPECT_TRUE(document().level().goals.empty());
}

TEST_F(ReachPanel, WalkersOfAnAuditStartEverywhere) {
    ASSERT_EQ(run("command panel.audit\nwait 3\nclick \"Audit/Start everywhere\"\nclick \"Audit/Run "
                  "audit\"\nfinish"),
              "");
    ASSERT_TRUE(editor().audit->report()) << editor().audit->problem();
    EXPECT_EQ(editor().audit->report()->starts, 60u);
    EXPECT_NE(editor().audit->tape_of({.walker = 5}).start, document().level().spawn);
}

}  // namespace
}  // namespace slipface
