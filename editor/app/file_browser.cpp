// Choosing a file: a path box and a list, the same on every machine.
#include <algorithm>
#include <system_error>

#include "app/parts.h"
#include "slipface/base/text.h"
#include "slipface/level/level_file.h"
#include "widgets/imgui_compat.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_entries = 5000;

bool is_level_name(const std::string& name) {
    const std::string lower = to_lower(name);
    return lower.ends_with(".obj") || lower.ends_with(".slipface.json");
}

bool is_folder(const fs::path& path) {
    std::error_code error;
    return fs::is_directory(path, error);
}

bool is_there(const fs::path& path) {
    std::error_code error;
    return fs::exists(path, error);
}

// Paths below the hidden folder are shown and typed relative to it.
std::string shown_path(const Parts& parts, const fs::path& path) {
    std::string text = path.string();
    if (!parts.hidden_folder.empty() && text.starts_with(parts.hidden_folder))
        text.erase(0, parts.hidden_folder.size());
    return text;
}

fs::path typed_path(const Parts& parts) {
    const fs::path path(parts.browser.path_text);
    if (path.is_absolute()) return path;
    return (parts.hidden_folder.empty() ? parts.browser.folder : fs::path(parts.hidden_folder)) / path;
}

void show_folder(Parts& parts, const fs::path& folder) {
    FileBrowser& browser = parts.browser;
    std::error_code error;
    const fs::path absolute = fs::weakly_canonical(folder, error);
    browser.folder = error ? folder : absolute;
    browser.entries = list_folder(browser.folder);
    browser.path_text = shown_path(parts, browser.folder / "");
    browser.problem.clear();
    browser.overwrite.clear();
}

void begin(Parts& parts) {
    FileBrowser& browser = parts.browser;
    const Editor& editor = parts.editor;
    std::error_code error;
    fs::path folder = fs::current_path(error);
    if (editor.document)
        folder = editor.document->level().file_path.parent_path();
    else if (!editor.recent.paths().empty())
        folder = editor.recent.paths().front().parent_path();
    browser.shown = editor.file_dialog;
    show_folder(parts, folder.empty() ? fs::path(".") : folder);
    if (editor.file_dialog == FileDialogKind::save_as && editor.document)
        browser.path_text = shown_path(parts, browser.folder / editor.document->level().file_path.filename());
}

// The user wants `path`, by double click, Enter or the button.
void choose(Parts& parts, const fs::path& path, bool may_overwrite) {
    FileBrowser& browser = parts.browser;
    Editor& editor = parts.editor;
    if (is_folder(path)) {
        show_folder(parts, path);
        return;
    }
    if (browser.shown == FileDialogKind::open) {
        if (!is_there(path)) {
            browser.problem = "No such file: " + path.filename().string();
            return;
        }
        editor.file_dialog = FileDialogKind::none;
        request_open(editor, path);
        return;
    }
    fs::path target = path;
    if (!to_lower(target.filename().string()).ends_with(".slipface.json")) target += ".slipface.json";
    if (!is_folder(target.parent_path())) {
        browser.problem = "No such folder: " + target.parent_path().string();
        return;
    }
    if (is_there(target) && !may_overwrite && target != editor.document->level().file_path) {
        browser.overwrite = target;
        return;
    }
    editor.file_dialog = FileDialogKind::none;
    save_level_as(editor, target);
}

void entry_list(Parts& parts, float height) {
    FileBrowser& browser = parts.browser;
    const ui::Scope scope("List");
    ImGui::PushStyleColor(ImGuiCol_ChildBg, ui::palette().panel);
    ImGui::PushStyleVar(ImGuiStyleVar_ChildRounding, 6 * ui::scale());
    ImGui::BeginChild("list", {0, height}, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
    fs::path chosen;
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(browser.entries.size()));
    while (clipper.Step()) {
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            const FileBrowser::Entry& entry = browser.entries[static_cast<std::size_t>(i)];
            const fs::path path = browser.folder / entry.name;
            const std::string label = (entry.folder ? "\uf07b  " : "\uf15b  ") + entry.name;
            const bool selected = typed_path(parts) == path;
            if (ImGui::Selectable(label.c_str(), selected, ImGuiSelectableFlags_AllowDoubleClick)) {
                if (entry.folder || ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
                    chosen = path;
                else
                    browser.path_text = shown_path(parts, path);
                browser.problem.clear();
            }
            ui::record_last_item(entry.name, true, selected);
        }
    }
    if (browser.entries.empty()) ui::muted_text("No levels here");
    ImGui::EndChild();
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
    if (!chosen.empty()) choose(parts, chosen, false);
}

