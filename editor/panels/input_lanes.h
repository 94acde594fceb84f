// The inputs of the lab's tape as lanes of the timeline, changed by the mouse: one for the stick, one for
// each button that the tape holds.
#pragma once

#include "panels/lab_track.h"

namespace slipface {

// Pixels, with the spaces between the lanes.
float input_lanes_height(const Lab& lab);
// Draws them from `y` on, under the ticks of `track`, with their names from `left` to the track. A press is
// moved by its middle and lengthened by its ends; dragging where there is none makes one; the right button
// deletes it. A click on the stick's lane chooses ticks, and a round pad bends the stick there.
void input_lanes(Editor& editor, const LabTrack& track, float left, float y);

}  // namespace slipface
