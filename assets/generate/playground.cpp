#include "playground.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "labels.h"
#include "painting.h"
#include "shapes.h"
#include "wild.h"

namespace slipface::generate {
namespace {

constexpr double y0 = playground_floor;

std::vector<ModelMaterial> materials() {
    return {
        {"stone_floor", "stone_floor", 2.5},
        {"mosaic_floor", "mosaic_floor", 2.5},
        {"stone_wall", "stone_wall", 2.0},
        {"stone_trim", "stone_trim", 2.0},
        {"column_stone", "column_stone", 1.0},
        {"tile_teal", "tile_teal", 1.0},
        {"terracotta", "terracotta", 1.0},
        {"test_floor", "test_floor", 2.0},
        {"ramp_stone", "ramp_stone", 2.0},
        {"ramp_steep", "ramp_steep", 2.0},
        {"step_stone", "step_stone", 2.0},
        {"wood_planks", "wood_planks", 2.0},
        {"wood_floor", "wood_floor", 2.5},
        {"bronze", "bronze", 1.0},
        {"cliff", "cliff", 6.0},
        {"grass", "grass", 4.0},
        {"sign_labels", "sign_labels", 1.0},
        {"banner_cloth", "banner_cloth", 1.0},
        {"lamp", "lamp_glass", 1.0},
        {"foliage", "foliage", 1.0},
        {"palm_trunk", "palm_trunk", 1.0},
        {"ice_floor", "ice", 3.0},
        {"ice_pipe", "ice", 3.0},
        {"ladder_wood", "ladder_wood", 1.0},
        {"sticky_moss", "sticky_moss", 1.6},
        {"bouncy_pad", "bouncy_pad", 1.0},
        {"conveyor_belt", "conveyor_belt", 2.5},
        {"turntable_stone", "turntable_stone", 1.0},
        {"hazard_embers", "hazard_embers", 2.5},
    };
}

// A slab of `thickness` that leans by `degrees` about its lower edge at (x, z), rising towards -Z; beyond 90
// degrees it leans back over who stands in front of it.
void leaning_slab(Model& model, double x, double z, double width, double length, double degrees) {
    const Vec3 along(0, sin_deg(degrees), -cos_deg(degrees)), out(0, cos_deg(degrees), sin_deg(degrees));
    const Vec3 foot(x, degrees > 0 ? y0 : y0 + 0.05, z), side(width, 0, 0), back = -0.3 * out;
    const Vec3 a = foot, b = foot + side, c = b + length * along, d = a + length * along;
    model.face(degrees > 50 ? "ramp_steep" : "ramp_stone", {a, b, c, d});
    model.face("stone_trim", {b + back, a + back, d + back, c + back});
    model.face("stone_trim", {d, c, c + back, d + back});
    model.face("stone_trim", {a + back, a, d, d + back});
    model.face("stone_trim", {b, b + back, c + back, c});
    model.face("stone_trim", {a + back, b + back, b, a});
}

void lamp_post(Model& model, double x, double z) {
    box(model, "stone_trim", {x - 0.3, y0, z - 0.3}, {x + 0.3, y0 + 0.3, z + 0.3}, side_standing);
    box(model, "bronze", {x - 0.07, y0 + 0.3, z - 0.07}, {x + 0.07, y0 + 2.8, z + 0.07}, side_walls);
    tower(model, "lamp", {x, 0, z}, y0 + 2.8, 0.18, y0 + 3.3, 0.26, 6);
    lathe(model, "bronze", {x, y0 + 3.3, z}, {{0.32, 0}, {0.0, 0.22}}, 6);
    ring(model, "bronze", {x, y0 + 2.8, z}, 0, 0.18, 6, false);
    ring(model, "bronze", {x, y0 + 3.3, z}, 0.26, 0.32, 6, false);
}

}  // namespace

void add_playground_terrace(Model& model) {
    model.begin_group("terrace");
    std::vector<double> xs, zs;
    for (int i = -16; i <= 16; ++i)
        xs.push_back(2.5 * i);
    for (int i = -24; i <= 5; ++i)
        zs.push_back(2.5 * i);
    const auto hole = [](double x, double z) {
        return (x > 20 && x < 35 && z > -50 && z < -30) ||        // the half-pipe
               (x > -37.5 && x < -17.5 && z > -55 && z < -35) ||  // the hills
               (x > 2.5 && x < 12.5 && z > -55 && z < -40);       // the gap of the movers
    };
    grid_floor(model, xs, zs, y0, [&](double x, double z) -> std::string {
        if (hole(x, z)) return {};
        if (std::abs(x) < 2.5) return "mosaic_floor";
        return std::abs(x) > 37.5 || z > 10 || z < -57.5 ? "stone_floor" : "test_floor";
    });
    // The rock that carries the terrace: two storeys of arches' width, then cliff that narrows downwards.
    const std::array<Vec3, 4> rim{Vec3(-40, y0, 12.5), Vec3(40, y0, 12.5), Vec3(40, y0, -60),
                                  Vec3(-40, y0, -60)};
    const auto lower = [](const Vec3& at, double fraction, double y) {
        return Vec3(fraction * at.x(), y, -24 + fraction * (at.z() + 24));
    };
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3 a = rim[i], b = rim[(i + 1) % 4];
        for (int k = 0; k < 8; ++k) {
            const Vec3 p = a + (b - a) * k / 8.0, q = a + (b - a) * (k + 1) / 8.0;
            model.face("stone_wall", {lower(p, 1, -5), lower(q, 1, -5), q, p});
            model.face("cliff", {lower(p, 0.8, -16), lower(q, 0.8, -16), lower(q, 1, -5), lower(p, 1, -5)});
            model.face("cliff",
                       {lower(p, 0.42, -30), lower(q, 0.42, -30), lower(q, 0.8, -16), lower(p, 0.8, -16)});
        }
        model.face("cliff", {lower(b, 0.42, -30), lower(a, 0.42, -30), Vec3(0, -40, -24)});
        // The parapet, with corner posts.
        const Vec3 in = (Vec3(0, y0, -24) - 0.5 * (a + b)).normalized();
        const Vec3 u = (b - a).normalized();
        const Vec3 p = a + 0.8 * u, q = b - 0.8 * u, t = 0.4 * in, h(0, 1.0, 0);
        model.face("stone_trim", {p, q, q + h, p + h});
        model.face("stone_trim", {q + t, p + t, p + t + h, q + t + h});
        model.face("stone_trim", {p + h, q + h, q + t + h, p + t + h});
        box(model, "stone_wall", {a.x() - 0.8, y0, a.z() - 0.8}, {a.x() + 0.8, y0 + 2.4, a.z() + 0.8},
            side_standing);
        lathe(model, "terracotta", {a.x(), y0 + 2.4, a.z()}, {{0.9, 0}, {0.5, 0.5}, {0.0, 1.3}}, 8, 22.5);
    }
    for (const double z : {6.0, -9.0, -24.0, -39.0, -54.0}) {
        lamp_post(model, -3.4, z);
        lamp_post(model, 3.4, z - 1.5);
    }
    for (const double x : {-36.0, -12.0, 12.0, 36.0})
        palm(model, {x, y0, 9.0}, 4.8 + 0.02 * x, 1500 + static_cast<std::uint32_t>(x + 50));
    // The gate at the end of the way: what one sees from the start.
    for (const double x : {-3.6, 3.6}) {
        box(model, "stone_wall", {x - 1.1, y0, -58.6}, {x + 1.1, 7.5, -56.4}, side_standing);
        box(model, "stone_trim", {x - 1.3, 7.5, -58.8}, {x + 1.3, 8.0, -56.2});
    }
    const ArchShape arch{.from = {-2.5, y0, -56.6},
                         .to = {2.5, y0, -56.6},
                         .y0 = 3.0,
                         .y1 = 7.0,
                         .half_width = 2.5,
                         .sill = 3.0,
                         .spring = 3.0,
                         .rise = 2.4,
                         .segments = 12};
    arch_wall(model, "stone_wall", arch);
    arch_reveal(model, "stone_trim", arch, 1.8, false);
    ArchShape back = arch;
    std::swap(back.from, back.to);
    back.from.z() = back.to.z() = -58.4;
    arch_wall(model, "stone_wall", back);
    model.face("stone_trim", {{-2.5, 7.0, -56.6}, {2.5, 7.0, -56.6}, {2.5, 7.0, -58.4}, {-2.5, 7.0, -58.4}});
    model.face_uv("banner_cloth", {{{-1.0, 5.55, -56.55}, {0, 0}},
                                   {{1.0, 5.55, -56.55}, {1, 0}},
                                   {{1.0, 6.9, -56.55}, {1, 1}},
                                   {{-1.0, 6.9, -56.55}, {0, 1}}});
}

