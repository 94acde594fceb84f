// Every command with its key, from the table.
#include <set>
#include <string>

#include "app/parts.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

void section(const char* menu) {
    ui::heading(menu);
    if (!ImGui::BeginTable(menu, 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp)) return;
    ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthStretch, 3.0f);
    ImGui::TableSetupColumn("key", ImGuiTableColumnFlags_WidthStretch, 1.4f);
    for (const Command& command : commands()) {
        if (std::string_view(command.menu) != menu || command.shortcut.key.empty()) continue;
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(command.label);
        ui::tooltip(command.description);
        ImGui::TableNextColumn();
        ImGui::TextColored(ui::palette().accent, "%s", command.shortcut.text().c_str());
    }
    ImGui::EndTable();
}

struct MouseRow {
    const char *what, *how;
};
constexpr MouseRow mouse_rows[] = {
    {"Use the tool", "Left button"},
    {"Pick the type under the mouse", "Alt+click"},
    {"Look around and fly", "Right button + WASD, Q, E"},
    {"Fly faster or slower", "Right button + wheel"},
    {"Orbit", "Middle drag, Alt+right drag"},
    {"Pan", "Shift+middle drag"},
    {"Zoom to the point under the mouse", "Wheel"},
};

}  // namespace

void shortcuts_window(Editor& editor) {
    if (!editor.show_shortcuts) return;
    const float scale = ui::scale();
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowSize(
        {std::min(460 * scale, screen.x * 0.9f), std::min(620 * scale, screen.y * 0.86f)},
        ImGuiCond_Appearing);
    ImGui::SetNextWindowPos({screen.x * 0.5f, screen.y * 0.5f}, ImGuiCond_Appearing, {0.5f, 0.5f});
    const ui::Scope scope("Shortcuts");
    if (ImGui::Begin("Keyboard and mouse", &editor.show_shortcuts,
                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings)) {
        std::set<std::string_view> seen;
        for (const Command& command : commands())
            if (!command.shortcut.key.empty() && seen.insert(command.menu).second) section(command.menu);
        ui::heading("Mouse in the view");
        if (ImGui::BeginTable("mouse", 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp)) {
            for (const MouseRow& row : mouse_rows) {
                ImGui::TableNextRow();
                ImGui::TableNextColumn();
                ImGui::TextUnformatted(row.what);
                ImGui::TableNextColumn();
                ImGui::TextColored(ui::palette().accent, "%s", row.how);
            }
            ImGui::EndTable();
        }
    }
    ImGui::End();
}

}  // namespace slipface
