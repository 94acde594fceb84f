// What a game asks of slipface.h beside a step: filters, contacts, events, triggers, rollback, threads of its
// own.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <thread>
#include <vector>

#include "mover/calls.h"
#include "slipface/movement/settings.h"

namespace slipface {
namespace {

using calls::Dice;

constexpr double dt = 1.0 / 60.0;

struct Shape {
    std::vector<float> positions;
    std::vector<std::uint32_t> indices;
    std::vector<std::uint8_t> types;
    std::vector<std::uint32_t> groups;

    void quad(const float (&corners)[12], std::uint8_t type = 0, std::uint32_t group = ~0U) {
        const auto first = static_cast<std::uint32_t>(positions.size() / 3);
        positions.insert(positions.end(), corners, corners + 12);
        for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U})
            indices.push_back(first + i);
        types.insert(types.end(), 2, type);
        groups.insert(groups.end(), 2, group);
    }
    void floor(float low, float high, float y, std::uint8_t type = 0, std::uint32_t group = ~0U) {
        quad({low, y, low, low, y, high, high, y, high, high, y, low}, type, group);
    }
    slipface_triangles view() const {
        return {sizeof(slipface_triangles), positions.data(), positions.size() / 3, indices.data(),
                indices.size() / 3,         types.data(),     groups.data()};
    }
};

// A bumpy yard with a lift.
void make_yard(slipface_world& world, std::uint32_t& lift) {
    Shape yard, plate;
    Dice random{7};
    for (int i = 0; i < 49; ++i) {
        const auto x = static_cast<float>(3 * (i % 7) - 10), z = static_cast<float>(3 * (i / 7) - 10);
        const auto y = [&] { return static_cast<float>(random.between(-0.4, 0.4)); };
        yard.quad({x, y(), z, x, y(), z + 3, x + 3, y(), z + 3, x + 3, y(), z},
                  static_cast<std::uint8_t>(random.below(8)));
    }
    yard.floor(-40, 40, -1);
    plate.floor(-2, 2, 0);
    const slipface_triangles view = yard.view(), lift_view = plate.view();
    OK(slipface_world_from_triangles(&view, &world, &error));
    OK(slipface_world_add_platform(world, &lift_view, &lift, &error));
}

slipface_input input_of(int player, int tick) {
    Dice random{static_cast<std::uint64_t>(player * 1000 + tick / 8)};
    return {sizeof(slipface_input), random.below(3) == 0 ? std::uint32_t{SLIPFACE_JUMP} : 0U,
            random.between(-1, 1), random.between(-1, 1)};
}

// The lift as it is within the tick, wherever the world was before: where the tick begins, and where it ends.
void set_lift(slipface_world world, std::uint32_t lift, int tick) {
    for (const int at : {tick, tick + 1}) {
        const double half = 0.01 * at;
        const double rotation[4] = {0, std::sin(half), 0, std::cos(half)};
        OK(slipface_world_move_platform(world, lift, {std::sin(0.05 * at), 0.5 + 0.02 * at, 0}, rotation, dt,
                                        &error));
    }
}

}  // namespace

// 16 players; at every tick the last 8 are played again from copies, as a game does that learns of late
// inputs.
TEST(Games, RollbackGivesTheSameBits) {
    slipface_world world{};
    slipface_settings settings{};
    std::uint32_t lift = 0;
    make_yard(world, lift);
    OK(slipface_settings_new(nullptr, &settings, &error));
    constexpr std::size_t count = 16;
    constexpr int depth = 8;
    const std::vector<slipface_settings> each(count, settings);
    std::vector<slipface_report> reports(count);
    std::vector<std::array<slipface_event, 8>> events(count);
    for (std::size_t i = 0; i < count; ++i) {
        reports[i].size = sizeof reports[i];
        reports[i].event_room = 8;
        reports[i].events = events[i].data();
    }
    using Players = std::vector<slipface_player>;
    const auto advance = [&](Players& players, int tick) {
        set_lift(world, lift, tick);
        std::vector<slipface_input> inputs;
        for (std::size_t i = 0; i < count; ++i)
            inputs.push_back(input_of(static_cast<int>(i), tick));
        OK(slipface_step_crowd(world, each.data(), players.data(), inputs.data(), count, dt, nullptr,
                               reports.data(), &error));
    };
    Players players(count);
    for (std::size_t i = 0; i < count; ++i)
        OK(slipface_player_at(world,
                              {1.5 * static_cast<double>(i % 4) - 2, 2, 1.5 * static_cast<double>(i / 4) - 2},
                              &players[i], &error));
    std::vector<Players> past;
    for (int tick = 0; tick < 200; ++tick) {
        past.push_back(players);
        advance(players, tick);
        if (tick + 1 < depth) continue;
        Players again = past[static_cast<std::size_t>(tick + 1 - depth)];
        for (int back = tick + 1 - depth; back <= tick; ++back)
            advance(again, back);
        ASSERT_EQ(std::memcmp(again.data(), players.data(), count * sizeof again[0]), 0) << tick;
    }
    OK(slipface_world_free(world, &error));
    OK(slipface_settings_free(settings, &error));
}

