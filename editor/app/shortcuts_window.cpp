// Every command with its key, and a new key for any of them.
#include <fmt/format.h>

#include <set>
#include <string>

#include "app/parts.h"
#include "slipface/base/text.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

bool matches(const Editor& editor, const Command& command, const std::string& filter) {
    if (filter.empty()) return true;
    const std::string text = to_lower(command_name(editor, command) + " " + command.search + " " +
                                      command.menu + " " + shortcut_text(editor, command));
    const std::string wanted = to_lower(filter);
    for (const std::string_view word : split(wanted, ' '))
        if (text.find(word) == std::string::npos) return false;
    return true;
}

// The other commands with the same key.
std::string conflict_text(const Editor& editor, const Command& command) {
    const Keymap& keymap = editor.session.keymap;
    std::string names;
    for (const Command* other : keymap.users_of(keymap.shortcut(command)))
        if (other != &command) names += (names.empty() ? "" : ", ") + command_name(editor, *other);
    return names;
}

void key_button(Editor& editor, const Command& command, bool conflict) {
    Session& session = editor.session;
    const ui::Palette& p = ui::palette();
    const bool waiting = session.rebinding == command.id;
    const std::string key = shortcut_text(editor, command);
    const std::string label = (waiting ? std::string("Press a key\u2026") : key) + "###" + command.id;
    ImGui::PushStyleColor(ImGuiCol_Button, waiting ? ui::with_alpha(p.accent, 0.25f) : ImVec4(0, 0, 0, 0));
    ImGui::PushStyleColor(ImGuiCol_Text, conflict ? p.bad : p.accent);
    ImGui::PushStyleVar(ImGuiStyleVar_ButtonTextAlign, {0.0f, 0.5f});
    if (ui::button(label.c_str(), waiting ? "Esc: leave it as it is" : "Click, then press the new key", true,
                   {ImGui::GetContentRegionAvail().x, 0}))
        session.rebinding = waiting ? nullptr : command.id;
    ImGui::PopStyleVar();
    ImGui::PopStyleColor(2);
}

void row_menu(Editor& editor, const Command& command) {
    Keymap& keymap = editor.session.keymap;
    const float side = ImGui::GetFrameHeight();
    const ui::Scope scope(command.id);
    const std::string conflict = conflict_text(editor, command);
    if (!conflict.empty()) {
        if (ui::icon_button("\uf00c", "Only here",
                            ("Also on: " + conflict + ". Click to remove it there").c_str(), true))
            keymap.take_from_others(command);
        ImGui::SameLine(0, 0);
    } else {
        ImGui::Dummy({side + 4 * ui::scale(), 0});
        ImGui::SameLine(0, 0);
    }
    if (!keymap.shortcut(command).key.empty()) {
        if (ui::icon_button("\uf00d", "None", "No key for this command", false)) keymap.bind(command, {});
        ImGui::SameLine(0, 0);
    } else {
        ImGui::Dummy({side + 4 * ui::scale(), 0});
        ImGui::SameLine(0, 0);
    }
    if (keymap.is_changed(command)) {
        const std::string usual = command.shortcut.text();
        if (ui::icon_button("\uf112", "Usual key", ("Back to " + (usual.empty() ? "no key" : usual)).c_str(),
                            false))
            keymap.reset(command);
    } else {
        ImGui::Dummy({side, 0});
    }
}

