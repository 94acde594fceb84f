// Images of a program's windows: their numbers hold the widgets' rectangles, which explain changed pixels.
//
//   "widgets": { "Toolbar/Paint": [x, y, width, height], ... }     pixels from the upper left corner
#pragma once

#include "goldens/explain.h"

namespace slipface {

// Names the widgets that look different, moved, appeared or disappeared; most pixels first. The images have
// one size.
std::vector<Finding> explain_widgets(const Difference& difference);

}  // namespace slipface
