// What `hard` is beside its geometry: surface types, paint, viewpoints, light.
#include "recipes.h"

namespace slipface::generate {
namespace {

const PaintedFace hard_types[] = {
    {{44, -1, -14}, "test_floor", "ice"},    {{46, -1, -14}, "test_floor", "ice"},
    {{48, -1, -14}, "test_floor", "ice"},    {{60, -1, -9}, "test_floor", "sticky"},
    {{0, -1.6, -18}, "flagstone", "bouncy"},
};

}  // namespace

void annotate_hard(Level& level) {
    add_common_rules(level);
    for (SurfaceType& surface : level.surfaces) {
        if (surface.name == "conveyor") surface.velocity = Vec3(3, 0, 0);
        if (surface.name == "bouncy") surface.restitution = 0.9;
    }
    paint_faces(level, hard_types);
    level.cameras = {
        {.name = "landing", .eye = {-1.6, 1.6, 5.2}, .target = {0.4, 1.6, -18}, .fov_y = 1.2},
        {.name = "heart", .eye = {8.5, 0.4, -9.5}, .target = {-0.5, 2.4, -18.5}, .fov_y = 1.2},
        {.name = "lookout", .eye = {11.5, 5.4, -3.0}, .target = {-6, -1.5, -20}, .fov_y = 1.2},
        {.name = "north-shore", .eye = {3.5, 1.4, -33.5}, .target = {-1, 1.2, -10}, .fov_y = 1.2},
        {.name = "pass", .eye = {22, 2.0, -12.4}, .target = {40, 0, -12.6}, .fov_y = 1.1},
        {.name = "proving", .eye = {39, 3.6, -6.2}, .target = {58, -1.5, -24}, .fov_y = 1.25},
        {.name = "crypt", .eye = {-35.4, 1.3, -23.6}, .target = {-41, 0.2, -28.6}, .fov_y = 1.2},
    };
    level.light = LevelLight{
        .texel_m = 0.5,
        .sun_direction = {0.25, 1.0, 0.10},
        .sun_color = {2.6, 2.3, 1.8},
        .sun_size = 0.03,
        .sky_zenith = {0, 0, 0},
        .sky_horizon = {0, 0, 0},
        .ambient = {0.90, 0.80, 1.05},
        .emitters = {{"sky", {5.0, 5.2, 5.6}, true},
                     {"crystal", {0.4, 2.0, 2.4}},
                     {"crystal_heart", {0.9, 4.6, 5.2}},
                     {"gem", {2.6, 0.5, 2.2}},
                     {"lamp", {80, 52, 24}},
                     {"hazard*", {3.4, 1.1, 0.25}}},
    };
}

}  // namespace slipface::generate
