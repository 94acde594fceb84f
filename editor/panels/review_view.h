#pragma once

#include "panels/panels.h"

namespace slipface {

// Draws the images under review into the current region. False, with nothing drawn: the level is to be shown.
bool review_view(Editor& editor, FrameContext& frame);

}  // namespace slipface
