#include "keys.h"

#include <array>
#include <string_view>
#include <utility>

namespace slipface {
namespace {

using Names = std::pair<std::string_view, std::string_view>;

constexpr std::array<Names, 17> named{{{"ArrowLeft", "Left"},
                                       {"ArrowRight", "Right"},
                                       {"ArrowUp", "Up"},
                                       {"ArrowDown", "Down"},
                                       {" ", "Space"},
                                       {"ContextMenu", "Menu"},
                                       {"Escape", "Escape"},
                                       {"Enter", "Enter"},
                                       {"Tab", "Tab"},
                                       {"Backspace", "Backspace"},
                                       {"Insert", "Insert"},
                                       {"Delete", "Delete"},
                                       {"PageUp", "PageUp"},
                                       {"PageDown", "PageDown"},
                                       {"Home", "Home"},
                                       {"End", "End"},
                                       {"Pause", "Pause"}}};

// What a key types changes with Shift; its name does not.
constexpr std::array<Names, 11> punctuation{{{"Minus", "-"},
                                             {"Equal", "="},
                                             {"BracketLeft", "["},
                                             {"BracketRight", "]"},
                                             {"Semicolon", ";"},
                                             {"Quote", "'"},
                                             {"Backquote", "`"},
                                             {"Backslash", "\\"},
                                             {"Comma", ","},
                                             {"Period", "."},
                                             {"Slash", "/"}}};

}  // namespace

std::string key_label(const std::string& code, const std::string& key) {
    for (const std::string_view row : {"Digit", "Numpad"})
        if (code.size() == row.size() + 1 && code.starts_with(row) && code.back() >= '0' &&
            code.back() <= '9')
            return {code.back()};
    for (const auto& [browser, ours] : punctuation)
        if (code == browser) return std::string(ours);
    for (const auto& [browser, ours] : named)
        if (key == browser) return std::string(ours);
    if (key.size() > 1 && key[0] == 'F' && key[1] >= '1' && key[1] <= '9') return key;
    if (key.size() == 1 && key[0] >= 'a' && key[0] <= 'z') return {static_cast<char>(key[0] - 'a' + 'A')};
    return key.size() == 1 ? key : std::string();
}

std::string place_of(const std::string& code) {
    if (code.size() == 4 && code.starts_with("Key")) return {code.back()};
    return code == "ShiftLeft" ? "Shift" : code == "Space" ? code : "";
}

bool taken_from_browser(const Shortcut& shortcut) {
    if (shortcut.key == "F11") return false;
    if (shortcut.ctrl && shortcut.shift)
        return shortcut.key != "I" && shortcut.key != "J" && shortcut.key != "C";
    if (shortcut.ctrl) return shortcut.key != "C" && shortcut.key != "V" && shortcut.key != "X";
    return true;
}

}  // namespace slipface
