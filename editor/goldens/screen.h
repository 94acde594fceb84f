// Images of a program's windows: their numbers hold the widgets' rectangles, which explain changed pixels.
//
//   "widgets": { "Toolbar/Paint": [x, y, width, height], ... }     pixels from the upper left corner
#pragma once

#include "goldens/golden.h"

namespace slipface {

// Names the widgets that look different, moved, appeared or disappeared; most pixels first. For
// Snapshot::explain.
std::vector<Finding> explain_widgets(const ExplainRequest& request);

}  // namespace slipface
