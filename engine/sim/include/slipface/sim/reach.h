// How far and how high a player gets under given settings, measured by running step() on a flat floor and
// over its edge.
#pragma once

#include <vector>

#include "slipface/movement/step.h"

namespace slipface {

struct JumpArc {
    std::vector<Vec2> path;   // of the centre, from take-off to landing: metres ahead, metres up
    double distance_m = 0.0;  // ahead, until the feet are back at the height of take-off
    double height_m = 0.0;    // of the highest point above take-off
    double duration_s = 0.0;
};

struct Reach {
    JumpArc running;          // at full speed, the jump held
    JumpArc tapped;           // at full speed, the jump released at once
    JumpArc standing;         // from rest, the jump held, no stick
    double top_speed = 0.0;   // m/s on the floor
    double stopping_m = 0.0;  // metres from full speed to rest
    int coyote_ticks = 0;     // ticks after leaving an edge in which a jump still starts
    double coyote_m = 0.0;    // metres past the edge at the last of these ticks
};

// Whether a press of jump may do more in the air than be remembered: what looks for ways presses it there,
// too.
bool jumps_in_air(const MovementSettings& settings);

Reach measure_reach(const MovementSettings& settings, double dt);

}  // namespace slipface
