// The 3D view: the picture, the mouse in it, and what is drawn over it.
#pragma once

#include <imgui.h>

#include <optional>
#include <string>

#include "panels/panels.h"

namespace slipface {

// What a held mouse button is doing in the view.
enum class Gesture { none, orbit, pan, fly, stroke, click, place_probe, drag_probe_end, drag_probe_start };

struct ViewportState {
    Gesture gesture = Gesture::none;
    const Document* document = nullptr;  // the one the gesture began in
    ImVec2 last_mouse{0, 0};
    ImVec2 pressed_at{0, 0};
    Probe probe_before;  // put back when the gesture is cancelled
    // Where the view was drawn last, pixels of the window.
    ImVec2 min{0, 0}, size{1, 1};
    bool hovered = false;
    const char* lit_axis = nullptr;  // under the mouse
    // Faces of each type, counted anew when they change.
    const Document* counted = nullptr;
    std::uint64_t counted_revision = 0;
    std::vector<std::size_t> face_counts;
};

ViewportState& viewport_state();
void reset_viewport_panel();
// Takes back the stroke or drag under way. False if there is none.
bool cancel_viewport_gesture(Editor& editor);
bool viewport_is_flying();

// "Click: paint ice · Alt+click: pick a type · …" for the status bar.
std::string viewport_hint(const Editor& editor);

// Parts of the view, in files of their own.
Camera shown_camera(const Editor& editor);
void viewport_gestures(Editor& editor, FrameContext& frame, ViewportState& state);  // after the view's item
Overlay viewport_overlay(const Editor& editor, const ViewportState& state);
void playtest_frame(Editor& editor, FrameContext& frame);  // advances it
void playtest_hud(const Editor& editor, const ViewportState& state);
void axis_buttons(Editor& editor, ViewportState& state);           // before the view's item
void draw_axes(const Editor& editor, const ViewportState& state);  // over the picture

// The probe under the mouse: 0 none, 1 start, 2 end.
int probe_handle_at(const Editor& editor, const Camera& camera, const Vec2& pixel, const Vec2& size);
void drag_probe(Editor& editor, const Camera& camera, const Vec2& pixel, const Vec2& size, Gesture gesture,
                bool vertical);

}  // namespace slipface
