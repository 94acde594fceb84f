// GLFW's keys as shortcuts (by label) and as held movement keys (by position).
#pragma once

#include "panels/panels.h"

namespace slipface {

// The key's label on the user's keyboard with its modifiers; an empty key for those that are no shortcut by
// themselves.
Shortcut shortcut_of(int key, int scancode, int mods);

// The flag that the key at this place on the keyboard holds, or null.
bool* held_flag(HeldKeys& held, int key);

}  // namespace slipface
