#include "slipface/movement/buttons.h"

#include <array>

namespace slipface {

namespace {

constexpr auto table = std::to_array<ButtonInfo>({
    {Button::jump, "jump", "Jump", "Space", "A",
     "Jumps when it is pressed: from the ground, a ladder or a sticky surface, and where the settings allow "
     "it "
     "off a wall and in the air. Letting it go may cut the jump."},
    {Button::crouch, "crouch", "Crouch", "C", "B",
     "No ability reads it yet; it is stored for the game's own."},
    {Button::dash, "dash", "Dash", "Shift", "X", "No ability reads it yet; it is stored for the game's own."},
    {Button::grab, "grab", "Grab", "E", "RB", "No ability reads it yet; it is stored for the game's own."},
    {Button::drop, "drop", "Drop", "X", "LB", "No ability reads it yet; it is stored for the game's own."},
});

}  // namespace

std::span<const ButtonInfo> button_table() {
    return table;
}

const ButtonInfo* find_button(std::string_view name) {
    for (const ButtonInfo& info : table)
        if (name == info.name) return &info;
    return nullptr;
}

}  // namespace slipface
