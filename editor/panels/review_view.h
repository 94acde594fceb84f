#pragma once

#include "panels/panels.h"

namespace slipface {

// The pictures under review, in the current region. False, and nothing drawn: the level is to be shown.
bool review_view(Editor& editor, FrameContext& frame);

}  // namespace slipface
