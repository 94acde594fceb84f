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

// The side of the window that a dock belongs to. A column that the window has no room for is a rail of icons.
enum class Column { left, right };
inline constexpr std::size_t column_count = 2;

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
    float left_lower = 230.0f, bottom = 252.0f;  // heights

    // Focus: only the view and at most one panel are shown, without menus, toolbar and status bar. Not saved.
    bool focus = false;
    std::optional<PanelId> focused;

    // Not saved, either: what was used last stays open where there is no room for everything.
    std::array<bool, column_count> collapsed{};  // to a rail, by the user
    Column used_column = Column::left;
    Dock used_left = Dock::left;  // or left_lower
    // What the window has room for, as fit() found.
    std::array<bool, column_count> rail{};
    bool one_left_dock = false;  // left and left_lower share their space and tabs

    PanelLayout();  // as panel_table() says

    // For a window's room of `width` x `height` design pixels. A view as narrow as half of it leaves room for
    // one column only; a low column for one dock.
    void fit(float width, float height);

    bool shown(PanelId id) const { return panels[static_cast<std::size_t>(id)].shown; }
    Dock dock(PanelId id) const { return panels[static_cast<std::size_t>(id)].dock; }
    std::optional<PanelId> front_of(Dock dock) const;  // the visible panel; nothing: the dock is empty
    bool is_front(PanelId id) const { return front_of(dock(id)) == id; }
    bool occupied(Column column) const;
    bool visible(PanelId id) const;  // in front of a dock that is drawn

    void show(PanelId id);  // opens its column and brings it to the front; in focus instead of the panel that
                            // is shown
    void focus_on(std::optional<PanelId> id);  // nothing: the view alone
    void hide(PanelId id);
    void toggle(PanelId id);  // hides it if it is visible, else shows it
    void move(PanelId id, Dock dock);

    friend bool operator==(const PanelLayout&, const PanelLayout&) = default;
};

}  // namespace slipface
