// Choosing a file: a path box and a list, the same on every machine.
#include <algorithm>
#include <system_error>

#include "app/dialog_parts.h"
#include "app/parts.h"
#include "slipface/base/text.h"
#include "slipface/level/level_file.h"
#include "tools/exchange.h"
#include "tools/lab_actions.h"
#include "widgets/imgui_compat.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_entries = 5000;

// What is asked for, a row a kind.
struct Kind {
    FileDialogKind kind;
    const char* title;
    const char* suffix;  // of what is listed, and added to a name that is saved without it
    const char* hint;
    bool saves;
    void (*chosen)(Editor& editor, const fs::path& path);
    const char* proposed = "";        // what follows the level's name in the name that is offered
    const char* other_suffix = "";    // is listed and kept, too
    const char* foreign_suffix = "";  // ends like `suffix` and is another kind of file
};
constexpr Kind kinds[] = {
    {FileDialogKind::open, "Open a level", "", "Path of an OBJ or a .slipface.json file", false,
     request_open},
    {FileDialogKind::save_as, "Save the level file as", ".slipface.json",
     "Path of an OBJ or a .slipface.json file", true, save_level_as},
    {FileDialogKind::open_tape, "Open a tape", ".tape", "Path of a .tape file", false, open_tape},
    {FileDialogKind::open_recording, "Open a recording", ".tape", "Path of a .tape file", false, open_tape},
    {FileDialogKind::save_tape, "Save the tape as", ".tape", "Path of a .tape file", true, save_tape},
    {FileDialogKind::save_csv, "Export the run as CSV", ".csv", "Path of a .csv file", true, save_run_csv},
    {FileDialogKind::open_preset, "Open a preset", ".json", "Path of a preset's .json file", false,
     open_preset, "", "", ".slipface.json"},
    {FileDialogKind::save_preset, "Save the movement settings as a preset", ".json", "Path of a .json file",
     true, save_preset, "-movement", "", ".slipface.json"},
    {FileDialogKind::export_obj, "Export OBJ and MTL", ".obj", "Path of an .obj file", true, export_level_obj,
     "-typed"},
    {FileDialogKind::export_gltf, "Export glTF", ".gltf", "Path of a .gltf or a .glb file", true,
     export_level_gltf, "-typed", ".glb"},
    {FileDialogKind::export_game, "Export for a game", ".flat", "Path of a .flat file", true,
     export_level_game},
};
const Kind& kind_of(FileDialogKind kind) {
    for (const Kind& row : kinds)
        if (row.kind == kind) return row;
    return kinds[0];
}

bool is_level_name(const std::string& name) {
    const std::string lower = to_lower(name);
    return lower.ends_with(".obj") || lower.ends_with(".slipface.json");
}
bool has_suffix(const std::string& name, const Kind& kind) {
    const std::string lower = to_lower(name);
    return lower.ends_with(kind.suffix) || (*kind.other_suffix && lower.ends_with(kind.other_suffix));
}
bool is_listed(const std::string& name, const Kind& kind) {
    if (kind.kind == FileDialogKind::open || kind.kind == FileDialogKind::save_as) return is_level_name(name);
    const bool foreign = *kind.foreign_suffix && to_lower(name).ends_with(kind.foreign_suffix);
    return has_suffix(name, kind) && !foreign;
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
    browser.entries = list_folder(browser.folder, kind_of(browser.shown).kind);
    browser.path_text = shown_path(parts, browser.folder / "");
    browser.problem.clear();
    browser.overwrite.clear();
}

void begin(Parts& parts) {
    FileBrowser& browser = parts.browser;
    const Editor& editor = parts.editor;
    std::error_code error;
    fs::path folder = fs::current_path(error);
    if (editor.file_dialog == FileDialogKind::open_recording)
        folder = editor.session.recordings.folder();
    else if (editor.document)
        folder = editor.document->level().file_path.parent_path();
    else if (!editor.recent.paths().empty())
        folder = editor.recent.paths().front().parent_path();
    browser.shown = editor.file_dialog;
    show_folder(parts, folder.empty() ? fs::path(".") : folder);
    if (!editor.document) return;
    const Kind& kind = kind_of(editor.file_dialog);
    if (kind.kind == FileDialogKind::save_as)
        browser.path_text = shown_path(parts, browser.folder / editor.document->level().file_path.filename());
    else if (kind.saves)
        browser.path_text =
            shown_path(parts, browser.folder / editor.document->level().mesh_path.stem().concat(
                                                   std::string(kind.proposed) + kind.suffix));
}