void add_playground_slopes(Model& model) {
    model.begin_group("slopes");
    for (int i = 0; i < 18; ++i)
        leaning_slab(model, -36.0 + 1.75 * i, 0.0, 1.4, 3.4, 10.0 * i);
    model.begin_group("slopes_meeting");
    // A gentle slope that runs into a steep one, nine times.
    for (int i = 0; i < 9; ++i) {
        const double x = 5.5 + 2.5 * i, degrees = 5.0 + 5.0 * i, width = 1.9, run = 2.2,
                     height = run * tan_deg(degrees);
        ramp(model, "ramp_stone", "stone_trim",
             {.left = {x, y0, 1.0},
              .ahead = -Vec3::UnitZ(),
              .width = width,
              .run = run,
              .height = height,
              .back = false});
        const double top = y0 + height, steep = 1.4;
        const Vec3 a(x, top, -1.2), b(x + width, top, -1.2),
            c(x + width, top + steep * tan_deg(70), -1.2 - steep),
            d(x, top + steep * tan_deg(70), -1.2 - steep);
        model.face("ramp_steep", {a, b, c, d});
        const Vec3 ground_a(x, y0, -1.2), ground_b(x + width, y0, -1.2),
            ground_c(x + width, y0, -1.2 - steep), ground_d(x, y0, -1.2 - steep);
        model.face("stone_trim", {ground_d, ground_a, a, d});
        model.face("stone_trim", {ground_b, ground_c, c, b});
        model.face("stone_trim", {ground_c, ground_d, d, c});
    }
}

