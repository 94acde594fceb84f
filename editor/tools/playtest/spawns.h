// The level's spawns: positions where a walk can begin. The first in the list is the main one, where Play
// begins.
#pragma once

#include "tools/editor.h"

namespace slipface {

// Each change is one step of history. add_spawn and move_spawn use the target (tools/target.h) and the view's
// yaw; without one they only write to the status bar.
void add_spawn(Editor& editor);  // named with the first free "Spawn N", last in the list
void move_spawn(Editor& editor, std::size_t index);
void put_spawn_in_view(Editor& editor);        // the main one; the first, where there is none
void put_spawn_on_open_floor(Editor& editor);  // the main one, near the level's middle (find_open_floor)
void remove_spawn(Editor& editor, std::size_t index);
void rename_spawn(Editor& editor, std::size_t index, const std::string& name);
void make_main_spawn(Editor& editor, std::size_t index);  // to the front of the list
// Why the spawn cannot have that name; empty: it can.
std::string spawn_name_problem(const Document& document, std::size_t index, const std::string& name);

}  // namespace slipface
