// The 3D view: its image, mouse input and overlays.
#pragma once

#include <imgui.h>

#include <optional>
#include <string>

#include "panels/panels.h"
#include "tools/selection/selecting.h"

namespace slipface {

// The gesture of a held mouse button in the view.
enum class Gesture {
    none,
    orbit,
    pan,
    fly,  // by the right button; a click with it opens the context menu instead
    stroke,
    click,          // with the select tool; becomes one of the next two when the mouse moves
    outline,        // a box or a lasso
    select_stroke,  // the selecting brush
    place_probe,
    drag_probe_end,
    drag_probe_start,
    drag_prop
};

// A handle of the chosen prop in the mouse's hand.
struct PropDrag {
    std::size_t prop = 0;
    int axis = 0;
    Prop before, now;
    double start = 0.0;  // where along the axis, or at which angle, the drag began
};

class AuditJob;
class ReachJob;

struct ViewportState {
    Gesture gesture = Gesture::none;
    const Document* document = nullptr;  // the document in which the gesture began
    ImVec2 last_mouse{0, 0};
    ImVec2 pressed_at{0, 0};
    bool flown = false;       // the right button is held for flying, not for a click
    bool wants_menu = false;  // the context menu opens in this frame
    Probe probe_before;       // restored when the gesture is cancelled
    PropDrag prop_drag;
    std::vector<Vec2> outline;  // of box and lasso, pixels of the view
    SelectBy stroke_by = SelectBy::add;
    // Where a face was selected last: the next click there selects the face behind it.
    std::optional<ImVec2> clicked;
    std::uint64_t clicked_revision = 0;
    // The rectangle of the view in the last frame, pixels of the window.
    ImVec2 min{0, 0}, size{1, 1};
    bool hovered = false;
    std::optional<Vec3> lit_cube;  // the direction of the part of the view cube under the mouse
    bool cube_held = false, cube_dragged = false;  // by the mouse
};

ViewportState& viewport_state();
void reset_viewport_panel();
// Reverts the stroke or drag in progress. False if there is none.
bool cancel_viewport_gesture(Editor& editor);
bool viewport_is_flying();

// "Click: paint ice · Alt+click: pick a type · …" for the status bar.
std::string viewport_hint(const Editor& editor);

// Parts of the view, each in its own file.
Camera shown_camera(const Editor& editor);
void viewport_gestures(Editor& editor, FrameContext& frame, ViewportState& state);    // after the view's item
Overlay viewport_overlay(const Editor& editor, const Camera& camera, double height);  // of the view, pixels
void add_lab(Overlay& overlay, const Editor& editor);   // ribbons, ghosts, the highlighted record
void add_heat(Overlay& overlay, const Editor& editor);  // the audit's heat map, or the times to reach a face
void heat_legend(const Editor& editor, const ViewportState& state);
// A bar with the heat map's colours and their values, `width` pixels wide; returns its height.
float draw_heat_bar(ImDrawList& draw, const ImVec2& corner, float width, const AuditJob& job);
float draw_heat_bar(ImDrawList& draw, const ImVec2& corner, float width, const ReachJob& job);
void add_reach(Overlay& overlay, const Editor& editor);  // jump arcs and stopping distance
void reach_labels(const Editor& editor, const ViewportState& state);
// A text plate over a position in the level.
void view_label(const ViewportState& state, const Camera& camera, const Vec3& position,
                const std::string& text, const ImVec4& color);
void lab_labels(const Editor& editor, const ViewportState& state);
void playtest_hud(const Editor& editor, const ViewportState& state);
void view_cube(Editor& editor, ViewportState& state);                     // before the view's item
void draw_view_cube(const Editor& editor, const ViewportState& state);    // over the image
void draw_outline(const ViewportState& state);                            // the box or lasso being drawn
void draw_spawn_names(const Editor& editor, const ViewportState& state);  // only if there are several
std::string tool_preview(const Editor& editor);  // "Fill 766 faces with ice"; empty: none
void draw_tool_preview(const Editor& editor, const ViewportState& state);  // beside the mouse
void draw_triangle_ids(const Editor& editor, const ViewportState& state);

// The axis of the chosen prop's handle under the mouse, or -1.
int prop_handle_at(const Editor& editor, const Camera& camera, const Vec2& pixel, const Vec2& size);
// False if the axis points at the eye.
bool begin_prop_drag(const Editor& editor, const Camera& camera, const Vec2& pixel, const Vec2& size,
                     int axis, PropDrag& drag);
void drag_prop(const Editor& editor, const Camera& camera, const Vec2& pixel, const Vec2& size,
               bool other_snap, PropDrag& drag);
void end_prop_drag(Editor& editor, const PropDrag& drag);
// Metres that one pixel covers at `point`; `viewport_height` in pixels.
double metres_per_pixel(const Camera& camera, const Vec3& point, double viewport_height);
void add_prop_handles(Overlay& overlay, const Editor& editor, const Camera& camera, double height);

// The probe under the mouse: 0 none, 1 start, 2 end.
int probe_handle_at(const Editor& editor, const Camera& camera, const Vec2& pixel, const Vec2& size);
void drag_probe(Editor& editor, const Camera& camera, const Vec2& pixel, const Vec2& size, Gesture gesture,
                bool vertical);

}  // namespace slipface