// A trapdoor of group 2 carries those whose mask has it; the callback does the same by triangles; and the
// type by its number.
TEST(Games, AFilterLetsAPlayerFall) {
    Shape shape;
    shape.floor(-5, 5, 0, 1, 2);
    shape.floor(-50, 50, -3, 0, 1);
    const slipface_triangles view = shape.view();
    slipface_world world{};
    slipface_settings settings{};
    OK(slipface_world_from_triangles(&view, &world, &error));
    OK(slipface_settings_new(nullptr, &settings, &error));
    const std::uint8_t ice = 1;
    const auto by_triangle = [](void*, std::uint32_t platform, std::uint32_t triangle) {
        return platform != SLIPFACE_NONE || triangle >= 2 ? 1 : 0;
    };
    const slipface_input rest{sizeof rest, 0, 0, 0};
    for (int kind = 0; kind < 4; ++kind) {
        slipface_filter filter = SLIPFACE_FILTER;
        if (kind == 1) filter.mask = ~2U;
        if (kind == 2) filter.sees = by_triangle;
        if (kind == 3) {
            filter.ignored_types = &ice;
            filter.ignored_type_count = 1;
        }
        slipface_player player, many;
        OK(slipface_player_at(world, {0, 1, 0}, &player, &error));
        many = player;
        for (int tick = 0; tick < 120; ++tick) {
            OK(slipface_step(world, settings, &player, &rest, dt, &filter, nullptr, &player, &error));
            OK(slipface_step_many(world, settings, &many, &rest, 1, dt, &filter, nullptr, &error));
        }
        EXPECT_NEAR(player.position.y, kind == 0 ? 0.902 : -2.098, 1e-3) << kind;
        EXPECT_EQ(std::memcmp(&many, &player, sizeof player), 0) << kind;
        slipface_ray_hit hit;
        OK(slipface_ray(world, {0, 1, 0}, {0, -1, 0}, INFINITY, &filter, &hit, &error));
        EXPECT_DOUBLE_EQ(hit.t, kind == 0 ? 1.0 : 4.0) << kind;
    }
    // The trapdoor opens for everybody who does not meet group 4.
    slipface_filter filter = SLIPFACE_FILTER;
    filter.mask = ~4U;
    for (const std::uint32_t face : {0U, 1U})
        OK(slipface_world_set_face_groups(world, SLIPFACE_NONE, face, 4, &error));
    slipface_ray_hit hit;
    OK(slipface_ray(world, {0, 1, 0}, {0, -1, 0}, INFINITY, &filter, &hit, &error));
    EXPECT_DOUBLE_EQ(hit.t, 4.0);
    OK(slipface_world_free(world, &error));
    OK(slipface_settings_free(settings, &error));
}

