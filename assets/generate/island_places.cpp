#include <algorithm>
#include <array>
#include <cmath>

#include "island.h"
#include "shapes.h"
#include "wild.h"

namespace slipface::generate {
namespace {

constexpr double plaza_y = -1.0;
const Vec3 light_foot(41.5, 1.4, -6);  // centre of the lighthouse on its rock

void add_column(Model& model, const Vec3& foot, double height, double radius, bool broken) {
    box(model, "stone_trim", foot + Vec3(-1.25 * radius, -1.0, -1.25 * radius),
        foot + Vec3(1.25 * radius, 0.25, 1.25 * radius), side_standing);
    if (broken) {
        lathe(model, "column_stone", foot,
              {{radius, 0.25}, {0.94 * radius, 0.55 * height}, {0.5 * radius, 0.66 * height}}, 10, 18,
              "stone_trim");
        return;
    }
    lathe(model, "column_stone", foot,
          {{1.15 * radius, 0.25}, {radius, 0.5}, {0.86 * radius, height - 0.6}, {1.2 * radius, height - 0.3}},
          10, 18);
    box(model, "stone_trim", foot + Vec3(-1.3 * radius, height - 0.3, -1.3 * radius),
        foot + Vec3(1.3 * radius, height, 1.3 * radius));
}

// Rungs on a plane x = const or z = const: `from` and `to` are its lower corners, left to right for the
// climber.
void add_ladder(Model& model, const Vec3& from, const Vec3& to, double height) {
    const int pieces = static_cast<int>(std::ceil(height));
    const Vec3 out = (to - from).cross(Vec3::UnitY()).normalized();
    for (int i = 0; i < pieces; ++i) {
        const Vec3 low(0, height * i / pieces, 0), high(0, height * (i + 1) / pieces, 0);
        const double v0 = i, v1 = i + 1.0;
        model.face_uv(
            "ladder_wood",
            {{from + low, {0, v0}}, {to + low, {1, v0}}, {to + high, {1, v1}}, {from + high, {0, v1}}});
    }
    const Vec3 back = -0.14 * out, top(0, height, 0);
    model.face("wood_planks", {from + back, from, from + top, from + top + back});
    model.face("wood_planks", {to, to + back, to + top + back, to + top});
    model.face("wood_planks", {from + top, to + top, to + top + back, from + top + back});
    model.face("wood_planks", {to + back, from + back, from + top + back, to + top + back});
}

void add_brazier(Model& model, const Vec3& foot) {
    lathe(model, "bronze", foot,
          {{0.34, -0.3},
           {0.34, 0.12},
           {0.12, 0.25},
           {0.1, 0.95},
           {0.34, 1.15},
           {0.44, 1.35},
           {0.36, 1.35},
           {0.3, 1.22}},
          8, 0, "bronze");
    lathe(model, "lamp", foot + Vec3(0, 1.22, 0), {{0.2, 0.01}, {0.24, 0.18}, {0.0, 0.5}}, 6);
}

}  // namespace

void add_island_plaza(Model& model) {
    model.begin_group("plaza");
    // A round terrace with the turntable in its north.
    const Vec3 centre(0, plaza_y, -2);
    tower(model, "stone_wall", {0, 0, -2}, -4.0, 11.4, plaza_y - 0.25, 11.4, 24);
    ring(model, "stone_trim", centre - Vec3(0, 0.25, 0), 11.0, 11.4, 24, true);
    tower(model, "stone_trim", {0, 0, -2}, plaza_y - 0.25, 11.0, plaza_y, 11.0, 24);
    ring(model, "flagstone", centre, 8.0, 11.0, 24, true);
    ring(model, "mosaic_floor", centre, 7.2, 8.0, 24, true);
    ring(model, "stone_floor", centre, 3.0, 7.2, 24, true);
    disc(model, "mosaic_floor", centre, 3.0, 24);
    const Vec3 mill(0, plaza_y, -6.6);
    lathe(model, "stone_trim", mill, {{3.0, 0.0}, {2.95, 0.12}, {2.7, 0.16}}, 24);
    disc(model, "turntable_stone", mill + Vec3(0, 0.16, 0), 2.7, 24);

    for (int i = 0; i < 12; ++i) {
        const double angle = 30.0 * i + 15.0;
        if (i == 8 || i == 9 || i == 2 || i == 3 || i == 11 || i == 0)
            continue;  // ways to beach, mountain, bridge
        const Vec3 foot = Vec3(0, plaza_y, -2) + 9.6 * Vec3(cos_deg(angle), 0, -sin_deg(angle));
        add_column(model, foot, 4.2, 0.42, i == 4 || i == 7);
    }
    for (const Vec3& at : {Vec3(-4.2, plaza_y, 7.0), Vec3(4.2, plaza_y, 7.0), Vec3(-4.2, plaza_y, -11.0),
                           Vec3(4.2, plaza_y, -11.0)})
        add_brazier(model, at);
    // Steps down to the beach.
    for (int i = 0; i < 4; ++i) {
        const double y = plaza_y - 0.2 - 0.22 * i, z = 8.5 + 0.7 * i;
        box(model, "stone_trim", {-3.2, -3.4, z}, {3.2, y, z + (i == 3 ? 1.5 : 0.7)},
            side_standing & ~unsigned{side_north});
    }

    // The bridge over the inlet: planks, and beside them the belt that runs east.
    model.begin_group("bridge");
    const double y = -0.85, x0 = 10.2, x1 = 37.5;
    box(model, "wood_floor", {x0, y - 0.25, -5.2}, {x1, y, -3.2}, side_all);
    const int plates = 11;
    for (int i = 0; i < plates; ++i) {
        const double a = x0 + (x1 - x0) * i / plates, b = x0 + (x1 - x0) * (i + 1) / plates;
        model.face_uv("conveyor_belt", {{{a, y + 0.02, -1.0}, {0, 0}},
                                        {{b, y + 0.02, -1.0}, {0, 1}},
                                        {{b, y + 0.02, -3.0}, {1, 1}},
                                        {{a, y + 0.02, -3.0}, {1, 0}}});
    }
    box(model, "bronze", {x0, y - 0.3, -3.0}, {x1, y + 0.02, -1.0}, side_walls | side_bottom);
    for (const double x : {14.0, 19.0, 24.0, 29.0, 34.0}) {
        for (const double z : {-5.1, -1.1})
            box(model, "wood_planks", {x - 0.18, -8, z - 0.18}, {x + 0.18, y - 0.25, z + 0.18}, side_walls);
        box(model, "wood_planks", {x - 0.08, y, -5.18}, {x + 0.08, y + 0.95, -5.06}, side_standing);
    }
    box(model, "wood_planks", {x0, y + 0.95, -5.2}, {x1, y + 1.05, -5.04});
    // On the cape the bridge ends at a flight of stairs.
    stairs(model, "stone_floor", "stone_trim",
           {.left = {36.4, -2.25, -5.4},
            .ahead = Vec3::UnitX(),
            .width = 4.6,
            .count = 12,
            .rise = 0.3,
            .tread = 0.4,
            .landing = 1.0});
}

void add_island_lighthouse(Model& model) {
    model.begin_group("lighthouse");
    const Vec3 axis(light_foot.x(), 0, light_foot.z());
    const double base = light_foot.y(), r = 3.6;
    const int sides = 12;
    tower(model, "stone_wall", axis, -3.5, 5.6, base, 5.2, sides, 15);
    // The floor inside, the threshold and the terrace, so that the walls stand on edges.
    const std::array<double, 4> floors{0.0, r - 0.4, r, 5.2};
    for (std::size_t i = 0; i + 1 < floors.size(); ++i)
        ring(model, "flagstone", {axis.x(), base, axis.z()}, floors[i], floors[i + 1], sides, true, 15);
    // The ground floor: eleven walls and a door to the sea; the room inside is the hidden one.
    const auto corner = [&](int i, double radius, double y) {
        const double angle = 15.0 + 30.0 * (i % sides);
        return Vec3(axis + Vec3(radius * cos_deg(angle), y, -radius * sin_deg(angle)));
    };
    const int door = 0;  // its middle looks north-east, over the sea
    for (int i = 0; i < sides; ++i) {
        const Vec3 a = corner(i, r, base), b = corner(i + 1, r, base), c = corner(i + 1, r - 0.4, base),
                   d = corner(i, r - 0.4, base);
        if (i == door) {
            const ArchShape arch{.from = a,
                                 .to = b,
                                 .y0 = base,
                                 .y1 = base + 4,
                                 .half_width = 0.62,
                                 .sill = base,
                                 .spring = base + 1.9,
                                 .rise = 0.5,
                                 .segments = 6};
            ArchShape inner = arch;
            inner.from = c;
            inner.to = d;
            arch_wall(model, "plaster", arch);
            arch_reveal(model, "stone_trim", arch, 0.38, true);
            arch_wall(model, "stone_wall", inner);
        } else {
            wall(model, i % 2 == 0 ? "plaster" : "plaster", a, b, base + 4);
            wall(model, "stone_wall", c, d, base + 4);
        }
    }
    ring(model, "wood_planks", {axis.x(), base + 4, axis.z()}, 0, r - 0.4, sides, false, 15);
    lathe(model, "bronze", {axis.x(), base + 0.02, axis.z()}, {{1.1, 0}, {1.1, 0.5}, {0.9, 0.6}}, 8, 0,
          "mosaic_floor");
    shard(model, "crystal", {axis.x(), base + 0.62, axis.z()}, {0, 1, 0}, 0.32, 1.9);
    // Bands of plaster and terracotta up to the balcony.
    const double top = base + 15.0;
    const double r_top = 2.3;
    for (int i = 0; i < 4; ++i) {
        const double y0 = base + 4 + 2.75 * i, y1 = y0 + 2.75;
        const double ra = r - (r - r_top) * i / 4.0, rb = r - (r - r_top) * (i + 1) / 4.0;
        tower(model, i % 2 == 0 ? "terracotta" : "plaster", axis, y0, ra, y1, rb, sides, 15);
    }
    tower(model, "stone_trim", axis, top - 0.5, r_top, top - 0.2, 3.7, sides, 15);
    tower(model, "stone_trim", axis, top - 0.2, 3.7, top, 3.7, sides, 15);
    const std::array<double, 5> balcony{1.7, r_top, 3.45, 3.6,
                                        3.7};  // on the tower; below, between, beyond the rail
    for (std::size_t i = 0; i + 1 < balcony.size(); ++i)
        ring(model, "stone_floor", {axis.x(), top, axis.z()}, balcony[i], balcony[i + 1], sides, true, 15);
    tower(model, "bronze", axis, top, 1.7, top + 0.9, 1.7, sides, 15);
    tower(model, "lamp", axis, top + 0.9, 1.6, top + 2.7, 1.6, sides, 15);
    ring(model, "bronze", {axis.x(), top + 0.9, axis.z()}, 1.6, 1.7, sides, true, 15);
    lathe(model, "terracotta", {axis.x(), top + 2.7, axis.z()},
          {{2.1, 0}, {1.5, 0.9}, {0.3, 1.8}, {0.0, 2.6}}, sides, 15);
    ring(model, "terracotta", {axis.x(), top + 2.7, axis.z()}, 1.6, 2.1, sides, false, 15);
    // A low rail with a gap on the landward side, where the ladder ends.
    for (int i = 0; i < sides; ++i) {
        if (i == 5) continue;
        const Vec3 a = corner(i, 3.6, top), b = corner(i + 1, 3.6, top), c = corner(i + 1, 3.45, top),
                   d = corner(i, 3.45, top);
        const Vec3 up(0, 0.7, 0);
        model.face("bronze", {a, b, b + up, a + up});
        model.face("bronze", {c, d, d + up, c + up});
        model.face("bronze", {a + up, b + up, c + up, d + up});
    }
    add_ladder(model, {axis.x() - 3.74, base, axis.z() - 0.6}, {axis.x() - 3.74, base, axis.z() + 0.6}, 15.0);
}

void add_island_temple(Model& model) {
    model.begin_group("temple");
    const double x0 = 15, x1 = 30, z0 = -42.5, z1 = -27.5, top = 6.4, low = 0.8, ceiling = 5.6;
    // The plinth, and the hidden room in it under a well in the floor.
    box(model, "stone_wall", {x0, -1.0, z0}, {x1, top, z1}, side_walls);
    const auto well = [](double x, double z) {
        return std::abs(x - 22.5) < 1.25 && z > -38.75 && z < -36.25;
    };
    grid_floor(model, {15, 17.5, 20, 21.25, 23.75, 25, 27.5, 30},
               {-42.5, -40, -38.75, -36.25, -35, -32.5, -30, -27.5}, top, [&](double x, double z) {
                   if (well(x, z)) return "";
                   return std::abs(x - 22.5) < 1.25 ? "mosaic_floor" : "stone_floor";
               });
    const double a = 17.5, b = 27.5, c = -40, d = -30;
    grid_floor(
        model, {a, 20, 21.25, 23.75, 25, b}, {c, -38.75, -36.25, -35, -32.5, d}, ceiling,
        [&](double x, double z) { return well(x, z) ? "" : "plaster"; }, false);
    grid_floor(model, {a, 20, 22.5, 25, b}, {c, -37.5, -35, -32.5, d}, low, [](double x, double z) {
        return std::abs(x - 22.5) + std::abs(z + 35) < 3.0 ? "mosaic_floor" : "stone_floor";
    });
    wall(model, "tile_teal", {a, low, d}, {a, low, c}, ceiling);
    wall(model, "tile_teal", {b, low, c}, {b, low, d}, ceiling);
    wall(model, "tile_teal", {a, low, c}, {b, low, c}, ceiling);
    wall(model, "tile_teal", {b, low, d}, {a, low, d}, ceiling);
    for (int i = 0; i < 4; ++i) {
        const double wx0 = i == 1 ? 23.75 : 21.25, wx1 = i == 0   ? 21.25
                                                         : i == 1 ? 23.75
                                                         : i == 2 ? 21.25
                                                                  : 23.75;
        if (i < 2)
            wall(model, "stone_trim", {wx0, ceiling, i == 0 ? -36.25 : -38.75},
                 {wx1, ceiling, i == 0 ? -38.75 : -36.25}, top);
    }
    wall(model, "stone_trim", {21.25, ceiling, -38.75}, {23.75, ceiling, -38.75}, top);
    wall(model, "stone_trim", {23.75, ceiling, -36.25}, {21.25, ceiling, -36.25}, top);
    add_ladder(model, {22.0, low, -38.6}, {23.0, low, -38.6}, top - low);
    lathe(model, "stone_trim", {22.5, low, -32.4}, {{1.4, 0}, {1.3, 0.5}, {1.0, 0.6}}, 8, 22.5,
          "mosaic_floor");
    shard(model, "gem", {22.5, low + 0.6, -32.4}, {0, 1, 0}, 0.45, 2.4);
    shard(model, "gem", {22.1, low + 0.55, -32.2}, {-0.4, 1, 0.2}, 0.25, 1.4);
    shard(model, "gem", {22.95, low + 0.55, -32.5}, {0.45, 1, -0.1}, 0.28, 1.5);

    // Columns round the floor, a broken roof on those in the back.
    for (int i = 0; i < 5; ++i) {
        for (int j = 0; j < 5; ++j) {
            if (i > 0 && i < 4 && j > 0 && j < 4) continue;
            if (j == 4 && i == 2) continue;
            add_column(model, {x0 + 1.2 + 3.15 * i, top, z0 + 1.2 + 3.15 * j}, 5.0, 0.5,
                       (i * 3 + j * 5) % 7 == 3);
        }
    }
    box(model, "stone_trim", {x0 + 0.5, top + 5.0, z0 + 0.5}, {x1 - 0.5, top + 5.7, z0 + 1.9});
    box(model, "stone_trim", {x0 + 0.5, top + 5.0, z0 + 1.9}, {x0 + 1.9, top + 5.7, z0 + 8.8},
        side_all & ~unsigned{side_north});
    model.face("stone_trim", {{x0 + 0.5, top + 5.7, z0 + 1.9},
                              {x1 - 0.5, top + 5.7, z0 + 1.9},
                              {0.5 * (x0 + x1), top + 7.9, z0 + 1.9}});
    model.face("stone_trim", {{x1 - 0.5, top + 5.7, z0 + 0.5},
                              {x0 + 0.5, top + 5.7, z0 + 0.5},
                              {0.5 * (x0 + x1), top + 7.9, z0 + 0.5}});
    model.face("terracotta", {{0.5 * (x0 + x1), top + 7.9, z0 + 1.9},
                              {x1 - 0.5, top + 5.7, z0 + 1.9},
                              {x1 - 0.5, top + 5.7, z0 + 0.5},
                              {0.5 * (x0 + x1), top + 7.9, z0 + 0.5}});
    model.face("terracotta", {{x0 + 0.5, top + 5.7, z0 + 1.9},
                              {0.5 * (x0 + x1), top + 7.9, z0 + 1.9},
                              {0.5 * (x0 + x1), top + 7.9, z0 + 0.5},
                              {x0 + 0.5, top + 5.7, z0 + 0.5}});
    stairs(model, "stone_floor", "stone_wall",
           {.left = {19.5, 0.4, -19.5},
            .ahead = -Vec3::UnitZ(),
            .width = 6,
            .count = 20,
            .rise = 0.3,
            .tread = 0.4,
            .back = false});
    add_brazier(model, {19.2, top, -29});
    add_brazier(model, {25.8, top, -29});
}

void add_island_half_pipe(Model& model) {
    model.begin_group("half_pipe");
    const int segments = 24, pieces = 6;
    const double radius = 3.6, middle = -34, z0 = -12, z1 = 10, deck = 2.3;
    const auto point = [&](int i, double z) {
        const double angle = 180.0 * i / segments;
        return Vec3(middle - radius * cos_deg(angle), deck - radius * sin_deg(angle), z);
    };
    const double arc = 2 * radius * sin_deg(90.0 / segments) / 3;
    for (int i = 0; i < segments; ++i) {
        for (int k = 0; k < pieces; ++k) {
            const double a = z0 + (z1 - z0) * k / pieces, b = z0 + (z1 - z0) * (k + 1) / pieces;
            model.face_uv("ice_pipe", {{point(i, b), {b / 3, arc * i}},
                                       {point(i + 1, b), {b / 3, arc * (i + 1)}},
                                       {point(i + 1, a), {a / 3, arc * (i + 1)}},
                                       {point(i, a), {a / 3, arc * i}}});
        }
    }
    // Decks on both sides, end walls below the curve.
    for (const double side : {-1.0, 1.0}) {
        const double inner = middle + side * radius, outer = middle + side * (radius + 2.2);
        box(model, "wood_floor", {std::min(inner, outer), -3.0, z0}, {std::max(inner, outer), deck, z1},
            side_top | side_south | side_north | (side > 0 ? side_east : side_west));
        for (int k = 0; k < 6; ++k) {
            const double z = z0 + 0.3 + (z1 - z0 - 0.6) * k / 5;
            box(model, "wood_planks", {outer - 0.16 - (side > 0 ? 0.0 : -0.08), deck, z - 0.08},
                {outer + (side > 0 ? -0.0 : 0.24), deck + 0.9, z + 0.08}, side_standing);
        }
    }
    for (const bool south : {true, false}) {
        const double z = south ? z1 : z0;
        std::vector<Vec3> end{{middle - radius, -3.0, z}, {middle + radius, -3.0, z}};
        for (int i = segments; i >= 0; --i)
            end.push_back(point(i, z));
        if (!south) std::reverse(end.begin(), end.end());
        model.face("stone_wall", end);
    }
    stairs(model, "stone_floor", "stone_trim",
           {.left = {-23.58, -1.9, 1.5},
            .ahead = -Vec3::UnitX(),
            .width = 3,
            .count = 14,
            .rise = 0.3,
            .tread = 0.33,
            .back = false});
}

// The chute of ice from the shoulder of the mountain down to the plaza, and the stone tower beside it.
void add_island_slide(Model& model) {
    model.begin_group("slide");
    const int rows = 22;
    const auto centre = [&](int row) {
        const double t = static_cast<double>(row) / rows;
        const double x = -9.0 + 3.5 * t + 9.0 * t * (1.0 - t), z = -33.0 + 19.5 * t;
        double y = -10;
        for (const double dx : {-2.4, 0.0, 2.4})
            for (const double dz : {-1.4, 0.0, 1.4})
                y = std::max(y, island_height(x + dx, z + dz));
        return Vec3(x, y + 0.35, z);
    };
    // Smoothed, so that the chute does not follow each step of the ground.
    std::vector<Vec3> line;
    for (int row = 0; row <= rows; ++row) {
        Vec3 at = centre(row);
        double high = at.y();
        for (int k = std::max(0, row - 1); k <= std::min(rows, row + 1); ++k)
            high = std::max(high, 0.5 * (centre(k).y() + at.y()));
        at.y() = row == rows ? plaza_y + 0.05 : high + 0.2 * (1.0 - static_cast<double>(row) / rows);
        line.push_back(at);
    }
    const std::array<Vec2, 5> profile{Vec2(-1.9, 1.0), Vec2(-1.2, 0.25), Vec2(0, 0), Vec2(1.2, 0.25),
                                      Vec2(1.9, 1.0)};
    const auto point = [&](int row, std::size_t k) {
        return Vec3(line[static_cast<std::size_t>(row)] + Vec3(profile[k].x(), profile[k].y(), 0));
    };
    for (int row = 0; row < rows; ++row) {
        for (std::size_t k = 0; k + 1 < profile.size(); ++k) {
            const double v0 = 0.35 * row, v1 = v0 + 0.35, u0 = 0.3 * static_cast<double>(k), u1 = u0 + 0.3;
            model.face_uv("ice_slide", {{point(row + 1, k), {u0, v1}},
                                        {point(row + 1, k + 1), {u1, v1}},
                                        {point(row, k + 1), {u1, v0}}});
            model.face_uv(
                "ice_slide",
                {{point(row + 1, k), {u0, v1}}, {point(row, k + 1), {u1, v0}}, {point(row, k), {u0, v0}}});
        }
        for (const bool east : {false, true}) {
            const Vec3 a = point(row, east ? 4 : 0), b = point(row + 1, east ? 4 : 0);
            const Vec3 out(east ? 0.35 : -0.35, 0, 0), down(0, -2.6, 0);
            if (east) {
                model.face("snow", {a, b, b + out, a + out});
                model.face("snow", {a + out, b + out, b + out + down, a + out + down});
            } else {
                model.face("snow", {b, a, a + out, b + out});
                model.face("snow", {b + out, a + out, a + out + down, b + out + down});
            }
        }
    }
    // The start: a platform of stone on the shoulder.
    const Vec3 start = line.front();
    box(model, "stone_wall", start + Vec3(-2.45, -5, -5.2), start + Vec3(2.45, 0.25, -0.05), side_standing);
    for (const double x : {-2.0, 2.0})
        add_column(model, start + Vec3(x, 0.25, -4.6), 3.6, 0.32, x > 0);
    box(model, "bronze", start + Vec3(-2.05, 0.2, -0.9), start + Vec3(-1.95, 3.6, -0.8), side_standing);
    for (const bool front : {true, false}) {
        std::vector<Corner> cloth{{start + Vec3(-1.95, 2.2, -0.85), {0, 0}},
                                  {start + Vec3(-0.5, 2.2, -0.85), {1, 0}},
                                  {start + Vec3(-0.5, 3.5, -0.85), {1, 1}},
                                  {start + Vec3(-1.95, 3.5, -0.85), {0, 1}}};
        if (!front) std::reverse(cloth.begin(), cloth.end());
        model.face_uv("banner_cloth", cloth);
    }

    // The tower: climb its moss by sticking to it, or ride the lift.
    model.begin_group("moss_tower");
    box(model, "stone_wall", {-16.5, -4, -16}, {-12.5, 6.2, -12},
        (side_all & ~unsigned{side_bottom}) & ~unsigned{side_east});
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 4; ++j) {
            const double y0 = -4 + 2.55 * j, y1 = y0 + 2.55, za = -12 - 4.0 * i / 3,
                         zb = -12 - 4.0 * (i + 1) / 3;
            model.face("sticky_moss", {{-12.5, y0, za}, {-12.5, y0, zb}, {-12.5, y1, zb}, {-12.5, y1, za}});
        }
    }
    box(model, "stone_trim", {-16.8, 6.2, -16.3}, {-12.2, 6.5, -11.7});
    add_brazier(model, {-16.0, 6.5, -15.4});
    beam(model, "wood_floor", {-14.5, 6.5, -16.2}, {-11.5, 9.2, -26.0}, 1.6, 0.25);
}

