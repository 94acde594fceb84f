// The level `hard`: mines in a cave of crystal, all points and wedges, closed all round.
//
// Floor and roof of the cave are two sheets that meet at its rim, so the world is closed by construction. The
// great hall lies round a lake of embers with the heart, a tall crystal, in it; a pass in the east leads to
// the proving ground (the test area), one in the west to a crypt.
#pragma once

#include "model.h"

namespace slipface::generate {

Model make_hard();

// Heights of the cave's two sheets at (x, z); both are equal at the rim.
double hard_floor(double x, double z);

void add_hard_cave(Model& model);
void add_hard_crystals(Model& model);
void add_hard_ways(Model& model);     // bridges, ladders, the belt
void add_hard_proving(Model& model);  // the test area

}  // namespace slipface::generate
