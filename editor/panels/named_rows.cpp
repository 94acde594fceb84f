#include "panels/named_rows.h"

#include <imgui_internal.h>

#include "panels/panel_memory.h"
#include "tools/commands/icons.h"
#include "widgets/imgui_compat.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

struct Renaming {
    ImGuiID row = 0;
    std::string text;
    bool focus = false;
};

Renaming& renaming() {
    static Renaming state;
    return state;
}

// The row as a text box, until Enter or a click elsewhere.
void name_box(Renaming& state, NamedRowResult& result,
              const std::function<std::string(const std::string&)>& problem) {
    if (state.focus) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(-1.0f);
    ui::input_text("##Name", &state.text);
    const bool done = ImGui::IsItemDeactivated();
    const bool cancelled = ui::key_pressed(ImGuiKey_Escape);
    const std::string why_not = problem(state.text);
    if (!why_not.empty()) ui::muted_text(why_not.c_str());
    if (done && !state.focus) {
        if (!cancelled && why_not.empty()) result.renamed = state.text;
        state.row = 0;
    }
    state.focus = false;
}

// Small buttons over the row's right end, shown while the mouse is over it. They overlap the row and get
// its clicks.
bool row_button(const char* icon, const char* name, const char* tooltip, float x, float y, float side) {
    ImGui::SetCursorScreenPos({x, y});
    const bool pressed = ImGui::InvisibleButton(name, {side, side});
    ui::record_last_item(name);
    ui::tooltip(tooltip);
    const ImVec2 size = ImGui::CalcTextSize(icon);
    const ImVec4 color = ImGui::IsItemHovered() ? ui::palette().accent : ui::palette().muted;
    ImGui::GetWindowDrawList()->AddText({x + 0.5f * (side - size.x), y + 0.5f * (side - size.y)},
                                        ui::packed(color), icon);
    return pressed;
}

}  // namespace

void forget_renaming() {
    renaming() = {};
}

NamedRowResult named_row(std::size_t index, const NamedRow& row,
                         const std::function<std::string(const std::string&)>& problem) {
    NamedRowResult result;
    ImGui::PushID(static_cast<int>(index));
    const ui::Scope scope(row.name);
    Renaming& state = renaming();
    const ImGuiID id = ImGui::GetID("row");
    if (state.row == id) {
        name_box(state, result, problem);
        ImGui::PopID();
        return result;
    }
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, height = ImGui::GetFrameHeight();
    // A button that is held down stays, or it would never be released.
    const bool hovered = ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem) &&
                         ImGui::IsMouseHoveringRect(at, {at.x + width, at.y + height});
    float right = at.x + width;
    const bool on_buttons = hovered && ImGui::GetMousePos().x >= right - 3 * height;
    ImGui::Selectable("##row", row.chosen, ImGuiSelectableFlags_AllowItemOverlap, {0, height});
    ui::record_last_item("Row", true, row.chosen);
    ui::mark_as_ground();
    result.chosen = ImGui::IsItemClicked() && !on_buttons;
    if (ImGui::IsItemHovered() && !on_buttons && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
        state = {id, row.name, true};
    ui::tooltip(row.tooltip);
    ImGui::SetItemAllowOverlap();
    const float next = ImGui::GetCursorPosY();
    right -= height;
    const float ends[] = {right, right - height, right - 2 * height};
    if (hovered) {
        result.remove = row_button(icons::trash, "Delete", "Delete it", ends[0], at.y, height);
        if (row_button(icons::pencil, "Rename", "Rename", ends[1], at.y, height))
            state = {id, row.name, true};
        result.replace = row_button(icons::save, "Replace", row.replace_tooltip, ends[2], at.y, height);
        right = ends[2];
    }
    ImGui::SetCursorPosY(next);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float text_y = at.y + 0.5f * (height - ImGui::GetTextLineHeight()), em = ImGui::GetFontSize();
    if (!hovered) {
        const float detail = ImGui::CalcTextSize(row.detail.c_str()).x;
        right = at.x + width - detail - 0.4f * em;
        list.AddText({right, text_y}, ui::packed(ui::palette().muted), row.detail.c_str());
    }
    ui::ellipsis_text(list, {at.x + 0.4f * em, text_y}, {right - 0.4f * em, at.y + height}, right - 0.4f * em,
                      row.name.c_str());
    ImGui::PopID();
    return result;
}

}  // namespace slipface
