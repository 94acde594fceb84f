// The level `playground`: an obstacle course with one station for each thing that a mover must master, on a
// terrace in the evening sky. Editor, tests and benchmarks walk through the same stations.
//
// The terrace's floor lies at y = -1, from x = -40 to 40 and z = -60 to 12; the course runs north from the
// origin.
#pragma once

#include "model.h"

namespace slipface::generate {

inline constexpr double playground_floor = -1.0;

void add_playground_terrace(Model& model);
void add_playground_slopes(Model& model);    // ramps of 0 to 170 degrees, ramps that meet a steep slope
void add_playground_steps(Model& model);     // stairs, no stairs, bumps
void add_playground_walls(Model& model);     // pillars, zig-zag, open box
void add_playground_pipe(Model& model);      // half-pipe of 512 segments
void add_playground_surfaces(Model& model);  // one pad a surface type, ladder, sticky wall
void add_playground_movers(Model& model);    // platforms of every kind
void add_playground_hills(Model& model);     // a mesh of noise

Model make_playground();

}  // namespace slipface::generate
