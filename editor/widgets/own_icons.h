// Icons that Font Awesome 4.7 lacks.
#pragma once

#include <imgui.h>

#include <initializer_list>

namespace slipface::ui {

// Adds them to each of `fonts`, `pixels` high, and builds the atlas.
void draw_own_icons(ImFontAtlas& atlas, std::initializer_list<ImFont*> fonts, float pixels);

}  // namespace slipface::ui