void add_playground_steps(Model& model) {
    model.begin_group("bumps_small");
    for (int i = 0; i < 16; ++i) {
        const double z = -5.5 - 0.5 * i;
        box(model, "step_stone", {-36, y0, z - 0.05}, {-32, y0 + 0.01, z}, side_standing);
    }
    model.begin_group("bumps_large");
    for (int i = 0; i < 4; ++i) {
        const double z = -5.5 - 2.0 * i;
        box(model, "step_stone", {-30.5, y0, z - 0.3}, {-26.5, y0 + 0.1, z}, side_standing);
    }
    model.begin_group("stairs_box");
    for (int i = 0; i < 8; ++i)
        box(model, "step_stone", {-25, y0 + 0.3 * i, -13.4}, {-22, y0 + 0.3 * (i + 1), -7.0 - 0.45 * i},
            side_standing);
    model.begin_group("stairs_mesh");
    stairs(model, "step_stone", "stone_trim",
           {.left = {-20.5, y0, -7.0},
            .ahead = -Vec3::UnitZ(),
            .width = 3,
            .count = 8,
            .rise = 0.3,
            .tread = 0.45,
            .landing = 2.8});
    model.begin_group("stairs_none");
    stairs(model, "ramp_steep", "stone_trim",
           {.left = {-16, y0, -7.0},
            .ahead = -Vec3::UnitZ(),
            .width = 3,
            .count = 8,
            .rise = 0.3,
            .tread = 0.05,
            .landing = 3.2});
}

