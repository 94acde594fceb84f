// Choosing faces with the mouse and by command: everything that ends in Document::select().
#pragma once

#include "document/selection.h"
#include "tools/editor.h"

namespace slipface {

// How new faces change the selection.
enum class SelectBy { replace, add, remove, toggle };

// Selects as one step of history and writes the number of selected faces to the status line.
void apply_selection(Editor& editor, std::vector<FaceId> faces, SelectBy by, const std::string& step_name);

// Where "connected" and "similar" start: the selection, or the target (tools/target.h) if nothing is
// selected.
std::vector<FaceId> seed_faces(const Editor& editor);

// A click with the select tool on the face under the mouse. A click on empty space clears the selection,
// except when adding.
void click_select(Editor& editor, SelectBy by);
// Selects the connected faces in the plane of the face under the mouse.
void select_flat_hovered(Editor& editor, SelectBy by);
// Selects the faces under the selecting brush, inside the open transaction if there is one.
void brush_select(Editor& editor, SelectBy by);

// Selects the next (step 1) or previous (-1) of the faces along the ray, counted from the one that alone is
// selected; without one, the nearest.
void drill_select(Editor& editor, const Ray& ray, int step);

// Faces inside an outline drawn in a view of `size` pixels. Default: those with a visible part inside. With
// Editor::select_through: those with their centre inside, visible or not. Editor::select_whole then drops
// faces with an edge that leaves the outline. Ascending.
std::vector<FaceId> faces_in_outline(Editor& editor, const Camera& camera, const Vec2& size,
                                     std::span<const Vec2> outline);
bool inside_outline(std::span<const Vec2> outline, const Vec2& pixel);  // even-odd rule

// Named selections. An empty `name` means the first free "Selection N".
void save_selection(Editor& editor, std::string name);
void recall_selection(Editor& editor, std::size_t index, SelectBy by);
void rename_selection(Editor& editor, std::size_t index, const std::string& name);
void replace_selection(Editor& editor, std::size_t index);  // with the faces selected now
void remove_selection(Editor& editor, std::size_t index);
std::optional<std::size_t> find_selection(const Document& document, std::string_view name);

// Changes every face of type `from` to type `to`, as one step; only inside the selection if there is one.
void replace_type(Editor& editor, SurfaceId from, std::optional<SurfaceId> to);

}  // namespace slipface
