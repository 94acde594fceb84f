// What the card about a level's unit, axis and size shows and changes (panels/import_card.cpp draws it).
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "slipface/mesh/size_doubt.h"

namespace slipface {

struct Editor;

struct ImportCard {
    bool shown = false;
    std::string problem;  // why the last change was refused
    std::string scale_text;
    // Of the mesh that they were worked out for.
    MeshPtr mesh;
    std::size_t open_edges = 0;
    std::optional<SizeDoubt> doubt;
};

// Called for each level that was opened: shows the card where there is no level file, and nobody has closed
// the card for that geometry yet.
void offer_import_card(Editor& editor);
void toggle_import_card(Editor& editor);
void close_import_card(Editor& editor);    // for good: remembered in the preferences
void refresh_import_card(Editor& editor);  // its facts, where the mesh is another one
// Reads the geometry with another scale or axis, as one step; a refusal is the card's `problem`.
void change_import(Editor& editor, const ImportTransform& transform);
// The scale as typed by a person; what is no number above 0 is a `problem`.
void change_import_scale(Editor& editor, std::string_view text);

}  // namespace slipface
