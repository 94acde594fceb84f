// The lower part of the palette: the parameters of the type that is the brush, and adding and removing types.
#pragma once

#include "tools/editor.h"

namespace slipface {

void surface_editor(Editor& editor);

}  // namespace slipface
