// The steps by which a stop is explained: traces, trying, words.
#pragma once

#include <span>

#include "what_holds.h"

namespace slipface {

// What each face took in the first ticks of a stop, and the tick in which it took most.
struct Blame {
    FaceId face = no_id;
    double lost_m = 0.0;
    std::size_t worst = 0;
    Loss loss = {};
};

// Fills in the cause: of what `found` says is enough to free the player.
void name_cause(Stop& stop, WhatHolds& holds, std::span<const Holding> found, std::span<const Blame> by_trace,
                const MovementSettings& settings, const Mesh& mesh);
// What would have carried the player above the height `lowest`, if that is found, and what left it no room.
bool name_fall(Stop& stop, WhatHolds& holds, double lowest);
void name_press(Stop& stop, WhatHolds& holds);

void write_headline(Stop& stop, const MovementSettings& settings, const StoryNames& names);

}  // namespace slipface
