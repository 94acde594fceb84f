// Menus, made from the table of commands.
#include <set>
#include <string>

#include "app/parts.h"
#include "document/path_text.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

std::string_view family(const Command& command) {
    const std::string_view id = command.id;
    return id.substr(0, id.find('.'));
}

void recent_menu(Editor& editor) {
    if (!ui::begin_menu("Open recent")) return;
    if (editor.recent.paths().empty()) ui::menu_item("Nothing yet", "", false, false, nullptr);
    const std::vector<std::filesystem::path> paths = editor.recent.paths();
    const std::vector<std::string> folders = distinguishing_folders(paths);
    for (std::size_t i = 0; i < paths.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        const std::string name = printable(paths[i].filename().string());
        if (ui::menu_item(name.c_str(), folders[i].c_str(), false, true, with_tilde(paths[i]).c_str()))
            request_open(editor, paths[i]);
        ImGui::PopID();
    }
    ui::end_menu();
}

// "View" of "View/Panels".
std::string_view top_menu(const Command& command) {
    const std::string_view menu = command.menu;
    return menu.substr(0, menu.find('/'));
}

void command_item(Editor& editor, const Command& command) {
    const bool checked = command.checked && command.checked(editor);
    const std::string label = command_name(editor, command) + "###" + command.label;
    if (ui::menu_item(label.c_str(), shortcut_text(editor, command).c_str(), checked, command.enabled(editor),
                      command.description, command.icon))
        run_command(editor, command.id);
}

// The rows of the menu with this full name; each submenu is at the position of its first row.
void menu(Editor& editor, const std::string& name) {
    const std::size_t slash = name.find('/');
    if (!ui::begin_menu(slash == std::string::npos ? name.c_str() : name.c_str() + slash + 1)) return;
    const Command* before = nullptr;
    std::set<std::string_view> seen;
    for (const Command& command : commands()) {
        if (std::string_view(command.menu) != name) {
            if (slash == std::string::npos && top_menu(command) == name && seen.insert(command.menu).second) {
                if (before && std::string_view(before->menu) == name) ImGui::Separator();
                menu(editor, command.menu);
                before = &command;
            }
            continue;
        }
        if (before && family(*before) != family(command)) ImGui::Separator();
        command_item(editor, command);
        if (std::string_view(command.id) == "file.open") recent_menu(editor);
        before = &command;
    }
    ui::end_menu();
}

// What the menu of the view offers: ids of the table, names of submenus; "" separates groups.
constexpr std::string_view view_menu_rows[] = {
    "edit.set_spawn",      "edit.add_spawn",
    "playtest.from_here",  "",
    "Edit/Make it",        "tools.pick_surface",
    "edit.replace_type",   "edit.unset_selection",
    "edit.add_rule",       "",
    "Select/Connected",    "Select/Similar",
    "select.hide",         "select.isolate",
    "select.show_all",     "",
    "view.frame_selected", "props.choose",
    "props.place",         "reach.path",
};

}  // namespace

void view_menu(Editor& editor, bool opens) {
    constexpr const char* id = "##view menu";
    if (opens) ImGui::OpenPopup(id);
    if (!editor.show_command_palette && !ImGui::IsPopupOpen(id)) editor.pointed.reset();
    const float scale = ui::scale();
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {8 * scale, 8 * scale});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {10 * scale, 7 * scale});
    if (ImGui::BeginPopup(id)) {
        const ui::Scope scope("View menu");
        for (const std::string_view row : view_menu_rows) {
            if (row.empty())
                ImGui::Separator();
            else if (row.find('/') != std::string_view::npos)
                menu(editor, std::string(row));
            else if (const Command* const command = find_command(row))
                command_item(editor, *command);
        }
        ui::end(ImGui::EndPopup);
    }
    ImGui::PopStyleVar(2);
}

std::string document_name(const Editor& editor) {
    return editor.document ? printable(editor.document->level().mesh_path.filename().string())
                           : std::string();
}

std::string window_title(const Editor& editor) {
    if (!editor.document) return "Slipface";
    return document_name(editor) + (editor.document->dirty() ? " \u2022" : "") + " \u2014 Slipface";
}

float menu_bar(Parts& parts) {
    Editor& editor = parts.editor;
    const float scale = ui::scale();
    float height = ImGui::GetFrameHeight();
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {8 * scale, 8 * scale});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {10 * scale, 7 * scale});
    if (ImGui::BeginMainMenuBar()) {
        const ui::Scope scope("Menu");
        std::set<std::string_view> seen;
        for (const Command& command : commands())
            if (*command.menu && seen.insert(top_menu(command)).second)
                menu(editor, std::string(top_menu(command)));
        if (editor.document) {
            const std::string name = document_name(editor) + (editor.document->dirty() ? "  \u2022" : "");
            const float width = ImGui::CalcTextSize(name.c_str()).x;
            const float x = ImGui::GetWindowWidth() - width - 14 * scale;
            if (x > ImGui::GetCursorPosX()) {
                ImGui::SetCursorPosX(x);
                ImGui::TextColored(ui::palette().muted, "%s", name.c_str());
            }
        }
        height = ImGui::GetWindowHeight();
        ImGui::EndMainMenuBar();
    }
    ImGui::PopStyleVar(2);
    return height;
}

}  // namespace slipface
