#include <algorithm>
#include <cmath>
#include <string>

#include "easy.h"
#include "labels.h"
#include "shapes.h"
#include "test_room.h"

namespace slipface::generate {
namespace {

constexpr double steepest_walkable_deg = 50.0;

std::string degrees_text(double degrees) {
    return std::to_string(static_cast<int>(degrees)) + "*";
}

// Fifteen ramps side by side along the west wall, rising towards it. None is exactly as steep as can be
// walked up, for then rounding would decide.
void add_ramps(Model& model) {
    const double width = 1.6, pitch = 2.6, landing = 1.2;
    for (int i = 0; i < 15; ++i) {
        const double even = 5.0 * (i + 1);
        const double degrees = even == steepest_walkable_deg ? even - 1.0 : even;
        const double run = std::min(8.0, 3.0 / tan_deg(degrees));
        const double z = room.south - 0.7 - pitch * i;
        ramp(model, degrees > steepest_walkable_deg ? "ramp_steep" : "ramp_stone", "stone_trim",
             {.left = {room.west + landing + run, floor_y, z},
              .ahead = -Vec3::UnitX(),
              .width = width,
              .run = run,
              .height = run * tan_deg(degrees),
              .landing = landing,
              .back = false});
        add_label(model, degrees_text(degrees), {room.west + 0.02, 3.6, z - 0.1},
                  {room.west + 0.02, 3.6, z - width + 0.1});
    }
}

// Six flights along the south wall, rising towards it.
void add_flights(Model& model) {
    const std::array<int, 6> counts{24, 12, 8, 6, 5, 4};
    const std::array<double, 6> treads{0.3, 0.32, 0.35, 0.4, 0.5, 0.6};
    const double width = 2.2, pitch = 3.2, landing = 1.5;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const double x = room.east - 1.5 - pitch * static_cast<double>(i);
        const double rise = 0.1 * static_cast<double>(i + 1);
        const double foot = room.south - landing - treads[i] * counts[i];
        stairs(model, "step_stone", "stone_trim",
               {.left = {x, floor_y, foot},
                .ahead = Vec3::UnitZ(),
                .width = width,
                .count = counts[i],
                .rise = rise,
                .tread = treads[i],
                .landing = landing,
                .back = false});
        add_label(model, "0." + std::to_string(i + 1), {x - 0.3, 3.0, room.south - 0.02},
                  {x - 1.9, 3.0, room.south - 0.02});
    }
}

// Blocks against the north wall, each with an acute corner cut into it: walls that close in from both sides.
void add_wedges(Model& model) {
    const double depth = 2.2, back = 0.5, gap = 1.2;
    double x = -39.5;
    for (const double degrees : {15.0, 30.0, 45.0, 60.0, 85.0}) {
        const double half = std::round(depth * tan_deg(0.5 * degrees) * 1000.0) / 1000.0;
        const double width = 2 * half + 1.0, middle = x + 0.5 * width;
        const double front = room.north + depth + back;
        prism(model, "stone_trim",
              {{x + width, front},
               {x + width, room.north},
               {x, room.north},
               {x, front},
               {middle - half, front},
               {middle, room.north + back},
               {middle + half, front}},
              floor_y, 1.2, "stone_floor");
        add_label(model, degrees_text(degrees), {middle - 0.7, 2.2, room.north + 0.02},
                  {middle + 0.7, 2.2, room.north + 0.02});
        x += width + gap;
    }
}

// Leaning slabs along the east wall: floor and underside close in from below and above.
void add_overhangs(Model& model) {
    const double width = 2.5, height = 2.2, wall_x = room.east;
    double south = -23.0;
    for (const double degrees : {30.0, 45.0, 60.0}) {
        const double reach = std::round(height / tan_deg(degrees) * 1000.0) / 1000.0;
        const double z0 = south - width, z1 = south, y0 = floor_y, y1 = floor_y + height, x = wall_x - reach;
        model.face("stone_trim", {{wall_x, y0, z1}, {x, y1, z1}, {x, y1, z0}, {wall_x, y0, z0}});
        model.face("stone_floor", {{x, y1, z1}, {wall_x, y1, z1}, {wall_x, y1, z0}, {x, y1, z0}});
        model.face("stone_trim", {{wall_x, y0, z1}, {wall_x, y1, z1}, {x, y1, z1}});
        model.face("stone_trim", {{wall_x, y0, z0}, {x, y1, z0}, {wall_x, y1, z0}});
        add_label(model, degrees_text(degrees), {wall_x - 0.02, 2.2, z0 + 0.5},
                  {wall_x - 0.02, 2.2, z1 - 0.5});
        south += 3.5;
    }
}

// Blocks to slide along and to step onto, between stairs and seams.
void add_blocks(Model& model) {
    for (int i = 0; i < 5; ++i) {
        const double x = -22.5, z = -7.5 + 1.8 * i, height = 0.25 * (i + 1);
        box(model, "wood_planks", {x, floor_y, z}, {x + 1.2, floor_y + height, z + 1.2}, side_standing);
    }
    for (int i = 0; i < 4; ++i) {
        lathe(model, "column_stone", {-38.5, floor_y, -8.0 + 2.6 * i}, {{0.35, 0}, {0.35, 2.4}, {0.25, 2.5}},
              8, 0, "stone_trim");
    }
}

}  // namespace

void add_test_ramps_and_stairs(Model& model) {
    model.begin_group("test_ramps");
    add_ramps(model);
    model.begin_group("test_stairs");
    add_flights(model);
}

void add_test_obstacles(Model& model) {
    model.begin_group("test_wedges");
    add_wedges(model);
    add_overhangs(model);
    model.begin_group("test_blocks");
    add_blocks(model);
}

}  // namespace slipface::generate
