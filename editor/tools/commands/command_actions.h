// The functions behind the rows of the command table. Only commands_<area>.cpp use them.
#pragma once

#include "tools/editor.h"

namespace slipface::command_actions {

// Conditions.
bool always(const Editor& editor);
bool has_document(const Editor& editor);
bool has_selection(const Editor& editor);
bool can_undo(const Editor& editor);
bool can_redo(const Editor& editor);
bool is_playing(const Editor& editor);
bool is_first_person(const Editor& editor);
bool probe_is_placed(const Editor& editor);
bool brush_can_shrink(const Editor& editor);
bool brush_is_unset(const Editor& editor);
bool overlay_is_on(const Editor& editor);
bool movement_differs(const Editor& editor);

// Actions.
void open_file(Editor& editor);
void save(Editor& editor);
void save_as(Editor& editor);
template <FileDialogKind Which>
void ask_for_file(Editor& editor) {
    editor.file_dialog = Which;
}
void undo(Editor& editor);
void redo(Editor& editor);
void fill_selection(Editor& editor);
void unset_selection(Editor& editor);
void frame_selection(Editor& editor);
void frame_all(Editor& editor);
void toggle_overlay(Editor& editor);
void reset_layout(Editor& editor);
void larger_brush(Editor& editor);
void smaller_brush(Editor& editor);
void brush_unset(Editor& editor);
void clear_probe(Editor& editor);
void toggle_person(Editor& editor);
void reset_movement(Editor& editor);

// The type with a hotkey, or nothing.
std::optional<SurfaceId> surface_with_hotkey(const Editor& editor, std::size_t digit);
std::string type_on_key(const Editor& editor, std::size_t digit);  // its name; empty: no type has the key
// Functions without captures for the table, one per argument.
template <Tool Which>
bool tool_is(const Editor& editor) {
    return editor.tool == Which;
}
template <Tool Which>
void use_tool(Editor& editor) {
    editor.tool = Which;
}
template <bool LevelStyle::*Flag>
bool flag_is(const Editor& editor) {
    return editor.style.*Flag;
}
template <bool LevelStyle::*Flag>
void toggle_flag(Editor& editor) {
    editor.style.*Flag = !(editor.style.*Flag);
}
template <bool Editor::*Panel>
bool shown(const Editor& editor) {
    return editor.*Panel;
}
template <bool Editor::*Panel>
void toggle_shown(Editor& editor) {
    editor.*Panel = !(editor.*Panel);
}

}  // namespace slipface::command_actions
