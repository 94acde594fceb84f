// What `playground` is beside its geometry: surface types, platforms, viewpoints, light.
#include "playground.h"
#include "recipes.h"

namespace slipface::generate {
namespace {

const PaintedFace playground_types[] = {
    {{-35.3, 0, -0.8}, "ramp_stone", "ice"},
    {{11, -1, -14}, "test_floor", "sticky"},
    {{14, -1, -14}, "test_floor", "sticky"},
};

}  // namespace

void annotate_playground(Level& level) {
    add_common_rules(level);
    for (SurfaceType& surface : level.surfaces) {
        if (surface.name == "turntable") surface.spin_centre = Vec3(33, -0.84, -18);
        if (surface.name == "conveyor") surface.velocity = Vec3(0, 0, -3);
        if (surface.name == "bouncy") surface.restitution = 0.9;
    }
    paint_faces(level, playground_types);
    level.platforms = {
        {.name = "rotating plate",
         .group = "plate",
         .path = {},
         .spin_pivot = Vec3(-7, -0.75, -31),
         .spin_rate = 0.8},
        {.name = "rotating wall",
         .group = "wall",
         .path = {},
         .spin_pivot = Vec3(-10, 0, -42),
         .spin_rate = 0.5},
        {.name = "rotating and moving",
         .group = "swing",
         .path = {{Vec3(0, 0, 0), 2.0, 0.5}, {Vec3(0, 1.5, 0), 2.0, 0.5}},
         .spin_pivot = Vec3(-12, -0.75, -49.5),
         .spin_rate = 0.7},
        {.name = "smooth lift",
         .group = "lift_smooth",
         .path = {{Vec3(0, 0, 0), 1.5, 2.0}, {Vec3(0, 4.1, 0), 1.5, 2.0}}},
        {.name = "reversing lift",
         .group = "lift_hard",
         .path = {{Vec3(0, 0, 0), 5.0, 0.0}, {Vec3(0, 4.1, 0), 5.0, 0.0}}},
        {.name = "ferry",
         .group = "ferry",
         .path = {{Vec3(0, 0, 0), 3.0, 1.5}, {Vec3(0, 0, -11.6), 3.0, 1.5}}},
    };
    level.cameras = {
        {.name = "start", .eye = {-2.2, 1.7, 8.5}, .target = {0.8, 0.6, -30}, .fov_y = 1.15},
        {.name = "bird", .eye = {-38, 24, 24}, .target = {4, -4, -26}, .fov_y = 1.0},
        {.name = "slopes", .eye = {-31, 2.4, 7.0}, .target = {-20, 0.2, -2}, .fov_y = 1.1},
        {.name = "steps", .eye = {-13.5, 2.6, -3.6}, .target = {-27, -0.6, -11}, .fov_y = 1.15},
        {.name = "movers", .eye = {15.5, 3.4, -30.5}, .target = {6, -1, -44}, .fov_y = 1.15},
        {.name = "surfaces", .eye = {5.5, 2.8, -3.0}, .target = {24, -1, -15}, .fov_y = 1.15},
        {.name = "half-pipe", .eye = {20.5, 1.6, -27}, .target = {28, -4.5, -41}, .fov_y = 1.15},
        {.name = "zigzag", .eye = {-10, 4.2, -21}, .target = {-27, -0.5, -28}, .fov_y = 1.1},
    };
    level.light = LevelLight{
        .texel_m = 0.5,
        .sun_direction = {-0.70, 0.42, 0.35},
        .sun_color = {1.70, 1.12, 0.66},
        .sun_size = 0.03,
        .sky_zenith = {0.20, 0.24, 0.52},
        .sky_horizon = {0.92, 0.62, 0.44},
        .ambient = {0.14, 0.13, 0.15},
        .haze_m = 600,
        .emitters = {{"lamp", {30, 19, 8}}, {"hazard*", {2.4, 0.8, 0.2}}},
    };
}

}  // namespace slipface::generate
