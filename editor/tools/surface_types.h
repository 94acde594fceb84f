// Adding and changing surface types, as the palette does it.
#pragma once

#include <array>
#include <span>

#include "tools/editor.h"

namespace slipface {

// Colours that colour-blind users tell apart: Okabe and Ito (2008), then lighter and darker ones of the same
// hues.
std::span<const std::array<float, 3>> safe_surface_colors();

// A new type with a free name, the next free hotkey and a colour unlike the others; it becomes the brush.
// Nothing when the table is full.
std::optional<SurfaceId> add_surface_type(Editor& editor);
// Takes the brush's type out of the table if nothing uses it; the brush becomes `default`.
void remove_brush_type(Editor& editor);
// Replaces a type but for its name. A hotkey that another type has is taken from it.
void change_surface_type(Document& document, SurfaceId surface, SurfaceType changed, std::string step_name);

}  // namespace slipface
