// GLFW's keys as shortcuts (by label) and as held movement keys (by position).
#pragma once

#include <string>

#include "panels/panels.h"

namespace slipface {

// The key's label on the user's keyboard with its modifiers; an empty key for keys that are no shortcut
// alone.
Shortcut shortcut_of(int key, int scancode, int mods);

// The name for hold_key() of the key at this position on the keyboard; empty: it has none.
std::string place_of(int key);

}  // namespace slipface
