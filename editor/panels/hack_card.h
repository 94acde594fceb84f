// A hack's counter and its card, next to its switch in the movement panel.
#pragma once

#include "panels/panels.h"

namespace slipface {

// "214 of 600" and a button that opens the card: what the hack does, its formula with the numbers of a tick,
// its two images, its demo, where it acted, and the card after it.
void hack_cell(Editor& editor, FrameContext& frame, const SettingInfo& info);

}  // namespace slipface