// Of what saving `target` would write, what is there already.
std::vector<fs::path> replaced_files(const Kind& kind, const fs::path& target) {
    std::vector<fs::path> files = files_of_export(kind.kind, target);
    std::erase_if(files, [](const fs::path& file) { return !is_there(file); });
    return files;
}

// The user wants `path`, by double click, Enter or the button.
void choose(Parts& parts, const fs::path& path, bool may_overwrite) {
    FileBrowser& browser = parts.browser;
    Editor& editor = parts.editor;
    if (is_folder(path)) {
        show_folder(parts, path);
        return;
    }
    const Kind& kind = kind_of(browser.shown);
    if (!kind.saves) {
        if (!is_there(path)) {
            browser.problem = "No such file: " + path.filename().string();
            return;
        }
        editor.file_dialog = FileDialogKind::none;
        kind.chosen(editor, path);
        return;
    }
    fs::path target = path;
    if (!has_suffix(target.filename().string(), kind)) target += kind.suffix;
    if (!is_folder(target.parent_path())) {
        browser.problem = "No such folder: " + target.parent_path().string();
        return;
    }
    const bool own_file =
        kind.kind == FileDialogKind::save_as && target == editor.document->level().file_path;
    if (!replaced_files(kind, target).empty() && !may_overwrite && !own_file) {
        browser.overwrite = target;
        return;
    }
    editor.file_dialog = FileDialogKind::none;
    kind.chosen(editor, target);
}