TEST(Games, AStepTellsOfContactsAndOfATriggerThatMoves) {
    Shape shape, sheet;
    shape.floor(-20, 20, 0);
    shape.quad({4, 0, 9, 4, 0, -9, 4, 3, -9, 4, 3, 9});
    sheet.quad({0, -1, 9, 0, -1, -9, 0, 3, -9, 0, 3, 9}, 0);
    const slipface_triangles view = shape.view();
    slipface_world world{};
    slipface_settings settings{};
    std::uint32_t gate = 0, type = 0;
    OK(slipface_world_from_triangles(&view, &world, &error));
    OK(slipface_world_add_type(world, "gate", &type, &error));
    const double off = 0;
    OK(slipface_world_set_type(world, type, "solid", &off, 1, &error));
    for (std::uint8_t& one : sheet.types)
        one = static_cast<std::uint8_t>(type);
    const slipface_triangles sheet_view = sheet.view();
    OK(slipface_world_add_platform(world, &sheet_view, &gate, &error));
    OK(slipface_settings_new(nullptr, &settings, &error));
    slipface_player player;
    OK(slipface_player_at(world, {-2, 0.902, 0}, &player, &error));
    slipface_contact contacts[4];
    slipface_event events[4];
    slipface_report report{};
    report.size = sizeof report;
    report.contact_room = report.event_room = 4;
    report.contacts = contacts;
    report.events = events;
    int walls = 0, entered = 0, departed = 0, stayed = 0;
    double fastest = 0;
    const slipface_input right{sizeof right, 0, 1, 0};
    for (int tick = 0; tick < 120; ++tick) {
        OK(slipface_world_move_platform(world, gate, {3 - 0.05 * tick, 0, 0}, nullptr, dt, &error));
        OK(slipface_step(world, settings, &player, &right, dt, nullptr, &report, &player, &error));
        for (std::uint32_t i = 0; i < report.contact_count; ++i) {
            if (contacts[i].normal.x > -0.9) continue;
            ++walls;
            EXPECT_TRUE(contacts[i].face == 2 || contacts[i].face == 3);
            EXPECT_EQ(contacts[i].pass, std::uint32_t{SLIPFACE_HORIZONTAL});
            fastest = std::max(fastest, contacts[i].speed);
        }
        for (std::uint32_t i = 0; i < report.event_count; ++i) {
            entered += events[i].kind == SLIPFACE_ENTERED;
            stayed += events[i].kind == SLIPFACE_STAYED;
            departed += events[i].kind == SLIPFACE_DEPARTED;
            if (events[i].kind >= SLIPFACE_ENTERED) {
                EXPECT_TRUE(events[i].type == type && events[i].platform == gate);
            }
        }
    }
    EXPECT_GT(walls, 10);
    EXPECT_NEAR(fastest, 6.0, 0.01);
    EXPECT_EQ(entered, 1);
    EXPECT_EQ(departed, 1);
    EXPECT_GT(stayed, 2);
    OK(slipface_world_free(world, &error));
    OK(slipface_settings_free(settings, &error));
}

// The bits of threads that a program brings are those of the library's.
TEST(Games, AJobSystemOfThePrograms) {
    slipface_world world{};
    slipface_settings settings{};
    std::uint32_t lift = 0;
    make_yard(world, lift);
    OK(slipface_settings_new(nullptr, &settings, &error));
    std::vector<slipface_player> players(200);
    Dice random{3};
    for (slipface_player& player : players)
        OK(slipface_player_at(world, {random.between(-8, 8), 2, random.between(-8, 8)}, &player, &error));
    std::vector<slipface_player> alone = players;
    std::vector<slipface_input> inputs;
    for (int i = 0; i < 200; ++i)
        inputs.push_back(input_of(i, 0));
    struct Counted {
        int runs = 0;
        std::size_t jobs = 0;
    } counted;
    const auto run = [](void* user, std::size_t count, void (*job)(void*, std::size_t), void* data) {
        Counted& all = *static_cast<Counted*>(user);
        ++all.runs;
        all.jobs += count;
        std::vector<std::thread> threads;
        for (std::size_t k = 0; k < 3; ++k)
            threads.emplace_back([=] {
                for (std::size_t i = k; i < count; i += 3)
                    job(data, i);
            });
        for (std::thread& thread : threads)
            thread.join();
    };
    for (int tick = 0; tick < 30; ++tick) {
        OK(slipface_set_jobs(run, &counted, 3, &error));
        OK(slipface_step_many(world, settings, players.data(), inputs.data(), players.size(), dt, nullptr,
                              nullptr, &error));
        OK(slipface_set_jobs(nullptr, nullptr, 0, &error));
        OK(slipface_step_many(world, settings, alone.data(), inputs.data(), alone.size(), dt, nullptr,
                              nullptr, &error));
    }
    EXPECT_GE(counted.runs, 30);
    EXPECT_GT(counted.jobs, 60U);
    EXPECT_EQ(std::memcmp(players.data(), alone.data(), players.size() * sizeof players[0]), 0);
    OK(slipface_world_free(world, &error));
    OK(slipface_settings_free(settings, &error));
}

// A caller of a later version, whose structs are longer, is understood; arrays are stepped through by the
// size.
TEST(Games, LongerStructsOfLaterVersionsAreUnderstood) {
    slipface_world world{};
    slipface_settings settings{};
    std::uint32_t lift = 0;
    make_yard(world, lift);
    OK(slipface_settings_new(nullptr, &settings, &error));
    struct LaterInput {
        slipface_input now;
        double more[3];
    };
    std::vector<LaterInput> later;
    std::vector<slipface_input> inputs;
    std::vector<slipface_player> players(20), same;
    for (int i = 0; i < 20; ++i) {
        OK(slipface_player_at(world, {0.1 * i, 2, 0}, &players[static_cast<std::size_t>(i)], &error));
        inputs.push_back(input_of(i, 0));
        later.push_back({inputs.back(), {9, 9, 9}});
        later.back().now.size = sizeof(LaterInput);
    }
    same = players;
    for (int tick = 0; tick < 30; ++tick) {
        OK(slipface_step_many(world, settings, players.data(), inputs.data(), 20, dt, nullptr, nullptr,
                              &error));
        OK(slipface_step_many(world, settings, same.data(), &later[0].now, 20, dt, nullptr, nullptr, &error));
    }
    EXPECT_EQ(std::memcmp(players.data(), same.data(), 20 * sizeof same[0]), 0);
    OK(slipface_world_free(world, &error));
    OK(slipface_settings_free(settings, &error));
}

