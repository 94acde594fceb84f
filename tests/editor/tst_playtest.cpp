#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "level_fixture.h"
#include "slipface/sim/simulate.h"
#include "tools/playtest/playtest.h"

namespace slipface {
namespace {

constexpr double tick = Playtest::tick_s;

class PlaytestTest : public LevelFixture {
  protected:
    void SetUp() override {
        LevelFixture::SetUp();
        document = open();
    }
    MovementScene scene() const { return document->scene(); }
    const MovementSettings& movement() const { return document->level().movement; }
    int advance(const PlaytestInput& input, double seconds) {
        return playtest.advance(scene(), movement(), input, seconds);
    }
    void settle() {
        for (int i = 0; i < 60; ++i)
            advance({}, tick);
    }

    const Vec3 middle{4, 0.95, 4};
    std::unique_ptr<Document> document;
    Playtest playtest;
};

TEST_F(PlaytestTest, StandsOnTheFloor) {
    playtest.start(middle, 0);
    settle();
    EXPECT_TRUE(playtest.state().grounded);
    EXPECT_NEAR(playtest.state().position.y(), 0.9, 0.01);  // the ellipsoid's half height
    // The velocity holds the push against the floor; the player stands still all the same.
    EXPECT_GT(playtest.state().velocity.norm(), 0.5);
    EXPECT_NEAR(playtest.speed(), 0.0, 1e-3);
}

TEST_F(PlaytestTest, FramesOfAnyLengthMakeWholeTicks) {
    playtest.start(middle, 0);
    EXPECT_EQ(advance({}, 0.4 * tick), 0);
    EXPECT_EQ(advance({}, 0.4 * tick), 0);
    EXPECT_EQ(advance({}, 0.4 * tick), 1);
    EXPECT_EQ(advance({}, 3.0 * tick), 3);
    EXPECT_EQ(advance({}, 0.0), 0);
    EXPECT_EQ(advance({}, -5.0), 0);
    EXPECT_EQ(advance({}, std::nan("")), 0);
    EXPECT_EQ(playtest.tape().tick_count(), 4u);
}

TEST_F(PlaytestTest, LongPauseIsNotMadeUpFor) {
    playtest.start(middle, 0);
    EXPECT_EQ(advance({}, 100.0), Playtest::max_ticks_per_frame);
    EXPECT_EQ(advance({}, 0.5 * tick), 0);
}

TEST_F(PlaytestTest, ShownPositionLiesBetweenTheLastTwoTicks) {
    playtest.start(Vec3(4, 5, 4), 0);
    advance({}, 7 * tick);
    const double at = playtest.state().position.y();
    const double shown = playtest.shown_position().y();
    EXPECT_GE(shown, at);  // falling: shown a little behind
    advance({}, 0.5 * tick);
    EXPECT_LT(playtest.shown_position().y(), shown);
    EXPECT_GT(playtest.shown_position().y(), playtest.state().position.y());
}

TEST_F(PlaytestTest, WalksWhereTheCameraLooks) {
    for (const double yaw : {0.0, 0.5, 1.5708, -2.0}) {
        playtest.start(middle, yaw);
        for (int i = 0; i < 20; ++i)
            advance({.stick = {0, 1}}, tick);
        const Vec3 moved = playtest.state().position - middle;
        const Vec2 walked(moved.x(), moved.z());
        const Vec2 forward(-std::sin(yaw), -std::cos(yaw));
        EXPECT_GT(walked.dot(forward), 0.5) << yaw;
        EXPECT_NEAR(walked.normalized().dot(forward), 1.0, 1e-6) << yaw;
    }
    playtest.start(middle, 0);
    for (int i = 0; i < 20; ++i)
        advance({.stick = {1, 0}}, tick);
    EXPECT_GT(playtest.state().position.x(), middle.x() + 0.5);  // right of -Z is +X
}

TEST_F(PlaytestTest, LookingTurnsRightAndUpWithinLimits) {
    playtest.start(middle, 0);
    advance({.look = {0.25, 0.1}}, 0);
    EXPECT_NEAR(playtest.yaw, -0.25, 1e-12);
    EXPECT_NEAR(playtest.pitch, -0.1, 1e-12);
    advance({.look = {0, 100}}, 0);
    EXPECT_LT(playtest.pitch, std::numbers::pi / 2);
    advance({.look = {std::nan(""), 0}}, 0);
    EXPECT_TRUE(std::isfinite(playtest.yaw));
}

TEST_F(PlaytestTest, PressShorterThanATickStillJumps) {
    playtest.start(middle, 0);
    settle();
    ASSERT_TRUE(playtest.state().grounded);
    advance({.buttons = Button::jump}, 0.2 * tick);
    advance({}, tick);
    EXPECT_GT(playtest.state().velocity.y(), 1.0);
}

// A run of random inputs and frame times is repeated bit by bit by its tape, written out and read in again.
TEST_F(PlaytestTest, TapeRepeatsTheRunExactly) {
    constexpr int large = 128;
    write_text(obj, floor_and_wall_obj(large));
    document = open();
    const Vec3 start(large / 2 + 0.5, 0.95, large / 2 + 0.5);
    MovementSettings changed;
    changed.walk_speed = 7.123456789;
    changed.keep_energy = false;
    document->set_movement(changed, "Change");
    // Rows of ice, bouncy and hazardous faces (which put back to the start) across the way.
    const SurfaceId bouncy = 4, hazard = 7;
    std::vector<FaceId> rows[3];
    for (FaceId face = 0; face < large * large; ++face)
        if (face % 5 < 3) rows[face % 5 == 2 ? (face % 35 == 2 ? 2 : 1) : 0].push_back(face);
    document->paint(rows[0], ice);
    document->paint(rows[1], bouncy);
    document->paint(rows[2], hazard);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> fraction(0.0, 1.0);
    playtest.start(start, 0.3);
    playtest.name_level("grid.obj", document->level().mesh.fingerprint(), scene_fingerprint(scene()));
    std::size_t ticks = 0;
    int respawns = 0;
    PlaytestInput input;
    for (int frame = 0; frame < 3000; ++frame) {
        if (frame % 20 == 0) {
            input.stick = Vec2(2 * fraction(random) - 1, 2 * fraction(random) - 1);
            input.buttons.set(Button::jump, fraction(random) < 0.3);
        }
        input.look = Vec2(0.1 * (fraction(random) - 0.5), 0.0);
        const Vec3 before = playtest.state().position;
        ticks += static_cast<std::size_t>(advance(input, 0.04 * fraction(random)));
        if (playtest.state().position == start && before != start) ++respawns;
    }
    ASSERT_GT(ticks, 3000u);
    ASSERT_EQ(playtest.tape().tick_count(), ticks);
    EXPECT_GT(respawns, 0);

    const Result<Tape> tape = parse_tape(tape_to_text(playtest.tape()), "tape");
    ASSERT_TRUE(tape.ok()) << tape.error().text();
    MovementSettings settings;
    ASSERT_TRUE(apply_tape_settings(settings, *tape, "tape").ok());
    EXPECT_EQ(settings, changed);
    ASSERT_TRUE(tape->start.has_value());
    const SimulationReport report = simulate(scene(), settings, *tape->start, *tape);
    EXPECT_EQ(report.ticks, ticks);
    EXPECT_EQ(report.final_state, playtest.state());
    EXPECT_EQ(state_hash(report.final_state, 0), state_hash(playtest.state(), 0));
}

TEST_F(PlaytestTest, SettingsChangedOnTheWayAreOnTheTape) {
    playtest.start(middle, 0);
    advance({.stick = {0, 1}}, 5 * tick);
    MovementSettings other = movement();
    other.gravity = 5;
    other.walk_speed = 1.0 / 3.0;
    document->set_movement(other, "Change");
    advance({.stick = {0, 1}, .buttons = Button::jump}, 5 * tick);
    document->undo();
    advance({.stick = {1, 0}}, 5 * tick);

    const Result<Tape> tape = parse_tape(tape_to_text(playtest.tape()), "tape");
    ASSERT_TRUE(tape.ok()) << tape.error().text();
    EXPECT_EQ(tape->changes.size(), 4u);
    MovementSettings settings;
    settings.gravity = 17;  // the level's own do not matter
    ASSERT_TRUE(apply_tape_settings(settings, *tape, "tape").ok());
    EXPECT_EQ(simulate(scene(), settings, *tape->start, *tape).final_state, playtest.state());
}

TEST_F(PlaytestTest, GoesOnFromAnyTickOfATape) {
    playtest.start(middle, 0);
    for (int i = 0; i < 40; ++i)
        advance({.stick = {0.3, 1}, .buttons = {Button::jump, i == 20}}, tick);
    const Tape whole = playtest.tape();
    const Tape part = cut_tape(whole, 30);
    const SimulationReport at = simulate(scene(), movement(), middle, part);
    Playtest again;
    again.resume(part, movement(), at.final_state, at.final_state.position, at.end_hash, 0);
    for (int i = 30; i < 40; ++i)
        again.advance(scene(), movement(), {.stick = {0.3, 1}}, tick);
    EXPECT_EQ(again.state(), playtest.state());
    EXPECT_EQ(tape_to_text(again.tape()), tape_to_text(whole));
    EXPECT_EQ(again.hash(), playtest.hash());
    EXPECT_EQ(again.hash(), simulate(scene(), movement(), middle, whole).end_hash);
}

TEST_F(PlaytestTest, HazardPutsBackToTheSpawn) {
    std::vector<FaceId> floor(wall);
    for (FaceId face = 0; face < wall; ++face)
        floor[face] = face;
    document->paint(floor, SurfaceId{7});
    playtest.start(Vec3(4, 2, 4), 0);
    bool back = false;
    double last = 2;
    for (int i = 0; i < 120 && !back; ++i) {
        advance({}, tick);
        back = playtest.state().position.y() > last;
        last = playtest.state().position.y();
    }
    EXPECT_TRUE(back);
    EXPECT_EQ(playtest.state().position, Vec3(4, 2, 4));
    EXPECT_EQ(playtest.shown_position(), Vec3(4, 2, 4));  // no flight across the level
}

TEST_F(PlaytestTest, FallingOutOfTheLevelPutsBackToTheSpawn) {
    playtest.start(Vec3(100, 0, 100), 1.0);
    bool fell = false, back = false;
    for (int i = 0; i < 60 * 20 && !back; ++i) {
        advance({}, tick);
        fell = fell || playtest.state().position.y() < -10;
        back = fell && playtest.state().position == Vec3(100, 0, 100);
    }
    EXPECT_TRUE(back);
    EXPECT_GT(playtest.tape().tick_count(), 60u);
}

TEST_F(PlaytestTest, FirstPersonLooksFromTheHead) {
    playtest.start(middle, 0.7);
    playtest.pitch = 0.2;
    playtest.first_person = true;
    const Camera camera = playtest.camera(scene(), movement());
    EXPECT_NEAR(camera.eye.x(), middle.x(), 1e-12);
    EXPECT_GT(camera.eye.y(), middle.y());
    EXPECT_LT(camera.eye.y(), middle.y() + movement().radii.y());
    const Vec3 forward = camera.target - camera.eye;
    EXPECT_NEAR(std::asin(forward.normalized().y()), 0.2, 1e-9);
    EXPECT_NEAR(std::atan2(-forward.x(), -forward.z()), 0.7, 1e-9);
}

TEST_F(PlaytestTest, ThirdPersonStaysInFrontOfWalls) {
    playtest.first_person = false;
    playtest.pitch = 0;
    playtest.start(middle, 0);
    playtest.pitch = 0;
    const Camera free = playtest.camera(scene(), movement());
    EXPECT_NEAR((free.eye - free.target).norm(), 1.0, 1e-9);
    EXPECT_NEAR(free.eye.z(), middle.z() + playtest.boom, 1e-9);  // looking along -Z from behind

    // From above, looking up: the boom would go through the floor at y = 0.
    playtest.pitch = 1.0;
    const Camera floor = playtest.camera(scene(), movement());
    EXPECT_GT(floor.eye.y(), 0.0);
    EXPECT_LT((floor.eye - playtest.shown_position()).norm(), playtest.boom);
    // Nothing lies between the player and the eye.
    EXPECT_FALSE(cast_ray(scene().collision, middle, floor.eye - middle, 1.0).has_value());
}

}  // namespace
}  // namespace slipface
