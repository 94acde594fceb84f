// What the mouse does in the view.
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>

#include "panels/viewport_panel.h"
#include "tools/props/props.h"
#include "tools/selection/selecting.h"
#include "tools/target.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

constexpr float click_slop = 4.0f;      // design pixels that the mouse may move during a click
constexpr double stroke_spacing = 4.0;  // pixels between the points where a stroke paints
constexpr int max_stroke_points = 400;  // of one frame

Vec2 to_vec(ImVec2 v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y)};
}

Vec2 view_pixel(const ViewportState& state, ImVec2 mouse) {
    return to_vec({mouse.x - state.min.x, mouse.y - state.min.y});
}

void hover_at(Editor& editor, const ViewportState& state, ImVec2 mouse) {
    hover(editor, pixel_ray(shown_camera(editor), view_pixel(state, mouse), to_vec(state.size)));
}

void hover_nothing(Editor& editor) {
    editor.hovered = no_id;
}

// Uses the tool along the mouse's path since its last position, so that a fast stroke leaves no gaps.
template <class Use>
void stroke_along(Editor& editor, const ViewportState& state, ImVec2 mouse, const Use& use) {
    const Vec2 from = to_vec(state.last_mouse), to = to_vec(mouse);
    const int steps =
        std::clamp(static_cast<int>(std::ceil((to - from).norm() / stroke_spacing)), 1, max_stroke_points);
    for (int i = 1; i <= steps; ++i) {
        const Vec2 at = from + (to - from) * (static_cast<double>(i) / steps);
        hover_at(editor, state, {static_cast<float>(at.x()), static_cast<float>(at.y())});
        if (editor.hovered != no_id) use();
    }
}

std::string stroke_name(const Editor& editor) {
    const auto& surfaces = editor.document->level().surfaces;
    if (!editor.brush || *editor.brush >= surfaces.size()) return "Unset";
    return "Paint " + surfaces[*editor.brush].name;
}

void begin(ViewportState& state, const Editor& editor, Gesture gesture, ImVec2 mouse) {
    state.gesture = gesture;
    state.document = editor.document.get();
    state.pressed_at = state.last_mouse = mouse;
    state.flown = false;
    state.probe_before = editor.probe;
}

// Ctrl adds (a click toggles), Shift removes.
SelectBy select_by(bool click) {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.KeyShift) return SelectBy::remove;
    if (io.KeyCtrl) return click ? SelectBy::toggle : SelectBy::add;
    return SelectBy::replace;
}

void press_select(Editor& editor, ViewportState& state, ImVec2 mouse) {
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) && select_by(true) == SelectBy::replace) {
        select_flat_hovered(editor, SelectBy::replace);
        return;
    }
    begin(state, editor, Gesture::click, mouse);
    state.outline.clear();
}

// The mouse moved with the button held: the click becomes a box, a lasso or a stroke.
void begin_select_drag(Editor& editor, ViewportState& state) {
    state.outline = {view_pixel(state, state.pressed_at)};
    if (editor.select_shape != SelectShape::brush) {
        state.gesture = Gesture::outline;
        return;
    }
    state.gesture = Gesture::select_stroke;
    state.stroke_by = select_by(false);
    editor.document->begin("Select by stroke");
    if (state.stroke_by == SelectBy::replace) {
        editor.document->select({});
        state.stroke_by = SelectBy::add;
    }
    hover_at(editor, state, state.pressed_at);
    brush_select(editor, state.stroke_by);
}

void go_on_outline(Editor& editor, ViewportState& state, ImVec2 mouse) {
    const Vec2 to = view_pixel(state, mouse), from = state.outline.front();
    if (editor.select_shape == SelectShape::lasso) {
        if ((state.outline.back() - to).norm() >= 2.0) state.outline.push_back(to);
    } else {
        state.outline = {from, {to.x(), from.y()}, to, {from.x(), to.y()}};
    }
}

void end_outline(Editor& editor, ViewportState& state) {
    const bool lasso = editor.select_shape == SelectShape::lasso;
    apply_selection(editor, faces_in_outline(editor, shown_camera(editor), to_vec(state.size), state.outline),
                    select_by(false), lasso ? "Select by lasso" : "Select by box");
    state.outline.clear();
}

// A second click at the same position selects the face behind.
void end_click(Editor& editor, ViewportState& state) {
    const ImVec2 at = state.pressed_at;
    hover_at(editor, state, at);
    const SelectBy by = select_by(true);
    const float slop = click_slop * ui::scale();
    const auto selected = editor.document->selection();
    const bool again = state.clicked && std::abs(at.x - state.clicked->x) <= slop &&
                       std::abs(at.y - state.clicked->y) <= slop && selected.size() == 1 &&
                       editor.document->revision() == state.clicked_revision;
    if (again && by == SelectBy::replace && editor.hovered != no_id)
        drill_select(editor, pixel_ray(shown_camera(editor), view_pixel(state, at), to_vec(state.size)), 1);
    else
        click_select(editor, by);
    state.clicked = at;
    state.clicked_revision = editor.document->revision();
}

