// The parts of the window. Each draws itself every frame; layout() gives each its place.
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
    FileDialogKind shown = FileDialogKind::none;  // what the rest was filled for
    std::filesystem::path folder;
    std::string path_text;  // the path box
    std::string chosen;   // the entry of `folder` that the path box shows, byte for byte; empty: it was typed
    std::string problem;  // why the last answer was not taken
    std::vector<std::string> candidates;  // what Tab found to go on with
    std::optional<std::vector<std::string>>
        completed;  // the same, while the path box still has to take the text
    std::vector<StartFolder> places;

    FolderListing listing;          // of `folder`, sorted
    std::vector<std::size_t> rows;  // of its entries, what passes the filter
    ListingOrder order = ListingOrder::name;
    bool descending = false;
    std::string filter;
    std::size_t format = 0;  // of level_formats()
    bool hidden = false;     // files

    enum class Box { none, path, filter };
    Box edited = Box::none;        // in the frame before
    Box wants_typing = Box::none;  // gets the keyboard's focus
    Box typed_into = Box::none;    // what wanted it last
    bool caret_to_end = false;     // when it has it; until then typing goes on into it

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
    LevelThumbnails* thumbnails = nullptr;
    std::optional<std::vector<std::filesystem::path>> samples;  // the levels that come with the program
    Tool last_tool = Tool::select;  // to notice a change: the probe tool opens the probe's numbers
};

void layout(Parts& parts, ImVec2 size);
float menu_bar(Parts& parts);                                // returns its height
void toolbar(Parts& parts);                                  // into the current window
float toolbar_height_in(const Editor& editor, float width);  // of a window so wide: one line or two
void status_bar(Parts& parts);                               // into the current window
void welcome(Parts& parts);                                  // into the current window: nothing is open
void dialogs(Parts& parts);
void shortcuts_window(Editor& editor);
void command_palette(Editor& editor);
bool take_key_for_rebinding(Editor& editor, const Shortcut& key);  // true: it was waited for
void guide(Parts& parts);                             // the tour and the overlay of keys, over everything
bool guide_key(Editor& editor, const Shortcut& key);  // true: the tour or the overlay took it
bool dialog_is_open(const Editor& editor);
void close_dialog(Editor& editor);  // as its Cancel does
void file_browser(Parts& parts);    // inside the dialog's window

// Of the window: "easy.obj • — Slipface".
std::string window_title(const Editor& editor);
// The open level's name without its folder; empty when nothing is open.
std::string document_name(const Editor& editor);

}  // namespace slipface
