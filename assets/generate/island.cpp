#include "island.h"

#include <algorithm>
#include <cmath>

#include "painting.h"
#include "shapes.h"
#include "wild.h"

namespace slipface::generate {
namespace {

// What is shown of the beach lies this far above its heightfield, so that the two do not flicker; at its rim
// it meets the ground around it.
constexpr double beach_lift = 0.03;

std::vector<ModelMaterial> island_materials() {
    return {
        {"grass", "grass", 4.0},
        {"sand", "sand", 3.0},
        {"beach_sand", "sand", 3.0},
        {"sea_water", "water", 9.0},
        {"cliff", "cliff", 6.0},
        {"snow", "snow", 4.0},
        {"rock", "rock", 2.0},
        {"flagstone", "flagstone", 2.5},
        {"stone_floor", "stone_floor", 2.5},
        {"mosaic_floor", "mosaic_floor", 2.5},
        {"stone_wall", "stone_wall", 2.0},
        {"stone_trim", "stone_trim", 2.0},
        {"plaster", "plaster", 4.0},
        {"column_stone", "column_stone", 1.0},
        {"tile_teal", "tile_teal", 1.0},
        {"terracotta", "terracotta", 1.0},
        {"wood_planks", "wood_planks", 2.0},
        {"wood_floor", "wood_floor", 2.5},
        {"door_wood", "door_wood", 1.9},
        {"bronze", "bronze", 1.0},
        {"banner_cloth", "banner_cloth", 1.0},
        {"crystal", "crystal", 1.2},
        {"gem", "gem", 1.0},
        {"lamp", "lamp_glass", 1.0},
        {"palm_trunk", "palm_trunk", 1.0},
        {"foliage", "foliage", 1.0},
        {"ice_slide", "ice", 3.0},
        {"ice_pipe", "ice", 3.0},
        {"ladder_wood", "ladder_wood", 1.0},
        {"sticky_moss", "sticky_moss", 1.6},
        {"bouncy_mushroom", "bouncy_mushroom", 1.0},
        {"mushroom_stem", "mushroom_stem", 0.8},
        {"conveyor_belt", "conveyor_belt", 2.5},
        {"turntable_stone", "turntable_stone", 1.0},
        {"moss_bed", "moss", 1.6},
    };
}

double distance(double x, double z, double cx, double cz) {
    return std::sqrt((x - cx) * (x - cx) + (z - cz) * (z - cz));
}

// 1 inside a rectangle, fading to 0 over `border` metres around it.
double within(double x, double z, double x0, double x1, double z0, double z1, double border) {
    const double dx = std::max({x0 - x, 0.0, x - x1}), dz = std::max({z0 - z, 0.0, z - z1});
    return 1.0 - ramp_between(0.0, border, std::sqrt(dx * dx + dz * dz));
}

void blend(double& height, double target, double fraction) {
    height += (target - height) * fraction;
}

bool temple_cell(double x, double z) {
    return x > 15 && x < 30 && z > -42.5 && z < -27.5;
}

}  // namespace

namespace {

double exact_height(double x, double z) {
    const double n = cloud(x / 160.0 + 4.0, z / 160.0 + 4.0, 8, 4, 801) - 0.5;
    const double coast = 56.0 + 14.0 * (noise(x / 200.0 + 4.0, z / 200.0 + 4.0, 10, 10, 803) - 0.5);
    const double d = coast - std::sqrt(x * x + 1.15 * z * z);  // metres inland
    double y =
        -9.0 + 6.5 * ramp_between(-16, 0, d) + 2.2 * ramp_between(-1, 10, d) + 1.6 * ramp_between(8, 26, d);
    y += 2.4 * n * ramp_between(4, 18, d);
    // The mountain, with a sharp shoulder.
    const double m = 1.0 - distance(x, z, -10, -34) / 25.0;
    if (m > 0) y += 15.0 * m * (0.45 + 0.55 * m) * (1.0 + 0.6 * n) + 5.0 * ramp_between(0.25, 0.34, m);
    // The cape, cut off by an inlet.
    blend(y, 1.6 + 1.5 * n, within(x, z, 36, 47, -14, 4, 7));
    blend(y, -6.5, within(x, z, 23.5, 29.5, -26, 40, 4.5) * ramp_between(-27, -20, z));
    // South: a broad beach.
    const double shore = -1.6 - 0.075 * (z - 15);
    blend(y, shore + 0.5 * n, within(x, z, -22, 19, 19, 80, 9) * ramp_between(12, 20, z));
    // What people levelled.
    blend(y, 5.4, within(x, z, 15, 30, -42.5, -27.5, 5.0));
    blend(y, -1.45, 1.0 - ramp_between(13.0, 18.0, distance(x, z, 0, -2)));
    blend(y, -1.6, within(x, z, -44, -24, -14, 12, 5.0));
    blend(y, 1.0, within(x, z, -22.6, -17.4, -17.6, -9.9, 3.0));  // where the tower's lift waits
    return y;
}

}  // namespace

// In steps of which the mean of two is a number that an OBJ holds exactly: the beach's corners lie on the
// edges of the ground around it.
double island_height(double x, double z) {
    return std::round(0.5 * grid_per_unit * exact_height(x, z)) / (0.5 * grid_per_unit);
}

double beach_height(int column, int row) {
    const double step = (beach.x1 - beach.x0) / (beach.columns - 1);
    const auto at = [&](int i, int j) { return island_height(beach.x0 + step * i, beach.z0 + step * j); };
    const bool west_east = column == 0 || column == beach.columns - 1;
    const bool north_south = row == 0 || row == beach.rows - 1;
    if (west_east && row % 2 == 1) return 0.5 * (at(column, row - 1) + at(column, row + 1));
    if (north_south && column % 2 == 1) return 0.5 * (at(column - 1, row) + at(column + 1, row));
    return at(column, row);
}

void add_island_ground(Model& model) {
    model.begin_group("ground");
    Ground shape{.x0 = -75, .z0 = -75, .step = 2.5, .columns = 60, .rows = 60, .height = island_height};
    const auto on_beach = [](double x, double z) {
        return x > beach.x0 && x < beach.x1 && z > beach.z0 && z < beach.z1;
    };
    shape.material = [&](double x, double z, double steep) -> std::string {
        if (on_beach(x, z) || temple_cell(x, z)) return {};
        const double y = island_height(x, z);
        if (y > 14.0 && steep < 0.34) return "snow";
        if (steep > 0.20) return "cliff";
        return y < -1.9 ? "sand" : "grass";
    };
    ground(model, shape);

    // What one sees of the beach; what one stands on is the heightfield, which has the same heights.
    model.begin_group("beach");
    const double step = (beach.x1 - beach.x0) / (beach.columns - 1);
    for (int j = 0; j + 1 < beach.rows; ++j) {
        for (int i = 0; i + 1 < beach.columns; ++i) {
            const auto at = [&](int a, int b) {
                const bool rim = a == 0 || b == 0 || a + 1 == beach.columns || b + 1 == beach.rows;
                return Vec3(beach.x0 + step * a, beach_height(a, b) + (rim ? 0.0 : beach_lift),
                            beach.z0 + step * b);
            };
            model.face("beach_sand", {at(i, j), at(i, j + 1), at(i + 1, j + 1)});
            model.face("beach_sand", {at(i, j), at(i + 1, j + 1), at(i + 1, j)});
        }
    }

    model.begin_group("sea");
    const std::vector<double> lines{-600, -300, -150, -75, -50, -25, 0, 25, 50, 75, 150, 300, 600};
    grid_floor(model, lines, lines, sea_y, [](double, double) { return "sea_water"; });
}

Model make_island() {
    Model model(island_materials());
    add_island_ground(model);
    add_island_plaza(model);
    add_island_lighthouse(model);
    add_island_temple(model);
    add_island_slide(model);
    add_island_half_pipe(model);
    add_island_plants(model);
    add_island_platforms(model);
    model.join_edges();
    return model;
}

}  // namespace slipface::generate
