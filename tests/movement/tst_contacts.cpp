// One contact, one result: what a corner, a landing and a rim do depends on the planes, the velocity and the
// type, and neither on the tick in which they are met nor on what is touched first.
#include <algorithm>

#include "test_geometry.h"

namespace slipface::test {
namespace {

std::vector<MovementSettings> kinds_of_settings() {
    MovementSettings nothing = basic_settings();
    set_switches(nothing, false);
    return {MovementSettings{}, basic_settings(), every_hack(), nothing};
}

// Two walls that meet in an upright line through the origin or, if they lean, in its point; and a floor that
// rises by `rise` per metre along x and z.
struct InnerCorner {
    double angle;           // between the walls, which open along +X
    double lean_a, lean_b;  // away from the room; below 0 they hang over it
    Vec2 rise;

    Lab lab() const {
        Lab lab;
        const double half = angle / 2;
        wall(lab, {std::cos(half), 0, std::sin(half)}, {std::sin(half), 0, -std::cos(half)}, lean_a);
        wall(lab, {std::cos(half), 0, -std::sin(half)}, {std::sin(half), 0, std::cos(half)}, lean_b);
        const auto corner = [&](double x, double z) { return Vec3(x, rise.dot(Vec2(x, z)), z); };
        lab.polygon({corner(-40, -40), corner(-40, 40), corner(40, 40), corner(40, -40)});
        lab.ready();
        return lab;
    }