void recent_list(Parts& parts, float height) {
    const ui::Scope scope("Recent");
    ImGui::BeginChild("recent", {0, height}, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
    ui::heading("Recent");
    const std::vector<fs::path> paths = parts.editor.recent.paths();
    fs::path chosen;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        if (ui::selectable(paths[i].filename().c_str(), false)) chosen = paths[i];
        ui::tooltip(paths[i].c_str());
        ImGui::PopID();
    }
    if (paths.empty()) ui::muted_text("Nothing yet");
    ImGui::EndChild();
    if (!chosen.empty()) choose(parts, chosen, false);
}

void answer_buttons(Parts& parts) {
    FileBrowser& browser = parts.browser;
    const float width = 110 * ui::scale();
    const float x = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - 2 * width -
                    ImGui::GetStyle().ItemSpacing.x;
    if (!browser.overwrite.empty()) {
        ImGui::AlignTextToFramePadding();
        ImGui::TextColored(ui::palette().accent, "Replace %s?", browser.overwrite.filename().c_str());
        ImGui::SameLine(x);
        if (ui::button("Keep it", nullptr, true, {width, 0})) browser.overwrite.clear();
        ImGui::SameLine();
        if (ui::primary_button("Replace", true, {width, 0})) choose(parts, fs::path(browser.overwrite), true);
        return;
    }
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(ui::palette().bad, "%s", browser.problem.c_str());
    ImGui::SameLine(x);
    if (ui::button("Cancel", nullptr, true, {width, 0})) parts.editor.file_dialog = FileDialogKind::none;
    ImGui::SameLine();
    const bool opening = browser.shown == FileDialogKind::open;
    if (ui::primary_button(opening ? "Open" : "Save", !browser.path_text.empty(), {width, 0}))
        choose(parts, typed_path(parts), false);
}

}  // namespace

std::vector<FileBrowser::Entry> list_folder(const fs::path& folder) {
    std::vector<FileBrowser::Entry> entries;
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end && entries.size() < most_entries;
         it.increment(error)) {
        const std::string name = it->path().filename().string();
        std::error_code unreadable;
        const bool is_dir = it->is_directory(unreadable);
        if (name.starts_with('.') || (!is_dir && !is_level_name(name))) continue;
        entries.push_back({name, is_dir});
    }
    std::sort(entries.begin(), entries.end(), [](const FileBrowser::Entry& a, const FileBrowser::Entry& b) {
        return a.folder != b.folder ? a.folder : a.name < b.name;
    });
    return entries;
}

void file_browser(Parts& parts) {
    FileBrowser& browser = parts.browser;
    if (browser.shown != parts.editor.file_dialog) begin(parts);
    const ui::Scope scope("File dialog");
    const float scale = ui::scale();
    ImGui::PushFont(ui::fonts().semibold);
    ImGui::TextUnformatted(browser.shown == FileDialogKind::open ? "Open a level" : "Save the level file as");
    ImGui::PopFont();
    ImGui::Dummy({0, 2 * scale});

    if (ui::button("\uf062###Up", "To the folder above")) show_folder(parts, browser.folder.parent_path());
    ImGui::SameLine();
    const bool typing_before = ImGui::GetIO().WantTextInput;
    ui::input_text("##Path", &browser.path_text, "Path of an OBJ or a .slipface.json file");
    const bool entered = typing_before && ImGui::IsItemDeactivated() &&
                         (ui::key_pressed(ImGuiKey_Enter) || ui::key_pressed(ui::key_pad_enter));

    const float footer = ImGui::GetFrameHeightWithSpacing() + 10 * scale;
    const float height = std::max(60 * scale, ImGui::GetContentRegionAvail().y - footer);
    if (ImGui::BeginTable("lists", 2, ImGuiTableFlags_SizingStretchProp)) {
        ImGui::TableSetupColumn("here", ImGuiTableColumnFlags_WidthStretch, 2.4f);
        ImGui::TableSetupColumn("recent", ImGuiTableColumnFlags_WidthStretch, 1.0f);
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        entry_list(parts, height - 8 * scale);
        ImGui::TableNextColumn();
        recent_list(parts, height - 8 * scale);
        ImGui::EndTable();
    }
    if (parts.editor.file_dialog == FileDialogKind::none) return;
    answer_buttons(parts);
    if (entered && parts.editor.file_dialog != FileDialogKind::none) choose(parts, typed_path(parts), false);
}

}  // namespace slipface
