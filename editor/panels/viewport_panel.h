// The 3D view: the picture, the mouse in it, and what is drawn over it.
#pragma once

#include <imgui.h>

#include <optional>
#include <string>

#include "panels/panels.h"
#include "tools/selecting.h"

namespace slipface {

// What a held mouse button is doing in the view.
enum class Gesture {
    none,
    orbit,
    pan,
    fly,
    stroke,
    click,          // with the select tool; becomes one of the next two when the mouse moves on
    outline,        // a box or a lasso
    select_stroke,  // the selecting brush
    place_probe,
    drag_probe_end,
    drag_probe_start
};

struct ViewportState {
    Gesture gesture = Gesture::none;
    const Document* document = nullptr;  // the one the gesture began in
    ImVec2 last_mouse{0, 0};
    ImVec2 pressed_at{0, 0};
    Probe probe_before;         // put back when the gesture is cancelled
    std::vector<Vec2> outline;  // of box and lasso, pixels of the view
    SelectBy stroke_by = SelectBy::add;
    std::optional<ImVec2> clicked;  // where a face was selected last, to go on behind it
    std::uint64_t clicked_revision = 0;
    // Where the view was drawn last, pixels of the window.
    ImVec2 min{0, 0}, size{1, 1};
    bool hovered = false;
    std::optional<Vec3> lit_cube;  // the direction whose part of the view cube is under the mouse
    bool cube_held = false, cube_dragged = false;  // by the mouse
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
void viewport_gestures(Editor& editor, FrameContext& frame, ViewportState& state);    // after the view's item
Overlay viewport_overlay(const Editor& editor, const Camera& camera, double height);  // of the view, pixels
void playtest_frame(Editor& editor, FrameContext& frame);                             // advances it
void add_lab(Overlay& overlay, const Editor& editor);   // ribbons, ghosts, the lit record
void add_heat(Overlay& overlay, const Editor& editor);  // the audit's heat map
void heat_legend(const Editor& editor, const ViewportState& state);
// The heat map's colours with the values that they stand for, in a strip of that width; returns its height.
float draw_heat_bar(ImDrawList& draw, const ImVec2& corner, float width, const AuditJob& job);
void add_reach(Overlay& overlay, const Editor& editor);  // how far and high jumps go
void reach_labels(const Editor& editor, const ViewportState& state);
// A plate with words over a place of the level.
void view_label(const ViewportState& state, const Camera& camera, const Vec3& position,
                const std::string& text, const ImVec4& color);
void lab_labels(const Editor& editor, const ViewportState& state);
void playtest_hud(const Editor& editor, const ViewportState& state);
void view_cube(Editor& editor, ViewportState& state);                     // before the view's item
void draw_view_cube(const Editor& editor, const ViewportState& state);    // over the picture
void draw_outline(const ViewportState& state);                            // the box or lasso being drawn
void draw_spawn_names(const Editor& editor, const ViewportState& state);  // where there are several
std::string tool_preview(const Editor& editor);  // "Fill 766 faces with ice"; empty: nothing to say
void draw_tool_preview(const Editor& editor, const ViewportState& state);  // beside the mouse
void draw_triangle_ids(const Editor& editor, const ViewportState& state);

// The probe under the mouse: 0 none, 1 start, 2 end.
int probe_handle_at(const Editor& editor, const Camera& camera, const Vec2& pixel, const Vec2& size);
void drag_probe(Editor& editor, const Camera& camera, const Vec2& pixel, const Vec2& size, Gesture gesture,
                bool vertical);

}  // namespace slipface
