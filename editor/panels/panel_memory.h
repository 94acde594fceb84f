// What panels remember beside the Editor. An off-screen host begins without it, so that its images do not
// depend on those that the process made before.
#pragma once

namespace slipface {

void forget_renaming();     // the row whose name is a text box
void forget_plots();        // which channels are drawn
void forget_input_lanes();  // what is dragged and chosen
void forget_input_text();   // what is typed

}  // namespace slipface
