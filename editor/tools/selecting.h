// Choosing faces with the mouse and by command: everything that ends in Document::select().
#pragma once

#include "document/selection.h"
#include "tools/editor.h"

namespace slipface {

// What a new choice does to the selection there is.
enum class SelectBy { replace, add, remove, toggle };

// Selects as one step of history and tells in the status line how many are selected now.
void apply_selection(Editor& editor, std::vector<FaceId> faces, SelectBy by, const std::string& step_name);

// What "connected" and "similar" begin with: the selection, or the face under the mouse when nothing is
// selected.
std::vector<FaceId> seed_faces(const Editor& editor);

// A click with the select tool on the face under the mouse; empty space clears unless something is added.
void click_select(Editor& editor, SelectBy by);
// The connected faces in the plane of the face under the mouse.
void select_flat_hovered(Editor& editor, SelectBy by);
// The faces that the selecting brush covers, within the open transaction if there is one.
void brush_select(Editor& editor, SelectBy by);

// Selects the next face (step 1) or the one before (-1) of those that the ray goes through, beginning with
// the one that alone is selected; the nearest when there is none.
void drill_select(Editor& editor, const Ray& ray, int step);

// Faces inside an outline drawn in a view of `size` pixels: those of which a part can be seen there, or with
// Editor::select_through those whose centre lies inside, seen or not. With Editor::select_whole only those of
// them that no edge leads out of the outline. Ascending.
std::vector<FaceId> faces_in_outline(Editor& editor, const Camera& camera, const Vec2& size,
                                     std::span<const Vec2> outline);
bool inside_outline(std::span<const Vec2> outline, const Vec2& pixel);  // even and odd crossings

// Selections kept under a name. `name` empty: the first free "Selection N".
void save_selection(Editor& editor, std::string name);
void recall_selection(Editor& editor, std::size_t index, SelectBy by);
void rename_selection(Editor& editor, std::size_t index, const std::string& name);
void replace_selection(Editor& editor, std::size_t index);  // by the faces selected now
void remove_selection(Editor& editor, std::size_t index);
std::optional<std::size_t> find_selection(const Document& document, std::string_view name);

// Every face of type `from` gets type `to`, in one step; within the selection if there is one.
void replace_type(Editor& editor, SurfaceId from, std::optional<SurfaceId> to);

}  // namespace slipface
