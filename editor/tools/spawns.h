// The level's spawns: where a walk may begin. The first in the list is the main one, where Play begins.
#pragma once

#include "tools/editor.h"

namespace slipface {

// Each change is one step of history. A spawn is put on the face in the middle of the view, looking where the
// view looks; nothing happens, but for a word in the status bar, where there is none.
void add_spawn(Editor& editor);          // under the first free "Spawn N", the last in the list
void add_spawn_hovered(Editor& editor);  // on the face under the mouse
void move_spawn(Editor& editor, std::size_t index);
void remove_spawn(Editor& editor, std::size_t index);
void rename_spawn(Editor& editor, std::size_t index, const std::string& name);
void make_main_spawn(Editor& editor, std::size_t index);  // to the front of the list
std::string spawn_name_problem(const Document& document, std::size_t index,
                               const std::string& name);  // empty: fine

}  // namespace slipface