void section(Editor& editor, std::string_view menu, const std::string& filter) {
    bool any = false;
    for (const Command& command : commands())
        any |= command.menu == menu && matches(editor, command, filter);
    if (!any) return;
    const float scale = ui::scale();
    const std::string title(menu);
    ui::heading(title.empty() ? "Other keys" : title.c_str());
    if (!ImGui::BeginTable(("table" + title).c_str(), 3,
                           ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp))
        return;
    ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthStretch, 3.0f);
    ImGui::TableSetupColumn("key", ImGuiTableColumnFlags_WidthStretch, 1.7f);
    ImGui::TableSetupColumn("more", ImGuiTableColumnFlags_WidthFixed,
                            3 * ImGui::GetFrameHeight() + 12 * scale);
    for (const Command& command : commands()) {
        if (command.menu != menu || !matches(editor, command, filter)) continue;
        const std::string conflict = conflict_text(editor, command);
        ImGui::PushID(command.id);
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::AlignTextToFramePadding();
        ImGui::PushTextWrapPos(0.0f);
        ImGui::TextUnformatted(command_name(editor, command).c_str());
        ui::tooltip(command.description);
        if (!conflict.empty()) {
            ImGui::TextColored(ui::palette().bad, "Same key as %s", conflict.c_str());
            ui::record_last_item((std::string(command.id) + "/Conflict").c_str());
        }
        ImGui::PopTextWrapPos();
        ImGui::TableNextColumn();
        key_button(editor, command, !conflict.empty());
        ImGui::TableNextColumn();
        row_menu(editor, command);
        ImGui::PopID();
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

void mouse_section() {
    ui::heading("Mouse in the view");
    if (!ImGui::BeginTable("mouse", 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp)) return;
    for (const MouseRow& row : mouse_rows) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(row.what);
        ImGui::TableNextColumn();
        ImGui::TextColored(ui::palette().accent, "%s", row.how);
    }
    ImGui::EndTable();
}

std::size_t conflicts_in(const Editor& editor) {
    std::size_t count = 0;
    for (const Command& command : commands())
        count += conflict_text(editor, command).empty() ? 0 : 1;
    return count;
}

void head(Editor& editor, std::string& filter) {
    const float scale = ui::scale();
    if (ui::button("Reset all", "Reset all commands to their default keys", true, {110 * scale, 0}))
        editor.session.keymap.reset_all();
    ImGui::SameLine();
    ui::search_box("##Filter", &filter, "Find a command or a key");
    if (const std::size_t conflicts = conflicts_in(editor); conflicts > 0)
        ImGui::TextColored(
            ui::palette().bad,
            "\uf071  %zu commands have the same key; click a check mark to keep the key only there",
            conflicts);
}

}  // namespace

bool take_key_for_rebinding(Editor& editor, const Shortcut& key) {
    Session& session = editor.session;
    if (!session.rebinding || !editor.show_shortcuts) return false;
    const Command* const command = find_command(session.rebinding);
    session.rebinding = nullptr;
    if (!command || key == Shortcut{.key = "Escape"}) return true;
    session.keymap.bind(*command, key);
    const std::string conflict = conflict_text(editor, *command);
    editor.status = command_name(editor, *command) + " has " + key.text() +
                    (conflict.empty() ? "" : " now, and so has " + conflict);
    return true;
}

void shortcuts_window(Editor& editor) {
    if (!editor.show_shortcuts) {
        editor.session.rebinding = nullptr;
        return;
    }
    const float scale = ui::scale();
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowSize(
        {std::min(560 * scale, screen.x * 0.9f), std::min(660 * scale, screen.y * 0.86f)},
        ImGuiCond_Appearing);
    ImGui::SetNextWindowPos({screen.x * 0.5f, screen.y * 0.5f}, ImGuiCond_Appearing, {0.5f, 0.5f});
    const ui::Scope scope("Shortcuts");
    // It needs a border over panels of its own colour.
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, std::max(1.0f, scale));
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ui::palette().popup);
    const bool open = ImGui::Begin("Keyboard and mouse", &editor.show_shortcuts,
                                   ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings);
    ImGui::PopStyleColor();
    ImGui::PopStyleVar();
    if (open) {
        static std::string filter;
        if (ImGui::IsWindowAppearing()) filter.clear();
        const std::string before = filter;
        head(editor, filter);
        ImGui::BeginChild("rows", {0, 0}, false, ImGuiWindowFlags_NoSavedSettings);
        if (filter != before) ImGui::SetScrollY(0.0f);
        std::set<std::string_view> seen;
        for (const Command& command : commands())
            if (seen.insert(command.menu).second) section(editor, command.menu, filter);
        if (filter.empty()) mouse_section();
        ui::end(ImGui::EndChild);
    }
    ui::end(ImGui::End);
}

}  // namespace slipface
