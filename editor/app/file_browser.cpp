// Choosing a file: folders to start from, a path box, a filter and a list, the same on every machine.
#include "app/file_browser.h"

#include <imgui_internal.h>
#include <imgui_stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "document/path_text.h"
#include "slipface/base/files.h"
#include "slipface/base/text.h"
#include "widgets/imgui_compat.h"
#include "widgets/theme.h"
#include "widgets/ui.h"

namespace slipface {
namespace {

namespace fs = std::filesystem;

bool is_folder(const fs::path& path) {
    std::error_code error;
    return fs::is_directory(path, error);
}

FolderWants wants_of(const FileBrowser& browser) {
    const FileKind& kind = file_kind(browser.shown);
    return {[&kind](const std::string& name) { return is_listed(kind, name); }, browser.hidden,
            browser.shown == FileDialogKind::open};
}

void list_again(FileBrowser& browser) {
    browser.listing = list_folder(browser.folder, wants_of(browser));
    sort_rows(browser);
}

// If a folder was renamed or deleted since: its nearest existing parent.
fs::path nearest_folder(fs::path folder) {
    while (!is_folder(folder) && folder.has_relative_path())
        folder = folder.parent_path();
    return folder;
}

// Levels that came with a package lie where their user cannot write: then files are saved at home.
fs::path folder_to_save_in(const fs::path& folder) {
    if (::access(folder.c_str(), W_OK) == 0) return folder;
    const char* const home = std::getenv("HOME");
    return home && *home == '/' && ::access(home, W_OK) == 0 ? fs::path(home) : folder;
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
    if (file_kind(editor.file_dialog).saves) folder = folder_to_save_in(folder);
    browser.shown = editor.file_dialog;
    browser.filter.clear();
    browser.format = 0;
    browser.wants_typing = FileBrowser::Box::none;
    browser.caret_to_end = false;
    // What is mounted differs from machine to machine.
    const Result<std::string> mounts =
        parts.deterministic ? Result<std::string>("") : read_file("/proc/self/mounts", 1u << 20);
    browser.places = usual_folders(mounts ? *mounts : std::string());
    show_folder(parts, folder.empty() ? fs::path(".") : nearest_folder(folder));
    if (!editor.document) return;
    const FileKind& kind = file_kind(editor.file_dialog);
    if (kind.kind == FileDialogKind::save_as)
        browser.path_text = shown_path(parts, browser.folder / editor.document->level().file_path.filename());
    else if (kind.saves)
        browser.path_text =
            shown_path(parts, browser.folder / editor.document->level().mesh_path.stem().concat(
                                                   std::string(kind.proposed) + kind.suffix));
}

// The list follows the folder of the path that is being typed.
void follow_typing(Parts& parts) {
    FileBrowser& browser = parts.browser;
    browser.chosen.clear();
    browser.candidates.clear();
    browser.problem.clear();
    const std::size_t slash = browser.path_text.rfind('/');
    if (slash == std::string::npos) return;
    const fs::path folder = typed_path(parts, browser.path_text.substr(0, slash + 1)).lexically_normal();
    if (!is_folder(folder) || folder == browser.folder / "") return;
    std::error_code error;
    const fs::path absolute = fs::weakly_canonical(folder, error);
    browser.folder = error ? folder : absolute;
    list_again(browser);
}

// Typing goes to the filter, or, with the beginning of a path, to the path box.
void take_typing(Parts& parts) {
    FileBrowser& browser = parts.browser;
    ImVector<ImWchar>& typed = ImGui::GetIO().InputQueueCharacters;
    // The box in which typing began gets the focus some frames later.
    const bool goes_on = browser.caret_to_end || browser.wants_typing != FileBrowser::Box::none;
    std::string text;
    for (const ImWchar c : typed) {
        char utf8[5] = {};
        ImTextCharToUtf8(utf8, c);
        const bool blank = static_cast<unsigned char>(utf8[0]) <= ' ';
        if (!blank || goes_on || !text.empty()) text += utf8;
    }
    if (text.empty()) return;
    typed.resize(0);
    if (!goes_on) {
        const bool path = text[0] == '/' || text[0] == '~';
        browser.typed_into = path ? FileBrowser::Box::path : FileBrowser::Box::filter;
        if (path) browser.path_text.clear();
    }
    browser.wants_typing = browser.typed_into;
    if (browser.typed_into == FileBrowser::Box::path) {
        browser.path_text += text;
        follow_typing(parts);
    } else {
        browser.filter += text;
        filter_rows(browser);
    }
}

// Keys that work while the path box is not being edited.
void keyboard(Parts& parts) {
    FileBrowser& browser = parts.browser;
    const bool in_filter = browser.edited == FileBrowser::Box::filter;
    const bool typing = ImGui::GetIO().WantTextInput;
    if (!browser.overwrite.empty() || (typing && !in_filter)) return;
    if (!typing) take_typing(parts);
    if (browser.filter.empty() && ui::key_pressed(ImGuiKey_Backspace))
        return show_folder(parts, browser.folder.parent_path());
    if (browser.rows.empty()) return;
    const auto pressed = [&](ImGuiKey key, int rows) { return ui::key_pressed(key) ? rows : 0; };
    constexpr int page = 12;
    int step = pressed(ImGuiKey_DownArrow, 1) - pressed(ImGuiKey_UpArrow, 1) +
               pressed(ImGuiKey_PageDown, page) - pressed(ImGuiKey_PageUp, page);
    const int last = static_cast<int>(browser.rows.size()) - 1;
    if (!typing) step += pressed(ImGuiKey_End, last) - pressed(ImGuiKey_Home, last);
    if (step == 0) return;
    int row = step > 0 ? -1 : last + 1;
    for (int i = 0; i <= last; ++i)
        if (browser.listing.entries[browser.rows[static_cast<std::size_t>(i)]].name == browser.chosen &&
            !browser.chosen.empty())
            row = i;
    row = std::clamp(row + step, 0, last);
    choose_row(parts, static_cast<std::size_t>(row));
    browser.scroll_to = row;
}

int path_box_event(ImGuiInputTextCallbackData* data) {
    Parts& parts = *static_cast<Parts*>(data->UserData);
    FileBrowser& browser = parts.browser;
    if (data->EventFlag == ImGuiInputTextFlags_CallbackAlways && browser.caret_to_end) {
        data->CursorPos = data->SelectionStart = data->SelectionEnd = data->BufTextLen;
        browser.caret_to_end = false;
    }
    if (data->EventFlag != ImGuiInputTextFlags_CallbackCompletion) return 0;
    const fs::path base = parts.hidden_folder.empty() ? browser.folder : fs::path(parts.hidden_folder);
    PathCompletion completion = complete_path(
        std::string_view(data->Buf, static_cast<std::size_t>(data->BufTextLen)), base, wants_of(browser));
    data->DeleteChars(0, data->BufTextLen);
    data->InsertChars(0, completion.text.c_str());
    browser.completed = std::move(completion.others);
    return 0;
}

int filter_box_event(ImGuiInputTextCallbackData* data) {
    FileBrowser& browser = *static_cast<FileBrowser*>(data->UserData);
    if (data->EventFlag == ImGuiInputTextFlags_CallbackAlways && browser.caret_to_end) {
        data->CursorPos = data->SelectionStart = data->SelectionEnd = data->BufTextLen;
        browser.caret_to_end = false;
    }
    return 0;  // Up and Down belong to the list; querying them stops them from moving the focus
}

bool enter_pressed() {
    return ui::key_pressed(ImGuiKey_Enter) || ui::key_pressed(ui::key_pad_enter);
}

// Moves the keyboard focus to the box in which the user began to type. True for that box.
void focus_if_wanted(FileBrowser& browser, FileBrowser::Box box, const char* label) {
    if (browser.wants_typing != box) return;
    ui::focus_text_box(label);
    browser.wants_typing = FileBrowser::Box::none;
    browser.caret_to_end = true;
}

// True: the user pressed Enter in it.
bool path_box(Parts& parts) {
    FileBrowser& browser = parts.browser;
    focus_if_wanted(browser, FileBrowser::Box::path, "##Path");
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
    constexpr int flags = ImGuiInputTextFlags_CallbackCompletion | ImGuiInputTextFlags_CallbackAlways;
    if (ImGui::InputTextWithHint("##Path", file_kind(browser.shown).hint, &browser.path_text, flags,
                                 path_box_event, &parts))
        follow_typing(parts);
    if (browser.completed) browser.candidates = *std::exchange(browser.completed, {});
    ui::record_last_item("Path");
    if (ImGui::IsItemActive()) browser.edited = FileBrowser::Box::path;
    return ImGui::IsItemDeactivated() && enter_pressed();
}

bool filter_row(Parts& parts) {
    FileBrowser& browser = parts.browser;
    const float scale = ui::scale();
    const bool opens = browser.shown == FileDialogKind::open;
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float hidden_width = ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x +
                               ImGui::CalcTextSize("Hidden files").x;
    const float format_width = opens ? 150 * scale + gap : 0.0f;
    focus_if_wanted(browser, FileBrowser::Box::filter, "##Filter");
    ImGui::SetNextItemWidth(
        std::max(60 * scale, ImGui::GetContentRegionAvail().x - hidden_width - format_width - gap));
    constexpr int flags = ImGuiInputTextFlags_CallbackHistory | ImGuiInputTextFlags_CallbackAlways;
    const bool changed = ImGui::InputTextWithHint("##Filter", "Filter: type a part of the name",
                                                  &browser.filter, flags, filter_box_event, &browser);
    ui::record_last_item("Filter");
    if (ImGui::IsItemActive()) browser.edited = FileBrowser::Box::filter;
    const bool entered = ImGui::IsItemDeactivated() && enter_pressed();
    // Escape first clears the filter.
    if (ImGui::IsItemDeactivated() && ui::key_pressed(ImGuiKey_Escape)) browser.filter.clear();
    if (changed || ImGui::IsItemDeactivated()) filter_rows(browser);
    if (opens) {
        ImGui::SameLine();
        ImGui::SetNextItemWidth(format_width - gap);
        const std::vector<std::string>& formats = level_formats();
        const bool open = ImGui::BeginCombo("##Format", formats[browser.format].c_str());
        open ? ui::record_again("Format") : ui::record_last_item("Format");
        if (open) {
            const ui::Scope scope("Format");
            for (std::size_t i = 0; i < formats.size(); ++i) {
                if (!ui::selectable(formats[i].c_str(), i == browser.format)) continue;
                browser.format = i;
                filter_rows(browser);
            }
            ui::end(ImGui::EndCombo);
        }
    }
    ImGui::SameLine();
    if (ui::checkbox("Hidden files", &browser.hidden, "Show hidden files (names that begin with a dot)"))
        list_again(browser);
    return entered;
}

// At the left of the buttons, clipped to the free width.
void footer_text(const ImVec4& color, const std::string& text, float right) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::PushClipRect(at, {ImGui::GetWindowPos().x + right, at.y + ImGui::GetFrameHeight()}, true);
    ImGui::TextColored(color, "%s", text.c_str());
    ImGui::PopClipRect();
    ui::tooltip(text.c_str());
}

void answer_buttons(Parts& parts) {
    FileBrowser& browser = parts.browser;
    const float width = 110 * ui::scale();
    const float x = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - 2 * width -
                    ImGui::GetStyle().ItemSpacing.x;
    ImGui::AlignTextToFramePadding();
    const float text_end = x - ImGui::GetStyle().ItemSpacing.x;
    if (!browser.overwrite.empty()) {
        std::string names;
        for (const fs::path& file : replaced_files(file_kind(browser.shown), browser.overwrite))
            names += (names.empty() ? "" : " and ") + printable(file.filename().string());
        footer_text(ui::palette().accent, "Replace " + names + "?", text_end);
        ImGui::SameLine(x);
        if (ui::button("Keep it", nullptr, true, {width, 0})) browser.overwrite.clear();
        ImGui::SameLine();
        if (ui::primary_button("Replace", true, {width, 0})) choose(parts, fs::path(browser.overwrite), true);
        return;
    }
    if (!browser.problem.empty()) {
        footer_text(ui::palette().bad, browser.problem, text_end);
        ui::record_last_item("Problem");
    } else {
        std::string names;
        for (std::size_t i = 0; i < browser.candidates.size() && i < 30; ++i)
            names += (i > 0 ? "   " : "") + browser.candidates[i];
        footer_text(ui::palette().muted, names, text_end);
        if (!names.empty()) ui::record_last_item("Candidates");
    }
    ImGui::SameLine(x);
    if (ui::button("Cancel", nullptr, true, {width, 0})) parts.editor.file_dialog = FileDialogKind::none;
    ImGui::SameLine();
    if (ui::primary_button(file_kind(browser.shown).saves ? "Save" : "Open", !browser.path_text.empty(),
                           {width, 0}))
        choose(parts, typed_path(parts), false);
}

void columns(Parts& parts, float height) {
    const float scale = ui::scale();
    const bool narrow = ImGui::GetContentRegionAvail().x < 740 * scale;
    if (!ImGui::BeginTable("columns", narrow ? 2 : 3, ImGuiTableFlags_SizingFixedFit)) return;
    ImGui::TableSetupColumn("places", ImGuiTableColumnFlags_WidthFixed, 138 * scale);
    ImGui::TableSetupColumn("here", ImGuiTableColumnFlags_WidthStretch);
    if (!narrow) ImGui::TableSetupColumn("recent", ImGuiTableColumnFlags_WidthFixed, 230 * scale);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    folder_list(parts, height);
    ImGui::TableNextColumn();
    entry_list(parts, height);
    if (!narrow) {
        ImGui::TableNextColumn();
        recent_list(parts, height * 0.5f - ImGui::GetStyle().ItemSpacing.y);
        level_preview(parts, height * 0.5f);
    }
    ImGui::EndTable();
}

}  // namespace

