// The editor's panels. Each draws itself into the current ImGui window region given by the layout and acts on
// the Editor.
#pragma once

#include "slipface/render/overlay.h"
#include "tools/commands.h"

namespace slipface {

// The part of the frame that draws the 3D view. The app owns the GL objects; the viewport panel asks for a
// picture of the level.
struct ViewportServices {
    // Draws level and overlay with `camera` into a target of that many pixels and returns the texture (rows
    // from the bottom).
    virtual unsigned render(const Camera& camera, const Overlay& overlay, int width, int height) = 0;
    virtual ~ViewportServices() = default;
};

// Input that ImGui does not carry: keys held by position for movement (true while held), and the gamepad.
struct HeldKeys {
    bool forward = false, back = false, left = false, right = false, up = false, down = false, jump = false,
         fast = false;
    Vec2 stick = Vec2::Zero();        // gamepad, right and forward
    Vec2 look_stick = Vec2::Zero();   // gamepad, radians a second
    Vec2 look_pixels = Vec2::Zero();  // mouse movement while the cursor is captured by the playtest
};

struct FrameContext {
    double seconds = 1.0 / 60.0;  // since the last frame, clamped
    HeldKeys held;
    ViewportServices* viewport = nullptr;
    bool wants_cursor_capture = false;  // out: the host hides and captures the cursor
    bool animating = false;             // out: draw another frame soon even without events
};

void viewport_panel(Editor& editor,
                    FrameContext& frame);  // picture, gestures, overlays, legend, playtest HUD
void palette_panel(Editor& editor);        // surface types: choose, edit, counts
void movement_panel(Editor& editor);       // every hack and parameter, from settings_table()
void probe_panel(Editor& editor);          // numbers of the sweep probe
void inspector_panel(Editor& editor);      // the hovered or selected faces
void history_panel(Editor& editor);
void warnings_panel(Editor& editor);

}  // namespace slipface
