// Long ticks, and bodies that change: random scenes by seed.
#include <limits>

#include "test_geometry.h"

namespace slipface::test {

namespace {

// A floor with random triangles above it, as dense as a forest.
void random_scene(Lab& lab, Random& random, int triangles) {
    lab.floor();
    for (int i = 0; i < triangles; ++i) {
        const Vec3 centre(random.between(-8, 8), random.between(0, 4), random.between(-8, 8));
        const auto corner = [&] {
            return Vec3(centre +
                        Vec3(random.between(-1.5, 1.5), random.between(-1, 1), random.between(-1.5, 1.5)));
        };
        lab.polygon({corner(), corner(), corner()});
    }
    lab.ready();
}

std::optional<PlayerState> free_player(Lab& lab, const MovementSettings& s, Random& random) {
    for (int tries = 0; tries < 100; ++tries) {
        const Vec3 position(random.between(-8, 8), random.between(1, 5), random.between(-8, 8));
        if (!overlaps_any(lab.world(), s.radii, position)) return at(position);
    }
    return std::nullopt;
}

}  // namespace

TEST(Hitch, IsMovedInPartsOfAQuarterSecond) {
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        Lab lab;
        random_scene(lab, random, 60);
        const MovementSettings s = basic_settings();
        const auto start = free_player(lab, s, random);
        ASSERT_TRUE(start);
        const PlayerInput input = wish(random.between(-1, 1), random.between(-1, 1), random.below(2) == 0);
        const PlayerState whole = step(lab.scene(), s, *start, input, 1.5).state;
        PlayerState parts = run(lab, s, *start, input, 6, 0.25);
        EXPECT_EQ(whole.position, parts.position);
        EXPECT_EQ(whole.velocity, parts.velocity);
        EXPECT_FALSE(whole.position == start->position);
    }
}

TEST(Hitch, EndsOutsideAfterAnyTime) {
    for (std::uint64_t seed = 100; seed < 130; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        Lab lab;
        random_scene(lab, random, 60);
        const MovementSettings s = every_hack();
        auto player = free_player(lab, s, random);
        ASSERT_TRUE(player);
        for (int i = 0; i < 40; ++i) {
            const PlayerInput input =
                wish(random.between(-1, 1), random.between(-1, 1), random.below(3) == 0);
            player = step(lab.scene(), s, *player, input, random.between(0.25, 5.0)).state;
            ASSERT_FALSE(overlaps_any(lab.world(), s.radii, player->position)) << i;
        }
    }
}

TEST(Hitch, CountsAsAMinuteAtMost) {
    Lab lab;
    lab.floor();
    lab.ready();
    const MovementSettings s = basic_settings();
    const PlayerState start = at({0, 3, 0});
    const PlayerState minute = step(lab.scene(), s, start, wish(0, 1), 60.0).state;
    EXPECT_TRUE(step(lab.scene(), s, start, wish(0, 1), 1e300).state == minute);
    EXPECT_FALSE(minute == start);
}

TEST(Hitch, CarriesByAPlatformOnce) {
    Lab lab, platform;
    lab.floor(-20);
    lab.ready();
    platform.floor(0, plain, 5);
    platform.ready();
    const MovementSettings s = basic_settings();
    MovingPart part;
    part.rest = &platform.world();
    PlayerState player = at({0, s.radii.y() + 0.05, 0});
    const auto scene = [&] {
        return MovementScene{.collision = lab.world(), .surfaces = lab.surfaces, .platforms = {&part, 1}};
    };
    for (int i = 0; i < 30; ++i)
        player = step(scene(), s, player, {}, tick).state;
    ASSERT_EQ(player.ground_platform, 0u);
    // The platform has moved by 1 m along X during one second: its faces stand at the end.
    part.begin.offset.x() = -1.0;
    part.velocity.x() = 1.0;
    const PlayerState carried = step(scene(), s, player, {}, 1.0).state;
    EXPECT_NEAR(carried.position.x() - player.position.x(), 1.0, 0.01);
}