  private:
    static void wall(Lab& lab, const Vec3& along, const Vec3& inside, double lean) {
        const Vec3 up = 10 * (std::cos(lean) * Vec3::UnitY() - std::sin(lean) * inside);
        lab.polygon({-up - 2 * along, 40 * along - up, 40 * along + up, up - 2 * along});
    }
};

// How far the player moves to and fro in the fifth second of pushing into the corner, at most `aside` radians
// off its middle; m.
double to_and_fro(const InnerCorner& corner, double aside, const MovementSettings& s, int rate) {
    const Lab lab = corner.lab();
    const double x = 3.0 + 0.8 / std::sin(corner.angle / 2);
    PlayerState state = at({x, corner.rise.x() * x + 1.3, 0});
    const PlayerInput push = wish(-std::cos(aside), std::sin(aside));
    state = run(lab, s, state, push, 4 * rate, 1.0 / rate);
    const Vec3 begin = state.position;
    double way = 0.0;
    for (int i = 0; i < rate; ++i) {
        const Vec3 before = state.position;
        state = step(lab.scene(), s, state, push, 1.0 / rate).state;
        way += (state.position - before).norm();
    }
    return way - (state.position - begin).norm();
}

// Without static friction a player on a ramp is in the air in every other tick, and the stick with it; there
// it comes to rest on level floors only. What is left are wedges between a floor and an overhang.
TEST(Contacts, InCornersOfAllAnglesThePlayerIsAtRest) {
    Random random(71);
    int moving = 0;
    constexpr int corners = 400;
    for (int i = 0; i < corners; ++i) {
        InnerCorner corner{
            .angle = radians(random.between(15, 175)), .lean_a = 0, .lean_b = 0, .rise = {0, 0}};
        const bool leans = random.below(2) == 0, rises = random.below(2) == 0;
        const double lean_a = radians(random.between(-60, 25)), lean_b = radians(random.between(-60, 25));
        const double rise_x = random.between(-0.5, 0.5), rise_z = random.between(-0.5, 0.5);
        if (leans) corner.lean_a = lean_a, corner.lean_b = lean_b;
        if (rises) corner.rise = {rise_x, rise_z};
        const double aside = random.between(-0.35, 0.35) * (pi - corner.angle);
        const int rate = std::array{30, 60, 120, 144}[static_cast<std::size_t>(random.below(4))];
        for (const MovementSettings& s : kinds_of_settings()) {
            if (!s.static_friction && (leans || rises)) continue;
            const double way = to_and_fro(corner, aside, s, rate);
            if (way <= 1e-4) continue;
            ++moving;
            EXPECT_TRUE(leans || rises || !s.static_friction) << "corner " << i << ": " << way << " m";
        }
    }
    EXPECT_LE(moving, 24);
}

// What a fall onto a slope ends in: the velocity after the tick in which it lands.
PlayerState landed(const Lab& lab, const MovementSettings& s, PlayerState state, const PlayerInput& input,
                   double dt) {
    for (int i = 0; i < 1000 && !state.grounded && state.velocity.y() <= 0.0; ++i)
        state = step(lab.scene(), s, state, input, dt).state;
    return state;
}

TEST(Contacts, ALandingDoesNotDependOnThePartOfTheTick) {
    Random random(72);
    for (int i = 0; i < 200; ++i) {
        const double angle = radians(random.between(0, 45)), speed = random.between(0, 6);
        const double fall = random.between(0.5, 6),
                     dt = 1.0 / std::array{30, 60, 120}[static_cast<std::size_t>(random.below(3))];
        Lab lab;
        lab.slope(angle);
        lab.ready();
        for (const MovementSettings& s : {MovementSettings{}, basic_settings()}) {
            for (int part = 0; part < 40; ++part) {
                const double above = centre_height(s, slope_normal(angle)) + fall;
                const double shift = part * 0.025 * dt * std::sqrt(2 * s.gravity * fall);
                PlayerState state = at({0, above + shift, 0}, {speed, 0, 0});
                state.velocity.y() = -0.1;
                state = landed(lab, s, state, wish(speed / s.walk_speed, 0), dt);
                ASSERT_TRUE(state.grounded) << i;
                EXPECT_NEAR(state.velocity.x(), speed, 0.01 * speed + 1e-6)
                    << "up " << angle << " rad, part " << part;
            }
        }
    }
}

// A trampoline gives back what came along its normal, however it leans and whatever came with it.
TEST(Contacts, ABounceDoesNotDependOnThePartOfTheTick) {
    Random random(73);
    for (int i = 0; i < 100; ++i) {
        const double angle = radians(random.between(0, 60)), speed = random.between(0, 6);
        const double fall = random.between(1, 6), dt = 1.0 / 60.0;
        Lab lab;
        lab.slope(angle, bouncy);
        lab.ready();
        const MovementSettings s;
        const Vec3 n = slope_normal(angle);
        for (int part = 0; part < 20; ++part) {
            const double above =
                centre_height(s, n) + fall + part * 0.05 * dt * std::sqrt(2 * s.gravity * fall);
            PlayerState state = at({0, above, 0}, {speed, 0, 0});
            Vec3 before = state.velocity;
            for (int k = 0; k < 1000 && state.velocity.dot(n) <= 1e-9; ++k) {
                before = state.velocity;
                state = step(lab.scene(), s, state, wish(speed / s.walk_speed, 0), dt).state;
                ASSERT_FALSE(state.grounded) << i << " part " << part;
            }
            // The contact lies within the tick, in which gravity changes the velocity by so much.
            const double rounding = 2 * s.gravity * dt;
            EXPECT_NEAR(state.velocity.dot(n), -0.8 * before.dot(n), rounding) << i << " part " << part;
            EXPECT_NEAR((state.velocity - n * state.velocity.dot(n) - (before - n * before.dot(n))).norm(),
                        0.0, rounding)
                << i << " part " << part;
        }
    }
}

TEST(Contacts, AFasterFlightIsNotBrakedByTheStickAhead) {
    Lab lab;
    lab.floor(-1000);
    lab.ready();
    MovementSettings s;
    Random random(74);
    for (int i = 0; i < 50; ++i) {
        const double speed = random.between(6.5, 30), heading = random.between(0, 2 * pi);
        const Vec2 ahead(std::cos(heading), std::sin(heading));
        const PlayerState start = at({0, 0, 0}, {speed * ahead.x(), 0, speed * ahead.y()});
        s.keep_speed = true;
        const PlayerState pushed = run(lab, s, start, {.wish = ahead}, 30);
        const PlayerState released = run(lab, s, start, {}, 30);
        EXPECT_LT((pushed.velocity - released.velocity).norm(), 1e-9 * speed);
        // Across, the stick steers as before, and turning gains no speed.
        const PlayerState turned = run(lab, s, start, {.wish = Vec2(-ahead.y(), ahead.x())}, 30);
        EXPECT_LE(Vec2(turned.velocity.x(), turned.velocity.z()).norm(), speed + 1e-9);
        s.keep_speed = false;
        const PlayerState braked = run(lab, s, start, {.wish = ahead}, 30);
        EXPECT_LT(Vec2(braked.velocity.x(), braked.velocity.z()).norm(), speed - 0.4);
    }
}

TEST(Contacts, ARampOfATypeThatIsTooSteepIsNotWalkedUp) {
    for (const double type_limit : {10.0, 20.0, 30.0}) {
        for (double angle = type_limit + 1.0; angle < 49.0; angle += 3.0) {
            Lab lab;
            lab.surfaces.push_back({.name = "slippery ramp", .max_slope = radians(type_limit)});
            const auto type = static_cast<SurfaceId>(lab.surfaces.size() - 1);
            lab.floor();
            lab.polygon({{2, 0, -5},
                         {2, 0, 5},
                         {12, 10 * std::tan(radians(angle)), 5},
                         {12, 10 * std::tan(radians(angle)), -5}},
                        type);
            lab.ready();
            const PlayerState end = run(lab, MovementSettings{}, at({0, 0.95, 0}), wish(1, 0), 180);
            EXPECT_LT(end.position.y(), 1.4) << angle << " degrees of a type limited to " << type_limit;
        }
    }
}

TEST(Contacts, ARimOfAOneSidedFaceHoldsNobodyBesideIt) {
    Random random(75);
    for (int i = 0; i < 200; ++i) {
        const double height = random.between(0.46, 1.7), heading = random.between(-1.2, 1.2);
        Lab lab;
        lab.surfaces.push_back({.name = "jump through", .one_sided = true});
        lab.floor();
        lab.polygon({{-2, height, -2}, {-2, height, 2}, {2, height, 2}, {2, height, -2}},
                    static_cast<SurfaceId>(lab.surfaces.size() - 1));
        lab.ready();
        PlayerState state = at({-4, 0.902, random.between(-1, 1)});
        const PlayerInput push = wish(std::cos(heading), std::sin(heading));
        state = run(lab, MovementSettings{}, state, push, 12);
        for (int k = 0; k < 120; ++k) {
            const Vec3 before = state.position;
            state = step(lab.scene(), MovementSettings{}, state, push, tick).state;
            ASSERT_NEAR((state.position - before).norm(), 0.1, 1e-3) << height << " tick " << k;
        }
    }
}

TEST(Contacts, APlayerThatIsPutIntoASolidIsPutOutside) {
    Random random(76);
    for (int i = 0; i < 100; ++i) {
        Lab lab;
        lab.floor();
        const double w = random.between(0.5, 4), d = random.between(0.5, 4), h = random.between(1, 6);
        const auto at_corner = [&](int x, int y, int z) { return Vec3(x ? w : -w, y ? h : 0.0, z ? d : -d); };
        lab.polygon({at_corner(0, 1, 0), at_corner(0, 1, 1), at_corner(1, 1, 1), at_corner(1, 1, 0)});
        lab.polygon({at_corner(0, 0, 0), at_corner(1, 0, 0), at_corner(1, 0, 1), at_corner(0, 0, 1)});
        lab.polygon({at_corner(0, 0, 0), at_corner(0, 1, 0), at_corner(1, 1, 0), at_corner(1, 0, 0)});
        lab.polygon({at_corner(0, 0, 1), at_corner(1, 0, 1), at_corner(1, 1, 1), at_corner(0, 1, 1)});
        lab.polygon({at_corner(0, 0, 0), at_corner(0, 0, 1), at_corner(0, 1, 1), at_corner(0, 1, 0)});
        lab.polygon({at_corner(1, 0, 0), at_corner(1, 1, 0), at_corner(1, 1, 1), at_corner(1, 0, 1)});
        lab.ready();
        const Vec3 inside(random.between(-w, w), random.between(0.1, h), random.between(-d, d));
        const MovementSettings s;
        const auto put = put_player(lab.scene(), s, at(inside), 12.0);
        ASSERT_TRUE(put) << i;
        const Vec3& p = put->position;
        EXPECT_TRUE(std::abs(p.x()) > w || std::abs(p.z()) > d || p.y() > h) << i;
        EXPECT_GT(p.y(), 0.0) << i;
        EXPECT_FALSE(overlaps_any(lab.world(), s.radii, p)) << i;
        EXPECT_FALSE(put_player(lab.scene(), s, at({0, h / 2, 0}), 0.3)) << "there is no room so near";
        const Vec3 free(w + 2, 1, 0);
        EXPECT_EQ(put_player(lab.scene(), s, at(free), 1.0)->position, free);
    }
}

}  // namespace
}  // namespace slipface::test
