// Icons that Font Awesome 4.7 lacks.
#pragma once

#include "widgets/imgui_compat.h"

namespace slipface::ui {

// Adds them to each of `fonts`, `pixels` high. All fonts of the atlas have been added before.
void draw_own_icons(std::initializer_list<Font> fonts, float pixels);

}  // namespace slipface::ui
