// The file dialog's state and its parts; file_browser() in parts.h draws it.
#pragma once

#include "app/file_kinds.h"
#include "app/parts.h"

namespace slipface {

// The path that the path box or the list shows.
std::filesystem::path typed_path(const Parts& parts);
std::filesystem::path typed_path(const Parts& parts, const std::string& text);
std::string shown_path(const Parts& parts, const std::filesystem::path& path);
void show_folder(Parts& parts, const std::filesystem::path& folder);
void filter_rows(FileBrowser& browser);  // after a change of the listing, the filter or the format
void sort_rows(FileBrowser& browser);
void choose_row(Parts& parts, std::size_t row);  // row of browser.rows; copies it into the path box
// Chooses `path`, by double click, Enter or the button.
void choose(Parts& parts, const std::filesystem::path& path, bool may_overwrite);

// Parts of the window, `height` pixels high.
void folder_list(Parts& parts, float height);
void entry_list(Parts& parts, float height);
void recent_list(Parts& parts, float height);
void level_preview(Parts& parts, float height);  // of the level selected in the list

}  // namespace slipface
