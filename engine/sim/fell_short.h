// The ground that a jump did not reach.
#pragma once

#include <optional>

#include "slipface/sim/run.h"

namespace slipface {

struct FellShort {
    FaceId face = no_id;   // ahead, at the height from which the player came, or higher
    double short_m = 0.0;  // from the player's middle, when its feet came below that height, to the ground
    double low_m = 0.0;    // from the highest point of the feet up to the ground; 0 or less: high enough
};

// Of a player who jumped from the ground before tick `left` and came below its height until tick `end`.
std::optional<FellShort> fell_short(const TickScene& scene, const TapeRun& run, std::size_t left,
                                    std::size_t end);

}  // namespace slipface
