// The parts of the window. Each draws itself in every frame; layout() positions them.
#pragma once

#include <imgui.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/level_preview.h"
#include "app/level_thumbnails.h"
#include "document/folder_listing.h"
#include "panels/panels.h"

namespace slipface {

// The file dialog's state between frames.
struct FileBrowser {
    FileDialogKind shown = FileDialogKind::none;  // the dialog for which the rest was filled in
    std::filesystem::path folder;
    std::string path_text;  // the path box
    std::string chosen;     // the entry of `folder` in the path box, byte for byte; empty: the path was typed
    std::string problem;    // why the last choice was rejected
    std::vector<std::string> candidates;  // the possible names after Tab
    // The candidates, until the path box has taken the completed text.
    std::optional<std::vector<std::string>> completed;
    std::vector<StartFolder> places;

    FolderListing listing;          // of `folder`, sorted
    std::vector<std::size_t> rows;  // the entries that pass the filter
    ListingOrder order = ListingOrder::name;
    bool descending = false;
    std::string filter;
    std::size_t format = 0;  // index into level_formats()
    bool hidden = false;     // show hidden files

    enum class Box { none, path, filter };
    Box edited = Box::none;        // the box edited in the previous frame
    Box wants_typing = Box::none;  // this box gets the keyboard focus
    Box typed_into = Box::none;    // the box that was typed into last
    bool caret_to_end = false;     // once it has the focus, so that typing continues at the end

    std::filesystem::path overwrite;  // the file to confirm; empty: none
    int scroll_to = -1;               // row selected by key; -1: none
    std::filesystem::path previewed;  // the level selected last, by click or key
};

struct Parts {
    Parts(Editor& the_editor, FrameContext& the_frame) : editor(the_editor), frame(the_frame) {}

    Editor& editor;
    FrameContext& frame;
    bool deterministic = false;
    std::string hidden_folder;  // left out of messages, so that images do not depend on the files' location
    FileBrowser browser;
    LevelPreview* preview = nullptr;
    LevelThumbnails* thumbnails = nullptr;
    std::optional<std::vector<std::filesystem::path>> samples;  // the levels that ship with the program
    Tool last_tool = Tool::select;  // to detect a change: the probe tool opens the probe's numbers
};

void layout(Parts& parts, ImVec2 size);
float menu_bar(Parts& parts);  // returns its height
// The context menu of the view, which `opens` now; the face under the mouse is Editor::pointed meanwhile.
void view_menu(Editor& editor, bool opens);
void toolbar(Parts& parts);                                  // into the current window
float toolbar_height_in(const Editor& editor, float width);  // for a window this wide: one or two rows
void notices(Parts& parts);                                  // into the current window, below the toolbar
float notices_height(const Parts& parts);                    // 0: nothing needs attention
void status_bar(Parts& parts);                               // into the current window
void welcome(Parts& parts);                                  // into the current window, while nothing is open
void dialogs(Parts& parts);
void shortcuts_window(Editor& editor);
void command_palette(Editor& editor);
bool take_key_for_rebinding(Editor& editor, const Shortcut& key);  // true: the key was used
void guide(Parts& parts);  // the tour and the overlay of keys, on top of everything
bool guide_key(Editor& editor, const Shortcut& key);  // true: the tour or the overlay used the key
bool dialog_is_open(const Editor& editor);
void close_dialog(Editor& editor);  // as its Cancel button does
void file_browser(Parts& parts);    // inside the dialog's window

// The window's title: "easy.obj • — Slipface".
std::string window_title(const Editor& editor);
// The open level's name without its folder; empty when nothing is open.
std::string document_name(const Editor& editor);

}  // namespace slipface
