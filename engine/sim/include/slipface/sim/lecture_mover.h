// The lecture's mover as it is before its hacks, and the same with each mistake that its slides warn of. The
// demos of the lecture's first half are played with these: Slipface's own step() cannot be led into most of
// these mistakes. A tape names its mover (tape.h).
#pragma once

#include <span>
#include <string_view>

#include "slipface/movement/step.h"

namespace slipface {

using StepFunction = StepResult (*)(const MovementScene&, const MovementSettings&, const PlayerState&,
                                    const PlayerInput&, double, TraceSink*, StepContacts*);

struct NamedMover {
    const char* name;   // "lecture-no-epsilon", as in tapes
    const char* about;  // what it does otherwise than the lecture
    StepFunction step;
};

// Of the settings they read radii, gravity, walk_speed, skin (the lecture's epsilon), max_slides, max_slope
// and bounce, of the scene the static triangles. Positions are rounded to floats, as in the lecture.
// Source: Brown University CS1950u, lecture 7, "Bouncing" to "Analytic Player Offset".
std::span<const NamedMover> lecture_movers();
// Null if there is none.
const NamedMover* find_mover(std::string_view name);

}  // namespace slipface
