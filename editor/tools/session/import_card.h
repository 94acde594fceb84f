// State and actions of the card about a level's unit, axis and size (drawn by panels/import_card.cpp).
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "slipface/mesh/facing_doubt.h"
#include "slipface/mesh/size_doubt.h"
#include "slipface/mesh/up_doubt.h"

namespace slipface {

struct Editor;

struct ImportCard {
    bool shown = false;
    std::string problem;  // why the last change was refused
    std::string scale_text;
    // The mesh, and facts computed from it.
    MeshPtr mesh;
    std::size_t open_edges = 0;
    std::optional<SizeDoubt> size_doubt;
    std::optional<UpDoubt> up_doubt;
    std::optional<FacingDoubt> facing_doubt;
};

// Called for each opened level. Shows the card if the level has no level file and the card was never closed
// for that geometry.
void offer_import_card(Editor& editor);
void toggle_import_card(Editor& editor);
void close_import_card(Editor& editor);    // permanently: stored in the preferences
void refresh_import_card(Editor& editor);  // computes its facts again if the mesh changed
// Reads the geometry with another scale, axis or facing, as one step; an error becomes the card's `problem`.
void change_import(Editor& editor, const ImportTransform& transform);
// The scale as typed; anything but a number above 0 becomes a `problem`.
void change_import_scale(Editor& editor, std::string_view text);

}  // namespace slipface