TEST(Games, SettingsHaveNumbers) {
    slipface_settings settings{};
    OK(slipface_settings_new("momentum", &settings, &error));
    ASSERT_EQ(slipface_setting_count(), settings_table().size());
    for (std::uint32_t i = 0; i < slipface_setting_count(); ++i) {
        slipface_setting setting;
        std::uint32_t number = 0;
        double by_name = 0, by_number = 1;
        OK(slipface_setting_at(i, &setting, &error));
        OK(slipface_setting_find(setting.name, &number, &error));
        EXPECT_EQ(number, i);
        EXPECT_TRUE(setting.minimum <= setting.initial && setting.initial <= setting.maximum) << setting.name;
        OK(slipface_settings_set_number(settings, i, setting.maximum, &error));
        OK(slipface_settings_get(settings, setting.name, &by_name, &error));
        OK(slipface_settings_get_number(settings, i, &by_number, &error));
        EXPECT_EQ(by_name, setting.maximum);
        EXPECT_EQ(by_number, setting.maximum);
        EXPECT_EQ(slipface_settings_set_number(settings, i, std::nan(""), nullptr), SLIPFACE_WRONG_ARGUMENT);
        EXPECT_EQ(slipface_settings_set_number(settings, i, setting.maximum + 1, nullptr),
                  SLIPFACE_WRONG_ARGUMENT);
    }
    OK(slipface_settings_free(settings, &error));
}

