#include <algorithm>
#include <cmath>

#include "easy.h"
#include "shapes.h"

namespace slipface::generate {
namespace {

constexpr double stairwell_x = 11.5;
constexpr double stair_top_z = 6.0;
constexpr double stair_foot_z = -1.5;  // east
constexpr double ramp_foot_z = -4.0;   // west
constexpr double parapet_y = gallery_y + 0.9;

double foot_z(bool west) {
    return west ? ramp_foot_z : stair_foot_z;
}

void add_parapet(Model& model, double z0, double z1) {
    box(model, "tile_teal", {6.62, gallery_y, z0}, {6.88, parapet_y, z1}, side_walls);
    box(model, "stone_trim", {6.54, parapet_y, z0}, {6.96, parapet_y + 0.1, z1});
}

void add_parapets(Model& model, bool west) {
    for (int k = 0; k < bays; ++k) {
        const double middle = south_z - bay * (k + 0.5);
        const double z0 = middle - 1.9, z1 = middle + 1.9;
        const bool ladder = !west && k == 3;
        const bool landing = k == 6 || (west && k == 1);  // over the bouncy pads, and where the moss ends
        if (k == 0) {
            add_parapet(model, z0, 8.5);  // the loft begins there
        } else if (ladder) {
            add_parapet(model, z0, middle - 0.7);
            add_parapet(model, middle + 0.7, z1);
        } else if (!landing) {
            add_parapet(model, z0, z1);
        }
    }
}

void add_stairwell_rail(Model& model, double foot) {
    box(model, "wood_planks", {11.28, gallery_y, foot - 0.22}, {11.5, parapet_y, stair_top_z - 0.6},
        side_standing);
    box(model, "wood_planks", {11.5, gallery_y, foot - 0.22}, {hall_x, parapet_y, foot},
        side_south | side_north | side_top);
}

void add_gallery(Model& model, bool west) {
    const double foot = foot_z(west);
    const auto open = [&](double x, double z) { return x > stairwell_x && z > foot && z < stair_top_z; };
    std::vector<double> zs{foot, stair_top_z};
    for (int i = 0; i <= 2 * bays; ++i)
        zs.push_back(north_z + 0.5 * bay * i);
    std::sort(zs.begin(), zs.end());
    zs.erase(std::unique(zs.begin(), zs.end()), zs.end());
    grid_floor(model, {6.5, 9, 11.5, 14}, zs, gallery_y,
               [&](double x, double z) { return open(x, z) ? "" : "wood_floor"; });
    grid_floor(
        model, {7.5, 9, 11.5, 14}, zs, aisle_ceiling_y,
        [&](double x, double z) { return open(x, z) ? "" : "plaster"; }, false);
    wall(model, "wood_planks", {stairwell_x, aisle_ceiling_y, stair_top_z},
         {stairwell_x, aisle_ceiling_y, foot}, gallery_y);
    wall(model, "wood_planks", {stairwell_x, aisle_ceiling_y, foot}, {hall_x, aisle_ceiling_y, foot},
         gallery_y);
    add_stairwell_rail(model, foot);

    grid_floor(
        model, {7.5, 14}, {north_z, -24, -19, -14, -9, -4, 1, 6, south_z}, gallery_ceiling_y,
        [](double, double) { return "plaster"; }, false);
    const unsigned beam = side_bottom | side_south | side_north;
    for (int k = 1; k < bays; ++k) {
        const double z = south_z - bay * k;
        box(model, "wood_planks", {7.5, 7.25, z - 0.18}, {hall_x, gallery_ceiling_y, z + 0.18}, beam);
        const double end = z + 0.18 > foot && z < stair_top_z ? stairwell_x : hall_x;
        box(model, "wood_planks", {7.5, 3.3, z - 0.18}, {end, aisle_ceiling_y, z + 0.18}, beam | side_east);
    }
    add_parapets(model, west);
}

void add_loft(Model& model) {
    grid_floor(model, {-6.5, -2.5, 2.5, 6.5}, {8.5, south_z}, gallery_y,
               [](double, double) { return "wood_floor"; });
    grid_floor(
        model, {-6.5, -2.5, 2.5, 6.5}, {8.5, south_z}, aisle_ceiling_y,
        [](double, double) { return "plaster"; }, false);
    wall(model, "wood_planks", {6.5, aisle_ceiling_y, 8.5}, {-6.5, aisle_ceiling_y, 8.5}, gallery_y);
    box(model, "tile_teal", {-6.5, gallery_y, 8.55}, {6.5, parapet_y, 8.8}, side_walls);
    box(model, "stone_trim", {-6.5, parapet_y, 8.48}, {6.5, parapet_y + 0.1, 8.88});
    for (const double x : {-3.4, 3.4}) {
        box(model, "stone_trim", {x - 0.45, floor_y, 8.45}, {x + 0.45, -0.7, 9.35}, side_standing);
        lathe(model, "column_stone", {x, 0, 8.9}, {{0.38, -0.7}, {0.3, -0.55}, {0.27, 3.0}, {0.42, 3.3}}, 8,
              22.5);
        box(model, "stone_trim", {x - 0.45, 3.3, 8.45}, {x + 0.45, aisle_ceiling_y, 9.35});
    }
}

void add_ladder(Model& model) {
    const double z0 = -7.0, z1 = -6.0, x0 = 6.3, x1 = 6.42, top = gallery_y + 0.02;
    std::vector<double> ys;
    for (int i = 0; i <= 5; ++i)
        ys.push_back(floor_y + (top - floor_y) * i / 5);
    for (std::size_t i = 0; i + 1 < ys.size(); ++i) {
        const auto v0 = static_cast<double>(i), v1 = v0 + 1;
        model.face_uv("ladder_wood", {{{x0, ys[i], z0}, {0, v0}},
                                      {{x0, ys[i], z1}, {1, v0}},
                                      {{x0, ys[i + 1], z1}, {1, v1}},
                                      {{x0, ys[i + 1], z0}, {0, v1}}});
        model.face_uv("ladder_wood", {{{x1, ys[i], z1}, {0, v0}},
                                      {{x1, ys[i], z0}, {1, v0}},
                                      {{x1, ys[i + 1], z0}, {1, v1}},
                                      {{x1, ys[i + 1], z1}, {0, v1}}});
    }
    model.face("wood_planks", {{x0, top, z1}, {x1, top, z1}, {x1, top, z0}, {x0, top, z0}});
    for (const double z : {z0 - 0.1, z1})
        box(model, "wood_planks", {x0 - 0.04, floor_y, z}, {nave_x, top, z + 0.1}, side_standing);
}

// A bay of the west arcade walled up and overgrown, to climb by sticking to it.
void add_moss_wall(Model& model) {
    model.mirror_x(true);
    const std::vector<double> zs{1.5, 2.5, 3.5, 4.5, 5.5}, ys{floor_y, 0.25, 1.5, 2.75, gallery_y};
    const double x = 6.3;
    for (std::size_t i = 0; i + 1 < zs.size(); ++i) {
        for (std::size_t j = 0; j + 1 < ys.size(); ++j) {
            model.face(
                "sticky_moss",
                {{x, ys[j], zs[i]}, {x, ys[j], zs[i + 1]}, {x, ys[j + 1], zs[i + 1]}, {x, ys[j + 1], zs[i]}});
        }
    }
    box(model, "stone_wall", {x, floor_y, 1.5}, {6.9, gallery_y, 5.5}, side_east | side_south | side_north);
    model.face("stone_trim",
               {{x, gallery_y, 5.5}, {6.38, gallery_y, 5.5}, {6.38, gallery_y, 1.5}, {x, gallery_y, 1.5}});
    model.mirror_x(false);
}

}  // namespace

void add_galleries(Model& model) {
    for (const bool west : {false, true}) {
        model.begin_group(west ? "gallery_west" : "gallery_east");
        model.mirror_x(west);
        add_gallery(model, west);
        model.mirror_x(false);
    }
    model.begin_group("loft");
    add_loft(model);
}

void add_ways_up(Model& model) {
    model.begin_group("ways_up");
    stairs(model, "stone_floor", "stone_trim",
           {.left = {hall_x, floor_y, stair_foot_z},
            .ahead = Vec3::UnitZ(),
            .width = hall_x - stairwell_x,
            .count = 20,
            .rise = 0.25,
            .tread = 0.375,
            .left_side = false});
    ramp(model, "wood_planks", "stone_trim",
         {.left = {-stairwell_x, floor_y, ramp_foot_z},
          .ahead = Vec3::UnitZ(),
          .width = hall_x - stairwell_x,
          .run = stair_top_z - ramp_foot_z,
          .height = gallery_y - floor_y,
          .right_side = false});
    add_ladder(model);
    add_moss_wall(model);
    for (const double x : {-4.3, 4.3}) {
        lathe(model, "stone_trim", {x, floor_y, -21.5}, {{1.1, 0}, {1.05, 0.12}, {0.9, 0.16}}, 16);
        disc(model, "bouncy_pad", {x, floor_y + 0.16, -21.5}, 0.9, 16);
    }
}

}  // namespace slipface::generate