void add_island_platforms(Model& model) {
    const auto raft = [&](const std::string& group, const Vec3& middle, double half_x, double half_z) {
        model.begin_group(group);
        const Vec3 half(half_x, 0.2, half_z);
        box(model, "wood_floor", middle - half, middle + half);
        for (const double z : {-0.7, 0.7})
            box(model, "bronze", middle + Vec3(-half_x - 0.06, -0.3, z * half_z - 0.12),
                middle + Vec3(half_x + 0.06, -0.16, z * half_z + 0.12));
    };
    raft("raft", {21.9, -0.15, 4.0}, 1.6, 1.6);
    raft("lift", {-20.5, 0.86, -14}, 1.5, 1.5);
    raft("carousel", {31.5, 1.5, 14}, 3.4, 0.9);
}

void add_island_plants(Model& model) {
    model.begin_group("plants");
    std::uint32_t seed = 1000;
    const std::array<Vec2, 16> palms{Vec2(-9, 18),    Vec2(-12.5, 22), Vec2(10, 17.5),  Vec2(13.5, 21),
                                     Vec2(-16, 16.5), Vec2(17, 13),    Vec2(-15, 4),    Vec2(-17.5, 8),
                                     Vec2(14, 8),     Vec2(36.5, 3),   Vec2(45.5, -12), Vec2(-27, 16),
                                     Vec2(-21, -18),  Vec2(33, -22),   Vec2(12.5, -22), Vec2(-40, 16)};
    for (const Vec2& at : palms) {
        palm(model, {at.x(), island_height(at.x(), at.y()), at.y()}, 4.6 + 2.2 * scatter(seed, 5), seed);
        ++seed;
    }
    for (std::uint32_t i = 0; i < 90; ++i) {
        const double x = -48 + 96 * scatter(1100, i), z = -48 + 90 * scatter(1101, i);
        const double y = island_height(x, z);
        const double steep = std::abs(island_height(x + 1, z) - y) + std::abs(island_height(x, z + 1) - y);
        const bool built = (x > 13 && x < 32 && z > -45 && z < -18) ||
                           (x > -42 && x < -22 && z > -14 && z < 12) || (x * x + (z + 2) * (z + 2) < 150) ||
                           std::abs(x + 7) < 4.5;
        if (built) continue;
        if (y < -2.2 || i % 3 == 0) {
            if (y > -5.5)
                wild_rock(model, "rock", {x, y - 0.15, z}, 0.5 + 1.3 * scatter(1102, i),
                          0.5 + 1.3 * scatter(1103, i), 1200 + i);
        } else if (steep < 0.8 && y < 13) {
            tuft(model, {x, y, z}, 0.6 + 0.6 * scatter(1104, i), 7, 1300 + i);
        }
    }
    // Sea stacks south-west and west, for the skyline.
    for (const Vec3& at : {Vec3(-38, -7, 34), Vec3(-44, -7, 27), Vec3(52, -7, 22), Vec3(58, -7, -20)}) {
        wild_rock(model, "cliff", at, 4.2, 9.0 + 6.0 * scatter(seed, 3), seed);
        ++seed;
    }
    for (const Vec3& at : {Vec3(-19.0, -1.2, 0), Vec3(-20.5, -1.1, 1.8)}) {
        const double height = 1.0 + 0.5 * scatter(seed, 2);
        ++seed;
        lathe(model, "mushroom_stem", at, {{0.3, -0.3}, {0.22, height}}, 8);
        lathe(model, "mushroom_stem", at, {{0.22, height}, {1.0, height - 0.05}}, 12);
        lathe(model, "bouncy_mushroom", at,
              {{1.0, height - 0.05}, {1.05, height + 0.1}, {0.8, height + 0.3}, {0.4, height + 0.42}}, 12, 0,
              "bouncy_mushroom");
    }
}

}  // namespace slipface::generate
