// What is wrong with a frame's geometry, found from what was drawn: no panel has to say anything for it.
#pragma once

#include <string>
#include <vector>

namespace slipface {

// Of the frame built last, in a window of that many pixels, a line per defect:
// - a widget leaves the window or is cut by the region around it, and no scroll bar leads to the rest;
// - two widgets of one region lie on each other;
// - the contents of a region are wider or higher than it, and it has no scroll bar;
// - a letter is cut at the left or right edge of what is drawn (an ellipsis is a cut that says so);
// - two texts lie on each other.
std::vector<std::string> layout_defects(float width, float height);

}  // namespace slipface
