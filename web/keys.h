// Keys as browsers name them.
#pragma once

#include <string>

#include "tools/commands/shortcut.h"
#include "tools/playtest/play_frame.h"

namespace slipface {

// The names of shortcuts. `code` is the key's place on a US keyboard ("KeyW", "Digit1"), `key` what it types
// ("w", "F5").
std::string key_label(const std::string& code, const std::string& key);
// The name for hold_key() of the key at that place; empty: it has none.
std::string place_of(const std::string& code);
// Whether a browser should not see the key: all but those for its own clipboard and developer tools.
bool taken_from_browser(const Shortcut& shortcut);

}  // namespace slipface
