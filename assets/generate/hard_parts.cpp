#include <algorithm>
#include <array>
#include <cmath>

#include "hard.h"
#include "labels.h"
#include "shapes.h"
#include "wild.h"

namespace slipface::generate {
namespace {

constexpr double ground_y = -1.0;

Vec3 on_floor(double x, double z, double lift = 0.0) {
    return {x, hard_floor(x, z) + lift, z};
}

// A bunch of crystals that lean away from each other.
void cluster(Model& model, const std::string& material, const Vec3& foot, double size, int count,
             std::uint32_t seed) {
    for (int i = 0; i < count; ++i) {
        const auto n = static_cast<std::uint32_t>(i);
        const double angle = 360.0 * i / count + 40.0 * scatter(seed, n);
        const double lean = i == 0 ? 0.1 : 0.35 + 0.6 * scatter(seed, n + 20);
        const double length = size * (i == 0 ? 1.0 : 0.35 + 0.4 * scatter(seed, n + 40));
        const Vec3 out(cos_deg(angle), 0, sin_deg(angle));
        shard(model, material, foot + 0.16 * size * out, lean * out + Vec3::UnitY(), 0.13 * length, length);
    }
}

void hanging_lamp(Model& model, const Vec3& top, double drop) {
    const Vec3 low = top - drop * Vec3::UnitY();
    box(model, "bronze", low + Vec3(-0.03, 0.5, -0.03), top + Vec3(0.03, 0, 0.03), side_walls);
    tower(model, "lamp", low, 0.0, 0.16, 0.42, 0.24, 6);
    lathe(model, "bronze", low, {{0.0, -0.12}, {0.18, 0.0}}, 6);
    lathe(model, "bronze", low, {{0.28, 0.42}, {0.0, 0.6}}, 6);
    ring(model, "bronze", low + Vec3(0, 0.42, 0), 0.24, 0.28, 6, false);
}

// Pillars of basalt standing in the embers.
void stepping_stone(Model& model, double x, double z, double radius, double top, std::uint32_t seed) {
    std::vector<Vec2> plan;
    for (int i = 0; i < 6; ++i) {
        const double angle = 60.0 * i + 14.0 * scatter(seed, static_cast<std::uint32_t>(i));
        const double r = radius * (0.85 + 0.3 * scatter(seed, static_cast<std::uint32_t>(i) + 9));
        plan.emplace_back(x + r * cos_deg(angle), z - r * sin_deg(angle));
    }
    prism(model, "basalt", plan, -9.2, top, "flagstone");
}

// A block standing on the ground with an acute notch cut into its south side.
double notch(Model& model, double x, double back_z, double degrees) {
    const double depth = 2.4, back = 0.5;
    const double half = std::round(depth * tan_deg(0.5 * degrees) * 1000.0) / 1000.0;
    const double width = 2 * half + 0.9, middle = x + 0.5 * width, front = back_z + depth + back;
    prism(model, "stone_trim",
          {{x + width, front},
           {x + width, back_z},
           {x, back_z},
           {x, front},
           {middle - half, front},
           {middle, back_z + back},
           {middle + half, front}},
          ground_y, ground_y + 2.6, "flagstone");
    return width;
}

// A gutter whose sides meet in an acute line, running along -Z.
void gutter(Model& model, double x, double z0, double z1, double degrees) {
    const double height = 1.8;
    const double half = std::round(height * tan_deg(0.5 * degrees) * 1000.0) / 1000.0;
    const double y0 = ground_y, y1 = y0 + height;
    const std::array<double, 5> xs{x - half - 0.5, x - half, x, x + half, x + half + 0.5};
    const auto strip = [&](const std::string& material, double xa, double ya, double xb, double yb) {
        model.face(material, {{xa, ya, z1}, {xb, yb, z1}, {xb, yb, z0}, {xa, ya, z0}});
    };
    strip("ramp_steep", xs[1], y1, xs[2], y0);
    strip("ramp_steep", xs[2], y0, xs[3], y1);
    strip("flagstone", xs[0], y1, xs[1], y1);
    strip("flagstone", xs[3], y1, xs[4], y1);
    wall(model, "stone_wall", {xs[4], y0, z1}, {xs[4], y0, z0}, y1);
    wall(model, "stone_wall", {xs[0], y0, z0}, {xs[0], y0, z1}, y1);
    for (const bool south : {true, false}) {
        const double z = south ? z1 : z0;
        std::vector<Vec3> left{{xs[0], y0, z}, {xs[2], y0, z}, {xs[1], y1, z}, {xs[0], y1, z}};
        std::vector<Vec3> right{{xs[2], y0, z}, {xs[4], y0, z}, {xs[4], y1, z}, {xs[3], y1, z}};
        if (!south) {
            std::reverse(left.begin(), left.end());
            std::reverse(right.begin(), right.end());
        }
        model.face("stone_wall", left);
        model.face("stone_wall", right);
    }
}

// A wall with the plan of a saw: points and notches of the same angle.
void star(Model& model, double x, double z, double radius, int points, double height) {
    std::vector<Vec2> plan;
    for (int i = 0; i < 2 * points; ++i) {
        const double angle = 180.0 * i / points, r = i % 2 == 0 ? radius : 0.42 * radius;
        plan.emplace_back(x + r * cos_deg(angle), z - r * sin_deg(angle));
    }
    prism(model, "basalt", plan, ground_y, ground_y + height, "flagstone");
}

// A slab whose underside comes down to the ground.
void low_roof(Model& model, double x, double z, double width, double degrees) {
    const double height = 2.4, reach = std::round(height / tan_deg(degrees) * 1000.0) / 1000.0;
    const double y0 = ground_y, y1 = y0 + height, t = 0.35, x1 = x + reach;
    const double z0 = z - width;
    model.face("roof_basalt", {{x, y0, z0}, {x1, y1, z0}, {x1, y1, z}, {x, y0, z}});
    model.face("basalt", {{x, y0, z}, {x1, y1, z}, {x1, y1 + t, z}, {x - 0.6, y0, z}});
    model.face("basalt", {{x - 0.6, y0, z0}, {x1, y1 + t, z0}, {x1, y1, z0}, {x, y0, z0}});
    model.face("ramp_stone", {{x - 0.6, y0, z}, {x1, y1 + t, z}, {x1, y1 + t, z0}, {x - 0.6, y0, z0}});
    model.face("basalt", {{x1, y1, z}, {x1, y1, z0}, {x1, y1 + t, z0}, {x1, y1 + t, z}});
    for (const double at : {z - 0.2, z0 + 0.2})
        box(model, "wood_planks", {x1 - 0.3, y0, at - 0.1}, {x1 - 0.1, y1 - 0.05, at + 0.1}, side_walls);
}

}  // namespace

void add_hard_crystals(Model& model) {
    model.begin_group("crystals");
    // The heart: what one sees from the landing place.
    stepping_stone(model, 0, -18, 4.2, -1.6, 701);
    const Vec3 heart(0, -1.6, -18.4);
    shard(model, "crystal_heart", heart, {0.04, 1, 0.02}, 1.15, 9.5);
    shard(model, "crystal_heart", heart + Vec3(0.9, 0, 0.3), {0.42, 1, 0.15}, 0.55, 5.2);
    shard(model, "crystal_heart", heart + Vec3(-0.9, 0, 0.2), {-0.5, 1, 0.1}, 0.6, 4.6);
    shard(model, "crystal_heart", heart + Vec3(0.2, 0, -1.0), {0.1, 1, -0.5}, 0.5, 4.0);
    shard(model, "crystal_heart", heart + Vec3(-0.5, 0, 1.0), {-0.3, 1, 0.5}, 0.35, 2.4);
    const std::array<Vec3, 9> gems{Vec3(-14, 0, -4),  Vec3(17, 0, -27), Vec3(-20, 0, -12),
                                   Vec3(12, 0, 0.5),  Vec3(-9, 0, -34), Vec3(23, 0, -9),
                                   Vec3(-43, 0, -31), Vec3(5, 0, -36),  Vec3(-36, 0, -24)};
    std::uint32_t seed = 720;
    for (const Vec3& at : gems) {
        cluster(model, seed % 3 == 0 ? "crystal" : "gem", on_floor(at.x(), at.z(), -0.2),
                2.2 + 1.8 * scatter(seed, 1), 6, seed);
        ++seed;
    }
    // Stone teeth from below and above.
    for (std::uint32_t i = 0; i < 46; ++i) {
        const double angle = 360.0 * scatter(750, i), reach = 0.55 + 0.38 * scatter(751, i);
        const double x = 26.0 * reach * cos_deg(angle), z = -16 + 22.0 * reach * sin_deg(angle);
        const bool landing = std::abs(x) < 8 && z > -8;
        const double size = 1.2 + 2.6 * scatter(752, i);
        const Vec3 lean(0.5 * (scatter(753, i) - 0.5), 0, 0.5 * (scatter(754, i) - 0.5));
        const bool path = std::abs(z + 13) < 3.5 && x > 14;
        if (!landing && !path && hard_floor(x, z) > -3)
            spike(model, "rock", on_floor(x, z), Vec3::UnitY() + lean, 0.30 * size, size, 5, 760 + i);
    }
    for (std::uint32_t i = 0; i < 40; ++i) {
        const double angle = 360.0 * scatter(850, i), reach = 0.9 * std::sqrt(scatter(851, i));
        const double x = 26.0 * reach * cos_deg(angle), z = -16 + 22.0 * reach * sin_deg(angle);
        const double size = 2.0 + 4.0 * scatter(852, i) * (1.1 - reach);
        const double out = 1.0 - reach * reach;
        const double top = -1.0 + 17.0 * std::sqrt(std::max(0.05, out * 0.8)) - 0.4;
        if (std::abs(x - 3) < 5.5 && std::abs(z + 17) < 4.5) continue;  // under the hole in the roof
        spike(model, "rock", {x, top, z}, {0.1, -1, 0.05}, 0.24 * size, size, 5, 860 + i);
    }
}

void add_hard_ways(Model& model) {
    model.begin_group("ways");
    const std::array<Vec3, 7> stones{Vec3(6.5, -2.4, -11.5), Vec3(9.6, -2.0, -15),   Vec3(10.2, -1.6, -19.5),
                                     Vec3(-7.2, -2.2, -13),  Vec3(-10, -1.8, -17.5), Vec3(-7.5, -1.4, -22.5),
                                     Vec3(5.6, -1.8, -24)};
    std::uint32_t seed = 900;
    for (const Vec3& at : stones)
        stepping_stone(model, at.x(), at.z(), 1.35, at.y(), seed++);
    // The bridge to the heart, and on to the north shore.
    beam(model, "wood_floor", {0, -1.0, -4.6}, {0, -1.55, -14.6}, 2.0, 0.25);
    beam(model, "wood_floor", {1.5, -1.55, -21.4}, {3.0, -0.7, -31.0}, 1.8, 0.25);
    for (const double side : {-0.95, 0.95}) {
        beam(model, "wood_planks", {side, -0.15, -4.8}, {side, -0.7, -14.4}, 0.12, 0.12);
        for (int i = 0; i <= 4; ++i) {
            const double z = -5.0 - 2.3 * i, y = -1.0 - 0.055 * (-z - 4.6);
            box(model, "wood_planks", {side - 0.07, y - 0.05, z - 0.07}, {side + 0.07, y + 0.85, z + 0.07},
                side_standing);
        }
    }
    hanging_lamp(model, {0, 7.2, 1.5}, 4.6);
    hanging_lamp(model, {-5.5, 6.6, -1.5}, 4.4);
    hanging_lamp(model, {5.5, 6.6, -1.5}, 4.4);
    hanging_lamp(model, {30, 3.2, -13}, 1.4);
    hanging_lamp(model, {-29, 2.6, -25}, 1.2);

    // The lookout: a ledge in the east of the landing, up by a ladder or by moss.
    box(model, "stone_wall", {9, -4, -6}, {13, 3.2, -2}, side_standing);
    for (int i = 0; i < 4; ++i) {
        const double y0 = -1.0 + 1.05 * i, y1 = y0 + 1.05;
        model.face_uv("ladder_wood", {{{8.9, y0, -4.6}, {0, y0}},
                                      {{8.9, y0, -3.6}, {1, y0}},
                                      {{8.9, y1, -3.6}, {1, y1}},
                                      {{8.9, y1, -4.6}, {0, y1}}});
    }
    box(model, "wood_planks", {8.9, -1.2, -4.6}, {9.0, 3.2, -3.6}, side_north | side_south | side_top);
    box(model, "bronze", {12.6, 3.2, -5.8}, {12.8, 5.6, -5.6}, side_standing);
    model.face_uv("banner_cloth", {{{12.62, 4.0, -5.58}, {0, 0}},
                                   {{12.62, 4.0, -4.2}, {1, 0}},
                                   {{12.62, 5.5, -4.2}, {1, 1}},
                                   {{12.62, 5.5, -5.58}, {0, 1}}});
    model.face_uv("banner_cloth", {{{12.62, 4.0, -4.2}, {1, 0}},
                                   {{12.62, 4.0, -5.58}, {0, 0}},
                                   {{12.62, 5.5, -5.58}, {0, 1}},
                                   {{12.62, 5.5, -4.2}, {1, 1}}});
    box(model, "stone_wall", {-13.5, -4, -6}, {-9.5, 2.6, -2}, side_standing & ~unsigned{side_east});
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const double y0 = -4 + 2.2 * i, y1 = y0 + 2.2, z0 = -6 + 4.0 * j / 3, z1 = -6 + 4.0 * (j + 1) / 3;
            model.face("sticky_moss", {{-9.5, y0, z1}, {-9.5, y0, z0}, {-9.5, y1, z0}, {-9.5, y1, z1}});
        }
    }
    cluster(model, "gem", {-11.8, 2.5, -4}, 1.8, 6, 940);

    // The belt through the pass to the proving ground, and a pad at its end.
    for (int i = 0; i < 6; ++i) {
        const double x0 = 24.5 + 2.2 * i, x1 = x0 + 2.2, y = 0.35;
        model.face_uv("conveyor_belt", {{{x0, y, -11.4}, {0, 0}},
                                        {{x1, y, -11.4}, {0, 1}},
                                        {{x1, y, -13.4}, {1, 1}},
                                        {{x0, y, -13.4}, {1, 0}}});
    }
    box(model, "bronze", {24.5, -2.5, -13.4}, {37.7, 0.35, -11.4}, side_walls);
    ramp(model, "wood_floor", "wood_planks",
         {.left = {21.5, -1.2, -13.4},
          .ahead = Vec3::UnitX(),
          .width = 2,
          .run = 3.0,
          .height = 1.55,
          .back = false});
    lathe(model, "stone_trim", {-2.5, -1.6, -17.5}, {{0.9, 0}, {0.85, 0.12}, {0.75, 0.16}}, 12);
    disc(model, "bouncy_pad", {-2.5, -1.44, -17.5}, 0.75, 12);

    // The crypt: an altar of ice with a ring of columns that lean.
    lathe(model, "stone_trim", {-40, ground_y, -28}, {{3.2, 0}, {3.2, 0.3}, {2.6, 0.3}}, 10, 0, "ice_floor");
    for (int i = 0; i < 8; ++i) {
        const double angle = 45.0 * i + 22.5;
        const Vec3 out(cos_deg(angle), 0, sin_deg(angle));
        spike(model, "stone_trim", Vec3(-40, ground_y, -28) + 4.6 * out, Vec3::UnitY() - 0.25 * out, 0.5, 3.6,
              4, 950 + static_cast<std::uint32_t>(i));
    }
    shard(model, "gem", {-40, -0.75, -28}, {0, 1, 0}, 0.4, 2.6);
}

