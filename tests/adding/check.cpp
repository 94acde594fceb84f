// What check.py builds with the hack of hack.txt in it: everything that follows from the places of the
// CONTRIBUTING's checklist.
#include <gtest/gtest.h>

#include "movement/test_geometry.h"
#include "slipface/level/preset.h"
#include "slipface/scenes/demo.h"
#include "slipface/sim/simulate.h"
#include "slipface/sim/story.h"
#include "tools/commands/docs.h"

namespace slipface::test {
namespace {

Vec3 end_of(const Demo& demo, const MovementSettings& settings) {
    TapeRun run(std::make_shared<const Tape>(demo.tape), settings, demo.level.spawn);
    LevelScene level = std::move(LevelScene::build(demo.level, settings).value());
    const TickScene scene(level);
    run.advance(scene, TapeRun::max_ticks);
    return run.samples().back().position;
}

TEST(AddedHack, is_a_setting_in_files_and_pages) {
    MovementSettings settings = basic_settings();
    EXPECT_FALSE(settings.second_jump) << "off where an old file does not name it";
    ASSERT_TRUE(set_setting(settings, "second_jump=on").ok());
    ASSERT_TRUE(set_setting(settings, "second_jump_time=0.25").ok());
    const slipface::Preset mine{.name = "Mine", .about = "", .settings = settings};
    EXPECT_EQ(preset_from_json(preset_to_json(mine), "mine.json").value(), mine);
    EXPECT_NE(settings_markdown().find("| Second jump | `second_jump` | on |"), std::string::npos);
    EXPECT_TRUE(find_preset("momentum").value().settings.second_jump);
    EXPECT_FALSE(find_preset("simulation").value().settings.second_jump);
}

TEST(AddedHack, has_its_clock_in_the_state) {
    ASSERT_NE(find_demo("second-jump"), nullptr);
    const Demo demo = make_demo(*find_demo("second-jump"));
    EXPECT_LT(end_of(demo, demo.off).y(), -1.0);
    EXPECT_GT(end_of(demo, demo.on).y(), 0.5);

    PlayerState state;
    const std::uint64_t hash = state_hash(state, 0);
    state.second_jump_s = 0.1;
    EXPECT_NE(state_hash(state, 0), hash);
    state.second_jump_s = std::numeric_limits<double>::infinity();
    EXPECT_EQ(step({.collision = CollisionWorld(), .surfaces = {}}, {}, state, {}, 0.01).state, state)
        << "refused as not finite";
}

TEST(AddedHack, is_told_in_the_story) {
    const TraceRecord record = DecisionRecord{.kind = Decision::second_jump, .value = 0.2};
    const std::vector<StoryLine> lines = describe(std::span(&record, 1), {});
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines[0].text, "Jumped again in the air, 0.2 s before the window closed");
    EXPECT_EQ(lines[0].hack, find_setting("second_jump"));
}

TEST(AddedHack, leaves_the_hashes_of_older_tapes) {
    EXPECT_EQ(state_hash({}, 0), 0x8882bf295dadfff0U);
}

TEST(AddedParameter, slows_and_is_in_hashes_and_pages) {
    Lab lab;
    lab.floor();
    lab.ready();
    const std::uint64_t before = scene_fingerprint(lab.scene());
    lab.surfaces[plain].pace = 0.5;
    EXPECT_NE(scene_fingerprint(lab.scene()), before);
    EXPECT_NEAR(run(lab, {}, at({0, 0.902, 0}), wish(1, 0), 30).velocity.x(), 3.0, 1e-9);
    EXPECT_NE(settings_markdown().find("| Pace | `pace` |"), std::string::npos);
}

TEST(AddedChoice, is_settable_and_acts) {
    const Demo demo = make_demo(*find_demo("step-up"));
    MovementSettings settings = demo.on;
    ASSERT_TRUE(set_setting(settings, "step_form=when_slow").ok());
    EXPECT_GT(end_of(demo, demo.on).y(), end_of(demo, settings).y() + 1.0);
    EXPECT_NE(settings_markdown().find("When slow: the same, unless"), std::string::npos);
}

}  // namespace
}  // namespace slipface::test
