#include "tools/commands/command_actions.h"

#include <algorithm>
#include <utility>

#include "document/faces.h"
#include "tools/lab/lab_actions.h"

namespace slipface::command_actions {
namespace {

constexpr double smallest_brush_m = 0.25, largest_brush_m = 64.0;

std::string metres_text(double metres) {
    std::string text = std::to_string(metres);
    return text.substr(0, text.find('.') + 3) + " m";
}

void report_brush_size(Editor& editor) {
    editor.status = editor.brush_radius > 0.0 ? "Brush radius " + metres_text(editor.brush_radius)
                                              : "Brush: single faces";
}

}  // namespace

bool always(const Editor& /*editor*/) {
    return true;
}
bool has_document(const Editor& editor) {
    return editor.document != nullptr;
}
bool has_selection(const Editor& editor) {
    return editor.document && !editor.document->selection().empty();
}
bool can_undo(const Editor& editor) {
    return editor.document && (editor.document->can_undo() || editor.lab.can_undo_edit(*editor.document));
}
bool can_redo(const Editor& editor) {
    return editor.document && (editor.document->can_redo() || editor.lab.can_redo_edit(*editor.document));
}
bool is_playing(const Editor& editor) {
    return editor.playtest.has_value();
}
bool is_first_person(const Editor& editor) {
    return editor.playtest && editor.playtest->first_person;
}
bool probe_is_placed(const Editor& editor) {
    return editor.probe.placed;
}
bool brush_can_shrink(const Editor& editor) {
    return editor.brush_radius > 0.0;
}
bool brush_is_unset(const Editor& editor) {
    return !editor.brush;
}
bool overlay_is_on(const Editor& editor) {
    return editor.style.overlay > 0.0f;
}
bool movement_differs(const Editor& editor) {
    return editor.document && !(editor.document->level().movement == MovementSettings{});
}

void open_file(Editor& editor) {
    editor.file_dialog = FileDialogKind::open;
}
void save(Editor& editor) {
    save_level(editor);
}
void save_as(Editor& editor) {
    editor.file_dialog = FileDialogKind::save_as;
}

void undo(Editor& editor) {
    if (editor.lab.can_undo_edit(*editor.document)) {
        editor.lab.undo_edit(*editor.document);
        editor.status = "Undone: Change inputs";
        return;
    }
    editor.status = "Undone: " + editor.document->history()[editor.document->history_cursor() - 1].name;
    editor.document->undo();
}

void redo(Editor& editor) {
    if (editor.lab.can_redo_edit(*editor.document)) {
        editor.lab.redo_edit(*editor.document);
        editor.status = "Done again: Change inputs";
        return;
    }
    editor.status = "Done again: " + editor.document->history()[editor.document->history_cursor()].name;
    editor.document->redo();
}

void fill_selection(Editor& editor) {
    paint_faces(editor, editor.document->selection(), editor.brush);
}
void unset_selection(Editor& editor) {
    paint_faces(editor, editor.document->selection(), std::nullopt);
}

void frame_selection(Editor& editor) {
    frame_selected(editor, editor.view_aspect);
}
void frame_all(Editor& editor) {
    frame_pane(editor, editor.panes.active);
}

void toggle_overlay(Editor& editor) {
    if (overlay_is_on(editor))
        editor.overlay_strength = std::exchange(editor.style.overlay, 0.0f);
    else
        editor.style.overlay =
            editor.overlay_strength > 0.0f ? editor.overlay_strength : LevelStyle{}.overlay;
}

void reset_layout(Editor& editor) {
    editor.layout = {};
    editor.status = "Layout reset";
}

void larger_brush(Editor& editor) {
    editor.brush_radius =
        editor.brush_radius > 0.0 ? std::min(2.0 * editor.brush_radius, largest_brush_m) : smallest_brush_m;
    report_brush_size(editor);
}

void smaller_brush(Editor& editor) {
    editor.brush_radius = editor.brush_radius > smallest_brush_m ? 0.5 * editor.brush_radius : 0.0;
    report_brush_size(editor);
}

void brush_unset(Editor& editor) {
    choose_brush(editor, std::nullopt);
}
void clear_probe(Editor& editor) {
    editor.probe = {};
}
void toggle_person(Editor& editor) {
    editor.playtest->first_person = !editor.playtest->first_person;
}
void reset_movement(Editor& editor) {
    editor.document->set_movement({}, "Reset movement");
}

std::optional<SurfaceId> surface_with_hotkey(const Editor& editor, std::size_t digit) {
    if (!editor.document) return std::nullopt;
    const std::vector<SurfaceType>& surfaces = editor.document->level().surfaces;
    for (std::size_t i = 0; i < surfaces.size(); ++i)
        if (surfaces[i].hotkey == static_cast<int>(digit)) return static_cast<SurfaceId>(i);
    return std::nullopt;
}

std::string type_on_key(const Editor& editor, std::size_t digit) {
    const std::optional<SurfaceId> surface = surface_with_hotkey(editor, digit);
    return surface ? editor.document->level().surfaces[*surface].name : std::string();
}

}  // namespace slipface::command_actions