void add_hard_proving(Model& model) {
    model.begin_group("proving_notches");
    double x = 39.5;
    for (const double degrees : {5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0, 45.0, 50.0, 60.0}) {
        x += notch(model, x, -31.4, degrees) + 0.7;
    }
    model.begin_group("proving_gutters");
    double at = 40.5;
    for (const double degrees : {15.0, 30.0, 45.0, 60.0, 85.0}) {
        const double half = 1.8 * tan_deg(0.5 * degrees);
        at += half;
        gutter(model, at, -22.5, -17.5, degrees);
        at += half + 2.2;
    }
    model.begin_group("proving_stars");
    for (int i = 0; i < 4; ++i)
        star(model, 42.5 + 4.6 * i, -9.0, 1.9, 4 + 2 * i, 2.0);
    model.begin_group("proving_roofs");
    double roof_z = -1.2;
    for (const double degrees : {15.0, 25.0, 35.0}) {
        low_roof(model, 40.5 + 0.0 * roof_z, roof_z, 1.6, degrees);
        roof_z -= 2.0;
    }
    model.begin_group("proving_spikes");
    for (int i = 0; i < 5; ++i) {
        for (int j = 0; j < 4; ++j) {
            const auto n = static_cast<std::uint32_t>(5 * j + i);
            spike(model, "rock", {55.5 + 2.0 * i, ground_y, -1.2 - 1.5 * j},
                  {0.8 * (scatter(980, n) - 0.5), 1, 0.8 * (scatter(981, n) - 0.5)}, 0.45,
                  1.0 + 1.2 * scatter(982, n), 5, 990 + n);
        }
    }
    model.begin_group("proving_ramps");
    for (int i = 0; i < 5; ++i) {
        const double degrees = 25.0 + 10.0 * i, run = std::min(3.2, 2.6 / tan_deg(degrees));
        ramp(model, degrees > 50 ? "ramp_steep" : "ramp_stone", "stone_trim",
             {.left = {63.2, ground_y, -11.0 - 2.1 * i},
              .ahead = Vec3::UnitX(),
              .width = 1.5,
              .run = run,
              .height = run * tan_deg(degrees),
              .landing = 0.8,
              .back = true});
    }
    hanging_lamp(model, {43, 6.6, -13}, 2.0);
    hanging_lamp(model, {61, 6.6, -13}, 2.0);
    hanging_lamp(model, {44, 6.2, -26}, 2.0);
    hanging_lamp(model, {60, 6.2, -26}, 2.0);
}

}  // namespace slipface::generate
