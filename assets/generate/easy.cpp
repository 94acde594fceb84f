#include "easy.h"

namespace slipface::generate {

std::vector<ModelMaterial> easy_materials() {
    return {
        {"stone_floor", "stone_floor", 2.5},
        {"mosaic_floor", "mosaic_floor", 2.5},
        {"stone_wall", "stone_wall", 2.0},
        {"plaster", "plaster", 4.0},
        {"stone_trim", "stone_trim", 2.0},
        {"column_stone", "column_stone", 1.0},
        {"coffer_panel", "coffer_panel", 1.0},
        {"apse_mosaic", "apse_mosaic", 2.0},
        {"tile_teal", "tile_teal", 1.0},
        {"sky", "sky", 8.0},
        {"rose_glass", "rose_glass", 1.0},
        {"wood_planks", "wood_planks", 2.0},
        {"wood_floor", "wood_floor", 2.5},
        {"door_wood", "door_wood", 1.9},
        {"bronze", "bronze", 1.0},
        {"banner_cloth", "banner_cloth", 1.0},
        {"terracotta", "terracotta", 1.0},
        {"moss_bed", "moss", 1.6},
        {"rock", "rock", 1.5},
        {"foliage", "foliage", 1.0},
        {"mushroom_stem", "mushroom_stem", 0.8},
        {"crystal", "crystal", 1.2},
        {"ice_floor", "ice", 3.0},
        {"ice_pipe", "ice", 3.0},
        {"ladder_wood", "ladder_wood", 1.0},
        {"sticky_moss", "sticky_moss", 1.6},
        {"bouncy_mushroom", "bouncy_mushroom", 1.0},
        {"bouncy_pad", "bouncy_pad", 1.0},
        {"conveyor_belt", "conveyor_belt", 2.5},
        {"turntable_stone", "turntable_stone", 1.0},
        {"hazard_embers", "hazard_embers", 2.5},
        {"test_floor", "test_floor", 2.0},
        {"seam_floor", "seam_floor", 2.5},
        {"ramp_stone", "ramp_stone", 2.0},
        {"ramp_steep", "ramp_steep", 2.0},
        {"step_stone", "step_stone", 2.0},
        {"sign_labels", "sign_labels", 1.0},
    };
}

Model make_easy() {
    Model model(easy_materials());
    add_hall_floors(model);
    add_hall_walls(model);
    add_arcades(model);
    add_vault(model);
    add_apse(model);
    add_pool(model);
    add_galleries(model);
    add_ways_up(model);
    add_garden(model);
    add_test_room(model);
    add_test_ramps_and_stairs(model);
    add_test_obstacles(model);
    model.join_edges();
    return model;
}

}  // namespace slipface::generate
