// Which panels exist and where in the window they are. It knows no Dear ImGui: panels/ draws them, app/
// positions them, and the layout is plain data that can be saved.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

namespace slipface {

// A column or strip of the window, whose panels are tabs.
enum class Dock { left, left_lower, right, bottom };
inline constexpr std::size_t dock_count = 4;

enum class PanelId {
#define SLIPFACE_PANEL(name, ...) name,
#include "tools/view/panel_rows.inc"
#undef SLIPFACE_PANEL
    count
};
inline constexpr std::size_t panel_count = static_cast<std::size_t>(PanelId::count);

struct PanelInfo {
    PanelId id;
    const char* name;  // "history", as commands and saved layouts name it
    const char* label;
    const char* icon;
    Dock dock;
    bool shown;            // at first
    const char* shortcut;  // "Ctrl+H" or ""
    const char* description;
    const char* search;
};
std::span<const PanelInfo, panel_count> panel_table();
const PanelInfo& panel_info(PanelId id);

struct PanelState {
    bool shown = false;
    Dock dock = Dock::right;
    friend bool operator==(const PanelState&, const PanelState&) = default;
};

struct PanelLayout {
    std::array<PanelState, panel_count> panels;
    // The open tab of each dock. Nothing, or a hidden panel: the first shown panel.
    std::array<std::optional<PanelId>, dock_count> front;
    float left = 264.0f, right = 344.0f;         // widths in design pixels
    float left_lower = 230.0f, bottom = 230.0f;  // heights

    // Focus: only the view and at most one panel are shown, without menus, toolbar and status bar. Not saved.
    bool focus = false;
    std::optional<PanelId> focused;

    PanelLayout();  // as panel_table() says

    bool shown(PanelId id) const { return panels[static_cast<std::size_t>(id)].shown; }
    Dock dock(PanelId id) const { return panels[static_cast<std::size_t>(id)].dock; }
    std::optional<PanelId> front_of(Dock dock) const;  // the visible panel; nothing: the dock is empty
    bool is_front(PanelId id) const { return front_of(dock(id)) == id; }

    void show(PanelId id);  // and brings it to the front; in focus instead of the panel that is shown
    void focus_on(std::optional<PanelId> id);  // nothing: the view alone
    void hide(PanelId id);
    void toggle(PanelId id);  // hides it if it is visible, else shows it
    void move(PanelId id, Dock dock);

    friend bool operator==(const PanelLayout&, const PanelLayout&) = default;
};

}  // namespace slipface
