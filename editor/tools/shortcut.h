// A key with its modifiers.
#pragma once

#include <string>
#include <string_view>

namespace slipface {

// By label: the key that carries the letter on the user's keyboard.
struct Shortcut {
    std::string key;  // "S", "1", "F5", "Delete", "Escape"; empty: none
    bool ctrl = false, shift = false, alt = false;
    std::string text() const;  // "Ctrl+Shift+S"
    friend bool operator==(const Shortcut&, const Shortcut&) = default;
};
Shortcut parse_shortcut(std::string_view text);  // reads what text() writes; no key: none was named

}  // namespace slipface
