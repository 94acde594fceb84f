// The parts of the window. Each draws itself every frame; layout() gives each its place.
#pragma once

#include <imgui.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

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
};

// Sizes that the user may drag, in design pixels.
struct LayoutSizes {
    float left = 264.0f;
    float right = 344.0f;
    float inspector = 210.0f;
};

struct Parts {
    Parts(Editor& the_editor, FrameContext& the_frame) : editor(the_editor), frame(the_frame) {}

    Editor& editor;
    FrameContext& frame;
    bool deterministic = false;
    std::string hidden_folder;  // left out of messages, so that pictures do not depend on where the files lie
    FileBrowser browser;
    LayoutSizes sizes;
    Tool last_tool = Tool::select;     // to notice a change: the probe tool opens the probe's numbers
    const char* wanted_tab = nullptr;  // to be opened in the right column
    Warnings texture_warnings;         // of the level that is shown
};

void layout(Parts& parts, ImVec2 size);
float menu_bar(Parts& parts);   // returns its height
void toolbar(Parts& parts);     // into the current window
void status_bar(Parts& parts);  // into the current window
void welcome(Parts& parts);     // into the current window: nothing is open
void dialogs(Parts& parts);
void shortcuts_window(Editor& editor);
bool dialog_is_open(const Editor& editor);
void close_dialog(Editor& editor);  // as its Cancel does
void file_browser(Parts& parts);    // inside the dialog's window

// A folder's levels and folders, sorted; nothing when it cannot be read.
std::vector<FileBrowser::Entry> list_folder(const std::filesystem::path& folder);

// Of the window: "easy.obj • — Slipface".
std::string window_title(const Editor& editor);
// The open level's name without its folder; empty when nothing is open.
std::string document_name(const Editor& editor);

}  // namespace slipface