void entry_list(Parts& parts, float height) {
    FileBrowser& browser = parts.browser;
    const ui::Scope scope("List");
    ImGui::PushStyleColor(ImGuiCol_ChildBg, ui::palette().panel);
    ImGui::PushStyleVar(ImGuiStyleVar_ChildRounding, 6 * ui::scale());
    ImGui::BeginChild("list", {0, height}, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
    fs::path chosen;
    if (browser.scroll_to >= 0)
        ImGui::SetScrollY(static_cast<float>(browser.scroll_to) * ImGui::GetTextLineHeightWithSpacing() -
                          0.5f * height);
    browser.scroll_to = -1;
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
    if (browser.entries.empty()) ui::muted_text("No such files here");
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

// The level that is chosen in the list, as a picture.
void preview(Parts& parts, float height) {
    FileBrowser& browser = parts.browser;
    const fs::path typed = typed_path(parts);
    if (is_level_name(typed.filename().string()) && is_there(typed)) browser.previewed = typed;
    if (browser.previewed.empty() || !parts.preview) return;
    const float width = ImGui::GetContentRegionAvail().x;
    const float picture = std::min(width / 1.5f, height - 2.0f * ImGui::GetTextLineHeightWithSpacing());
    if (picture < 40 * ui::scale()) return;
    const LevelPreview::Shown shown =
        parts.preview->show(browser.previewed, static_cast<int>(picture * 1.5f), static_cast<int>(picture));
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImVec2 end{at.x + picture * 1.5f, at.y + picture};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (shown.texture != 0)
        list.AddImageRounded(ui::texture_id(shown.texture), at, end, {0, 1}, {1, 0}, IM_COL32_WHITE,
                             6 * ui::scale());
    else
        list.AddRectFilled(at, end, ui::packed(ui::palette().panel), 6 * ui::scale());
    ImGui::Dummy({width, picture});
    ui::record_last_item("Preview");
    ImGui::TextUnformatted(browser.previewed.filename().c_str());
    ui::muted_text(shown_text(parts, shown.facts).c_str());
}

// The arrow keys move the choice in the list, while the path box is not being edited.
void keyboard(Parts& parts) {
    FileBrowser& browser = parts.browser;
    const bool back = ui::key_pressed(ImGuiKey_Backspace);
    if (ImGui::GetIO().WantTextInput || !browser.overwrite.empty()) return;
    if (back) return show_folder(parts, browser.folder.parent_path());
    const int step =
        (ui::key_pressed(ImGuiKey_DownArrow) ? 1 : 0) - (ui::key_pressed(ImGuiKey_UpArrow) ? 1 : 0);
    if (step == 0 || browser.entries.empty()) return;
    const fs::path typed = typed_path(parts);
    int row = step > 0 ? -1 : static_cast<int>(browser.entries.size());
    for (std::size_t i = 0; i < browser.entries.size(); ++i)
        if (browser.folder / browser.entries[i].name == typed) row = static_cast<int>(i);
    row = std::clamp(row + step, 0, static_cast<int>(browser.entries.size()) - 1);
    browser.path_text =
        shown_path(parts, browser.folder / browser.entries[static_cast<std::size_t>(row)].name);
    browser.problem.clear();
    browser.scroll_to = row;
}

void answer_buttons(Parts& parts) {
    FileBrowser& browser = parts.browser;
    const float width = 110 * ui::scale();
    const float x = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - 2 * width -
                    ImGui::GetStyle().ItemSpacing.x;
    if (!browser.overwrite.empty()) {
        ImGui::AlignTextToFramePadding();
        std::string names;
        for (const fs::path& file : replaced_files(kind_of(browser.shown), browser.overwrite))
            names += (names.empty() ? "" : " and ") + file.filename().string();
        ImGui::TextColored(ui::palette().accent, "Replace %s?", names.c_str());
        ImGui::SameLine(x);
        if (ui::button("Keep it", nullptr, true, {width, 0})) browser.overwrite.clear();
        ImGui::SameLine();
        if (ui::primary_button("Replace", true, {width, 0})) choose(parts, fs::path(browser.overwrite), true);
        return;
    }
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(ui::palette().bad, "%s", browser.problem.c_str());
    if (!browser.problem.empty()) ui::record_last_item("Problem");
    ImGui::SameLine(x);
    if (ui::button("Cancel", nullptr, true, {width, 0})) parts.editor.file_dialog = FileDialogKind::none;
    ImGui::SameLine();
    if (ui::primary_button(kind_of(browser.shown).saves ? "Save" : "Open", !browser.path_text.empty(),
                           {width, 0}))
        choose(parts, typed_path(parts), false);
}

}  // namespace

std::vector<FileBrowser::Entry> list_folder(const fs::path& folder, FileDialogKind kind) {
    std::vector<FileBrowser::Entry> entries;
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end && entries.size() < most_entries;
         it.increment(error)) {
        const std::string name = it->path().filename().string();
        std::error_code unreadable;
        const bool is_dir = it->is_directory(unreadable);
        if (name.starts_with('.') || (!is_dir && !is_listed(name, kind_of(kind)))) continue;
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
    ImGui::TextUnformatted(kind_of(browser.shown).title);
    ImGui::PopFont();
    ImGui::Dummy({0, 2 * scale});

    keyboard(parts);
    if (ui::button("\uf062###Up", "To the folder above")) show_folder(parts, browser.folder.parent_path());
    ImGui::SameLine();
    const bool typing_before = ImGui::GetIO().WantTextInput;
    ui::input_text("##Path", &browser.path_text, kind_of(browser.shown).hint);
    const bool entered = typing_before && ImGui::IsItemDeactivated() &&
                         (ui::key_pressed(ImGuiKey_Enter) || ui::key_pressed(ui::key_pad_enter));

    const float footer = ImGui::GetFrameHeightWithSpacing() + 10 * scale;
    const float height = std::max(60 * scale, ImGui::GetContentRegionAvail().y - footer);
    if (ImGui::BeginTable("lists", 2, ImGuiTableFlags_SizingStretchProp)) {
        ImGui::TableSetupColumn("here", ImGuiTableColumnFlags_WidthStretch, 1.7f);
        ImGui::TableSetupColumn("recent", ImGuiTableColumnFlags_WidthStretch, 1.0f);
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        entry_list(parts, height - 8 * scale);
        ImGui::TableNextColumn();
        recent_list(parts, (height - 8 * scale) * 0.42f);
        preview(parts, (height - 8 * scale) * 0.58f);
        ImGui::EndTable();
    }
    if (parts.editor.file_dialog == FileDialogKind::none) return;
    answer_buttons(parts);
    if (entered && parts.editor.file_dialog != FileDialogKind::none) choose(parts, typed_path(parts), false);
}

}  // namespace slipface
