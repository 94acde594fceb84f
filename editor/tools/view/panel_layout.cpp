#include "tools/view/panel_layout.h"

#include "tools/commands/icons.h"

namespace slipface {

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

void PanelLayout::show(PanelId id) {
    PanelState& state = panels[static_cast<std::size_t>(id)];
    state.shown = true;
    front[static_cast<std::size_t>(state.dock)] = id;
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
    if (shown(id) && is_front(id))
        hide(id);
    else
        show(id);
}

void PanelLayout::move(PanelId id, Dock dock) {
    panels[static_cast<std::size_t>(id)].dock = dock;
    show(id);
}

}  // namespace slipface
