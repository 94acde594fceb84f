// The level `easy`: a sunken temple with a frozen pool, and a test room behind its west aisle.
//
// The hall runs north (-Z) from the entrance at z = 11 to the apse at z = -29 in eight bays of 5 m. The nave
// is 13 m wide between two arcades, with aisles behind them, and galleries above the aisles. The floor lies
// at y = -1, so that a player of the usual size stands free at the origin.
#pragma once

#include "model.h"

namespace slipface::generate {

inline constexpr double floor_y = -1.0;
inline constexpr double gallery_y = 4.0;
inline constexpr double aisle_ceiling_y = 3.6;
inline constexpr double gallery_ceiling_y = 7.6;
inline constexpr double springing_y = 8.0;  // where the vault begins
inline constexpr double vault_rise = 5.0;
inline constexpr double nave_x = 6.5;         // half the nave's width
inline constexpr double arcade_back_x = 7.5;  // the arcade walls are 1 m thick
inline constexpr double hall_x = 14.0;
inline constexpr double south_z = 11.0;
inline constexpr double north_z = -29.0;
inline constexpr double bay = 5.0;
inline constexpr int bays = 8;

std::vector<ModelMaterial> easy_materials();

void add_hall_floors(Model& model);
void add_hall_walls(Model& model);
void add_arcades(Model& model);
void add_vault(Model& model);
void add_apse(Model& model);
void add_pool(Model& model);
void add_galleries(Model& model);
void add_ways_up(Model& model);  // stairs, ramp, ladder, moss wall
void add_garden(Model& model);
void add_test_room(Model& model);
void add_test_ramps_and_stairs(Model& model);
void add_test_obstacles(Model& model);

Model make_easy();

}  // namespace slipface::generate
