// The surface types of the open level, as the overlay draws them.
#pragma once

#include <imgui.h>

#include "document/selection.h"
#include "panels/viewport_panel.h"
#include "slipface/movement/surface_type.h"

namespace slipface {

// A type's colour with its hatch, as the overlay shows it on faces.
void draw_swatch(ImDrawList& list, ImVec2 min, ImVec2 max, const SurfaceType& type, float rounding);

// In the lower left corner of the view: swatch, name, number of faces and area of each used type, or of each
// slope class while slopes are shown. A click selects the row's faces.
struct LegendLayout {
    struct Row {
        std::string name, area;
        std::size_t faces = 0;
        std::optional<SurfaceId> surface;  // nothing: a slope class
    };
    std::vector<Row> rows;  // empty: nothing is shown
    ImVec2 min{0, 0}, max{0, 0};
    float name_width = 0, count_width = 0, area_width = 0;
    mutable std::optional<std::size_t> lit;  // the row under the mouse
};
LegendLayout legend_layout(const Editor& editor, ImVec2 view_min, ImVec2 view_max);
void legend_buttons(Editor& editor, const LegendLayout& layout);     // before the view's item
void draw_legend(const Editor& editor, const LegendLayout& layout);  // over the picture

}  // namespace slipface