void add_playground_walls(Model& model) {
    model.begin_group("pillars");
    for (int i = 0; i < 30; ++i)
        lathe(model, "column_stone", {-36.0 + 1.0 * i, y0, -18.5}, {{0.3, 0}, {0.3, 1.8}, {0.2, 2.0}}, 8, 0,
              "stone_trim");
    model.begin_group("zigzag");
    // 25 pieces whose points reach further out one by one, 0.5 to 4 m.
    std::vector<Vec2> line;
    double x = -36;
    for (int i = 0; i <= 25; ++i) {
        const double reach = 0.25 + 1.75 * i / 25.0;
        line.emplace_back(x, -26.0 + (i % 2 == 0 ? -reach : reach));
        x += 0.95;
    }
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Vec3 a(line[i].x(), y0, line[i].y()), b(line[i + 1].x(), y0, line[i + 1].y()), t(0, 0, -0.3),
            h(0, 2.2, 0);
        model.face("stone_wall", {a, b, b + h, a + h});
        model.face("stone_wall", {b + t, a + t, a + t + h, b + t + h});
        model.face("stone_trim", {a + h, b + h, b + t + h, a + t + h});
    }
    model.begin_group("open_box");
    // A room that is entered from behind its faces: they all look outward.
    const double bx = 8, bz = -24;
    box(model, "wood_planks", {bx, y0, bz - 4}, {bx + 5, y0 + 2.8, bz},
        side_standing & ~unsigned{side_south});
    model.face("wood_planks",
               {{bx, y0, bz}, {bx + 1.6, y0, bz}, {bx + 1.6, y0 + 2.8, bz}, {bx, y0 + 2.8, bz}});
    model.face("wood_planks",
               {{bx + 3.4, y0, bz}, {bx + 5, y0, bz}, {bx + 5, y0 + 2.8, bz}, {bx + 3.4, y0 + 2.8, bz}});
    model.face("wood_planks", {{bx + 1.6, y0 + 2.2, bz},
                               {bx + 3.4, y0 + 2.2, bz},
                               {bx + 3.4, y0 + 2.8, bz},
                               {bx + 1.6, y0 + 2.8, bz}});
}

void add_playground_pipe(Model& model) {
    model.begin_group("half_pipe");
    const int segments = 512;
    const double radius = 5.0, middle = 27.5, za = -50, zb = -30;
    const auto point = [&](int i, double z) {
        const double angle = 180.0 * i / segments;
        return Vec3(middle - 1.5 * radius * cos_deg(angle), y0 - radius * sin_deg(angle), z);
    };
    for (int i = 0; i < segments; ++i) {
        const double v0 = 6.0 * i / segments, v1 = 6.0 * (i + 1) / segments;
        model.face_uv("ice_pipe", {{point(i, zb), {zb / 3, v0}},
                                   {point(i + 1, zb), {zb / 3, v1}},
                                   {point(i + 1, za), {za / 3, v1}},
                                   {point(i, za), {za / 3, v0}}});
    }
    for (const bool south : {true, false}) {
        // A fan: as one face with so many corners its triangles would be needles.
        const double z = south ? zb : za;
        for (int i = 0; i < segments; ++i) {
            std::vector<Vec3> piece{{middle, y0, z}, point(i, z), point(i + 1, z)};
            if (south) std::reverse(piece.begin(), piece.end());
            model.face("stone_wall", piece);
        }
    }
}

void add_playground_surfaces(Model& model) {
    model.begin_group("surfaces");
    // A row of pads, each with a frame.
    const std::array<const char*, 4> pads{"ice_floor", "bouncy_pad", "hazard_embers", "conveyor_belt"};
    for (std::size_t i = 0; i < pads.size(); ++i) {
        const double x = 8.0 + 6.0 * static_cast<double>(i), z = -8.0, half = 2.0, y = y0 + 0.12;
        box(model, "stone_trim", {x - half - 0.25, y0, z - half - 0.25},
            {x + half + 0.25, y, z + half + 0.25}, side_walls);
        for (int side = 0; side < 4; ++side) {
            const std::array<Vec3, 4> outer{
                Vec3(x - half - 0.25, y, z + half + 0.25), Vec3(x + half + 0.25, y, z + half + 0.25),
                Vec3(x + half + 0.25, y, z - half - 0.25), Vec3(x - half - 0.25, y, z - half - 0.25)};
            const std::array<Vec3, 4> inner{Vec3(x - half, y, z + half), Vec3(x + half, y, z + half),
                                            Vec3(x + half, y, z - half), Vec3(x - half, y, z - half)};
            const auto a = static_cast<std::size_t>(side), b = (a + 1) % 4;
            model.face("stone_trim", {outer[a], outer[b], inner[b], inner[a]});
        }
        model.face_uv(pads[i], {{{x - half, y, z + half}, {0, 0}},
                                {{x + half, y, z + half}, {1, 0}},
                                {{x + half, y, z - half}, {1, 1}},
                                {{x - half, y, z - half}, {0, 1}}});
    }
    lathe(model, "stone_trim", {33, y0, -18}, {{3.4, 0}, {3.35, 0.12}, {3.1, 0.16}}, 24);
    disc(model, "turntable_stone", {33, y0 + 0.16, -18}, 3.1, 24);
    // The climbing tower: ladder in the south, moss in the west.
    box(model, "stone_wall", {18, y0, -22}, {23, y0 + 5, -17},
        side_east | side_north | side_south | side_top);
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const double ya = y0 + 5.0 * j / 3, yb = y0 + 5.0 * (j + 1) / 3, za = -22 + 5.0 * i / 3,
                         zb = -22 + 5.0 * (i + 1) / 3;
            model.face("sticky_moss", {{18, ya, za}, {18, ya, zb}, {18, yb, zb}, {18, yb, za}});
        }
    }
    for (int i = 0; i < 5; ++i)
        model.face_uv("ladder_wood", {{{20, y0 + i, -16.9}, {0, i * 1.0}},
                                      {{21, y0 + i, -16.9}, {1, i * 1.0}},
                                      {{21, y0 + i + 1, -16.9}, {1, i + 1.0}},
                                      {{20, y0 + i + 1, -16.9}, {0, i + 1.0}}});
    box(model, "wood_planks", {20, y0, -17}, {21, y0 + 5, -16.9}, side_east | side_west | side_top);
}