std::string shown_path(const Parts& parts, const fs::path& path) {
    std::string text = path.string();
    if (!parts.hidden_folder.empty() && text.starts_with(parts.hidden_folder))
        text.erase(0, parts.hidden_folder.size());
    return printable(text);
}

fs::path typed_path(const Parts& parts, const std::string& text) {
    const fs::path path = expand_tilde(text);
    if (path.is_absolute()) return path;
    return (parts.hidden_folder.empty() ? parts.browser.folder : fs::path(parts.hidden_folder)) / path;
}

fs::path typed_path(const Parts& parts) {
    const FileBrowser& browser = parts.browser;
    return browser.chosen.empty() ? typed_path(parts, browser.path_text) : browser.folder / browser.chosen;
}

void filter_rows(FileBrowser& browser) {
    browser.rows.clear();
    const std::string wanted = to_lower(browser.filter);
    for (std::size_t i = 0; i < browser.listing.entries.size(); ++i) {
        const FolderEntry& entry = browser.listing.entries[i];
        if (!entry.folder && !is_of_format(browser.format, entry.name)) continue;
        if (to_lower(entry.name).find(wanted) != std::string::npos) browser.rows.push_back(i);
    }
}

void sort_rows(FileBrowser& browser) {
    sort_listing(browser.listing.entries, browser.order, browser.descending);
    filter_rows(browser);
}

