// What a hack's switch has to say for itself, beside it in the movement panel.
#pragma once

#include "panels/panels.h"

namespace slipface {

// "214 of 600" and a button that opens the card: what the hack does, where it acted, its two pictures, its
// demo.
void hack_cell(Editor& editor, FrameContext& frame, const SettingInfo& info);

}  // namespace slipface
