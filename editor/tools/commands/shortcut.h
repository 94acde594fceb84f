// A key with its modifiers.
#pragma once

#include <string>
#include <string_view>

namespace slipface {

// Keys are identified by label: the key with that letter on the user's keyboard.
struct Shortcut {
    std::string key;  // "S", "1", "F5", "Delete", "Escape"; empty: none
    bool ctrl = false, shift = false, alt = false;
    std::string text() const;  // "Ctrl+Shift+S"
    friend bool operator==(const Shortcut&, const Shortcut&) = default;
};
Shortcut parse_shortcut(std::string_view text);  // reads what text() writes; an empty key if there is none

}  // namespace slipface
