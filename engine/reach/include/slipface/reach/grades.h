// Ledges and gaps of a level against what the player can step, climb and jump under its settings.
#pragma once

#include <string>
#include <vector>

#include "slipface/reach/links.h"

namespace slipface {

// Measured by running step() in bare scenes, metres: the highest step that is walked up, the highest ledge
// and the widest gap that a straight run with one jump masters.
struct JumpLimits {
    double step_m = 0.0, ledge_m = 0.0, gap_m = 0.0;
};
JumpLimits measure_limits(const MovementSettings& settings, double dt);

// A region that is easiest to come to by a ledge or a gap within a tenth of the limit.
struct GradeNote {
    FaceId face = no_id;           // whose rim it is
    Vec3 position = Vec3::Zero();  // of the rim
    bool reached = false;          // within the limit
    std::string text;              // "0.03 m too high for the jump of 1.20 m"
};

struct Grades {
    JumpLimits limits;
    // Regions by how they are come to most easily from another: dropped onto; by a jump; by one that fails
    // by less than a tenth.
    std::size_t dropped = 0, jumped = 0, missed = 0;
    std::vector<GradeNote> notes;  // by region
};
// Only by the sizes of ledges and gaps: ceilings, bounces, ladders and platforms are for the search.
Grades grade(const Level& level);

}  // namespace slipface
