// Adding and changing surface types from the palette.
#pragma once

#include <array>
#include <span>

#include "tools/editor.h"

namespace slipface {

// Colours that colour-blind users can distinguish: Okabe and Ito (2008), then lighter and darker ones of the
// same hues.
std::span<const std::array<float, 3>> safe_surface_colors();

// Adds a type with a free name, the next free hotkey and a colour unlike the others, and makes it the brush.
// Nothing if the table is full.
std::optional<SurfaceId> add_surface_type(Editor& editor);
// Removes the brush's type if nothing uses it; the brush becomes `default`.
void remove_brush_type(Editor& editor);
// Replaces everything of a type except its name. If another type has the new hotkey, it loses it.
void change_surface_type(Document& document, SurfaceId surface, SurfaceType changed, std::string step_name);

}  // namespace slipface
