// Where the parts of the window are: a fixed frame with columns whose borders can be dragged.
#include <algorithm>
#include <cmath>
#include <string_view>

#include "app/parts.h"
#include "panels/viewport_panel.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

constexpr ImGuiWindowFlags fixed_window = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                          ImGuiWindowFlags_NoSavedSettings |
                                          ImGuiWindowFlags_NoBringToFrontOnFocus;

struct Region {
    ImVec2 min, max;
    ImVec2 size() const { return {std::max(1.0f, max.x - min.x), std::max(1.0f, max.y - min.y)}; }
};

bool begin_region(const char* name, const Region& region, ImVec2 padding, const ImVec4& color,
                  ImGuiWindowFlags flags = 0) {
    ImGui::SetNextWindowPos(region.min);
    ImGui::SetNextWindowSize(region.size());
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, padding);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, color);
    const bool open = ImGui::Begin(name, nullptr, fixed_window | flags);
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(3);
    return open;
}

// A border that can be dragged. `line` is where it is, across `region`; returns by how many pixels it moved.
float splitter(const char* name, const Region& region, bool vertical) {
    float moved = 0.0f;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    begin_region(name, region, {0, 0}, ui::palette().window, ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::InvisibleButton("border", region.size());
    ui::record_last_item(name + 2);
    if (ImGui::IsItemHovered() || ImGui::IsItemActive()) {
        ImGui::SetMouseCursor(vertical ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
        ImGui::GetWindowDrawList()->AddRectFilled(region.min, region.max,
                                                  ui::packed(ui::with_alpha(ui::palette().accent, 0.7f)));
    }
    if (ImGui::IsItemActive()) moved = vertical ? ImGui::GetIO().MouseDelta.x : ImGui::GetIO().MouseDelta.y;
    ImGui::End();
    ImGui::PopStyleVar();
    return moved;
}

struct Tab {
    const char* label;
    bool shown;
    void (*panel)(Editor&);
};

void right_column(Parts& parts) {
    Editor& editor = parts.editor;
    if (editor.tool != parts.last_tool) {
        if (editor.tool == Tool::probe) parts.wanted_tab = "Probe";
        parts.last_tool = editor.tool;
    }
    const Tab tabs[] = {
        {"Movement", editor.show_settings, movement_panel},
        {"Probe", editor.show_probe_table, probe_panel},
        {"History", editor.show_history, history_panel},
        {"Warnings", editor.show_warnings, warnings_panel},
    };
    const Tab* open_tab = nullptr;
    ImGui::PushStyleVar(ImGuiStyleVar_ItemInnerSpacing, {4 * ui::scale(), 4 * ui::scale()});
    if (ImGui::BeginTabBar("tabs", ImGuiTabBarFlags_FittingPolicyScroll | ImGuiTabBarFlags_NoTooltip)) {
        const ui::Scope scope("Tabs");
        for (const Tab& tab : tabs) {
            if (!tab.shown) continue;
            const bool wanted = parts.wanted_tab && std::string_view(parts.wanted_tab) == tab.label;
            const bool open =
                ImGui::BeginTabItem(tab.label, nullptr, wanted ? ImGuiTabItemFlags_SetSelected : 0);
            if (wanted) parts.wanted_tab = nullptr;
            ui::record_last_item(tab.label, true, open);
            if (!open) continue;
            open_tab = &tab;
            ImGui::EndTabItem();
        }
        ImGui::EndTabBar();
    }
    ImGui::PopStyleVar();
    // The rows scroll, the tabs stay.
    ImGui::BeginChild("rows", {0, 0}, false, ImGuiWindowFlags_NoSavedSettings);
    if (open_tab) open_tab->panel(editor);
    ImGui::EndChild();
}

}  // namespace

void layout(Parts& parts, ImVec2 size) {
    Editor& editor = parts.editor;
    LayoutSizes& sizes = parts.sizes;
    const float scale = ui::scale();
    const float gap = std::round(4.0f * scale);
    const float menu_height = menu_bar(parts);
    const float toolbar_height = std::round(46.0f * scale);
    const float status_height = std::round(30.0f * scale);
    const bool opened = editor.document != nullptr;
    const bool walking = editor.playtest.has_value();

    const float top = menu_height + toolbar_height + 1.0f;
    const float bottom = std::max(top + 1.0f, size.y - status_height);
    // A small window keeps at least a third for the view.
    const float left_width = std::round(std::min(sizes.left * scale, size.x * 0.30f));
    const float right_width = std::round(std::min(sizes.right * scale, size.x * 0.36f));
    const bool left_shown = opened && editor.show_palette && !walking;
    const bool right_shown = opened && (editor.show_settings || editor.show_probe_table ||
                                        editor.show_history || editor.show_warnings);
    const float view_left = left_shown ? left_width + gap : 0.0f;
    const float view_right = right_shown ? size.x - right_width - gap : size.x;

    const ui::Palette& p = ui::palette();
    const ImVec2 panel_padding{std::round(12 * scale), std::round(10 * scale)};
    begin_region("##toolbar", {{0, menu_height}, {size.x, menu_height + toolbar_height}},
                 {10 * scale, 5 * scale}, p.panel);
    toolbar(parts);
    ImGui::End();

    if (left_shown) {
        const float height = bottom - top;
        const float inspector = std::min(sizes.inspector * scale, height * 0.5f);
        const float split = std::round(bottom - inspector - gap);
        begin_region("##palette", {{0, top}, {left_width, split}}, panel_padding, p.panel,
                     ImGuiWindowFlags_AlwaysUseWindowPadding);
        palette_panel(editor);
        ImGui::End();
        sizes.inspector -=
            splitter("##Inspector border", {{0, split}, {left_width, split + gap}}, false) / scale;
        sizes.inspector = std::clamp(sizes.inspector, 80.0f, 600.0f);
        begin_region("##inspector", {{0, split + gap}, {left_width, bottom}}, panel_padding, p.panel);
        inspector_panel(editor);
        ImGui::End();
        sizes.left +=
            splitter("##Left border", {{left_width, top}, {left_width + gap, bottom}}, true) / scale;
        sizes.left = std::clamp(sizes.left, 160.0f, 520.0f);
    }
    if (right_shown) {
        begin_region("##right", {{size.x - right_width, top}, {size.x, bottom}}, panel_padding, p.panel);
        right_column(parts);
        ImGui::End();
        sizes.right -=
            splitter("##Right border", {{view_right, top}, {view_right + gap, bottom}}, true) / scale;
        sizes.right = std::clamp(sizes.right, 200.0f, 640.0f);
    }

    begin_region("##viewport", {{view_left, top}, {view_right, bottom}}, {0, 0}, p.window);
    if (opened)
        viewport_panel(editor, parts.frame);
    else
        welcome(parts);
    ImGui::End();

    begin_region("##status", {{0, bottom}, {size.x, size.y}}, {12 * scale, 5 * scale}, p.window);
    status_bar(parts);
    ImGui::End();

    shortcuts_window(editor);
    dialogs(parts);
}

}  // namespace slipface
