// The level's camera bookmarks: named views to return to, also used by snapshot suites.
#pragma once

#include "tools/editor.h"

namespace slipface {

// Each change is one step of history. An empty `name` means the first free "Camera N". An existing name is
// replaced.
void save_camera(Editor& editor, std::string name);
void go_to_camera(Editor& editor, std::size_t index);
// The next (step 1) or previous (-1) after the one used last; wraps around.
void go_to_next_camera(Editor& editor, int step);
void replace_camera(Editor& editor, std::size_t index);  // with the current view
void remove_camera(Editor& editor, std::size_t index);
void rename_camera(Editor& editor, std::size_t index, const std::string& name);
// Why the camera cannot have that name; empty: it can.
std::string camera_name_problem(const Document& document, std::size_t index, std::string_view name);
std::optional<std::size_t> find_camera(const Document& document, std::string_view name);

}  // namespace slipface