// What is not a number, has no size or no direction is an error, and changes nothing.
TEST(Games, MisusesAreErrors) {
    slipface_world world{};
    slipface_settings settings{};
    std::uint32_t lift = 0;
    make_yard(world, lift);
    OK(slipface_settings_new(nullptr, &settings, &error));
    slipface_player player;
    OK(slipface_player_at(world, {0, 2, 0}, &player, &error));
    slipface_error error;
    const auto wrong = [&](slipface_status status, const char* text) {
        EXPECT_EQ(status, SLIPFACE_WRONG_ARGUMENT) << text;
        EXPECT_NE(std::strstr(error.text, text), nullptr) << error.text << " has no " << text;
    };
    const double nan = std::nan(""), inf = INFINITY;
    slipface_contact contact;
    slipface_ray_hit hit;
    slipface_closest closest;
    slipface_overlap overlap;
    std::size_t found = 0;
    slipface_vec3 turned;
    std::uint32_t number = 0;
    double value = 0;
    for (const double bad : {nan, inf, -inf}) {
        slipface_sweep sweep{{0.4, 0.9, 0.4}, {0, 2, 0}, {0, -1, 0}};
        for (double* const one :
             {&sweep.radii.x, &sweep.radii.y, &sweep.radii.z, &sweep.from.x, &sweep.from.y, &sweep.from.z,
              &sweep.move.x, &sweep.move.y, &sweep.move.z}) {
            const double good = *one;
            *one = bad;
            wrong(slipface_sweep_one(world, &sweep, nullptr, &contact, &error), "finite");
            wrong(slipface_sweep_many(world, &sweep, 1, nullptr, &contact, &error), "finite");
            wrong(slipface_sweep_hits(world, &sweep, nullptr, &contact, 1, &found, &error), "finite");
            *one = good;
        }
        wrong(slipface_ray(world, {0, bad, 0}, {0, 1, 0}, 1, nullptr, &hit, &error), "origin");
        wrong(slipface_ray(world, {0, 1, 0}, {0, 1, bad}, 1, nullptr, &hit, &error), "direction");
        wrong(slipface_ray_hits(world, {0, bad, 0}, {0, 1, 0}, 1, nullptr, &hit, 1, &found, &error),
              "origin");
        wrong(slipface_closest_point(world, {bad, 0, 0}, 1, nullptr, &closest, &error), "point");
        wrong(slipface_overlaps(world, {0.4, 0.9, 0.4}, {bad, 0, 0}, nullptr, &overlap, 1, &found, &error),
              "centre");
        wrong(slipface_overlaps(world, {bad, 0.9, 0.4}, {0, 0, 0}, nullptr, &overlap, 1, &found, &error),
              "radii");
        wrong(slipface_player_at(world, {bad, 0, 0}, &player, &error), "position");
        std::uint8_t done = 0;
        wrong(slipface_put_player(world, settings, &player, bad, nullptr, &player, &done, &error),
              "farthest");
        wrong(slipface_world_move_platform(world, lift, {bad, 0, 0}, nullptr, dt, &error), "position");
        const slipface_input input{sizeof input, 0, bad, 0};
        wrong(slipface_step(world, settings, &player, &input, dt, nullptr, nullptr, &player, &error), "wish");
    }
    for (const double radius : {0.0, -0.4}) {
        const slipface_sweep sweep{{0.4, radius, 0.4}, {0, 2, 0}, {0, -1, 0}};
        wrong(slipface_sweep_one(world, &sweep, nullptr, &contact, &error), "above 0");
        wrong(slipface_overlaps(world, {radius, 0.9, 0.4}, {0, 0, 0}, nullptr, &overlap, 1, &found, &error),
              "above 0");
        std::uint8_t done = 0;
        wrong(slipface_change_body(world, settings, &player, {0.4, radius, 0.4}, nullptr, &player, &done,
                                   &error),
              "above 0");
    }
    wrong(slipface_ray(world, {0, 1, 0}, {0, 0, 0}, 1, nullptr, &hit, &error), "direction");
    wrong(slipface_ray(world, {0, 1, 0}, {0, 1, 0}, -1, nullptr, &hit, &error), "max_t");
    wrong(slipface_ray(world, {0, 1, 0}, {0, 1, 0}, nan, nullptr, &hit, &error), "max_t");
    wrong(slipface_closest_point(world, {0, 0, 0}, -1, nullptr, &closest, &error), "max_distance");
    const double no_turn[4] = {0, 0, 0, 0};
    wrong(slipface_world_move_platform(world, lift, {0, 0, 0}, no_turn, dt, &error), "quaternion");
    wrong(slipface_world_move_platform(world, lift, {0, 0, 0}, nullptr, 0, &error), "dt");
    wrong(slipface_world_move_platform(world, 9, {0, 0, 0}, nullptr, dt, &error), "platform 9");
    wrong(slipface_world_set_face_groups(world, SLIPFACE_NONE, 1000, 1, &error), "face 1000");
    wrong(slipface_world_set_face_groups(world, 5, 0, 1, &error), "platform 5");
    wrong(slipface_setting_find("gravty", &number, &error), "gravty");
    wrong(slipface_settings_get_number(settings, 5000, &value, &error), "5000");
    wrong(slipface_settings_new("nobody", &settings, &error), "platformer");
    wrong(
        slipface_set_jobs([](void*, std::size_t, void (*)(void*, std::size_t), void*) {}, nullptr, 0, &error),
        "threads");
    // Structs without their size, and a player of another version.
    slipface_input input{sizeof input, 0, 0, 0};
    input.size = 0;
    wrong(slipface_step(world, settings, &player, &input, dt, nullptr, nullptr, &player, &error), "size 0");
    input.size = sizeof input;
    slipface_filter filter{};
    wrong(slipface_step(world, settings, &player, &input, dt, &filter, nullptr, &player, &error), "filter");
    wrong(slipface_ray(world, {0, 1, 0}, {0, 1, 0}, 1, &filter, &hit, &error), "filter");
    slipface_report report{};
    wrong(slipface_step(world, settings, &player, &input, dt, nullptr, &report, &player, &error), "report");
    report.size = sizeof report;
    report.contact_room = 5;
    wrong(slipface_step(world, settings, &player, &input, dt, nullptr, &report, &player, &error), "contacts");
    slipface_triangles triangles{};
    slipface_world other{};
    wrong(slipface_world_from_triangles(&triangles, &other, &error), "triangles");
    slipface_player old = player;
    old.size = 200;
    wrong(slipface_step(world, settings, &old, &input, dt, nullptr, nullptr, &player, &error), "200 bytes");
    wrong(slipface_motion_velocity(nullptr, &turned, &error), "null");
    old = player;
    old.trigger_count = 99;
    wrong(slipface_step(world, settings, &old, &input, dt, nullptr, nullptr, &player, &error),
          "trigger_count");
    EXPECT_EQ(slipface_world_free(world, nullptr), SLIPFACE_OK);
    EXPECT_EQ(slipface_settings_free(settings, nullptr), SLIPFACE_OK);
}

}  // namespace slipface
