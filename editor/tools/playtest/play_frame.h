// A frame of the playtest: held keys, mouse and gamepad become the player's input.
#pragma once

#include <string>
#include <string_view>

#include "slipface/base/types.h"
#include "slipface/movement/buttons.h"

namespace slipface {

struct Editor;

// Input that ImGui does not carry: movement keys by position (true while held), and the gamepad.
struct HeldKeys {
    bool forward = false, back = false, left = false, right = false, up = false, down = false, fast = false;
    ButtonSet buttons{};              // of the keyboard and the gamepad
    Vec2 stick = Vec2::Zero();        // gamepad, right and forward
    Vec2 look_stick = Vec2::Zero();   // gamepad, radians per second
    Vec2 look_pixels = Vec2::Zero();  // mouse movement while the cursor is captured by the playtest
};

// Presses or releases the key that is named so by its place on a US keyboard: "W", "Space", "Shift", and
// those of button_table(). Several movements may share one. False: no movement has that key.
bool hold_key(HeldKeys& held, std::string_view key, bool down);
// All such keys, for a message: "W, S, A, D, E, Q, Shift, Space, C or X".
std::string movement_key_names();

// Advances the playtest by `seconds`. `wheel`: notches of the mouse wheel, which move the camera closer or
// away.
void play_frame(Editor& editor, const HeldKeys& held, float wheel, double seconds);

}  // namespace slipface
