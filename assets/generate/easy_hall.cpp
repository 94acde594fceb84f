#include <cmath>

#include "easy.h"
#include "shapes.h"

namespace slipface::generate {
namespace {

constexpr double dado_y = 0.2;
constexpr double door_z = -11.5;  // of the passage to the test room

std::vector<double> half_bays() {
    std::vector<double> zs;
    for (int i = 0; i <= 2 * bays; ++i)
        zs.push_back(north_z + 0.5 * bay * i);
    return zs;
}

bool inside(double value, double low, double high) {
    return value > low && value < high;
}

std::string hall_floor_material(double x, double z) {
    if (inside(std::abs(x), 0, 5) && inside(z, -19, -6.5)) return {};  // the pool
    if (inside(x, 9, 11.5) && inside(z, -21.5, -14)) return {};        // the pit
    if (inside(x, 11.5, 14) && inside(z, -1.5, 6)) return {};          // under the stairs
    if (inside(x, -14, -11.5) && inside(z, -4, 6)) return {};          // under the ramp
    if (inside(x, -11.5, -9) && inside(z, -24, 6)) return {};          // the belt
    if (std::abs(x) < 2.5) return "mosaic_floor";
    return "stone_floor";
}

// Runs north along the west aisle, its chevrons pointing the way.
void add_conveyor(Model& model) {
    for (double z = -24; z < 6; z += 2.5) {
        model.face_uv("conveyor_belt", {{{-11.5, floor_y, z + 2.5}, {0, 0}},
                                        {{-9, floor_y, z + 2.5}, {1, 0}},
                                        {{-9, floor_y, z}, {1, 1}},
                                        {{-11.5, floor_y, z}, {0, 1}}});
    }
}

void add_pit(Model& model) {
    const double depth_y = -3.0;
    grid_floor(model, {9, 11.5}, {-21.5, -19, -16.5, -14}, depth_y,
               [](double, double) { return "hazard_embers"; });
    wall(model, "stone_wall", {9, depth_y, -14}, {9, depth_y, -21.5}, floor_y);
    wall(model, "stone_wall", {11.5, depth_y, -21.5}, {11.5, depth_y, -14}, floor_y);
    wall(model, "stone_wall", {9, depth_y, -21.5}, {11.5, depth_y, -21.5}, floor_y);
    wall(model, "stone_wall", {11.5, depth_y, -14}, {9, depth_y, -14}, floor_y);
    // A plank bridge for those who trust it, off the middle so that there is something to jump for.
    box(model, "wood_planks", {9.6, -1.08, -21.9}, {10.3, -0.92, -13.6});
    for (const double z : {-21.2, -14.3})
        box(model, "bronze", {9.5, -0.92, z - 0.08}, {10.4, -0.88, z + 0.08}, side_standing);
}

// One bay of an outer wall: plain below, a window at gallery level. `from` and `to` as in wall().
void add_outer_bay(Model& model, const Vec3& from, const Vec3& to) {
    wall(model, "stone_wall", from, to, dado_y);
    wall(model, "plaster", {from.x(), dado_y, from.z()}, {to.x(), dado_y, to.z()}, gallery_y);
    const ArchShape window{.from = from,
                           .to = to,
                           .y0 = gallery_y,
                           .y1 = gallery_ceiling_y,
                           .half_width = 0.9,
                           .sill = 5.0,
                           .spring = 6.1,
                           .rise = 0.9,
                           .segments = 8};
    arch_wall(model, "plaster", window);
    arch_reveal(model, "stone_trim", window, 0.5, true);
    arch_panel(model, "sky", window, 0.5);
}

void add_pilaster(Model& model, double z) {
    box(model, "stone_trim", {13.65, floor_y, z - 0.35}, {hall_x, gallery_y, z + 0.35},
        side_west | side_south | side_north);
    box(model, "stone_trim", {13.55, floor_y, z - 0.45}, {hall_x, floor_y + 0.3, z + 0.45},
        side_west | side_south | side_north | side_top);
    box(model, "stone_trim", {13.65, gallery_y, z - 0.3}, {hall_x, gallery_ceiling_y, z + 0.3},
        side_west | side_south | side_north);
}

void add_long_wall(Model& model, bool west) {
    model.mirror_x(west);
    for (int k = 0; k < bays; ++k) {
        const double z1 = south_z - bay * k;
        const Vec3 from(hall_x, floor_y, z1 - bay), to(hall_x, floor_y, z1);
        if (west && inside(door_z, from.z(), to.z())) {
            // Reflected with its front, the opening stays in the middle of the bay.
            const ArchShape door{.from = from,
                                 .to = to,
                                 .y0 = floor_y,
                                 .y1 = gallery_y,
                                 .half_width = 1.5,
                                 .sill = floor_y,
                                 .spring = 1.4,
                                 .rise = 1.2,
                                 .segments = 10};
            arch_wall(model, "stone_wall", door);
            arch_reveal(model, "stone_trim", door, 4.0, true);
            model.face("stone_floor",
                       {{14, floor_y, -10}, {18, floor_y, -10}, {18, floor_y, -13}, {14, floor_y, -13}});
            wall(model, "plaster", {hall_x, gallery_y, from.z()}, {hall_x, gallery_y, to.z()},
                 gallery_ceiling_y);
        } else {
            add_outer_bay(model, from, to);
        }
        if (k > 0) add_pilaster(model, z1);
    }
    model.mirror_x(false);
}

// The ends of aisle and gallery on one side.
void add_side_ends(Model& model, bool west) {
    model.mirror_x(west);
    for (const bool south : {false, true}) {
        const double z = south ? south_z : north_z;
        const double x0 = south ? hall_x : nave_x, x1 = south ? nave_x : hall_x;
        wall(model, "stone_wall", {x0, floor_y, z}, {x1, floor_y, z}, dado_y);
        wall(model, "plaster", {x0, dado_y, z}, {x1, dado_y, z}, aisle_ceiling_y);
        wall(model, "plaster", {x0, gallery_y, z}, {x1, gallery_y, z}, gallery_ceiling_y);
    }
    model.mirror_x(false);
}

void add_entrance(Model& model) {
    const ArchShape door{.from = {nave_x, floor_y, south_z},
                         .to = {-nave_x, floor_y, south_z},
                         .y0 = floor_y,
                         .y1 = gallery_y,
                         .half_width = 1.9,
                         .sill = floor_y,
                         .spring = 1.3,
                         .rise = 1.7,
                         .segments = 12};
    arch_wall(model, "stone_wall", door);
    arch_reveal(model, "stone_trim", door, 0.6, true);
    arch_panel(model, "door_wood", door, 0.6);
    model.face("stone_floor",
               {{-1.9, floor_y, 11.6}, {1.9, floor_y, 11.6}, {1.9, floor_y, 11}, {-1.9, floor_y, 11}});
    for (const double y : {-0.6, 0.7}) {
        for (const double side : {-1.0, 1.0}) {
            const double x0 = side < 0 ? -1.85 : 0.1;
            box(model, "bronze", {x0, y, 11.54}, {x0 + 1.75, y + 0.16, 11.6},
                side_north | side_top | side_bottom | side_east | side_west);
        }
    }
    wall(model, "stone_wall", {nave_x, gallery_y, south_z}, {-nave_x, gallery_y, south_z}, springing_y);
}

}  // namespace

void add_hall_floors(Model& model) {
    model.begin_group("hall_floor");
    grid_floor(model, {-14, -11.5, -9, -5, -2.5, 0, 2.5, 5, 9, 11.5, 14}, half_bays(), floor_y,
               hall_floor_material);
    add_conveyor(model);
    add_pit(model);
}

void add_hall_walls(Model& model) {
    model.begin_group("hall_walls");
    for (const bool west : {false, true}) {
        add_long_wall(model, west);
        add_side_ends(model, west);
    }
    add_entrance(model);
}

}  // namespace slipface::generate
