#include <algorithm>

#include "easy.h"
#include "shapes.h"

namespace slipface::generate {
namespace {

constexpr double half_opening = 1.9;  // half the width of an arch
const std::vector<Vec2> column_profile{{0.54, -0.75}, {0.54, -0.6}, {0.42, -0.48},
                                       {0.36, 1.25},  {0.43, 1.35}, {0.58, 1.75}};

void add_column(Model& model, double z) {
    box(model, "stone_trim", {6.4, floor_y, z - 0.6}, {7.6, -0.75, z + 0.6}, side_standing);
    lathe(model, "column_stone", {7, 0, z}, column_profile, 10, 18);
    box(model, "stone_trim", {6.38, 1.75, z - 0.62}, {7.62, 2.0, z + 0.62});
}

void add_arch_bay(Model& model, double z0, double z1) {
    const Vec3 north_nave(nave_x, 0, z0), south_nave(nave_x, 0, z1);
    const Vec3 north_back(arcade_back_x, 0, z0), south_back(arcade_back_x, 0, z1);
    const double thickness = arcade_back_x - nave_x;

    ArchShape lower{.from = north_nave,
                    .to = south_nave,
                    .y0 = 2.0,
                    .y1 = gallery_y,
                    .half_width = half_opening,
                    .sill = 2.0,
                    .spring = 2.0,
                    .rise = 1.4,
                    .segments = 10};
    arch_wall(model, "stone_wall", lower);
    arch_reveal(model, "stone_trim", lower, thickness, false);
    lower.from = south_back;
    lower.to = north_back;
    lower.y1 = aisle_ceiling_y;
    arch_wall(model, "stone_wall", lower);

    ArchShape upper{.from = north_nave,
                    .to = south_nave,
                    .y0 = gallery_y,
                    .y1 = springing_y,
                    .half_width = half_opening,
                    .sill = gallery_y,
                    .spring = 6.0,
                    .rise = 1.1,
                    .segments = 8};
    arch_wall(model, "stone_wall", upper);
    arch_reveal(model, "stone_trim", upper, thickness, true);
    upper.from = south_back;
    upper.to = north_back;
    upper.y1 = gallery_ceiling_y;
    arch_wall(model, "plaster", upper);
}

// What is the same on every pier between two bays: string course stops, impost blocks and a banner.
void add_pier_details(Model& model, double z) {
    box(model, "stone_trim", {6.4, 5.8, z - 0.68}, {7.6, 6.0, z + 0.68});
    model.face_uv("banner_cloth", {{{6.44, 4.55, z - 0.42}, {0, 0}},
                                   {{6.44, 4.55, z + 0.42}, {1, 0}},
                                   {{6.44, 5.75, z + 0.42}, {1, 1}},
                                   {{6.44, 5.75, z - 0.42}, {0, 1}}});
    box(model, "bronze", {6.4, 5.72, z - 0.5}, {6.48, 5.8, z + 0.5},
        side_west | side_bottom | side_north | side_south);
}

void add_end_pilaster(Model& model, double z0, double z1) {
    const bool south = z1 >= south_z;
    const unsigned sides = side_west | side_east | (south ? side_north : side_south);
    box(model, "stone_trim", {nave_x, floor_y, z0}, {arcade_back_x, 2.0, z1}, sides);
    // Capital and base stand out on all free sides.
    const double north = south ? z0 - 0.02 : z0, end = south ? z1 : z1 + 0.02;
    box(model, "stone_trim", {6.38, 1.75, north}, {7.62, 2.0, end}, sides | side_bottom | side_top);
    box(model, "stone_trim", {6.38, floor_y, north}, {7.62, -0.75, end}, sides | side_top);
}

}  // namespace

void add_arcades(Model& model) {
    for (const bool west : {false, true}) {
        model.begin_group(west ? "arcade_west" : "arcade_east");
        model.mirror_x(west);
        for (int k = 0; k < bays; ++k) {
            const double z1 = south_z - bay * k;
            add_arch_bay(model, z1 - bay, z1);
            if (k == 0) continue;
            add_column(model, z1);
            add_pier_details(model, z1);
        }
        add_end_pilaster(model, south_z - 0.62, south_z);
        add_end_pilaster(model, north_z, north_z + 0.62);
        // String course below the gallery and cornice below the vault.
        const unsigned strip = side_west | side_top | side_bottom;
        for (int k = 0; k < bays; ++k) {
            const double z0 = north_z + bay * k;
            box(model, "stone_trim", {6.38, 3.78, z0}, {nave_x, gallery_y, std::min(z0 + bay, 8.5)}, strip);
        }
        box(model, "tile_teal", {6.46, 7.3, north_z}, {nave_x, 7.7, south_z}, strip);
        box(model, "stone_trim", {6.2, 7.8, north_z}, {nave_x, springing_y, south_z}, strip);
        model.mirror_x(false);
    }
}

}  // namespace slipface::generate
