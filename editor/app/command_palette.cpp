// Every command by a few letters: Ctrl+P, type, Enter.
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "app/parts.h"
#include "tools/commands/fuzzy.h"
#include "widgets/imgui_compat.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

constexpr std::size_t most_recent = 12;

struct PaletteState {
    bool was_shown = false;
    std::string query;
    std::size_t chosen = 0;
    bool moved = false;  // by a key: scrolls the row into view
};

PaletteState& palette_state() {
    static PaletteState state;
    return state;
}

void run_from_palette(Editor& editor, const Command& command) {
    editor.show_command_palette = false;
    const std::string id = command.id;
    std::erase(editor.recent_commands, id);
    editor.recent_commands.insert(editor.recent_commands.begin(), id);
    if (editor.recent_commands.size() > most_recent) editor.recent_commands.resize(most_recent);
    run_command(editor, id);
}

// Icon, label and menu at the left, the description under it, the shortcut at the right.
bool draw_row(const Editor& editor, const Command& command, bool chosen) {
    const float scale = ui::scale(), line = ImGui::GetTextLineHeight(), height = 2 * line + 13 * scale;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const bool enabled = command.enabled(editor);
    const bool pressed =
        ImGui::Selectable("##row", chosen, enabled ? 0 : ImGuiSelectableFlags_Disabled, {0, height});
    ui::record_last_item(command.label, enabled, chosen);

    const ui::Palette& p = ui::palette();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImU32 text = ui::packed(enabled ? p.text : p.muted), muted = ui::packed(p.muted);
    const float icon_room = 34 * scale, top = at.y + 5 * scale;
    list.AddText({at.x + 10 * scale, at.y + 0.5f * (height - line)}, chosen ? ui::packed(p.accent) : muted,
                 command.icon);
    const std::string name = command_name(editor, command);
    list.AddText({at.x + icon_room, top}, text, name.c_str());
    std::string menu = command.menu;
    if (const std::size_t slash = menu.find('/'); slash != std::string::npos)
        menu.replace(slash, 1, " \u203a ");
    const float label_width = ImGui::CalcTextSize(name.c_str()).x;
    list.AddText({at.x + icon_room + label_width + 10 * scale, top}, muted, menu.c_str());
    const std::string shortcut = shortcut_text(editor, command);
    const float key_width = ImGui::CalcTextSize(shortcut.c_str()).x;
    if (!shortcut.empty())
        list.AddText({at.x + width - key_width - 10 * scale, top}, ui::packed(p.accent), shortcut.c_str());
    const float below = top + line + 2 * scale, end = at.x + width - 10 * scale;
    ImGui::PushStyleColor(ImGuiCol_Text, p.muted);
    ui::ellipsis_text(list, {at.x + icon_room, below}, {end, below + line}, end, command.description);
    ImGui::PopStyleColor();
    return pressed;
}

void move_choice(PaletteState& state, std::size_t count) {
    if (count == 0) return;
    const auto step = [&](std::ptrdiff_t by) {
        const auto n = static_cast<std::ptrdiff_t>(count);
        state.chosen =
            static_cast<std::size_t>(((static_cast<std::ptrdiff_t>(state.chosen) + by) % n + n) % n);
        state.moved = true;
    };
    if (ui::key_pressed(ImGuiKey_DownArrow)) step(1);
    if (ui::key_pressed(ImGuiKey_UpArrow)) step(-1);
    state.chosen = std::min(state.chosen, count - 1);
}

}  // namespace

void command_palette(Editor& editor) {
    PaletteState& state = palette_state();
    if (!editor.show_command_palette) {
        state = {};
        return;
    }
    const bool appearing = !std::exchange(state.was_shown, true);
    const float scale = ui::scale();
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const ImVec2 size{std::min(620 * scale, screen.x * 0.92f), std::min(470 * scale, screen.y * 0.8f)};
    ImGui::SetNextWindowPos({std::round(0.5f * (screen.x - size.x)), std::round(0.12f * screen.y)});
    ImGui::SetNextWindowSize(size);
    if (appearing) ImGui::SetNextWindowFocus();
    const ui::Scope scope("Commands");
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {12 * scale, 12 * scale});
    const bool open = ImGui::Begin(
        "##commands", nullptr,
        ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
    ImGui::PopStyleVar();
    if (open) {
        if (ui::search_box("##Find a command", &state.query, "Find a command")) state.chosen = 0;
        const std::vector<const Command*> found = find_commands(editor, state.query);
        move_choice(state, found.size());
        const Command* run = nullptr;
        if (!found.empty() && (ui::key_pressed(ImGuiKey_Enter) || ui::key_pressed(ui::key_pad_enter)))
            run = found[state.chosen];
        ImGui::BeginChild("rows", {0, 0}, false, ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav);
        ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 2 * scale});
        for (std::size_t i = 0; i < found.size(); ++i) {
            ImGui::PushID(found[i]->id);
            if (draw_row(editor, *found[i], i == state.chosen)) run = found[i];
            if (i == state.chosen && state.moved) ImGui::SetScrollHereY(0.5f);
            ImGui::PopID();
        }
        ImGui::PopStyleVar();
        if (found.empty()) ui::muted_text("No command has these letters");
        ui::end(ImGui::EndChild);
        state.moved = false;
        if (run && run->enabled(editor)) run_from_palette(editor, *run);
        if (!appearing && !ImGui::IsWindowFocused(ImGuiFocusedFlags_RootAndChildWindows))
            editor.show_command_palette = false;
    }
    ui::end(ImGui::End);
}

}  // namespace slipface
