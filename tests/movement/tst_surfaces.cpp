// What each surface type does, and that it does nothing with surface types switched off.
#include <cstring>

#include "test_geometry.h"

namespace slipface::test {

// --- ladder
// ----------------------------------------------------------------------------------------------------------

namespace {

// A ladder on the wall x = 2 from the floor to a platform at height 4.
void build_ladder(Lab& lab) {
    lab.floor();
    lab.wall({2, -1}, {2, 1}, 0.0, 4.0, ladder);
    lab.wall({2, -10}, {2, -1}, 0.0, 4.0);
    lab.wall({2, 1}, {2, 10}, 0.0, 4.0);
    lab.polygon({{2, 4, -10}, {2, 4, 10}, {12, 4, 10}, {12, 4, -10}});
    lab.ready();
}

PlayerState on_ladder(const Lab& lab, const MovementSettings& s) {
    PlayerState state = run(lab, s, at({1.0, 0.95, 0}), {}, 30);
    for (int i = 0; i < 60 && !state.climbing; ++i)
        state = step(lab.scene(), s, state, wish(1, 0), tick).state;
    return state;
}

}  // namespace

TEST(Ladder, IsClimbedAtItsSpeedWithoutGravity) {
    Lab lab;
    build_ladder(lab);
    const MovementSettings s = basic_settings();
    PlayerState state = on_ladder(lab, s);
    ASSERT_TRUE(state.climbing);
    EXPECT_FALSE(state.grounded);
    EXPECT_EQ(state.ground_surface, ladder);
    const double y = state.position.y();
    state = run(lab, s, state, wish(1, 0), 30);
    EXPECT_NEAR(state.position.y(), y + 1.5, 1e-6);  // 3 m/s for 0.5 s
    EXPECT_NEAR(state.position.x(), 2 - 0.4 - s.skin, 1e-6);
    // Let go of the stick: hangs, bit by bit.
    const Vec3 rest = state.position;
    state = run(lab, s, state, {}, 120);
    EXPECT_EQ(std::memcmp(rest.data(), state.position.data(), sizeof(double) * 3), 0);
    EXPECT_TRUE(state.climbing);
    // Sideways along the plane, then away from the wall: down.
    state = run(lab, s, state, wish(0, 1), 10);
    EXPECT_NEAR(state.position.z(), 0.5, 1e-6);
    EXPECT_NEAR(state.position.y(), rest.y(), 1e-6);
    state = run(lab, s, state, wish(-1, 0), 10);
    EXPECT_NEAR(state.position.y(), rest.y() - 0.5, 1e-6);
}

TEST(Ladder, IsLeftAtTheFloor) {
    Lab lab;
    build_ladder(lab);
    const MovementSettings s = basic_settings();
    PlayerState state = run(lab, s, on_ladder(lab, s), wish(1, 0), 10);
    ASSERT_TRUE(state.climbing);
    state = run(lab, s, state, wish(-1, 0), 60);
    EXPECT_FALSE(state.climbing);
    EXPECT_TRUE(state.grounded);
    EXPECT_LT(state.position.x(), 0.0) << "walks away";
}

TEST(Ladder, IsLeftAtTheTopByWalkingOntoIt) {
    Lab lab;
    build_ladder(lab);
    const MovementSettings s = basic_settings();
    PlayerState state = on_ladder(lab, s);
    // 4 m of wall and 0.9 m of player at 3 m/s, then a walk of 3 m: 4 s are ample.
    for (int i = 0; i < 240 && state.position.x() < 5.0; ++i) {
        state = step(lab.scene(), s, state, wish(1, 0), tick).state;
        ASSERT_FALSE(overlaps_any(lab.world(), s.radii, state.position)) << i;
    }
    EXPECT_FALSE(state.climbing);
    EXPECT_TRUE(state.grounded);
    EXPECT_GT(state.position.x(), 5.0);
    EXPECT_NEAR(state.position.y(), 4.0 + 0.9 + s.skin, 1e-6);
}

TEST(Ladder, IsLeftByAJumpOffAlongTheNormal) {
    Lab lab;
    build_ladder(lab);
    const MovementSettings s = basic_settings();
    PlayerState state = run(lab, s, on_ladder(lab, s), wish(1, 0), 30);
    const double x = state.position.x();
    state = step(lab.scene(), s, state, wish(0, 0, true), tick).state;
    EXPECT_FALSE(state.climbing);
    EXPECT_NEAR(state.velocity.x(), -8.0, 1e-6);
    EXPECT_NEAR(state.position.x(), x - 8.0 * tick, 1e-6);
}

TEST(Ladder, ThatEndsBelowAWallHoldsAtItsEnd) {
    Lab lab;
    lab.floor();
    lab.wall({2, -5}, {2, 5}, 0.0, 3.0, ladder);
    lab.wall({2, -5}, {2, 5}, 3.0, 9.0);
    lab.ready();
    const MovementSettings s = basic_settings();
    PlayerState state = run(lab, s, on_ladder(lab, s), wish(1, 0), 120);
    EXPECT_TRUE(state.climbing);
    EXPECT_NEAR(state.position.y(), 3.0, 0.06);
    const double y = state.position.y();
    EXPECT_NEAR(run(lab, s, state, wish(1, 0), 60).position.y(), y, 1e-9);
}

// A ladder that leans against a wall: the wall ends the climb, and what the player holds on to stays the
// ladder.
TEST(Ladder, ThatLeansAgainstAWallIsHeldOnToAtItsEnd) {
    Lab lab;
    lab.floor();
    lab.polygon({{2, 0, -5}, {2, 0, 5}, {3, 3, 5}, {3, 3, -5}}, ladder);
    lab.wall({3, -5}, {3, 5}, 3.0, 9.0);
    lab.ready();
    const MovementSettings s = basic_settings();
    PlayerState state = on_ladder(lab, s);
    for (int i = 0; i < 120; ++i) {
        state = step(lab.scene(), s, state, wish(1, 0), tick).state;
        ASSERT_TRUE(state.climbing) << i;
        ASSERT_EQ(state.ground_surface, ladder) << i;
    }
    EXPECT_GT(state.position.y(), 2.5);
}

// A platform that moves where the player never comes changes nothing of a climb onto the top of a ladder.
TEST(Ladder, IsClimbedAlikeBesideAFarPlatform) {
    Lab lab, far;
    build_ladder(lab);
    far.floor(100.0);
    far.ready();
    const Pose before{.offset = Vec3(0, -0.1, 0)};
    const std::vector<MovingPart> parts{{.rest = &far.world(), .begin = before, .end = {}}};
    MovementScene with = lab.scene();
    with.platforms = parts;
    const MovementSettings s = basic_settings();
    PlayerState one = on_ladder(lab, s), other = one;
    bool arrived = false;
    for (int i = 0; i < 180; ++i) {
        one = step(lab.scene(), s, one, wish(1, 0), tick).state;
        other = step(with, s, other, wish(1, 0), tick).state;
        ASSERT_EQ(one, other) << i;
        arrived = arrived || one.grounded;
    }
    EXPECT_TRUE(arrived);
}

TEST(Ladder, IsAWallWithoutSurfaceTypes) {
    Lab lab;
    build_ladder(lab);
    MovementSettings s = basic_settings();
    s.surface_types = false;
    EXPECT_FALSE(on_ladder(lab, s).climbing);
}

TEST(Ladder, IsPassedByWhoWalksAlongIt) {
    Lab lab;
    build_ladder(lab);
    const MovementSettings s = basic_settings();
    PlayerState state = run(lab, s, at({1.5, 0.95, -4}), {}, 30);
    // 11 degrees into the wall is no wish to climb.
    for (int i = 0; i < 90; ++i) {
        state = step(lab.scene(), s, state, wish(0.196, 0.98), tick).state;
        ASSERT_FALSE(state.climbing);
    }
    EXPECT_GT(state.position.z(), 3.0);
}

// --- sticky
// ----------------------------------------------------------------------------------------------------------

TEST(Sticky, WallsAndCeilingsHoldUntilAJump) {
    for (const bool overhead : {false, true}) {
        Lab lab;
        lab.floor(-40);
        if (overhead) {
            lab.floor(3, sticky);
        } else {
            lab.wall({2, -9}, {2, 9}, -5, 9, sticky);
        }
        lab.ready();
        const MovementSettings s = basic_settings();
        PlayerState state = at({1, 1, 0}, overhead ? Vec3(0, 12, 0) : Vec3(10, 0, 0));
        for (int i = 0; i < 30 && !state.stuck; ++i)
            state = step(lab.scene(), s, state, {}, tick).state;
        ASSERT_TRUE(state.stuck) << overhead;
        const Vec3 held = state.position;
        EXPECT_EQ(state.velocity, Vec3(0, 0, 0));
        state = run(lab, s, state, wish(-1, 0.3), 60);
        EXPECT_EQ(std::memcmp(held.data(), state.position.data(), sizeof(double) * 3), 0);
        const Vec3 normal = overhead ? Vec3(0, -1, 0) : Vec3(-1, 0, 0);
        EXPECT_LT((state.ground_normal - normal).norm(), 1e-9);
        const PlayerState off = step(lab.scene(), s, state, wish(0, 0, true), tick).state;
        EXPECT_FALSE(off.stuck);
        EXPECT_LT((off.velocity - (8.0 * normal + Vec3(0, -s.gravity * tick, 0))).norm(), 1e-9);
        // Repainted, it lets go.
        lab.world().set_face_surface(1, plain);
        EXPECT_FALSE(run(lab, s, state, {}, 5).stuck);
    }
}

TEST(Sticky, DoesNotActWithoutSurfaceTypes) {
    Lab lab;
    lab.floor(0, sticky);
    lab.ready();
    MovementSettings s = basic_settings();
    EXPECT_TRUE(run(lab, s, at({0, 1, 0}), {}, 60).stuck);
    s.surface_types = false;
    EXPECT_FALSE(run(lab, s, at({0, 1, 0}), {}, 60).stuck);
}

// --- bounce
// ----------------------------------------------------------------------------------------------------------

TEST(Bouncy, DropHeightsFallByTheSquareOfTheRestitution) {
    for (const double e : {0.5, 0.8, 1.0}) {
        for (const int rate : {30, 60, 240}) {
            Lab lab;
            lab.surfaces[bouncy].restitution = e;
            lab.floor(0, bouncy);
            lab.ready();
            const MovementSettings s = basic_settings();
            const double dt = 1.0 / rate;
            const double rest = 0.9 + s.skin;
            PlayerState state = at({0, rest + 4.0, 0});
            // The apex between two ticks is the height plus v v / 2g of the rising player.
            double expected = 4.0;
            bool rising = false;
            int bounces = 0;
            for (int i = 0; i < 6 * rate && bounces < 3; ++i) {
                state = step(lab.scene(), s, state, {}, dt).state;
                const bool up = state.velocity.y() > 0.0;
                if (up && !rising) {
                    expected *= e * e;
                    const double height =
                        state.position.y() - rest + state.velocity.y() * state.velocity.y() / (2 * s.gravity);
                    EXPECT_NEAR(height, expected, 0.01 * expected)
                        << e << " at " << rate << " Hz, bounce " << bounces;
                    ++bounces;
                }
                rising = up;
            }
            EXPECT_EQ(bounces, 3) << e << " at " << rate;
        }
    }
}

// A bounce is flight: it leaves nothing to stand on, and no late jump starts from it.
TEST(Bouncy, ABounceIsNoGroundToJumpFrom) {
    Lab lab;
    lab.floor(0, bouncy);
    lab.ready();
    const MovementSettings s = every_hack();
    PlayerState state = at({0, 1.0, 0}, {0, -6, 0});
    state.coyote_s = s.coyote_time;
    for (int i = 0; i < 10 && state.velocity.y() < 0.0; ++i)
        state = step(lab.scene(), s, state, {}, tick).state;
    ASSERT_GT(state.velocity.y(), 1.0);
    EXPECT_FALSE(state.grounded);
    EXPECT_EQ(state.ground_face, no_id);
    EXPECT_EQ(state.coyote_s, 0.0);
    TraceRecorder trace;
    step(lab.scene(), s, state, wish(0, 0, true), tick, &trace);
    EXPECT_TRUE(decisions_of(trace, Decision::jumped).empty());
}

TEST(Bouncy, WithoutSurfaceTypesItStops) {
    Lab lab;
    lab.floor(0, bouncy);
    lab.ready();
    MovementSettings s = basic_settings();
    s.surface_types = false;
    PlayerState state = at({0, 3, 0});
    for (int i = 0; i < 60; ++i) {
        state = step(lab.scene(), s, state, {}, tick).state;
        EXPECT_LE(state.velocity.y(), 0.0);
    }
    EXPECT_TRUE(state.grounded);
}

TEST(Bouncy, ComesToRestAndCanBeWalkedOn) {
    Lab lab;
    lab.floor(0, bouncy);
    lab.ready();
    const MovementSettings s = basic_settings();
    PlayerState state = run(lab, s, at({0, 2, 0}), {}, 600);
    EXPECT_TRUE(state.grounded);
    for (int i = 0; i < 60; ++i) {
        state = step(lab.scene(), s, state, wish(1, 0), tick).state;
        EXPECT_TRUE(state.grounded);
    }
}

TEST(Bouncy, WallsReflectAndScaleTheParallelPartByFriction) {
    Lab lab;
    lab.surfaces[bouncy].restitution = 0.5;
    lab.surfaces[bouncy].friction = 4.0;  // keeps a quarter
    lab.wall({2, -90}, {2, 90}, -50, 50, bouncy);
    lab.ready();
    MovementSettings s = basic_settings();
    s.gravity = 0.0;
    const PlayerState state = run(lab, s, at({0, 0, 0}, {8, 0, 4}), {}, 30);
    EXPECT_LT((state.velocity - Vec3(-4, 0, 1)).norm(), 1e-9);
}

TEST(Ladder, AJumpRememberedFromBeforeItIsTracedOnce) {
    Lab lab;
    build_ladder(lab);
    MovementSettings s = basic_settings();
    s.jump_buffer = true;
    PlayerState state = on_ladder(lab, s);
    ASSERT_TRUE(state.climbing);
    state.jump_buffer_s = 0.05;
    state.jump_held = true;
    TraceRecorder trace;
    step(lab.scene(), s, state, wish(0, 0, true), tick, &trace);
    int explained = 0;
    for (const TraceRecord& record : trace.records) {
        const auto* decision = std::get_if<DecisionRecord>(&record);
        if (decision != nullptr && std::string_view(decision_info(decision->kind).hack) == "jump_buffer")
            ++explained;
    }
    EXPECT_EQ(explained, 1);
}

TEST(Conveyor, ThatPushesIntoAWallIsNoReasonToStepUp) {
    Lab lab;
    lab.surfaces[conveyor].velocity = Vec3(2, 0, 0);
    lab.floor(0, conveyor);
    lab.wall({2, -9}, {2, 9});
    lab.ready();
    MovementSettings s = basic_settings();
    s.step_up = true;
    const PlayerState pressed = run(lab, s, at({0, 0.95, 0}), {}, 90);
    TraceRecorder trace;
    step(lab.scene(), s, pressed, wish(-1, 0), tick, &trace);
    EXPECT_FALSE(has_decision(trace, "step_up", false, ""));
    EXPECT_FALSE(has_decision(trace, "step_up", true, ""));
}

TEST(Terrain, ItsDistanceBelowTheFeetIsTraced) {
    Lab lab;
    lab.floor(-50);
    lab.ready();
    const Heightfield field{
        .columns = 2, .rows = 2, .heights = {1, 1, 1, 1}, .origin = {-9, 0, -9}, .size = {18, 18}};
    MovementScene scene = lab.scene();
    scene.heightfield = &field;
    MovementSettings s = basic_settings();
    s.gravity = 0.0;
    TraceRecorder trace;
    step(scene, s, at({0, 4, 0}), {}, tick, &trace);
    const std::vector<DecisionRecord> above = decisions_of(trace, Decision::terrain_above);
    ASSERT_EQ(above.size(), 1u);
    EXPECT_NEAR(above[0].value, 4 - s.radii.y() - 1, 1e-12);
}

// A wall that comes half a metre along -X in a tick, to 0.05 m inside the player's body, pushes it a skin
// before itself.
TEST(Platforms, AWallThatComesPushesThePlayerAhead) {
    Lab lab, coming;
    lab.floor(-50);
    lab.ready();
    coming.wall({0.35, -5}, {0.35, 5});
    coming.ready();
    const Pose before{.offset = Vec3(0.5, 0, 0)};
    const std::vector<MovingPart> parts{
        {.rest = &coming.world(), .begin = before, .end = {}, .velocity = Vec3(-30, 0, 0)}};
    MovementScene scene = lab.scene();
    scene.platforms = parts;
    MovementSettings s = basic_settings();
    s.gravity = 0.0;
    const PlayerState state = step(scene, s, at({0, 5, 0}), {}, tick).state;
    EXPECT_NEAR(state.position.x(), 0.35 - s.radii.x() - s.skin, 1e-6);
    EXPECT_FALSE(state.trapped);
}

TEST(Platforms, SwitchedOffGiveNoVelocityToAJump) {
    Lab lab;
    lab.floor(-20);
    lab.ready();
    Lab raft;
    raft.floor(0, plain, 3);
    raft.ready();
    const std::vector<MovingPart> parts{
        {.rest = &raft.world(), .begin = {}, .end = {}, .velocity = Vec3(3, 0, 0)}};
    MovementScene scene = lab.scene();
    scene.platforms = parts;
    for (const bool on : {true, false}) {
        MovementSettings s = basic_settings();
        s.platforms = on;
        PlayerState state = at({0, 0.95, 0});
        for (int i = 0; i < 20; ++i)
            state = step(scene, s, state, {}, tick).state;
        ASSERT_EQ(state.ground_platform, 0u);
        state = step(scene, s, state, wish(0, 0, true), tick).state;
        EXPECT_NEAR(state.velocity.x(), on ? 3.0 : 0.0, 1e-9);
    }
}

// --- moving surfaces
// -------------------------------------------------------------------------------------------------

TEST(Conveyor, CarriesAndGivesItsVelocityOnLeave) {
    Lab lab;
    lab.surfaces[conveyor].velocity = Vec3(0, 0, -2);
    lab.floor(0, conveyor);
    lab.ready();
    MovementSettings s = basic_settings();
    PlayerState state = run(lab, s, at({0, 0.95, 0}), {}, 30);
    const Vec3 from = state.position;
    state = run(lab, s, state, {}, 60);
    EXPECT_NEAR((state.position - from).z(), -2.0, 1e-9);
    EXPECT_TRUE(state.grounded);
    const PlayerState jumped = step(lab.scene(), s, state, wish(0, 0, true), tick).state;
    EXPECT_NEAR(jumped.velocity.z(), -2.0, 1e-9);
    s.surface_types = false;
    EXPECT_NEAR(run(lab, s, state, {}, 60).position.z(), state.position.z(), 1e-9);
}

TEST(Conveyor, DoesNotCarryThroughAWall) {
    Lab lab;
    lab.floor(0, conveyor);
    lab.wall({-20, -3}, {20, -3});
    lab.ready();
    const MovementSettings s = basic_settings();
    const PlayerState state = run(lab, s, at({0, 0.95, 0}), {}, 300);
    EXPECT_NEAR(state.position.z(), -3 + 0.4 + s.skin, 1e-6);
    EXPECT_TRUE(state.grounded);
}

TEST(Turntable, CarriesOnTheCircle) {
    Lab lab;
    lab.surfaces[turntable].angular_velocity = 2 * pi;
    lab.surfaces[turntable].spin_centre = Vec3(1, 0, 2);
    lab.floor(0, turntable);
    lab.ready();
    const MovementSettings s = basic_settings();
    PlayerState state = at({10, 0.9 + s.skin, 2});
    state.grounded = true;
    state.ground_face = 0;
    state.ground_surface = turntable;
    // 60 ticks of 6 degrees, 9 m out.
    for (int i = 1; i <= 60; ++i) {
        state = step(lab.scene(), s, state, {}, tick).state;
        const double a = 2 * pi * i / 60;
        EXPECT_LT((state.position - Vec3(1 + 9 * std::cos(a), 0.9 + s.skin, 2 - 9 * std::sin(a))).norm(),
                  1e-4)
            << i;
        EXPECT_TRUE(state.grounded);
    }
}

// --- the rest
// --------------------------------------------------------------------------------------------------------

TEST(Hazard, IsReportedWhileTouched) {
    Lab lab;
    lab.polygon({{-5, 0, -5}, {-5, 0, 5}, {0, 0, 5}, {0, 0, -5}});
    lab.polygon({{0, 0, -5}, {0, 0, 5}, {5, 0, 5}, {5, 0, -5}}, hazard);
    lab.ready();
    MovementSettings s = basic_settings();
    EXPECT_FALSE(run(lab, s, at({-3, 1, 0}), {}, 30).hazard);
    EXPECT_TRUE(run(lab, s, at({3, 1, 0}), {}, 30).hazard);
    EXPECT_FALSE(run(lab, s, at({3, 5, 0}), {}, 1).hazard);
    s.surface_types = false;
    EXPECT_FALSE(run(lab, s, at({3, 1, 0}), {}, 30).hazard);
}

TEST(Solid, WhatIsNotIsPassed) {
    Lab lab;
    lab.surfaces[hazard].solid = false;
    lab.floor(-10);
    lab.floor(0, hazard);
    lab.ready();
    const MovementSettings s = basic_settings();
    EXPECT_NEAR(run(lab, s, at({0, 3, 0}), {}, 180).position.y(), -10 + 0.9 + s.skin, 1e-6);
}

TEST(OneSided, LetsThroughFromBehindOnly) {
    Lab lab;
    lab.surfaces[bouncy].restitution = 0.0;
    lab.surfaces[bouncy].one_sided = true;
    lab.floor(0, bouncy);  // winding normal up
    lab.ready();
    const MovementSettings s = basic_settings();
    ASSERT_GT(lab.world().triangle_normal(0).y(), 0.0);
    const PlayerState up = run(lab, s, at({0, -2, 0}, {0, 15, 0}), {}, 30);
    EXPECT_GT(up.position.y(), 1.0) << "up through it";
    const PlayerState down = run(lab, s, up, {}, 120);
    EXPECT_NEAR(down.position.y(), 0.9 + s.skin, 1e-6) << "and lands on it";
}

TEST(Surfaces, AnUnknownIdIsPlainGround) {
    Lab lab;
    lab.floor(0, SurfaceId{200});
    lab.ready();
    const MovementSettings s = basic_settings();
    EXPECT_TRUE(run(lab, s, at({0, 1, 0}), {}, 60).grounded);
    const MovementScene empty{.collision = lab.world(), .surfaces = {}};
    EXPECT_TRUE(std::isfinite(step(empty, s, at({0, 1, 0}), {}, tick).state.position.y()));
}

TEST(Surfaces, PresetsAreComplete) {
    const std::vector<SurfaceType> types = preset_surface_types();
    ASSERT_EQ(types.size(), 8u);
    const std::array<const char*, 8> names{"default", "ice",      "ladder",    "sticky",
                                           "bouncy",  "conveyor", "turntable", "hazard"};
    for (std::size_t i = 0; i < types.size(); ++i) {
        EXPECT_EQ(types[i].name, names[i]);
        for (std::size_t j = 0; j < i; ++j) {
            EXPECT_NE(types[i].hotkey, types[j].hotkey);
            EXPECT_NE(types[i].color, types[j].color);
            EXPECT_NE(types[i].hatch, types[j].hatch);
        }
        // Every default lies in the range that its field allows.
        for (const SurfaceField& field : surface_fields()) {
            if (const auto* number = std::get_if<double SurfaceType::*>(&field.member)) {
                EXPECT_GE(types[i].*(*number), field.minimum) << field.name;
                EXPECT_LE(types[i].*(*number), field.maximum) << field.name;
            }
        }
    }
    EXPECT_TRUE(types[ice].keeps_energy && types[ladder].climbable && types[sticky].sticky &&
                types[hazard].hazardous);
    EXPECT_GT(types[bouncy].restitution, 0.0);
}

}  // namespace slipface::test