TEST(Body, CrouchesAndStandsUpInTheOpen) {
    for (const double degrees : {0.0, 10.0, 30.0, 40.0}) {
        SCOPED_TRACE(degrees);
        Lab lab;
        lab.slope(radians(degrees));
        lab.ready();
        const MovementSettings tall = basic_settings();
        MovementSettings low = tall;
        low.radii.y() *= 0.5;
        const PlayerState standing = standing_on_slope(lab, tall, radians(degrees));
        ASSERT_TRUE(standing.grounded);
        const auto crouched = change_body(lab.scene(), tall, standing, low.radii);
        ASSERT_TRUE(crouched);
        const PlayerState settled = run(lab, low, *crouched, {}, 5);
        EXPECT_TRUE(settled.grounded);
        EXPECT_NEAR(settled.position.y(), crouched->position.y(), 2 * tall.skin);
        const auto up = change_body(lab.scene(), low, settled, tall.radii);
        ASSERT_TRUE(up);
        EXPECT_NEAR(up->position.y(), standing.position.y(), 2 * tall.skin);
    }
}

TEST(Body, CrouchesAndStandsUpOnTerrain) {
    Heightfield hill{.columns = 2, .rows = 2, .heights = {0.0, 8.0, 0.0, 8.0}};
    hill.origin = Vec3(-10, 0, -10);
    hill.size = Vec2(20, 20);  // 22 degrees up along X
    const CollisionWorld nothing;
    const std::vector<SurfaceType> types = preset_surface_types();
    const MovementScene scene{.collision = nothing, .surfaces = types, .heightfield = &hill};
    MovementSettings tall = basic_settings();
    tall.heightfield = true;
    MovementSettings low = tall;
    low.radii.y() *= 0.5;
    PlayerState player = at({2, 7, 0});
    const auto rest = [&](const MovementSettings& settings) {
        for (int i = 0; i < 90; ++i)
            player = step(scene, settings, player, {}, tick).state;
        ASSERT_TRUE(player.grounded);
        EXPECT_NEAR(player.position.y(), 4.0 + 0.4 * player.position.x() + settings.radii.y(), 1e-9);
    };
    rest(tall);
    const double feet = player.position.y() - tall.radii.y();
    for (const MovementSettings* next : {&low, &tall}) {
        const auto changed = change_body(scene, next == &low ? tall : low, player, next->radii);
        ASSERT_TRUE(changed);
        EXPECT_NEAR(changed->position.y() - next->radii.y(), feet, 1e-12);
        player = *changed;
        rest(*next);
        EXPECT_NEAR(player.position.y() - next->radii.y(), feet, 1e-9);
    }
}

TEST(Body, DoesNotStandUpUnderACeiling) {
    const MovementSettings tall = basic_settings();
    MovementSettings low = tall;
    low.radii.y() *= 0.5;
    Lab lab;
    lab.floor();
    lab.floor(1.5 * tall.radii.y());
    lab.ready();
    const PlayerState player = run(lab, low, at({0, low.radii.y() + 0.02, 0}), {}, 10);
    EXPECT_FALSE(change_body(lab.scene(), low, player, tall.radii));
    EXPECT_TRUE(change_body(lab.scene(), low, player, low.radii));
}

TEST(Body, NeverEndsInsideNorBehindATriangle) {
    int changed = 0, refused = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        Lab lab;
        random_scene(lab, random, 120);
        MovementSettings s = every_hack();
        auto player = free_player(lab, s, random);
        ASSERT_TRUE(player);
        for (int i = 0; i < 200; ++i) {
            const PlayerInput input =
                wish(random.between(-1, 1), random.between(-1, 1), random.below(9) == 0);
            player = step(lab.scene(), s, *player, input, tick).state;
            const Vec3 radii(random.between(0.2, 0.8), random.between(0.3, 1.2), random.between(0.2, 0.8));
            const auto other = change_body(lab.scene(), s, *player, radii);
            ++(other ? changed : refused);
            if (!other) continue;
            const Vec3 way = other->position - player->position;
            if (way.norm() > 0.0) {
                ASSERT_FALSE(cast_ray(lab.world(), player->position, way, 1.0)) << i;
            }
            s.radii = radii;
            player = other;
            ASSERT_FALSE(overlaps_any(lab.world(), s.radii, player->position)) << i;
        }
    }
    EXPECT_GT(changed, 500);
    EXPECT_GT(refused, 500);
}

TEST(Body, RefusesBadNumbers) {
    Lab lab;
    lab.floor();
    lab.ready();
    const MovementSettings s = basic_settings();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double bad : {0.0, -1.0, nan, 1.0 / 0.0})
        EXPECT_FALSE(change_body(lab.scene(), s, at({0, 3, 0}), {0.5, bad, 0.5})) << bad;
    EXPECT_FALSE(change_body(lab.scene(), s, at({0, nan, 0}), s.radii));
    EXPECT_TRUE(change_body(lab.scene(), s, at({0, 3, 0}), s.radii));
}

}  // namespace slipface::test
