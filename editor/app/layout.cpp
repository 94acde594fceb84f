// Where the parts of the window are: a fixed frame with columns whose borders can be dragged.
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include "app/parts.h"
#include "panels/review_view.h"
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

// A border that can be dragged. `line` is its position across `region`; returns by how many pixels it moved.
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
    ui::end(ImGui::End);
    ImGui::PopStyleVar();
    return moved;
}

// The context menu of a tab.
void tab_menu(Editor& editor, PanelId panel) {
    if (!ImGui::BeginPopupContextItem(panel_info(panel).name)) return;
    struct DockChoice {
        Dock dock;
        const char* label;
    };
    const ui::Scope scope("Tab menu");
    for (const DockChoice& choice :
         {DockChoice{Dock::left, "To the left"}, DockChoice{Dock::left_lower, "To the left, below"},
          DockChoice{Dock::right, "To the right"}, DockChoice{Dock::bottom, "To the bottom"}})
        if (ui::menu_item(choice.label, "", editor.layout.dock(panel) == choice.dock, true, nullptr))
            editor.layout.move(panel, choice.dock);
    ImGui::Separator();
    PanelLayout& layout = editor.layout;
    if (ui::menu_item("Only this", "", layout.focus, true, "Hide everything but this panel and the view")) {
        if (layout.focus)
            layout.focus = false;
        else
            layout.focus_on(panel);
    }
    if (layout.dock(panel) != Dock::bottom) {
        const bool right = layout.dock(panel) == Dock::right;
        bool& collapsed = layout.collapsed[right ? 1 : 0];
        if (ui::menu_item("Collapse", "", layout.rail[right ? 1 : 0], true,
                          "Reduce this side of the window to icons; a press on one opens it again"))
            layout.rail[right ? 1 : 0] ? layout.show(panel) : void(collapsed = true);
    }
    if (ui::menu_item("Hide", "", false, true, nullptr)) layout.hide(panel);
    ui::end(ImGui::EndPopup);
}

using Docks = std::initializer_list<Dock>;
constexpr Docks both_left_docks{Dock::left, Dock::left_lower};

// Calls `draw` for each panel that has a tab in these docks.
template <class Draw>
void for_each_tab(Editor& editor, Docks docks, const Draw& draw) {
    for (const Dock dock : docks)
        for (const PanelInfo& info : panel_table()) {
            const PanelLayout& layout = editor.layout;
            if (!layout.shown(info.id) || layout.dock(info.id) != dock) continue;
            if (!layout.focus || layout.visible(info.id)) draw(info);
        }
}

// As many lines as needed: every panel of the docks stays visible and can be clicked, however narrow they
// are.
void tabs(Editor& editor, Docks docks, PanelId front) {
    const ui::Scope scope("Tabs");
    const float scale = ui::scale();
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {2 * scale, 2 * scale});
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {8 * scale, 4 * scale});
    bool first = true;
    for_each_tab(editor, docks, [&](const PanelInfo& info) {
        if (!std::exchange(first, false)) ui::flow(ui::button_width(info.label));
        if (ui::tab(info.label, front == info.id)) editor.layout.show(info.id);
        ui::tooltip(info.description);
        tab_menu(editor, info.id);
    });
    ImGui::PopStyleVar(2);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + ImGui::GetContentRegionAvail().x, at.y + scale},
                                              ui::packed(ui::palette().hairline));
    ImGui::Dummy({1, 2 * scale});
}

// Without a level, the review is the only panel that has something to show.
std::optional<PanelId> front_panel(const Editor& editor, Dock dock) {
    if (editor.document) return editor.layout.front_of(dock);
    return editor.review && editor.layout.dock(PanelId::review) == dock ? std::optional(PanelId::review)
                                                                        : std::nullopt;
}

