#include "panels/viewport_panel.h"

#include <algorithm>
#include <cmath>

#include "document/faces.h"
#include "panels/legend.h"
#include "widgets/imgui_compat.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {

ViewportState& viewport_state() {
    static ViewportState state;
    return state;
}

void reset_viewport_panel() {
    viewport_state() = {};
}

bool viewport_is_flying() {
    return viewport_state().gesture == Gesture::fly;
}

Camera shown_camera(const Editor& editor) {
    if (editor.playtest && editor.document)
        return editor.playtest->camera(editor.document->scene(), editor.document->level().movement);
    return editor.view.camera();
}

namespace {

std::string select_hint(const Editor& editor) {
    const char* drag = "box";
    if (editor.select_shape == SelectShape::lasso) drag = "lasso";
    if (editor.select_shape == SelectShape::brush) drag = "select by brush";
    return std::string("Click: select, again: behind \u00b7 Drag: ") + drag +
           " \u00b7 Ctrl: add \u00b7 Shift: remove";
}

}  // namespace

std::string viewport_hint(const Editor& editor) {
    if (!editor.document) return {};
    if (editor.playtest)
        return "WASD: walk \u00b7 Space: jump \u00b7 Mouse: look \u00b7 Wheel: distance \u00b7 Esc: back to "
               "editing";
    if (viewport_is_flying())
        return "WASD: fly \u00b7 Q, E: down, up \u00b7 Shift: faster \u00b7 Wheel: speed";
    const auto& surfaces = editor.document->level().surfaces;
    const std::string type =
        editor.brush && *editor.brush < surfaces.size() ? surfaces[*editor.brush].name : "unset";
    std::string hint;
    switch (editor.tool) {
        case Tool::select: hint = select_hint(editor); break;
        case Tool::paint:
            hint = "Click: paint " + type + " \u00b7 Drag: paint more \u00b7 Alt+click: pick type";
            break;
        case Tool::fill: hint = "Click: fill with " + type + " \u00b7 Alt+click: pick type"; break;
        case Tool::probe:
            hint = editor.probe.placed
                       ? "Drag a handle: change the sweep \u00b7 Shift: up and down \u00b7 Click: place again"
                       : "Press: place the ellipsoid \u00b7 Drag: set the displacement";
            break;
        case Tool::props:
            hint = editor.props.file.empty()
                       ? "Click: choose a prop \u00b7 Drag a handle: change it \u00b7 Shift: without steps"
                       : "Click: place " + editor.props.file;
            break;
    }
    return hint + " \u00b7 RMB+WASD: fly \u00b7 MMB: orbit";
}

