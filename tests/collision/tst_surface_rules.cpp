// What is not solid, and what is solid from one side only.
#include <gtest/gtest.h>

#include "scenes.h"

namespace slipface {
namespace {

using scenes::Soup;

const Vec3 half_metre = Vec3::Constant(0.5);

// Face 5 at y = 1 above face 9 at y = 0; winding normals +Y.
struct TwoFloors {
    Soup soup;
    CollisionWorld world;

    TwoFloors() : soup(make()), world(soup.world()) {}
    static Soup make() {
        Soup s;
        s.add({-10, 1, -10}, {-10, 1, 10}, {20, 1, 0});
        s.add({-10, 0, -10}, {-10, 0, 10}, {20, 0, 0});
        s.faces = {5, 9};
        return s;
    }
};

TEST(SurfaceRules, FacesStartWithTheDefaultSurface) {
    TwoFloors scene;
    EXPECT_EQ(scene.world.face_surface(5), default_surface);
    scene.world.set_face_surface(5, 3);
    scene.world.set_face_surface(6, 4);  // no such face
    EXPECT_EQ(scene.world.face_surface(5), 3);
    EXPECT_EQ(scene.world.face_surface(6), default_surface);
    EXPECT_EQ(scene.world.face_surface(9), default_surface);
    const auto contact = sweep_ellipsoid(scene.world, half_metre, {0, 3, 0}, {0, -5, 0});
    ASSERT_TRUE(contact);
    EXPECT_EQ(contact->face, 5U);
    EXPECT_EQ(contact->surface, 3);
}

TEST(SurfaceRules, WhatIsNotSolidIsNotThere) {
    TwoFloors scene;
    scene.world.set_face_surface(5, 7);
    scene.world.set_surface_rule(7, {.solid = false, .one_sided = false});
    EXPECT_EQ(sweep_ellipsoid(scene.world, half_metre, {0, 3, 0}, {0, -5, 0})->face, 9U);
    EXPECT_EQ(cast_ray(scene.world, {0, 3, 0}, {0, -1, 0})->face, 9U);
    EXPECT_EQ(closest_point(scene.world, {0, 3, 0})->face, 9U);
    EXPECT_FALSE(overlaps_any(scene.world, half_metre, {0, 1.2, 0}));
    EXPECT_EQ(find_overlaps(scene.world, half_metre, {0, 1.2, 0}, {}), 0U);
    // Solid again, without a rebuild.
    scene.world.set_surface_rule(7, {});
    EXPECT_TRUE(overlaps_any(scene.world, half_metre, {0, 1.2, 0}));
}

struct OneSided : testing::Test {
    TwoFloors scene;
    OneSided() {
        scene.world.set_face_surface(5, 2);
        scene.world.set_surface_rule(2, {.solid = true, .one_sided = true});
    }
    std::optional<Contact> sweep(const Vec3& from, const Vec3& move) const {
        return sweep_ellipsoid(scene.world, half_metre, from, move);
    }
};

TEST_F(OneSided, StopsMotionAgainstTheWinding) {
    const auto contact = sweep({0, 3, 0}, {0, -5, 0});
    ASSERT_TRUE(contact);
    EXPECT_EQ(contact->face, 5U);
    EXPECT_NEAR(contact->t, 1.5 / 5, 1e-15);
}
TEST_F(OneSided, LetsMotionAlongTheWindingPass) {
    EXPECT_FALSE(sweep({0, 0.501, 0}, {0, 5, 0}));
}
TEST_F(OneSided, LetsACentreBehindThePlaneGoBack) {
    // Half way through from below, then falling: only the floor below stops it.
    const auto contact = sweep({0, 0.9, 0}, {0, -5, 0});
    ASSERT_TRUE(contact);
    EXPECT_EQ(contact->face, 9U);
}
TEST_F(OneSided, HoldsWhatItHardlyCutsAndLetsGoWhatDidNotClearIt) {
    const auto contact = sweep({0, 1.495, 0}, {0, -5, 0});
    ASSERT_TRUE(contact);
    EXPECT_EQ(contact->face, 5U);
    EXPECT_EQ(contact->t, 0.0);
    EXPECT_EQ(sweep({0, 1.4, 0}, {0, -5, 0})->face, 9U);
}
TEST_F(OneSided, ARimBesideTheBodyDoesNotStopIt) {
    // A plane in front of which the centre is by `front` of the radius when the rim, at x = -10, is touched.
    const auto stops = [&](double front) {
        const Vec3 from(-12, 1.0 + 0.5 * front + 1e-3, 0);
        const auto contact = sweep(from, {8, -8e-3, 0});
        return contact && contact->face == 5U;
    };
    for (double front = 0.05; front < 0.45; front += 0.05)
        EXPECT_FALSE(stops(front)) << front;
    for (double front = 0.55; front < 1.0; front += 0.05)
        EXPECT_TRUE(stops(front)) << front;
}
TEST_F(OneSided, IgnoresMotionParallelToThePlane) {
    // Its edge at x = -10 would stop a two-sided one.
    EXPECT_FALSE(sweep({-12, 1.2, 0}, {8, 0, 0}));
    scene.world.set_surface_rule(2, {});
    EXPECT_TRUE(sweep({-12, 1.2, 0}, {8, 0, 0}));
}
TEST_F(OneSided, OverlapsOnlyFromTheFront) {
    EXPECT_TRUE(overlaps_any(scene.world, half_metre, {0, 1.2, 0}));
    EXPECT_FALSE(overlaps_any(scene.world, half_metre, {0, 0.8, 0}));
    EXPECT_EQ(find_overlaps(scene.world, half_metre, {0, 0.8, 0}, {}), 0U);
}
TEST_F(OneSided, RaysAndDistancesSeeBothSides) {
    const auto hit = cast_ray(scene.world, {0, 0.5, 0}, {0, 1, 0});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->face, 5U);
    EXPECT_TRUE(hit->back_face);
    EXPECT_EQ(closest_point(scene.world, {0, 0.9, 0})->face, 5U);
}
TEST_F(OneSided, WithoutAreaThereIsNoSideToStopAt) {
    Soup soup;
    soup.add({-1, 0, 0}, {0, 0, 0}, {1, 0, 0});
    CollisionWorld world = soup.world();
    EXPECT_TRUE(sweep_ellipsoid(world, half_metre, {0, 3, 0}, {0, -5, 0}));
    world.set_surface_rule(default_surface, {.solid = true, .one_sided = true});
    EXPECT_FALSE(sweep_ellipsoid(world, half_metre, {0, 3, 0}, {0, -5, 0}));
}

}  // namespace
}  // namespace slipface
