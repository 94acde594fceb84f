// Pictures of a program's windows: what their numbers hold, and what changed pixels belong to.
//
//   "widgets": { "Toolbar/Paint": [x, y, width, height], ... }     pixels from the upper left corner
#pragma once

#include "slipface/snapshot/golden.h"

namespace slipface {

// Names the widgets that look different, moved, came or went; most pixels first. For Snapshot::explain.
std::vector<Finding> explain_widgets(const ExplainRequest& request);

}  // namespace slipface