// The panels of one dock, or of two that share their space, as tabs with the open one below.
void dock_panels(Parts& parts, Docks docks, Dock open) {
    Editor& editor = parts.editor;
    const std::optional<PanelId> front = front_panel(editor, open);
    if (!front) return;
    if (editor.document) tabs(editor, docks, *front);
    // The rows scroll, the tabs stay.
    ImGui::BeginChild(panel_info(*front).name, {0, 0}, false, ImGuiWindowFlags_NoSavedSettings);
    draw_panel(*front, editor, parts.frame);
    ui::end(ImGui::EndChild);
}

// A column as icons, one below the other: a press opens the column with that panel.
void rail(Editor& editor, const char* name, const Region& region, Docks docks) {
    const float scale = ui::scale();
    begin_region(name, region, {4 * scale, 6 * scale}, ui::palette().panel);
    {
        const ui::Scope scope("Tabs");
        for_each_tab(editor, docks, [&](const PanelInfo& info) {
            const std::string tip = std::string(info.label) + "\n" + info.description;
            if (ui::icon_button(info.icon, info.label, tip.c_str(), false)) editor.layout.show(info.id);
            tab_menu(editor, info.id);
        });
    }
    ui::end(ImGui::End);
}

bool occupied(const Editor& editor, Dock dock) {
    return front_panel(editor, dock).has_value();
}

// The left column: one dock over another, either alone, or both in one.
void left_column(Parts& parts, const Region& column, ImVec2 padding, float gap) {
    Editor& editor = parts.editor;
    PanelLayout& sizes = editor.layout;
    const ui::Palette& p = ui::palette();
    const float scale = ui::scale();
    if (sizes.rail[0]) return rail(editor, "##left rail", column, both_left_docks);
    const bool upper = occupied(editor, Dock::left), lower = occupied(editor, Dock::left_lower);
    const bool split = upper && lower && !sizes.one_left_dock;
    float border = upper || sizes.one_left_dock ? column.max.y : column.min.y - gap;
    if (split)
        border = std::round(column.max.y - std::min(sizes.left_lower * scale, column.size().y * 0.5f) - gap);
    if (upper || sizes.one_left_dock) {
        begin_region("##left", {column.min, {column.max.x, border}}, padding, p.panel);
        if (sizes.one_left_dock)
            dock_panels(parts, both_left_docks, sizes.used_left);
        else
            dock_panels(parts, {Dock::left}, Dock::left);
        ui::end(ImGui::End);
    }
    if (split) {
        sizes.left_lower -=
            splitter("##Lower border", {{column.min.x, border}, {column.max.x, border + gap}}, false) / scale;
        sizes.left_lower = std::clamp(sizes.left_lower, 80.0f, 600.0f);
    }
    if (lower && !sizes.one_left_dock) {
        begin_region("##left lower", {{column.min.x, border + gap}, column.max}, padding, p.panel);
        dock_panels(parts, {Dock::left_lower}, Dock::left_lower);
        ui::end(ImGui::End);
    }
}

}  // namespace