void press_props(Editor& editor, ViewportState& state, ImVec2 mouse) {
    const Vec2 pixel = view_pixel(state, mouse), size = to_vec(state.size);
    const int axis = prop_handle_at(editor, shown_camera(editor), pixel, size);
    if (axis >= 0) {
        if (begin_prop_drag(editor, shown_camera(editor), pixel, size, axis, state.prop_drag))
            begin(state, editor, Gesture::drag_prop, mouse);
    } else if (!editor.props.file.empty() && editor.hovered != no_id) {
        add_prop(editor, editor.props.file, editor.hovered_point);
    } else {
        choose_prop(editor, prop_of_target(editor, pointed_target(editor)));
    }
}

void press_left(Editor& editor, ViewportState& state, ImVec2 mouse) {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.KeyAlt) {
        if (editor.tool != Tool::probe && editor.tool != Tool::props && editor.hovered != no_id)
            pick_surface(editor);
        return;
    }
    switch (editor.tool) {
        case Tool::select: press_select(editor, state, mouse); return;
        case Tool::paint:
            begin(state, editor, Gesture::stroke, mouse);
            editor.document->begin(stroke_name(editor));
            editor.stroke_painted = 0;
            if (editor.hovered != no_id) paint_hovered(editor);
            return;
        case Tool::fill:
            if (editor.hovered != no_id) fill_hovered(editor);
            return;
        case Tool::props: press_props(editor, state, mouse); return;
        case Tool::probe: break;
    }
    const Vec2 pixel = view_pixel(state, mouse);
    const int handle = probe_handle_at(editor, shown_camera(editor), pixel, to_vec(state.size));
    if (handle != 0) {
        begin(state, editor, handle == 2 ? Gesture::drag_probe_end : Gesture::drag_probe_start, mouse);
    } else if (editor.hovered != no_id) {
        begin(state, editor, Gesture::place_probe, mouse);
        editor.probe.place_on(editor.hovered_point, editor.hovered_normal, editor.document->level().movement);
        editor.probe.move = Vec3::Zero();
    }
}

void press(Editor& editor, ViewportState& state, ImVec2 mouse) {
    const ImGuiIO& io = ImGui::GetIO();
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Middle))
        begin(state, editor, io.KeyShift ? Gesture::pan : Gesture::orbit, mouse);
    else if (ImGui::IsMouseClicked(ImGuiMouseButton_Right))
        begin(state, editor, io.KeyAlt ? Gesture::orbit : Gesture::fly, mouse);
    else if (ImGui::IsMouseClicked(ImGuiMouseButton_Left))
        press_left(editor, state, mouse);
}

int button_of(Gesture gesture, const ImGuiIO& io) {
    switch (gesture) {
        case Gesture::pan: return ImGuiMouseButton_Middle;
        case Gesture::orbit:
            return io.MouseDown[ImGuiMouseButton_Right] ? ImGuiMouseButton_Right : ImGuiMouseButton_Middle;
        case Gesture::fly: return ImGuiMouseButton_Right;
        default: return ImGuiMouseButton_Left;
    }
}

bool beyond_click(const ViewportState& state, ImVec2 mouse) {
    const float slop = click_slop * ui::scale();
    return std::abs(mouse.x - state.pressed_at.x) > slop || std::abs(mouse.y - state.pressed_at.y) > slop;
}

Vec3 flying_direction(const HeldKeys& held) {
    const auto axis = [](bool plus, bool minus) { return (plus ? 1.0 : 0.0) - (minus ? 1.0 : 0.0); };
    return {axis(held.right, held.left), axis(held.up, held.down), axis(held.forward, held.back)};
}

// The right button was pressed for flying once the mouse or a key moves or the wheel turns. How long it is
// held says nothing: hands are slow, and so are frames of large levels.
bool begins_to_fly(const ViewportState& state, const HeldKeys& held, ImVec2 mouse) {
    return beyond_click(state, mouse) || !flying_direction(held).isZero() ||
           ImGui::GetIO().MouseWheel != 0.0f;
}

// The commands of the context menu act on the face that was clicked, which is selected for that.
void open_menu(Editor& editor, ViewportState& state) {
    hover_at(editor, state, state.pressed_at);
    remember_pointed(editor);
    const auto selected = editor.document->selection();
    if (editor.hovered != no_id && !std::binary_search(selected.begin(), selected.end(), editor.hovered))
        click_select(editor, SelectBy::replace);
    state.wants_menu = true;
}

void fly(Editor& editor, FrameContext& frame) {
    const HeldKeys& held = frame.held;
    const Vec3 direction = flying_direction(held);
    if (direction.isZero()) return;
    editor.view.fly(direction, frame.seconds * (held.fast ? 3.0 : 1.0));
    frame.animating = true;
}

void release(Editor& editor, ViewportState& state) {
    const Gesture ended = state.gesture;
    state.gesture = Gesture::none;
    if (ended == Gesture::stroke || ended == Gesture::select_stroke) editor.document->commit();
    if (ended == Gesture::outline) end_outline(editor, state);
    if (ended == Gesture::click) end_click(editor, state);
    if (ended == Gesture::drag_prop) end_prop_drag(editor, state.prop_drag);
    if (ended == Gesture::fly && !state.flown) open_menu(editor, state);
}

