// The level's camera bookmarks: views with a name that one goes back to and that snapshot suites use.
#pragma once

#include "tools/editor.h"

namespace slipface {

// Each change is one step of history. `name` empty: the first free "Camera N". A name that exists is
// replaced.
void save_camera(Editor& editor, std::string name);
void go_to_camera(Editor& editor, std::size_t index);
void go_to_next_camera(Editor& editor,
                       int step);  // after, or before, the one gone to last; around at the ends
void replace_camera(Editor& editor, std::size_t index);  // by the view there is now
void remove_camera(Editor& editor, std::size_t index);
void rename_camera(Editor& editor, std::size_t index, const std::string& name);
std::string camera_name_problem(const Document& document, std::size_t index,
                                std::string_view name);  // empty: fine
std::optional<std::size_t> find_camera(const Document& document, std::string_view name);

}  // namespace slipface
