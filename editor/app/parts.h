// The parts of the window. Each draws itself every frame; layout() gives each its place.
#pragma once

#include <imgui.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/level_preview.h"
#include "panels/panels.h"

namespace slipface {

// The file dialog's state between frames.
struct FileBrowser {
    struct Entry {
        std::string name;
        bool folder = false;
    };
    FileDialogKind shown = FileDialogKind::none;  // what the rest was filled for
    std::filesystem::path folder;
    std::string path_text;            // the path box
    std::string problem;              // why the last answer was not taken
    std::vector<Entry> entries;       // of `folder`: folders first, then by name
    std::filesystem::path overwrite;  // asked about; empty: nothing
    int scroll_to = -1;               // the row that the keyboard chose; -1: none
    std::filesystem::path previewed;  // the level that was looked at last, by click or key
};

struct Parts {
    Parts(Editor& the_editor, FrameContext& the_frame) : editor(the_editor), frame(the_frame) {}

    Editor& editor;
    FrameContext& frame;
    bool deterministic = false;
    std::string hidden_folder;  // left out of messages, so that pictures do not depend on where the files lie
    FileBrowser browser;
    LevelPreview* preview = nullptr;
    Tool last_tool = Tool::select;  // to notice a change: the probe tool opens the probe's numbers
    std::array<std::optional<PanelId>, dock_count> opened_tabs;  // what ImGui was told to open last
};

void layout(Parts& parts, ImVec2 size);
float menu_bar(Parts& parts);   // returns its height
void toolbar(Parts& parts);     // into the current window
void status_bar(Parts& parts);  // into the current window
void welcome(Parts& parts);     // into the current window: nothing is open
void dialogs(Parts& parts);
void shortcuts_window(Editor& editor);
void command_palette(Editor& editor);
bool take_key_for_rebinding(Editor& editor, const Shortcut& key);  // true: it was waited for
void guide(Parts& parts);                             // the tour and the overlay of keys, over everything
bool guide_key(Editor& editor, const Shortcut& key);  // true: the tour or the overlay took it
bool dialog_is_open(const Editor& editor);
void close_dialog(Editor& editor);  // as its Cancel does
void file_browser(Parts& parts);    // inside the dialog's window

// A folder's folders and files of the kind asked for, sorted; nothing when it cannot be read.
std::vector<FileBrowser::Entry> list_folder(const std::filesystem::path& folder,
                                            FileDialogKind kind = FileDialogKind::open);

// Of the window: "easy.obj • — Slipface".
std::string window_title(const Editor& editor);
// The open level's name without its folder; empty when nothing is open.
std::string document_name(const Editor& editor);

}  // namespace slipface
