// The functions behind the rows of the command table. Only commands_<area>.cpp use them.
#pragma once

#include "tools/editor.h"

namespace slipface::command_actions {

// Conditions.
bool always(const Editor& editor);
bool has_document(const Editor& editor);
bool has_selection(const Editor& editor);
bool has_hovered(const Editor& editor);
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
// The row of settings_table() as a switch.
bool setting_is_on_at(const Editor& editor, std::size_t row);
void toggle_setting_at(Editor& editor, std::size_t row);
// The row of shipped_presets().
bool preset_is_used_at(const Editor& editor, std::size_t row);
void use_preset_at(Editor& editor, std::size_t row);

// Functions without captures for the table, one per argument.
template <std::size_t Row>
bool setting_is_on(const Editor& editor) {
    return setting_is_on_at(editor, Row);
}
template <std::size_t Row>
void toggle_setting(Editor& editor) {
    toggle_setting_at(editor, Row);
}
template <std::size_t Row>
bool preset_is_used(const Editor& editor) {
    return preset_is_used_at(editor, Row);
}
template <std::size_t Row>
void use_shipped_preset(Editor& editor) {
    use_preset_at(editor, Row);
}
template <std::size_t Digit>
bool has_hotkey(const Editor& editor) {
    return surface_with_hotkey(editor, Digit).has_value();
}
template <std::size_t Digit>
bool brush_has_hotkey(const Editor& editor) {
    return editor.brush && editor.brush == surface_with_hotkey(editor, Digit);
}
template <std::size_t Digit>
void brush_by_hotkey(Editor& editor) {
    choose_brush(editor, surface_with_hotkey(editor, Digit));
}
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
template <std::size_t Row>
bool panel_is_shown(const Editor& editor) {
    return editor.layout.shown(panel_table()[Row].id);
}
template <std::size_t Row>
void toggle_panel_at(Editor& editor) {
    editor.layout.toggle(panel_table()[Row].id);
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
