// slipface_level.h against the C++ functions: the same bits, and errors in words.
#include <gtest/gtest.h>
#include <slipface_level.h>

#include <cmath>
#include <cstring>

#include "collision/scenes.h"
#include "mover/calls.h"
#include "slipface/level/level_file.h"
#include "slipface/level/level_scene.h"

namespace slipface {
namespace {

using scenes::Random;

bool same(const slipface_vec3& a, const Vec3& b) {
    return a.x == b.x() && a.y == b.y() && a.z == b.z();
}

// The same player through a level with platforms in both interfaces.
TEST(C, StepsGiveTheBitsOfCppAndTheSameTrace) {
    const std::string path = SLIPFACE_SOURCE_DIR "/assets/levels/island.slipface.json";
    Result<LoadedLevel> loaded = load_level(path);
    ASSERT_TRUE(loaded.ok());
    const Level& level = loaded->level;
    LevelScene scene = LevelScene::build(level).value();
    slipface_world world{};
    slipface_settings settings{};
    OK(slipface_world_from_level(path.c_str(), &world, &error));
    OK(slipface_world_settings(world, &settings, &error));
    slipface_vec3 start;
    double yaw = 0;
    OK(slipface_world_spawn(world, settings, nullptr, &start, &yaw, &error));
    slipface_player player;
    OK(slipface_player_at(world, start, &player, &error));
    PlayerState state = scene.player_at(Vec3(start.x, start.y, start.z) - scene.offset());

    struct Count {
        std::size_t records = 0, sweeps = 0, hits = 0;
    } count;
    const auto note = [](void* user, const slipface_record* record) {
        Count& all = *static_cast<Count*>(user);
        ++all.records;
        all.sweeps += record->kind == SLIPFACE_SWEEP;
        all.hits += record->kind == SLIPFACE_SWEEP && record->contact.t <= 1.0;
        EXPECT_NE(record->name, nullptr);
        EXPECT_NE(record->text, nullptr);
    };
    slipface_report report{};
    report.size = sizeof report;
    report.trace = note;
    report.user = &count;
    TraceRecorder recorder;
    Random random(9);
    const double dt = 1.0 / 60.0;
    slipface_input input{sizeof input, 0, 0, 0};
    for (int tick = 0; tick < 1500; ++tick) {
        if (tick % 40 == 0) {
            const double a = random.uniform(0, 6.28);
            input = {sizeof input, random.below(2) != 0 ? std::uint32_t{SLIPFACE_JUMP} : 0, std::cos(a),
                     std::sin(a)};
        }
        OK(slipface_world_set_time(world, tick * dt, dt, &error));
        OK(slipface_step(world, settings, &player, &input, dt, nullptr, &report, &player, &error));
        state = step(scene.at(tick * dt, dt), level.movement, state,
                     {.wish = {input.wish_x, input.wish_z}, .buttons = {Button::jump, input.buttons != 0}},
                     dt, &recorder)
                    .state;
        ASSERT_TRUE(same(player.position, state.position) && same(player.velocity, state.velocity) &&
                    ((player.flags & SLIPFACE_GROUNDED) != 0) == state.grounded &&
                    player.ground_face == state.ground_face && player.numbers[1] == state.coyote_s)
            << tick;
    }
    EXPECT_EQ(count.records, recorder.records.size());
    EXPECT_GT(count.hits, 500u);
    slipface_vec3 motion;
    OK(slipface_motion_velocity(&player, &motion, &error));
    EXPECT_TRUE(same(motion, motion_velocity(state)));
    slipface_player put;
    std::uint8_t done = 9;
    OK(slipface_put_player(world, settings, &player, 2.0, nullptr, &put, &done, &error));
    const auto placed = put_player(scene.at(0, dt), level.movement, state, 2.0);
    EXPECT_EQ(done, placed ? 1 : 0);
    EXPECT_TRUE(!placed || same(put.position, placed->position));
    OK(slipface_world_free(world, &error));
    OK(slipface_settings_free(settings, &error));
}

TEST(C, WhatIsNoLevelIsRefusedInWords) {
    slipface_error said;
    slipface_world world{};
    slipface_settings settings{};
    EXPECT_EQ(slipface_world_from_level("/no/such.obj", &world, &said), SLIPFACE_CANNOT_READ);
    EXPECT_NE(std::strstr(said.text, "no such"), nullptr) << said.text;
    EXPECT_EQ(slipface_settings_from_file("/no/such.json", &settings, &said), SLIPFACE_CANNOT_READ);
    OK(slipface_settings_from_file(SLIPFACE_SOURCE_DIR "/assets/presets/momentum.json", &settings, &error));
    double speed = 0.0;
    OK(slipface_settings_get(settings, "walk_speed", &speed, &error));
    EXPECT_EQ(speed, 9.0);
    const slipface_triangles nothing{sizeof nothing, nullptr, 0, nullptr, 0, nullptr, nullptr};
    OK(slipface_world_from_triangles(&nothing, &world, &error));
    EXPECT_EQ(slipface_world_set_time(world, 0, 0.1, &said), SLIPFACE_WRONG_ARGUMENT);
    EXPECT_NE(std::strstr(said.text, "triangles"), nullptr) << said.text;
    OK(slipface_world_free(world, &error));
    OK(slipface_settings_free(settings, &error));
}

}  // namespace
}  // namespace slipface
