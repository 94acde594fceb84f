// slipface.h against the C++ functions: the same bits, and an error instead of a crash for bad input.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <thread>

#include "collision/scenes.h"
#include "mover/calls.h"
#include "slipface/collision/filter.h"
#include "slipface/movement/crowd.h"

namespace slipface {
namespace {

using scenes::Random;
using scenes::Soup;

slipface_vec3 c_of(const Vec3& v) {
    return {v.x(), v.y(), v.z()};
}
bool same(const slipface_vec3& a, const Vec3& b) {
    return a.x == b.x() && a.y == b.y() && a.z == b.z();
}

// Triangles of random types and groups, for both interfaces.
struct Twin {
    Soup soup;
    std::vector<std::uint8_t> types;
    std::vector<std::uint32_t> groups;
    std::vector<float> positions;
    std::vector<std::uint32_t> indices;
    slipface_triangles view{};

    explicit Twin(Random& random) {
        soup =
            random.below(2) == 0 ? scenes::random_soup(random, 200, 4, 1) : scenes::terrain(random, 9, 0.8);
        for (std::size_t i = 0; i < soup.triangles.size(); ++i) {
            soup.faces[i] = static_cast<FaceId>(i);
            types.push_back(static_cast<std::uint8_t>(random.below(8)));
            groups.push_back(std::uint32_t{1} << random.below(3));
            indices.insert(indices.end(), soup.triangles[i].begin(), soup.triangles[i].end());
        }
        for (const Vec3f& p : soup.positions)
            positions.insert(positions.end(), {p.x(), p.y(), p.z()});
        view = {sizeof view,           positions.data(), soup.positions.size(), indices.data(),
                soup.triangles.size(), types.data(),     groups.data()};
    }
    CollisionWorld world(const std::vector<SurfaceType>& surfaces) const {
        CollisionWorld made = soup.world();
        apply_surface_rules(made, surfaces);
        for (std::size_t i = 0; i < types.size(); ++i)
            made.set_face_surface(static_cast<FaceId>(i), types[i]);
        return made;
    }
};

bool same(const slipface_contact& a, const std::optional<Contact>& b) {
    if (!b) return a.t == 2.0 && a.triangle == SLIPFACE_NONE;
    return a.t == b->t && same(a.normal, b->normal) && same(a.point, b->point) && a.triangle == b->triangle &&
           a.face == b->face && a.type == b->surface && a.feature == static_cast<std::uint32_t>(b->feature) &&
           a.platform == SLIPFACE_NONE;
}

TEST(Mover, QueriesGiveTheBitsOfCpp) {
    Random random(5);
    const std::vector<SurfaceType> surfaces = preset_surface_types();
    int hits = 0;
    for (int round = 0; round < 8; ++round) {
        const Twin twin(random);
        const CollisionWorld cpp = twin.world(surfaces);
        slipface_world c{};
        OK(slipface_world_from_triangles(&twin.view, &c, &error));
        std::vector<slipface_sweep> sweeps;
        std::vector<slipface_contact> one_by_one;
        QueryFilter filter;
        filter.ignored[1] = filter.ignored[5] = true;
        filter.groups = twin.groups;
        filter.mask = 5;
        const std::array<std::uint8_t, 2> ignored{1, 5};
        slipface_filter c_filter = SLIPFACE_FILTER;
        c_filter.ignored_types = ignored.data();
        c_filter.ignored_type_count = 2;
        c_filter.mask = 5;
        for (int i = 0; i < 150; ++i) {
            const Vec3 from = Vec3(2, 0, 2) + random.in_box(4), direction = random.direction();
            const Vec3 move = random.uniform(0.1, 6) * direction;
            const Vec3 radii(random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 1));
            const slipface_sweep sweep{c_of(radii), c_of(from), c_of(move)};
            slipface_contact contact;
            OK(slipface_sweep_one(c, &sweep, nullptr, &contact, &error));
            EXPECT_TRUE(same(contact, sweep_ellipsoid(cpp, radii, from, move)));
            hits += contact.t <= 1.0;
            sweeps.push_back(sweep);
            one_by_one.push_back(contact);
            OK(slipface_sweep_one(c, &sweep, &c_filter, &contact, &error));
            EXPECT_TRUE(same(contact, sweep_ellipsoid(cpp, radii, from, move, filter)));

            std::vector<Contact> all(twin.types.size());
            std::vector<slipface_contact> c_all(all.size());
            std::size_t found = 0;
            OK(slipface_sweep_hits(c, &sweep, &c_filter, c_all.data(), c_all.size(), &found, &error));
            ASSERT_EQ(found, find_sweep_hits(cpp, radii, from, move, all, filter));
            for (std::size_t k = 0; k < found; ++k)
                EXPECT_TRUE(same(c_all[k], all[k]));

            const auto ray = cast_ray(cpp, from, move, 3.0, RayStops::solid, filter);
            slipface_ray_hit hit;
            OK(slipface_ray(c, c_of(from), c_of(move), 3.0, &c_filter, &hit, &error));
            EXPECT_EQ(hit.t, ray ? ray->t : -1.0);
            EXPECT_TRUE(!ray || (same(hit.point, ray->point) && same(hit.normal, ray->normal) &&
                                 hit.face == ray->face));
            std::vector<RayHit> rays(all.size());
            std::vector<slipface_ray_hit> c_rays(2);
            OK(slipface_ray_hits(c, c_of(from), c_of(move), 3.0, nullptr, c_rays.data(), 2, &found, &error));
            ASSERT_EQ(found, find_ray_hits(cpp, from, move, 3.0, RayStops::solid, rays));
            for (std::size_t k = 0; k < std::min<std::size_t>(2, found); ++k)
                EXPECT_EQ(c_rays[k].t, rays[k].t);

            const auto near = closest_point(cpp, from, 1.5, filter);
            slipface_closest closest;
            OK(slipface_closest_point(c, c_of(from), 1.5, &c_filter, &closest, &error));
            EXPECT_EQ(closest.distance, near ? near->distance : -1.0);
            std::vector<Overlap> touched(all.size());
            std::vector<slipface_overlap> c_touched(all.size());
            OK(slipface_overlaps(c, c_of(radii), c_of(from), nullptr, c_touched.data(), c_touched.size(),
                                 &found, &error));
            ASSERT_EQ(found, find_overlaps(cpp, radii, from, touched));
            for (std::size_t k = 0; k < found; ++k)
                EXPECT_TRUE(c_touched[k].depth == touched[k].depth_sphere_space &&
                            c_touched[k].triangle == touched[k].triangle);
        }
        std::vector<slipface_contact> many(sweeps.size());
        OK(slipface_sweep_many(c, sweeps.data(), sweeps.size(), nullptr, many.data(), &error));
        EXPECT_EQ(std::memcmp(many.data(), one_by_one.data(), many.size() * sizeof many[0]), 0);
        OK(slipface_world_free(c, &error));
    }
    EXPECT_GT(hits, 200);
}

// Every button and every member of a player: with all abilities on, the same state as in C++ in each tick.
TEST(Mover, ButtonsAndAbilitiesAreThoseOfCpp) {
    Random random(23);
    const Twin twin(random);
    slipface_world world{};
    slipface_settings settings{};
    OK(slipface_world_from_triangles(&twin.view, &world, &error));
    OK(slipface_settings_new("platformer", &settings, &error));
    MovementSettings values;
    for (const char* ability : {"air_jump=on", "wall_slide=on", "wall_jump=on", "dash=on", "crouch=on",
                                "ledge_grab=on", "drop_through=on", "glide=on"}) {
        OK(slipface_settings_set(settings, ability, &error));
        ASSERT_TRUE(set_setting(values, ability).ok());
    }
    const std::vector<SurfaceType> surfaces = preset_surface_types();
    const CollisionWorld collision = twin.world(surfaces);
    const MovementScene scene{.collision = collision, .surfaces = surfaces};
    std::uint32_t pressed = 0, crouched = 0, dashed = 0;
    for (int life = 0; life < 40; ++life) {
        const Vec3 start = Vec3(0, 3, 0) + random.in_box(2);
        slipface_player player;
        OK(slipface_player_at(world, c_of(start), &player, &error));
        PlayerState state;
        put_in_scene(scene, start, state);
        slipface_input input{sizeof input, 0, 0, 0};
        for (int tick = 0; tick < 120; ++tick) {
            if (tick % 10 == 0)
                input = {sizeof input, static_cast<std::uint32_t>(random.below(32)), random.uniform(-1, 1),
                         random.uniform(-1, 1)};
            PlayerInput same_input{.wish = {input.wish_x, input.wish_z}};
            same_input.buttons.bits = input.buttons;
            OK(slipface_step(world, settings, &player, &input, 1.0 / 60, nullptr, nullptr, &player, &error));
            state = step(scene, values, state, same_input, 1.0 / 60).state;
            ASSERT_TRUE(same(player.position, state.position) && same(player.velocity, state.velocity));
            for (std::size_t i = 0; i < PlayerState::numbers.size(); ++i)
                ASSERT_EQ(player.numbers[i], state.*PlayerState::numbers[i]) << i;
            for (std::size_t i = 0; i < PlayerState::counts.size(); ++i)
                ASSERT_EQ(player.counts[i], state.*PlayerState::counts[i]) << i;
            for (std::size_t i = 0; i < PlayerState::flags.size(); ++i)
                ASSERT_EQ(((player.flags >> i) & 1U) != 0, state.*PlayerState::flags[i]) << i;
            ASSERT_EQ((player.flags & SLIPFACE_CROUCHED) != 0, state.crouched);
            pressed |= input.buttons;
            crouched += (player.flags & SLIPFACE_CROUCHED) != 0 ? 1U : 0U;
            dashed += state.move_s > 0 ? 1U : 0U;
        }
    }
    EXPECT_EQ(pressed, 31U);
    EXPECT_GT(crouched, 200U);
    EXPECT_GT(dashed, 50U);
    OK(slipface_world_free(world, &error));
    OK(slipface_settings_free(settings, &error));
}

TEST(Mover, ManyPlayersMoveAsEachAlone) {
    Random random(3);
    const Twin twin(random);
    slipface_world world{};
    slipface_settings settings{};
    OK(slipface_world_from_triangles(&twin.view, &world, &error));
    OK(slipface_settings_new("momentum", &settings, &error));
    std::vector<slipface_player> many(100), alone;
    std::vector<slipface_input> inputs;
    for (slipface_player& player : many) {
        OK(slipface_player_at(world, c_of(Vec3(3, 4, 3) + random.in_box(2)), &player, &error));
        inputs.push_back({sizeof(slipface_input), 0, random.uniform(-1, 1), random.uniform(-1, 1)});
    }
    alone = many;
    for (int tick = 0; tick < 120; ++tick) {
        OK(slipface_step_many(world, settings, many.data(), inputs.data(), many.size(), 1.0 / 60, nullptr,
                              nullptr, &error));
        for (std::size_t i = 0; i < alone.size(); ++i)
            OK(slipface_step(world, settings, &alone[i], &inputs[i], 1.0 / 60, nullptr, nullptr, &alone[i],
                             &error));
    }
    EXPECT_EQ(std::memcmp(many.data(), alone.data(), many.size() * sizeof many[0]), 0);
    OK(slipface_world_free(world, &error));
    OK(slipface_settings_free(settings, &error));
}

TEST(Mover, ACrowdMovesAsInCpp) {
    Random random(17);
    const Twin twin(random);
    slipface_world world{};
    slipface_settings settings[2] = {};
    OK(slipface_world_from_triangles(&twin.view, &world, &error));
    for (slipface_settings& one : settings)
        OK(slipface_settings_new(nullptr, &one, &error));
    OK(slipface_settings_set(settings[1], "radius_y=0.5", &error));
    std::vector<MovementSettings> values(2);
    values[1].radii.y() = 0.5;
    const std::vector<SurfaceType> types = preset_surface_types();
    const CollisionWorld twin_world = twin.world(types);
    std::vector<slipface_settings> each;
    std::vector<slipface_player> players(40);
    std::vector<slipface_input> inputs;
    std::vector<CrowdMember> crowd;
    for (std::size_t i = 0; i < players.size(); ++i) {
        const Vec3 position = Vec3(3, 4, 3) + random.in_box(2);
        OK(slipface_player_at(world, c_of(position), &players[i], &error));
        inputs.push_back({sizeof(slipface_input), 0, random.uniform(-1, 1), random.uniform(-1, 1)});
        each.push_back(settings[i % 2]);
        CrowdMember member;
        member.settings = &values[i % 2];
        member.state.position = position;
        member.input.wish = {inputs[i].wish_x, inputs[i].wish_z};
        crowd.push_back(member);
    }
    for (int tick = 0; tick < 60; ++tick) {
        OK(slipface_step_crowd(world, each.data(), players.data(), inputs.data(), players.size(), 1.0 / 60,
                               nullptr, nullptr, &error));
        step_crowd({.collision = twin_world, .surfaces = types}, crowd, 1.0 / 60);
    }
    for (std::size_t i = 0; i < players.size(); ++i)
        EXPECT_EQ(players[i].position.y, crowd[i].state.position.y()) << i;
    each[3].id = 0;
    const slipface_player before = players[0];
    EXPECT_EQ(slipface_step_crowd(world, each.data(), players.data(), inputs.data(), players.size(), 1.0 / 60,
                                  nullptr, nullptr, nullptr),
              SLIPFACE_WRONG_HANDLE);
    EXPECT_EQ(std::memcmp(&before, &players[0], sizeof before), 0);
    OK(slipface_world_free(world, &error));
    OK(slipface_settings_free(settings[0], &error));
    OK(slipface_settings_free(settings[1], &error));
}

TEST(Mover, ALiftCarriesAPlayerAndTurns) {
    const float floor[] = {-5, 0, -5, 5, 0, -5, 5, 0, 5, -5, 0, 5};
    const std::uint32_t quad[] = {0, 2, 1, 0, 3, 2};
    const slipface_triangles shape{sizeof shape, floor, 4, quad, 2, nullptr, nullptr};
    const slipface_triangles nothing{sizeof nothing, nullptr, 0, nullptr, 0, nullptr, nullptr};
    slipface_world world{};
    slipface_settings settings{};
    std::uint32_t lift = 7;
    OK(slipface_world_from_triangles(&nothing, &world, &error));
    OK(slipface_world_add_platform(world, &shape, &lift, &error));
    EXPECT_EQ(lift, 0u);
    OK(slipface_settings_new(nullptr, &settings, &error));
    slipface_player player;
    OK(slipface_player_at(world, {3, 0.902, 0}, &player, &error));
    const slipface_input rest{sizeof rest, 0, 0, 0};
    const double dt = 1.0 / 60.0;
    for (int tick = 1; tick <= 60; ++tick) {  // a quarter turn, and a metre up
        const double half = 0.25 * 3.14159265358979 * tick / 60.0;
        const double rotation[4] = {0, std::sin(half), 0, std::cos(half)};
        OK(slipface_world_move_platform(world, lift, {0, tick / 60.0, 0}, rotation, dt, &error));
        OK(slipface_step(world, settings, &player, &rest, dt, nullptr, nullptr, &player, &error));
        ASSERT_EQ(player.ground_platform, 0u) << tick;
    }
    EXPECT_NEAR(player.position.y, 1.902, 0.01);
    EXPECT_NEAR(player.position.x, 0.0, 0.01);
    EXPECT_NEAR(player.position.z, -3.0, 0.02);
    OK(slipface_world_free(world, &error));
    OK(slipface_settings_free(settings, &error));
}

TEST(Mover, TypesAreChangedByName) {
    const float floor[] = {-5, 0, -5, 5, 0, -5, 5, 0, 5, -5, 0, 5};
    const std::uint32_t quad[] = {0, 2, 1, 0, 3, 2};
    const slipface_triangles shape{sizeof shape, floor, 4, quad, 2, nullptr, nullptr};
    slipface_world world{};
    OK(slipface_world_from_triangles(&shape, &world, &error));
    std::uint32_t ghost = 0, ice = 0, none = 0;
    OK(slipface_world_find_type(world, "ice", &ice, &error));
    EXPECT_EQ(ice, 1u);
    OK(slipface_world_find_type(world, "lava", &none, &error));
    EXPECT_EQ(none, SLIPFACE_NONE);
    OK(slipface_world_add_type(world, "ghost", &ghost, &error));
    const double off = 0.0;
    OK(slipface_world_set_type(world, ghost, "solid", &off, 1, &error));
    for (const std::uint32_t face : {0u, 1u})
        OK(slipface_world_set_face_type(world, face, ghost, &error));
    slipface_ray_hit hit;
    OK(slipface_ray(world, {0, 2, 0}, {0, -1, 0}, INFINITY, nullptr, &hit, &error));
    EXPECT_LT(hit.t, 0.0);
    const double on = 1.0, belt[3] = {2, 0, 0};
    OK(slipface_world_set_type(world, ghost, "solid", &on, 1, &error));
    OK(slipface_world_set_type(world, ghost, "velocity", belt, 3, &error));
    OK(slipface_ray(world, {0, 2, 0}, {0, -1, 0}, INFINITY, nullptr, &hit, &error));
    EXPECT_DOUBLE_EQ(hit.t, 2.0);
    OK(slipface_world_free(world, &error));
}

// Each call, and the status and a part of the text that it must give.
TEST(Mover, BadInputIsRefusedInWords) {
    const float floor[] = {-5, 0, -5, 5, 0, -5, 5, 0, 5, -5, 0, 5};
    const std::uint32_t quad[] = {0, 2, 1, 0, 3, 2}, beyond[] = {0, 2, 9};
    const slipface_triangles shape{sizeof shape, floor, 4, quad, 2, nullptr, nullptr};
    slipface_world world{};
    slipface_settings settings{};
    OK(slipface_world_from_triangles(&shape, &world, &error));
    OK(slipface_settings_new(nullptr, &settings, &error));
    slipface_player player;
    OK(slipface_player_at(world, {0, 0.902, 0}, &player, &error));
    slipface_input input{sizeof input, 0, 0, 0};
    slipface_error error;
    const auto expect = [&](slipface_status got, slipface_status wanted, const char* text) {
        EXPECT_EQ(got, wanted) << error.text;
        EXPECT_EQ(error.status, wanted);
        EXPECT_NE(std::strstr(error.text, text), nullptr) << error.text;
    };
    const double nan = std::nan("");
    slipface_world other{};
    const std::uint8_t wrong_types[] = {0, 99};
    float nan_floor[12];
    std::copy_n(floor, 12, nan_floor);
    nan_floor[4] = static_cast<float>(nan);
    for (const auto& [triangles, text] : std::initializer_list<std::pair<slipface_triangles, const char*>>{
             {{sizeof(slipface_triangles), floor, 4, beyond, 1, nullptr, nullptr}, "position 9"},
             {{sizeof(slipface_triangles), nullptr, 4, quad, 2, nullptr, nullptr}, "null"},
             {{sizeof(slipface_triangles), floor, 4, quad, std::size_t{1} << 40, nullptr, nullptr},
              "at most"},
             {{sizeof(slipface_triangles), floor, 4, quad, 2, wrong_types, nullptr}, "type 99"},
             {{sizeof(slipface_triangles), nan_floor, 4, quad, 2, nullptr, nullptr}, "finite"}})
        expect(slipface_world_from_triangles(&triangles, &other, &error), SLIPFACE_WRONG_ARGUMENT, text);
    EXPECT_EQ(other.id, 0u);
    expect(slipface_world_from_triangles(nullptr, &other, &error), SLIPFACE_WRONG_ARGUMENT, "null");
    expect(slipface_settings_set(settings, "gravty=1", &error), SLIPFACE_WRONG_ARGUMENT, "gravity");
    expect(slipface_settings_set(settings, "gravity=-1", &error), SLIPFACE_WRONG_ARGUMENT, "gravity");
    slipface_player put{};
    std::uint8_t done = 0;
    expect(slipface_put_player(world, settings, &put, -1.0, nullptr, &put, &done, &error),
           SLIPFACE_WRONG_ARGUMENT, "farthest");
    expect(slipface_world_set_face_type(world, 2, 0, &error), SLIPFACE_WRONG_ARGUMENT, "below 2");
    expect(slipface_world_set_face_type(world, 0, 77, &error), SLIPFACE_WRONG_ARGUMENT, "type 77");
    const double two[] = {1, 2};
    expect(slipface_world_set_type(world, 0, "friction", two, 2, &error), SLIPFACE_WRONG_ARGUMENT,
           "2 numbers");
    expect(slipface_world_set_type(world, 0, "friction", &nan, 1, &error), SLIPFACE_WRONG_ARGUMENT, "nan");
    expect(slipface_world_move_platform(world, 0, {0, 0, 0}, nullptr, 0.1, &error), SLIPFACE_WRONG_ARGUMENT,
           "platform 0");
    slipface_player next = player;
    expect(slipface_step(world, settings, &player, &input, nan, nullptr, nullptr, &next, &error),
           SLIPFACE_WRONG_ARGUMENT, "dt");
    slipface_player lost = player;
    lost.position.y = nan;
    expect(slipface_step(world, settings, &lost, &input, 0.1, nullptr, nullptr, &next, &error),
           SLIPFACE_WRONG_ARGUMENT, "position");
    lost = player;
    lost.ground_platform = 3;
    expect(slipface_step(world, settings, &lost, &input, 0.1, nullptr, nullptr, &next, &error),
           SLIPFACE_WRONG_ARGUMENT, "ground_platform");
    lost = player;
    lost.ground_type = 200;
    expect(slipface_step_many(world, settings, &lost, &input, 1, 0.1, nullptr, nullptr, &error),
           SLIPFACE_WRONG_ARGUMENT, "ground_type");
    EXPECT_EQ(std::memcmp(&next, &player, sizeof next), 0);
    // A handle of the other kind, one that was never given out, one that was freed, and one after another.
    expect(slipface_world_free({settings.id}, &error), SLIPFACE_WRONG_HANDLE, "world");
    expect(slipface_settings_free({0}, &error), SLIPFACE_WRONG_HANDLE, "settings");
    expect(slipface_world_free({~std::uint64_t{0}}, &error), SLIPFACE_WRONG_HANDLE, "world");
    EXPECT_EQ(slipface_world_free(world, nullptr), SLIPFACE_OK);
    expect(slipface_world_free(world, &error), SLIPFACE_WRONG_HANDLE, "freed");
    slipface_world again{};
    ASSERT_EQ(slipface_world_from_triangles(&shape, &again, &error), SLIPFACE_OK);
    expect(slipface_step(world, settings, &player, &input, 0.1, nullptr, nullptr, &next, &error),
           SLIPFACE_WRONG_HANDLE, "freed");
    EXPECT_EQ(slipface_world_free(again, nullptr), SLIPFACE_OK);
    EXPECT_EQ(slipface_settings_free(settings, nullptr), SLIPFACE_OK);
}

// A callback of a step is in the world: what changes it is refused there, and a query is answered.
TEST(Mover, AWorldThatIsInUseIsNotChanged) {
    const float floor[] = {-5, 0, -5, 5, 0, -5, 5, 0, 5, -5, 0, 5};
    const std::uint32_t quad[] = {0, 2, 1, 0, 3, 2};
    const slipface_triangles shape{sizeof shape, floor, 4, quad, 2, nullptr, nullptr};
    slipface_world world{};
    slipface_settings settings{};
    OK(slipface_world_from_triangles(&shape, &world, &error));
    OK(slipface_settings_new(nullptr, &settings, &error));
    slipface_player player;
    OK(slipface_player_at(world, {0, 0.902, 0}, &player, &error));
    struct Tried {
        slipface_world world;
        slipface_status change, free, query;
    } tried{world, SLIPFACE_OK, SLIPFACE_OK, SLIPFACE_FAILED};
    const auto try_all = [](void* user, const slipface_record*) {
        Tried& now = *static_cast<Tried*>(user);
        slipface_ray_hit hit;
        now.change = slipface_world_set_face_type(now.world, 0, 1, nullptr);
        now.free = slipface_world_free(now.world, nullptr);
        now.query = slipface_ray(now.world, {0, 2, 0}, {0, -1, 0}, 9, nullptr, &hit, nullptr);
    };
    const slipface_input input{sizeof input, 0, 0, 0};
    slipface_report report{};
    report.size = sizeof report;
    report.trace = try_all;
    report.user = &tried;
    OK(slipface_step(world, settings, &player, &input, 0.1, nullptr, &report, &player, &error));
    EXPECT_EQ(tried.change, SLIPFACE_IN_USE);
    EXPECT_EQ(tried.free, SLIPFACE_IN_USE);
    EXPECT_EQ(tried.query, SLIPFACE_OK);
    OK(slipface_world_free(world, &error));
    OK(slipface_settings_free(settings, &error));
}

// Threads that step, change and free at once: each call works or says that the world is in use or freed.
TEST(Mover, ThreadsAreToldWhenAWorldIsInUse) {
    Random random(4);
    const Twin twin(random);
    slipface_settings settings{};
    OK(slipface_settings_new(nullptr, &settings, &error));
    std::atomic<int> worked{0}, refused{0}, wrong{0};
    for (int round = 0; round < 20; ++round) {
        slipface_world world{};
        OK(slipface_world_from_triangles(&twin.view, &world, &error));
        const auto tell = [&](slipface_status status) {
            ++(status == SLIPFACE_OK                                          ? worked
               : status == SLIPFACE_IN_USE || status == SLIPFACE_WRONG_HANDLE ? refused
                                                                              : wrong);
        };
        std::vector<std::thread> threads;
        for (int t = 0; t < 3; ++t)
            threads.emplace_back([&] {
                slipface_player player{};
                slipface_status started{};
                do  // while another thread changes the world, there is no player yet
                    tell(started = slipface_player_at(world, {3, 4, 3}, &player, nullptr));
                while (started == SLIPFACE_IN_USE);
                if (started != SLIPFACE_OK) return;
                const slipface_input input{sizeof input, 0, 1, 0};
                for (int i = 0; i < 300; ++i)
                    tell(slipface_step(world, settings, &player, &input, 0.01, nullptr, nullptr, &player,
                                       nullptr));
            });
        threads.emplace_back([&] {
            for (int i = 0; i < 300; ++i)
                tell(slipface_world_set_face_type(world, 0, static_cast<std::uint32_t>(i % 8), nullptr));
            while (slipface_world_free(world, nullptr) == SLIPFACE_IN_USE) {
            }
        });
        for (std::thread& thread : threads)
            thread.join();
        EXPECT_EQ(slipface_world_free(world, nullptr), SLIPFACE_WRONG_HANDLE);
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_GE(worked, 20);  // a call is refused only while another one works
    OK(slipface_settings_free(settings, &error));
}

}  // namespace
}  // namespace slipface
