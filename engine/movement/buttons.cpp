#include "slipface/movement/buttons.h"

#include <array>

#include "slipface/movement/settings.h"

namespace slipface {

namespace {

constexpr auto table = std::to_array<ButtonInfo>({
    {Button::jump, "jump", "Jump", "Space", "A",
     "Jumps when it is pressed: from the ground, a ladder or a sticky surface, and where the settings allow "
     "it "
     "off a wall and in the air. Letting it go may cut the jump; held in a fall it may glide."},
    {Button::crouch, "crouch", "Crouch", "C", "B", "Crouches while it is held, where the settings allow it."},
    {Button::dash, "dash", "Dash", "Shift", "X", "Dashes when it is pressed, where the settings allow it."},
    {Button::grab, "grab", "Grab", "E", "RB",
     "Holds on to ledges while it is held, where the settings ask for a button."},
    {Button::drop, "drop", "Drop", "X", "LB",
     "Lets go of a ledge, and falls through one-sided faces where the settings allow it."},
});

}  // namespace

std::span<const ButtonInfo> button_table() {
    return table;
}

ButtonSet buttons_read(const MovementSettings& settings) {
    ButtonSet read = Button::jump;
    read.set(Button::crouch, settings.crouch);
    read.set(Button::dash, settings.dash);
    read.set(Button::grab, settings.ledge_grab && settings.ledge_form == LedgeForm::button);
    read.set(Button::drop, settings.ledge_grab || settings.drop_through);
    return read;
}

const ButtonInfo* find_button(std::string_view name) {
    for (const ButtonInfo& info : table)
        if (name == info.name) return &info;
    return nullptr;
}

}  // namespace slipface