namespace {

struct Rect {
    ImVec2 min, max;
    bool empty() const { return max.x - min.x < 1.0f || max.y - min.y < 1.0f; }
};

// A pane's rectangle in the window: whole pixels, with a gap to its neighbours.
Rect position_of(const PaneRect& pane, ImVec2 min, ImVec2 size) {
    if (pane.width <= 0.0) return {min, min};
    const float half_gap = 1.5f * ui::scale();
    const auto at = [](float from, float length, double fraction) {
        return from + std::round(length * static_cast<float>(fraction));
    };
    Rect rect{{at(min.x, size.x, pane.x), at(min.y, size.y, pane.y)},
              {at(min.x, size.x, pane.x + pane.width), at(min.y, size.y, pane.y + pane.height)}};
    if (pane.x > 0.0) rect.min.x += half_gap;
    if (pane.y > 0.0) rect.min.y += half_gap;
    if (pane.x + pane.width < 1.0) rect.max.x -= half_gap;
    if (pane.y + pane.height < 1.0) rect.max.y -= half_gap;
    return rect;
}

// The borders between panes can be dragged; a double click moves them back to the middle.
void pane_borders(Panes& panes, ImVec2 min, ImVec2 size) {
    if (panes.maximised || panes.count == 1) return;
    const float reach = 4.0f * ui::scale();
    const ImVec2 cross{min.x + size.x * static_cast<float>(panes.across),
                       min.y + size.y * static_cast<float>(panes.down)};
    const auto border = [&](const char* name, ImVec2 from, ImVec2 to, bool vertical) {
        ImGui::SetCursorScreenPos(from);
        ImGui::InvisibleButton(name, {std::max(1.0f, to.x - from.x), std::max(1.0f, to.y - from.y)});
        ui::record_last_item(name);
        ui::mark_as_ground();
        if (ImGui::IsItemHovered() || ImGui::IsItemActive()) {
            ImGui::SetMouseCursor(vertical ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
            ImGui::GetWindowDrawList()->AddRectFilled(from, to,
                                                      ui::packed(ui::with_alpha(ui::palette().accent, 0.7f)));
        }
        double& fraction = vertical ? panes.across : panes.down;
        const ImVec2 moved = ImGui::GetIO().MouseDelta;
        if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
            fraction = 0.5;
        else if (ImGui::IsItemActive())
            fraction += static_cast<double>(vertical ? moved.x / size.x : moved.y / size.y);
        fraction = std::clamp(fraction, 0.1, 0.9);
    };
    border("Pane border across", {cross.x - reach, min.y}, {cross.x + reach, min.y + size.y}, true);
    if (panes.count < 3) return;
    const float left = panes.count == 3 ? cross.x + reach : min.x;
    border("Pane border down", {left, cross.y - reach}, {min.x + size.x, cross.y + reach}, false);
}

bool over(const Rect& rect, ImVec2 mouse) {
    return mouse.x >= rect.min.x && mouse.y >= rect.min.y && mouse.x < rect.max.x && mouse.y < rect.max.y;
}

void draw_image(Editor& editor, FrameContext& frame, std::size_t pane, const Rect& rect) {
    if (!frame.viewport) return;
    const ImVec2 size{rect.max.x - rect.min.x, rect.max.y - rect.min.y};
    const bool active = pane == editor.panes.active;
    const Camera camera = active ? shown_camera(editor) : pane_view(editor, pane).camera();
    const Overlay overlay = viewport_overlay(editor, camera, static_cast<double>(size.y));
    const ImVec2 density = ImGui::GetIO().DisplayFramebufferScale;
    const unsigned texture =
        frame.viewport->render(pane, camera, overlay, static_cast<int>(std::lround(size.x * density.x)),
                               static_cast<int>(std::lround(size.y * density.y)));
    // Rows of the texture begin at the bottom.
    ImGui::GetWindowDrawList()->AddImage(ui::texture_id(texture), rect.min, rect.max, {0, 1}, {1, 0});
}

// The name of the view, where it is not obvious.
void pane_name(const Editor& editor, std::size_t pane, const Rect& rect) {
    const ViewCamera& view = pane_view(editor, pane);
    const bool several = editor.panes.count > 1 && !editor.panes.maximised;
    if (editor.playtest || (!several && !view.orthographic)) return;
    const float scale = ui::scale();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const bool active = pane == editor.panes.active;
    const ImVec2 at{rect.min.x + 12 * scale, rect.min.y + 10 * scale};
    const ImVec2 size = ImGui::CalcTextSize(view.name());
    list.AddRectFilled({at.x - 7 * scale, at.y - 4 * scale},
                       {at.x + size.x + 7 * scale, at.y + size.y + 4 * scale},
                       ui::packed(ui::with_alpha(ui::palette().window, 0.72f)), 4 * scale);
    list.AddText(at, ui::packed(active && several ? ui::palette().accent : ui::palette().muted), view.name());
}

}  // namespace

void viewport_panel(Editor& editor, FrameContext& frame) {
    ViewportState& state = viewport_state();
    if (!editor.document) return;
    if (state.gesture != Gesture::none && state.document != editor.document.get())
        state.gesture = Gesture::none;
    editor.style.max_slope = editor.document->level().movement.max_slope;

    ImVec2 min = ImGui::GetCursorScreenPos(), size = ImGui::GetContentRegionAvail();
    const ui::Scope scope("Viewport");
    const float card = import_card(editor, min, size);
    min.x += card;
    size = {std::max(1.0f, size.x - card), std::max(1.0f, size.y)};
    Panes one = editor.panes;
    if (editor.playtest) one.maximised = true;
    const auto rect_of_pane = [&](std::size_t pane) { return position_of(pane_rects(one)[pane], min, size); };
    if (!editor.playtest) pane_borders(editor.panes, min, size);
    one.across = editor.panes.across;
    one.down = editor.panes.down;
    if (state.gesture == Gesture::none && ImGui::IsWindowHovered() && !ImGui::IsAnyItemActive())
        for (std::size_t pane = 0; pane < Panes::maximum; ++pane)
            if (!rect_of_pane(pane).empty() && over(rect_of_pane(pane), ImGui::GetIO().MousePos))
                activate_pane(editor, pane);
    one.active = editor.panes.active;

    const Rect active = rect_of_pane(editor.panes.active);
    state.min = active.min;
    state.size = {std::max(1.0f, active.max.x - active.min.x), std::max(1.0f, active.max.y - active.min.y)};
    editor.view_aspect = static_cast<double>(state.size.x) / static_cast<double>(state.size.y);
    for (std::size_t pane = 0; pane < Panes::maximum; ++pane)
        if (const PaneRect rect = pane_rects(one)[pane]; rect.width > 0.0)
            fit_framed_pane(editor, pane, rect.width * size.x / std::max(1.0, rect.height * size.y));
    const Rect whole{min, {min.x + size.x, min.y + size.y}};
    const LegendLayout key = legend_layout(editor, whole.min, whole.max);
    if (editor.playtest) {
        play_frame(editor, frame.held, ImGui::GetIO().MouseWheel, frame.seconds);
        frame.wants_cursor_capture = true;
        frame.animating = true;
    } else {
        legend_buttons(editor, key);
        view_cube(editor, state);
    }
    ImGui::SetCursorScreenPos(state.min);
    ImGui::InvisibleButton("view", state.size,
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                               ImGuiButtonFlags_MouseButtonMiddle);
    ui::record_last_item("View");
    ui::mark_as_ground();
    state.hovered = ImGui::IsItemHovered();
    viewport_gestures(editor, frame, state);
    if (!editor.document) return;

    if (!editor.playtest && editor.lab.frame(*editor.document, frame.seconds)) frame.animating = true;
    follow_headline(editor);
    for (std::size_t pane = 0; pane < Panes::maximum; ++pane) {
        const Rect rect = rect_of_pane(pane);
        if (rect.empty()) continue;
        draw_image(editor, frame, pane, rect);
        pane_name(editor, pane, rect);
    }
    if (editor.playtest) {
        playtest_hud(editor, state);
        return;
    }
    lab_labels(editor, state);
    reach_labels(editor, state);
    draw_spawn_names(editor, state);
    heat_legend(editor, state);
    draw_triangle_ids(editor, state);
    draw_outline(state);
    draw_tool_preview(editor, state);
    draw_legend(editor, key);
    draw_view_cube(editor, state);
}

}  // namespace slipface
