// What in the level a command acts on. Whichever way a command is run - by key, menu, context menu, palette
// or script - it asks here, so that none of them works only with the mouse over a face.
#pragma once

#include <optional>

#include "tools/editor.h"

namespace slipface {

// The face in the middle of the active view; nothing: none is there.
std::optional<FacePoint> middle_of_view(const Editor& editor);

// Whether the active view shows that position: inside its borders, and nothing in front of it.
bool is_in_view(const Editor& editor, const Vec3& position);

// The face at the context menu's position, or else under the mouse.
std::optional<FacePoint> pointed_target(const Editor& editor);

// The first of these that is there: pointed_target(), a selected face, the face in the middle of the view.
std::optional<FacePoint> target_of(const Editor& editor);

// The same; if there is none, the status line says so.
std::optional<FacePoint> target_or_say(Editor& editor);

// Zooms the active view towards the target, or else towards what is in its middle; without either towards the
// pivot. `wheel` in notches.
void zoom_to(Editor& editor, double wheel, const std::optional<FacePoint>& target);

// Where the menu or the palette that is opened now finds the mouse: its commands act there.
void remember_pointed(Editor& editor);

}  // namespace slipface