void show_folder(Parts& parts, const fs::path& folder) {
    FileBrowser& browser = parts.browser;
    std::error_code error;
    const fs::path absolute = fs::weakly_canonical(folder, error);
    browser.folder = error ? folder : absolute;
    browser.filter.clear();
    list_again(browser);
    browser.path_text = shown_path(parts, browser.folder / "");
    browser.chosen.clear();
    browser.candidates.clear();
    browser.problem.clear();
    browser.overwrite.clear();
    browser.scroll_to = 0;
}

void choose_row(Parts& parts, std::size_t row) {
    FileBrowser& browser = parts.browser;
    browser.chosen = browser.listing.entries[browser.rows[row]].name;
    browser.path_text = shown_path(parts, browser.folder / browser.chosen);
    browser.problem.clear();
    browser.candidates.clear();
}

void choose(Parts& parts, const fs::path& path, bool may_overwrite) {
    FileBrowser& browser = parts.browser;
    Editor& editor = parts.editor;
    if (is_folder(path)) {
        show_folder(parts, path);
        return;
    }
    std::error_code error;
    const FileKind& kind = file_kind(browser.shown);
    if (!kind.saves) {
        if (!fs::exists(path, error)) {
            browser.problem = (error ? "Cannot be examined (" + error.message() + "): " : "No such file: ") +
                              printable(path.filename().string());
            return;
        }
        editor.file_dialog = FileDialogKind::none;
        kind.chosen(editor, path);
        return;
    }
    fs::path target = path;
    if (!has_suffix(kind, target.filename().string())) target += kind.suffix;
    if (!is_folder(target.parent_path())) {
        browser.problem = "No such folder: " + printable(target.parent_path().string());
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

void file_browser(Parts& parts) {
    FileBrowser& browser = parts.browser;
    if (browser.shown != parts.editor.file_dialog) begin(parts);
    const ui::Scope scope("File dialog");
    const float scale = ui::scale();
    ui::push_font(ui::fonts().semibold);
    ImGui::TextUnformatted(file_kind(browser.shown).title);
    ImGui::PopFont();
    ImGui::Dummy({0, 2 * scale});

    keyboard(parts);
    browser.edited = FileBrowser::Box::none;
    if (ui::button("\uf062###Up", "Parent folder (Backspace)"))
        show_folder(parts, browser.folder.parent_path());
    ImGui::SameLine();
    const bool path_entered = path_box(parts);
    const bool filter_entered = filter_row(parts);

    const ImGuiStyle& style = ImGui::GetStyle();
    const float footer =
        ImGui::GetFrameHeight() + 2 * (style.ItemSpacing.y + style.CellPadding.y) + 2 * scale;
    columns(parts, std::max(60 * scale, ImGui::GetContentRegionAvail().y - footer));
    if (parts.editor.file_dialog == FileDialogKind::none) return;
    answer_buttons(parts);
    if (parts.editor.file_dialog == FileDialogKind::none) return;
    if (filter_entered && browser.chosen.empty() && !browser.rows.empty()) choose_row(parts, 0);
    if (path_entered || (filter_entered && !browser.chosen.empty())) choose(parts, typed_path(parts), false);
}

}  // namespace slipface
