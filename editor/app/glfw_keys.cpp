#include "app/glfw_keys.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <array>
#include <utility>

namespace slipface {
namespace {

constexpr std::array<std::pair<int, const char*>, 18> named{{
    {GLFW_KEY_ESCAPE, "Escape"},
    {GLFW_KEY_ENTER, "Enter"},
    {GLFW_KEY_KP_ENTER, "Enter"},
    {GLFW_KEY_TAB, "Tab"},
    {GLFW_KEY_BACKSPACE, "Backspace"},
    {GLFW_KEY_INSERT, "Insert"},
    {GLFW_KEY_DELETE, "Delete"},
    {GLFW_KEY_LEFT, "Left"},
    {GLFW_KEY_RIGHT, "Right"},
    {GLFW_KEY_UP, "Up"},
    {GLFW_KEY_DOWN, "Down"},
    {GLFW_KEY_PAGE_UP, "PageUp"},
    {GLFW_KEY_PAGE_DOWN, "PageDown"},
    {GLFW_KEY_HOME, "Home"},
    {GLFW_KEY_END, "End"},
    {GLFW_KEY_SPACE, "Space"},
    {GLFW_KEY_PAUSE, "Pause"},
    {GLFW_KEY_MENU, "Menu"},
}};

std::string label(int key, int scancode) {
    for (const auto& [code, name] : named)
        if (code == key) return name;
    if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F25) return "F" + std::to_string(key - GLFW_KEY_F1 + 1);
    // On layouts where digits need Shift (AZERTY), the keys of that row still count as digits.
    if (key >= GLFW_KEY_0 && key <= GLFW_KEY_9) return std::to_string(key - GLFW_KEY_0);
    if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9) return std::to_string(key - GLFW_KEY_KP_0);
    const char* const name = glfwGetKeyName(key, scancode);
    if (!name) return {};
    std::string text = name;
    if (text.size() == 1 && text[0] >= 'a' && text[0] <= 'z')
        text[0] = static_cast<char>(text[0] - 'a' + 'A');
    return text;
}

}  // namespace

Shortcut shortcut_of(int key, int scancode, int mods) {
    Shortcut shortcut;
    shortcut.key = label(key, scancode);
    shortcut.ctrl = (mods & GLFW_MOD_CONTROL) != 0;
    shortcut.shift = (mods & GLFW_MOD_SHIFT) != 0;
    shortcut.alt = (mods & GLFW_MOD_ALT) != 0;
    return shortcut;
}

std::string place_of(int key) {
    // GLFW numbers keys by their place, those of letters by their ASCII code.
    if (key >= GLFW_KEY_A && key <= GLFW_KEY_Z) return {static_cast<char>(key)};
    if (key == GLFW_KEY_SPACE) return "Space";
    return key == GLFW_KEY_LEFT_SHIFT ? "Shift" : "";
}

}  // namespace slipface
