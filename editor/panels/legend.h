// The surface types of the open level, as the overlay draws them.
#pragma once

#include <imgui.h>

#include "panels/viewport_panel.h"
#include "slipface/movement/surface_type.h"

namespace slipface {

// A type's colour with its hatch, as the overlay shows it on faces.
void draw_swatch(ImDrawList& list, ImVec2 min, ImVec2 max, const SurfaceType& type, float rounding);

// In the lower left corner of the view: swatch, name and number of faces of each type that is used.
void legend(const Editor& editor, ViewportState& state);

}  // namespace slipface
