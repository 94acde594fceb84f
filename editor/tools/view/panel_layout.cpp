#include "tools/view/panel_layout.h"

#include "tools/commands/icons.h"

namespace slipface {
namespace {

constexpr float lowest_column_with_two_docks = 480.0f;  // design pixels
constexpr float least_view = 0.5f;                      // of the window's width

bool is_left(Dock dock) {
    return dock == Dock::left || dock == Dock::left_lower;
}

}  // namespace

std::span<const PanelInfo, panel_count> panel_table() {
    static constexpr std::array<PanelInfo, panel_count> rows{{
#define SLIPFACE_PANEL(name, label, icon, dock, shown, shortcut, description, search) \
    {PanelId::name, #name, label, icon, dock, shown, shortcut, description, search},
#include "tools/view/panel_rows.inc"
#undef SLIPFACE_PANEL
    }};
    return rows;
}

const PanelInfo& panel_info(PanelId id) {
    return panel_table()[static_cast<std::size_t>(id)];
}

PanelLayout::PanelLayout() {
    for (const PanelInfo& info : panel_table())
        panels[static_cast<std::size_t>(info.id)] = {info.shown, info.dock};
}

std::optional<PanelId> PanelLayout::front_of(Dock dock) const {
    if (focus) return focused && this->dock(*focused) == dock ? focused : std::nullopt;
    const std::optional<PanelId> wanted = front[static_cast<std::size_t>(dock)];
    const auto stands = [&](PanelId id) {
        const PanelState& state = panels[static_cast<std::size_t>(id)];
        return state.shown && state.dock == dock;
    };
    if (wanted && stands(*wanted)) return wanted;
    for (const PanelInfo& info : panel_table())
        if (stands(info.id)) return info.id;
    return std::nullopt;
}

bool PanelLayout::occupied(Column column) const {
    return column == Column::right ? front_of(Dock::right).has_value()
                                   : front_of(Dock::left).has_value() || front_of(Dock::left_lower);
}

void PanelLayout::fit(float width, float height) {
    const float sides = (occupied(Column::left) ? left : 0.0f) + (occupied(Column::right) ? right : 0.0f);
    const bool crowded =
        occupied(Column::left) && occupied(Column::right) && width - sides < least_view * width;
    for (const Column column : {Column::left, Column::right}) {
        const auto side = static_cast<std::size_t>(column);
        rail[side] = !focus && occupied(column) && (collapsed[side] || (crowded && used_column != column));
    }
    one_left_dock =
        height < lowest_column_with_two_docks && front_of(Dock::left) && front_of(Dock::left_lower);
}

bool PanelLayout::visible(PanelId id) const {
    const Dock at = dock(id);
    if (!is_front(id)) return false;
    if (at == Dock::right) return !rail[1];
    return !is_left(at) || (!rail[0] && (!one_left_dock || at == used_left));
}

void PanelLayout::show(PanelId id) {
    PanelState& state = panels[static_cast<std::size_t>(id)];
    state.shown = true;
    front[static_cast<std::size_t>(state.dock)] = id;
    if (is_left(state.dock)) used_left = state.dock;
    if (state.dock != Dock::bottom) {
        used_column = is_left(state.dock) ? Column::left : Column::right;
        collapsed[static_cast<std::size_t>(used_column)] = false;
    }
    if (focus) focused = id;
}

void PanelLayout::focus_on(std::optional<PanelId> id) {
    if (id) show(*id);
    focus = true;
    focused = id;
}

void PanelLayout::hide(PanelId id) {
    if (focused == id) focused.reset();
    panels[static_cast<std::size_t>(id)].shown = false;
}

void PanelLayout::toggle(PanelId id) {
    if (shown(id) && visible(id))
        hide(id);
    else
        show(id);
}

void PanelLayout::move(PanelId id, Dock dock) {
    panels[static_cast<std::size_t>(id)].dock = dock;
    show(id);
}

}  // namespace slipface