// One frame of the gesture in progress.
void go_on(Editor& editor, FrameContext& frame, ViewportState& state, ImVec2 mouse) {
    const ImGuiIO& io = ImGui::GetIO();
    const Vec2 moved = to_vec({mouse.x - state.last_mouse.x, mouse.y - state.last_mouse.y});
    const Vec2 design_moved = moved / static_cast<double>(ui::scale());
    const bool still = moved.isZero();
    switch (state.gesture) {
        case Gesture::orbit: editor.view.orbit(design_moved); break;
        case Gesture::pan: editor.view.pan(moved, to_vec(state.size)); break;
        case Gesture::fly:
            // What the mouse moved during a click does not turn the view.
            if (!state.flown && !(state.flown = begins_to_fly(state, frame.held, mouse))) break;
            editor.view.look(design_moved);
            if (io.MouseWheel != 0.0f)
                editor.view.fly_speed = std::clamp(
                    editor.view.fly_speed * std::pow(1.2, static_cast<double>(io.MouseWheel)), 0.2, 200.0);
            fly(editor, frame);
            break;
        case Gesture::stroke:
            if (!still) stroke_along(editor, state, mouse, [&] { paint_hovered(editor); });
            break;
        case Gesture::place_probe:
        case Gesture::drag_probe_end:
        case Gesture::drag_probe_start: {
            if (still || (state.gesture == Gesture::place_probe && !beyond_click(state, mouse))) break;
            drag_probe(editor, shown_camera(editor), view_pixel(state, mouse), to_vec(state.size),
                       state.gesture, io.KeyShift);
            break;
        }
        case Gesture::select_stroke:
            if (!still) stroke_along(editor, state, mouse, [&] { brush_select(editor, state.stroke_by); });
            break;
        case Gesture::outline:
            if (!still) go_on_outline(editor, state, mouse);
            break;
        case Gesture::click:
            if (beyond_click(state, mouse)) {
                begin_select_drag(editor, state);
                if (state.gesture == Gesture::outline)
                    go_on_outline(editor, state, mouse);
                else
                    stroke_along(editor, state, mouse, [&] { brush_select(editor, state.stroke_by); });
            }
            break;
        case Gesture::drag_prop:
            if (!still)
                drag_prop(editor, shown_camera(editor), view_pixel(state, mouse), to_vec(state.size),
                          io.KeyShift, state.prop_drag);
            break;
        case Gesture::none: break;
    }
    state.last_mouse = mouse;
}

}  // namespace

bool cancel_viewport_gesture(Editor& editor) {
    ViewportState& state = viewport_state();
    if (state.gesture == Gesture::none) return false;
    const Gesture ended = state.gesture;
    state.gesture = Gesture::none;
    if (state.document != editor.document.get()) return false;
    if (ended == Gesture::stroke || ended == Gesture::select_stroke) editor.document->cancel();
    state.outline.clear();
    if (ended == Gesture::place_probe || ended == Gesture::drag_probe_end ||
        ended == Gesture::drag_probe_start)
        editor.probe = state.probe_before;
    // The button is still down; the view must not treat the next movement as a new gesture.
    ImGui::ClearActiveID();
    return true;
}

void viewport_gestures(Editor& editor, FrameContext& frame, ViewportState& state) {
    const ImGuiIO& io = ImGui::GetIO();
    const ImVec2 mouse = io.MousePos;
    if (editor.playtest) {
        state.gesture = Gesture::none;
        hover_nothing(editor);
        return;
    }
    if (state.gesture != Gesture::none) {
        go_on(editor, frame, state, mouse);
        if (!io.MouseDown[button_of(state.gesture, io)]) release(editor, state);
        // The face under a painting mouse stays highlighted; during a drag of the camera or the probe none
        // is.
        const bool points = state.gesture == Gesture::none || state.gesture == Gesture::stroke ||
                            state.gesture == Gesture::select_stroke || state.gesture == Gesture::click ||
                            (state.gesture == Gesture::fly && !state.flown);
        if (!points) hover_nothing(editor);
        return;
    }
    if (!state.hovered) {
        hover_nothing(editor);
        return;
    }
    hover_at(editor, state, mouse);
    if (ImGui::IsItemActive() || ImGui::IsItemClicked(ImGuiMouseButton_Left)) press(editor, state, mouse);
    if (io.MouseWheel != 0.0f && state.gesture == Gesture::none) {
        const double wheel = static_cast<double>(io.MouseWheel);
        if (io.KeyCtrl && editor.tool == Tool::select)
            drill_select(editor,
                         pixel_ray(shown_camera(editor), view_pixel(state, mouse), to_vec(state.size)),
                         wheel < 0.0 ? 1 : -1);
        else
            zoom_to(editor, wheel, pointed_target(editor));
    }
}

}  // namespace slipface
