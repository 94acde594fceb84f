// A frame of the playtest: held keys, mouse and gamepad become the player's input.
#pragma once

#include "slipface/base/types.h"

namespace slipface {

struct Editor;

// Input that ImGui does not carry: movement keys by position (true while held), and the gamepad.
struct HeldKeys {
    bool forward = false, back = false, left = false, right = false, up = false, down = false, jump = false,
         fast = false;
    Vec2 stick = Vec2::Zero();        // gamepad, right and forward
    Vec2 look_stick = Vec2::Zero();   // gamepad, radians per second
    Vec2 look_pixels = Vec2::Zero();  // mouse movement while the cursor is captured by the playtest
};

// Advances the playtest by `seconds`. `wheel`: notches of the mouse wheel, which move the camera closer or
// away.
void play_frame(Editor& editor, const HeldKeys& held, float wheel, double seconds);

}  // namespace slipface
