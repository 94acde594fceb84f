// The level `island`: an open world of beach, cliffs and ruins under a morning sun.
//
// The plaza in the middle (floor y = -1) holds the origin. South of it lies the beach, whose ground is the
// level's heightfield; north the mountain with its ice slide; east, over an inlet, the cape with the
// lighthouse; west the half-pipe; north-east the temple with a room beneath it. The sea is at y = -3.
#pragma once

#include "model.h"

namespace slipface::generate {

inline constexpr double sea_y = -3.0;

// The beach: the heightfield's rectangle and its grid.
struct Beach {
    double x0 = -30, x1 = 30, z0 = 15, z1 = 55;
    int columns = 49, rows = 33;  // samples, 1.25 m apart
};
inline constexpr Beach beach;

// Height of the ground, everywhere.
double island_height(double x, double z);

// Height of a sample of the beach; at the rectangle's border it follows the coarser grid of the ground beside
// it.
double beach_height(int column, int row);

void add_island_ground(Model& model);
void add_island_plaza(Model& model);
void add_island_lighthouse(Model& model);
void add_island_temple(Model& model);
void add_island_slide(Model& model);
void add_island_half_pipe(Model& model);
void add_island_plants(Model& model);
void add_island_platforms(Model& model);

Model make_island();

}  // namespace slipface::generate
