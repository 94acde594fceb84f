#include "panels/viewport_panel.h"

#include <algorithm>
#include <cmath>

#include "document/faces.h"
#include "panels/legend.h"
#include "widgets/imgui_compat.h"
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
        case Tool::select:
            hint = "Click: select \u00b7 Ctrl+click: add or remove";
            break;
        case Tool::paint:
            hint = "Click: paint " + type + " \u00b7 Drag: keep painting \u00b7 Alt+click: pick type";
            break;
        case Tool::fill:
            hint = "Click: fill with " + type + " \u00b7 Alt+click: pick type";
            break;
        case Tool::probe:
            hint = editor.probe.placed
                       ? "Drag a handle: change the sweep \u00b7 Shift: up and down \u00b7 Click: place anew"
                       : "Press: place the ellipsoid \u00b7 Drag: pull the displacement";
            break;
    }
    return hint + " \u00b7 RMB+WASD: fly \u00b7 MMB: orbit";
}

void viewport_panel(Editor& editor, FrameContext& frame) {
    ViewportState& state = viewport_state();
    if (!editor.document) return;
    if (state.gesture != Gesture::none && state.document != editor.document.get())
        state.gesture = Gesture::none;

    state.min = ImGui::GetCursorScreenPos();
    state.size = ImGui::GetContentRegionAvail();
    state.size = {std::max(1.0f, state.size.x), std::max(1.0f, state.size.y)};
    const ui::Scope scope("Viewport");

    if (editor.playtest)
        playtest_frame(editor, frame);
    else
        axis_buttons(editor, state);
    ImGui::SetCursorScreenPos(state.min);
    ImGui::InvisibleButton("view", state.size,
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                               ImGuiButtonFlags_MouseButtonMiddle);
    ui::record_last_item("View");
    state.hovered = ImGui::IsItemHovered();
    viewport_gestures(editor, frame, state);
    if (!editor.document) return;

    const Camera camera = shown_camera(editor);
    const Overlay overlay = viewport_overlay(editor, state);
    if (frame.viewport) {
        const ImVec2 density = ImGui::GetIO().DisplayFramebufferScale;
        const unsigned texture =
            frame.viewport->render(camera, overlay, static_cast<int>(std::lround(state.size.x * density.x)),
                                   static_cast<int>(std::lround(state.size.y * density.y)));
        // Rows of the texture begin at the bottom.
        ImGui::GetWindowDrawList()->AddImage(ui::texture_id(texture), state.min,
                                             {state.min.x + state.size.x, state.min.y + state.size.y}, {0, 1},
                                             {1, 0});
    }
    legend(editor, state);
    if (editor.playtest)
        playtest_hud(editor, state);
    else
        draw_axes(editor, state);
}

}  // namespace slipface