void layout(Parts& parts, ImVec2 size) {
    Editor& editor = parts.editor;
    PanelLayout& sizes = editor.layout;
    const float scale = ui::scale();
    const float gap = std::round(4.0f * scale);
    const bool bars = !sizes.focus;
    const float menu_height = bars ? menu_bar(parts) : 0.0f;
    const float toolbar_height = bars ? toolbar_height_in(editor, size.x) : 0.0f;
    const float status_height = bars ? std::round(30.0f * scale) : 0.0f;
    const bool walking = editor.playtest.has_value();
    if (editor.tool != parts.last_tool) {
        if (editor.tool == Tool::probe && sizes.shown(PanelId::probe)) sizes.show(PanelId::probe);
        parts.last_tool = editor.tool;
    }

    const float notices_top = bars ? menu_height + toolbar_height + 1.0f : 0.0f;
    const float top = notices_top + notices_height(parts);
    const float bottom = std::max(top + 1.0f, size.y - status_height);
    // In a small window the view keeps at least half of the width; in focus only one of the columns is shown.
    sizes.fit(size.x / scale, (bottom - top) / scale);
    const float widest = sizes.focus ? 0.66f : 0.0f,
                rail_width = std::round(8 * scale) + ui::icon_button_side();
    const float left_width = sizes.rail[0]
                                 ? rail_width
                                 : std::round(std::min(sizes.left * scale, size.x * std::max(0.30f, widest)));
    const float right_width =
        sizes.rail[1] ? rail_width
                      : std::round(std::min(sizes.right * scale, size.x * std::max(0.36f, widest)));
    const float low_height =
        std::round(std::min(sizes.bottom * scale, (bottom - top) * (sizes.focus ? 0.5f : 0.4f)));
    const bool left_shown = (occupied(editor, Dock::left) || occupied(editor, Dock::left_lower)) && !walking;
    const bool right_shown = occupied(editor, Dock::right), low_shown = occupied(editor, Dock::bottom);
    const float view_left = left_shown ? left_width + gap : 0.0f;
    const float view_right = right_shown ? size.x - right_width - gap : size.x;
    const float view_bottom = low_shown ? bottom - low_height - gap : bottom;
    // A narrow timeline is useless: where the view is narrow, the lower dock also takes the left column's
    // width.
    const bool low_is_wide = low_shown && view_right - view_left < 440.0f * scale;
    const float left_bottom = low_is_wide ? view_bottom : bottom, low_left = low_is_wide ? 0.0f : view_left;

    const ui::Palette& p = ui::palette();
    const ImVec2 panel_padding{std::round(12 * scale), std::round(8 * scale)};
    if (bars) {
        begin_region("##toolbar", {{0, menu_height}, {size.x, menu_height + toolbar_height}},
                     {10 * scale, 5 * scale}, p.panel);
        toolbar(parts);
        ui::end(ImGui::End);
    }

    if (top > notices_top) {
        begin_region("##notices", {{0, notices_top}, {size.x, top}}, {0, 0}, p.raised);
        notices(parts);
        ui::end(ImGui::End);
    }

    if (left_shown) left_column(parts, {{0, top}, {left_width, left_bottom}}, panel_padding, gap);
    if (left_shown && !sizes.rail[0]) {
        sizes.left +=
            splitter("##Left border", {{left_width, top}, {left_width + gap, left_bottom}}, true) / scale;
        sizes.left = std::clamp(sizes.left, 240.0f, 520.0f);
    }
    const Region right{{size.x - right_width, top}, {size.x, bottom}};
    if (right_shown && sizes.rail[1]) {
        rail(editor, "##right rail", right, {Dock::right});
    } else if (right_shown) {
        begin_region("##right", right, panel_padding, p.panel);
        dock_panels(parts, {Dock::right}, Dock::right);
        ui::end(ImGui::End);
        sizes.right -=
            splitter("##Right border", {{view_right, top}, {view_right + gap, bottom}}, true) / scale;
        sizes.right = std::clamp(sizes.right, 240.0f, 640.0f);
    }
    if (low_shown) {
        begin_region("##bottom", {{low_left, view_bottom + gap}, {view_right, bottom}}, panel_padding,
                     p.panel);
        dock_panels(parts, {Dock::bottom}, Dock::bottom);
        ui::end(ImGui::End);
        sizes.bottom -=
            splitter("##Bottom border", {{low_left, view_bottom}, {view_right, view_bottom + gap}}, false) /
            scale;
        sizes.bottom = std::clamp(sizes.bottom, 90.0f, 700.0f);
    }

    begin_region("##viewport", {{view_left, top}, {view_right, view_bottom}}, {0, 0}, p.window);
    if (review_view(editor, parts.frame)) {
        // The snapshots' images replace the level.
    } else if (editor.document)
        viewport_panel(editor, parts.frame);
    else
        welcome(parts);
    view_menu(editor, editor.document && std::exchange(viewport_state().wants_menu, false));
    ui::end(ImGui::End);

    if (bars) {
        begin_region("##status", {{0, bottom}, {size.x, size.y}}, {12 * scale, 2 * scale}, p.window);
        status_bar(parts);
        ui::end(ImGui::End);
    }

    shortcuts_window(editor);
    command_palette(editor);
    dialogs(parts);
    guide(parts);
}

}  // namespace slipface
