// What `island` is beside its geometry: surface types, platforms, the beach's heights, viewpoints, light.
#include <algorithm>
#include <cmath>

#include "island.h"
#include "recipes.h"
#include "slipface/image/grey_image.h"

namespace slipface::generate {
namespace {

constexpr double lowest = -12.0, highest = 4.0;  // of the beach's image

const PaintedFace island_types[] = {
    {{-9.0, -1, -6}, "flagstone", "sticky"},
};

}  // namespace

Status write_island_heights(const std::filesystem::path& folder) {
    GreyImage image{.width = beach.columns, .height = beach.rows, .values = {}};
    for (int row = 0; row < beach.rows; ++row) {
        for (int column = 0; column < beach.columns; ++column) {
            const double fraction = (beach_height(column, row) - lowest) / (highest - lowest);
            image.values.push_back(
                static_cast<std::uint16_t>(std::clamp(fraction, 0.0, 1.0) * 65535.0 + 0.5));
        }
    }
    return save_grey_png(folder / "island.heights.png", image);
}

void annotate_island(Level& level) {
    add_common_rules(level);
    level.surfaces.push_back(
        {.name = "ghost", .color = {0.35f, 0.65f, 0.80f}, .hatch = Hatch::dots, .solid = false});
    level.rules.push_back({"sea_water*", "ghost"});
    level.rules.push_back({"beach_sand*", "ghost"});
    for (SurfaceType& surface : level.surfaces) {
        if (surface.name == "turntable") surface.spin_centre = Vec3(0, -0.84, -6.6);
        if (surface.name == "conveyor") surface.velocity = Vec3(4, 0, 0);
        if (surface.name == "bouncy") surface.restitution = 0.9;
    }
    paint_faces(level, island_types);
    level.heightfield = HeightfieldSource{.file = "island.heights.png",
                                          .origin = {beach.x0, 0, beach.z0},
                                          .size = {beach.x1 - beach.x0, beach.z1 - beach.z0},
                                          .low = lowest,
                                          .high = highest};
    level.platforms = {
        {.name = "raft over the inlet",
         .group = "raft",
         .path = {{Vec3(0, 0, 0), 3.0, 1.5}, {Vec3(9.9, 0, 0), 3.0, 1.5}}},
        {.name = "lift at the tower",
         .group = "lift",
         .path = {{Vec3(0, 0, 0), 2.0, 2.0}, {Vec3(0, 5.64, 0), 2.0, 2.0}, {Vec3(2.2, 5.64, 0), 2.0, 1.5}}},
        {.name = "carousel",
         .group = "carousel",
         .path = {},
         .spin_pivot = Vec3(31.5, 1.5, 14),
         .spin_rate = 0.6},
    };
    level.cameras = {
        {.name = "arrival", .eye = {1.5, 1.4, 9.5}, .target = {-2.5, 3.0, -24}, .fov_y = 1.1},
        {.name = "beach", .eye = {-17, 1.2, 34}, .target = {8, 0.5, -8}, .fov_y = 1.0},
        {.name = "lighthouse", .eye = {20, 1.8, 8}, .target = {41, 6.0, -6.5}, .fov_y = 1.15},
        {.name = "summit", .eye = {-4.6, 23.5, -38.5}, .target = {3, 0, 4}, .fov_y = 1.15},
        {.name = "temple", .eye = {16.5, 3.2, -15.5}, .target = {23.5, 9.5, -36}, .fov_y = 1.15},
        {.name = "hidden-room", .eye = {18.4, 3.6, -39.2}, .target = {23.6, 2.0, -32}, .fov_y = 1.25},
        {.name = "half-pipe", .eye = {-33.0, 3.9, 14.5}, .target = {-34.2, 0.2, -3}, .fov_y = 1.1},
        {.name = "from-the-sea", .eye = {34, 9, 62}, .target = {-1, 2, -8}, .fov_y = 0.9},
    };
    level.light = LevelLight{
        .texel_m = 0.8,
        .sun_direction = {0.62, 0.60, 0.55},
        .sun_color = {1.45, 1.22, 0.90},
        .sun_size = 0.02,
        .sky_zenith = {0.12, 0.30, 0.62},
        .sky_horizon = {0.66, 0.78, 0.86},
        .ambient = {0.16, 0.17, 0.18},
        .haze_m = 420,
        .emitters = {{"lamp", {9, 6, 2.6}}, {"crystal", {0.6, 2.2, 2.6}}, {"gem", {2.6, 0.5, 2.2}}},
    };
}

}  // namespace slipface::generate
