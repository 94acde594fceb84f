// What `easy` is beside its geometry: surface types, paint, viewpoints, light.
#include "recipes.h"

namespace slipface::generate {
namespace {

void set_surfaces(Level& level) {
    for (SurfaceType& surface : level.surfaces) {
        if (surface.name == "turntable") surface.spin_centre = Vec3(0, -1.8, -12.75);
        if (surface.name == "bouncy") surface.restitution = 0.9;
    }
    add_common_rules(level);
}

// What a rule by material cannot say: one iced ramp, one sticky ramp, a way of bouncy tiles, and a pedestal
// that throws.
const PaintedFace easy_types[] = {
    {{-45, 0, 4.3}, "ramp_stone", "ice"},         // 15 degrees
    {{-47, 0.5, -8.7}, "ramp_stone", "ice"},      // 40 degrees
    {{-48, 0.5, -19.1}, "ramp_steep", "sticky"},  // 60 degrees
    {{0, 0.6, -31}, "tile_teal", "bouncy"},       // the crystal's plinth
    {{-21, -1, -21}, "test_floor", "bouncy"},    {{-23, -1, -21}, "test_floor", "ice"},
    {{12.75, -1, -15.25}, "stone_floor", "ice"},  // beside the pit
    {{12.75, -1, -17.75}, "stone_floor", "ice"}, {{12.75, -1, -20.25}, "stone_floor", "ice"},
};

}  // namespace

void annotate_easy(Level& level) {
    set_surfaces(level);
    paint_faces(level, easy_types);
    level.cameras = {
        {.name = "overview", .eye = {-5.2, 6.4, 10.2}, .target = {1.6, 1.2, -14}, .fov_y = 1.15},
        {.name = "hall", .eye = {0, 0.7, 9.4}, .target = {0, 2.2, -29}},
        {.name = "pool", .eye = {4.6, 1.6, -3.4}, .target = {-2.4, -1.6, -14.5}},
        {.name = "gallery", .eye = {9.4, 5.6, 2.5}, .target = {2.0, 3.4, -20}},
        {.name = "garden", .eye = {8.2, 0.9, 5.2}, .target = {11.6, -0.2, 9.4}},
        {.name = "pit", .eye = {12.4, 0.9, -10.4}, .target = {10.2, -1.6, -19}},
        {.name = "test-room", .eye = {-19.4, 4.6, 8.2}, .target = {-39, -1.6, -15}, .fov_y = 1.2},
        {.name = "half-pipe", .eye = {-37.2, 0.6, -11.4}, .target = {-28, -3.2, -16.6}},
    };
    level.light = LevelLight{
        .texel_m = 0.4,
        .sun_direction = {-0.62, 0.55, 0.22},
        .sun_color = {1.7, 1.4, 1.0},
        .sun_size = 0.03,
        .sky_zenith = {0, 0, 0},
        .sky_horizon = {0, 0, 0},
        .ambient = {0.95, 0.90, 0.90},
        .emitters = {{"sky", {3.8, 4.2, 4.8}, true},
                     {"rose_glass", {2.2, 1.4, 1.0}},
                     {"crystal", {0.6, 2.2, 2.6}},
                     {"hazard*", {2.4, 0.8, 0.2}}},
    };
}

}  // namespace slipface::generate