void add_playground_movers(Model& model) {
    const auto slab = [&](const std::string& group, const std::string& material, const Vec3& low,
                          const Vec3& high) {
        model.begin_group(group);
        box(model, material, low, high);
    };
    slab("plate", "wood_floor", {-9.0, -0.9, -33.0}, {-5.0, -0.6, -29.0});
    slab("wall", "terracotta", {-13.0, -0.95, -42.2}, {-7.0, 0.8, -41.8});
    slab("swing", "bronze", {-14.0, -0.9, -50.5}, {-10.0, -0.6, -48.5});
    slab("lift_smooth", "wood_floor", {5.0, -0.9, -36.0}, {8.0, -0.6, -33.0});
    slab("lift_hard", "wood_floor", {9.5, -0.9, -36.0}, {12.5, -0.6, -33.0});
    slab("ferry", "wood_floor", {5.5, -1.3, -43.2}, {9.5, -1.0, -40.2});
    model.begin_group("gap");
    // What the ferry crosses.
    const double xa = 2.5, xb = 12.5, za = -55, zb = -40, low = -4.0;
    grid_floor(model, {2.5, 5, 7.5, 10, 12.5}, {-55, -52.5, -50, -47.5, -45, -42.5, -40}, low,
               [](double, double) { return "hazard_embers"; });
    wall(model, "stone_wall", {xa, low, zb}, {xa, low, za}, y0);
    wall(model, "stone_wall", {xb, low, za}, {xb, low, zb}, y0);
    wall(model, "stone_wall", {xa, low, za}, {xb, low, za}, y0);
    wall(model, "stone_wall", {xb, low, zb}, {xa, low, zb}, y0);
    box(model, "stone_wall", {4.5, y0, -39.0}, {13.0, 3.4, -37.2}, side_standing);
}

void add_playground_hills(Model& model) {
    model.begin_group("hills");
    // Waves that die out at the border, where they meet the floor.
    Ground hills{.x0 = -37.5, .z0 = -55, .step = 1.0, .columns = 20, .rows = 20};
    hills.height = [](double x, double z) {
        const double edge = std::min({x + 37.5, -17.5 - x, z + 55, -35 - z});
        const double wave = 3.2 * (cloud(x / 40.0 + 3.0, z / 40.0 + 3.0, 10, 3, 1601) - 0.32);
        return y0 + std::max(wave, -1.2) * ramp_between(0.0, 4.0, edge);
    };
    hills.material = [](double, double, double) -> std::string { return "grass"; };
    ground(model, hills);
}

Model make_playground() {
    Model model(materials());
    add_playground_terrace(model);
    add_playground_slopes(model);
    add_playground_steps(model);
    add_playground_walls(model);
    add_playground_pipe(model);
    add_playground_surfaces(model);
    add_playground_movers(model);
    add_playground_hills(model);
    model.join_edges();
    return model;
}

}  // namespace slipface::generate
