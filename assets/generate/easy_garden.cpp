#include <array>
#include <cstdint>

#include "easy.h"
#include "shapes.h"

namespace slipface::generate {
namespace {

// A repeatable fraction in [0, 1) for the n-th detail of a thing.
double scatter(std::uint32_t thing, std::uint32_t n) {
    std::uint32_t bits = thing * 0x9e3779b9U + n * 0x85ebca6bU + 0x27d4eb2fU;
    bits = (bits ^ (bits >> 15U)) * 0x2c1b3c6dU;
    bits = (bits ^ (bits >> 12U)) * 0x297a2d39U;
    return static_cast<double>((bits ^ (bits >> 15U)) >> 8U) / 16777216.0;
}

void add_rock(Model& model, const Vec3& foot, double radius, double height, std::uint32_t seed) {
    const int sides = 7;
    const auto point = [&](int side, int row) {
        const auto n = static_cast<std::uint32_t>(row * sides + side % sides);
        const double swell = row == 0 ? 1.0 : row == 1 ? 1.05 : 0.6;
        const double angle = 360.0 * (side % sides) / sides + 16.0 * (scatter(seed, n) - 0.5);
        const double r = radius * swell * (0.8 + 0.35 * scatter(seed, n + 40));
        const double y =
            row == 0 ? -0.1 : height * (row == 1 ? 0.45 : 0.85) * (0.85 + 0.3 * scatter(seed, n + 80));
        return Vec3(foot + Vec3(r * cos_deg(angle), y, -r * sin_deg(angle)));
    };
    const Vec3 top = foot + Vec3(0.1 * radius, height, 0.05 * radius);
    for (int side = 0; side < sides; ++side) {
        for (int row = 0; row < 2; ++row) {
            const Vec3 a = point(side, row), b = point(side + 1, row), c = point(side + 1, row + 1),
                       d = point(side, row + 1);
            model.face("rock", {a, b, c});
            model.face("rock", {a, c, d});
        }
        model.face("rock", {point(side, 2), point(side + 1, 2), top});
    }
}

void add_mushroom(Model& model, const Vec3& foot, double height, double cap) {
    const double under = height - 0.35 * cap;
    lathe(model, "mushroom_stem", foot, {{0.26 * cap, 0}, {0.2 * cap, 0.5 * under}, {0.24 * cap, under}}, 8);
    lathe(model, "mushroom_stem", foot, {{0.2 * cap, under}, {0.95 * cap, under - 0.06}}, 12);
    lathe(model, "bouncy_mushroom", foot,
          {{0.95 * cap, under - 0.06},
           {cap, under + 0.08 * cap},
           {0.8 * cap, under + 0.26 * cap},
           {0.42 * cap, height}},
          12, 0, "bouncy_mushroom");
}

// A rosette of stiff leaves, each a bent strip with a front on both sides.
void add_agave(Model& model, const Vec3& foot, double length, int leaves, std::uint32_t seed) {
    for (int i = 0; i < leaves; ++i) {
        const auto n = static_cast<std::uint32_t>(i);
        const double angle = 360.0 * i / leaves + 24.0 * scatter(seed, n);
        const double lift = 35.0 + 35.0 * scatter(seed, n + 20),
                     reach = length * (0.8 + 0.4 * scatter(seed, n + 40));
        const Vec3 out(cos_deg(angle), 0, -sin_deg(angle)), side(sin_deg(angle), 0, cos_deg(angle));
        const Vec3 middle = foot + 0.55 * reach * (cos_deg(lift) * out + sin_deg(lift) * Vec3::UnitY());
        const Vec3 tip =
            middle + 0.5 * reach * (cos_deg(0.4 * lift) * out + sin_deg(0.4 * lift) * Vec3::UnitY());
        const double width = 0.13 * length;
        const std::array<Corner, 5> leaf{{{foot - 0.6 * width * side, {0.2, 0}},
                                          {middle - width * side, {0, 0.5}},
                                          {tip, {0.5, 1}},
                                          {middle + width * side, {1, 0.5}},
                                          {foot + 0.6 * width * side, {0.8, 0}}}};
        model.face_uv("foliage", {leaf[0], leaf[1], leaf[3], leaf[4]});
        model.face_uv("foliage", {leaf[1], leaf[2], leaf[3]});
        model.face_uv("foliage", {leaf[4], leaf[3], leaf[1], leaf[0]});
        model.face_uv("foliage", {leaf[3], leaf[2], leaf[1]});
    }
}

void add_pot(Model& model, double x, double z, std::uint32_t seed) {
    lathe(model, "terracotta", {x, floor_y, z},
          {{0.26, 0}, {0.4, 0.5}, {0.46, 0.5}, {0.46, 0.6}, {0.38, 0.6}}, 8, 0, "moss_bed");
    add_agave(model, {x, floor_y + 0.58, z}, 0.75, 7, seed);
}

}  // namespace

// A bed of moss, rocks and mushrooms in the south end of the east aisle, and plants along the nave.
void add_garden(Model& model) {
    model.begin_group("garden");
    const std::vector<Vec2> bed{{13.6, 7.2}, {12.4, 6.6},  {10.4, 7.0}, {9.6, 8.2},
                                {9.8, 10.4}, {11.2, 11.0}, {13.6, 11.0}};
    std::vector<Vec2> plan(bed.begin(), bed.end());
    prism(model, "rock", plan, floor_y, floor_y + 0.28, "moss_bed");
    const double y = floor_y + 0.28;
    add_mushroom(model, {10.9, y, 8.3}, 0.7, 0.8);
    add_mushroom(model, {12.4, y, 8.1}, 1.25, 1.0);
    add_mushroom(model, {12.2, y, 9.9}, 1.9, 1.1);
    add_rock(model, {10.6, y, 9.9}, 0.6, 0.7, 3);
    add_rock(model, {13.2, y, 9.0}, 0.45, 0.9, 5);
    add_rock(model, {9.0, floor_y, 10.3}, 0.5, 0.45, 8);
    add_agave(model, {11.5, y, 9.1}, 0.6, 7, 11);
    add_agave(model, {10.3, y, 7.6}, 0.5, 7, 13);
    add_agave(model, {13.0, y, 10.3}, 0.8, 8, 17);
    std::uint32_t seed = 20;
    for (const double x : {-5.6, 5.6}) {
        for (const double z : {6.0, -1.5, -22.6})
            add_pot(model, x, z, seed++);
    }
    add_rock(model, {-9.2, floor_y, -26.5}, 1.0, 1.1, 31);
    add_rock(model, {-10.6, floor_y, -27.6}, 0.8, 1.7, 33);
    add_rock(model, {-8.4, floor_y, -28.0}, 0.6, 0.6, 35);
}

}  // namespace slipface::generate
