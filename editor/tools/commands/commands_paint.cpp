// Commands that give faces their types.
#include <algorithm>

#include "tools/commands/command_actions.h"
#include "tools/commands/command_rows.h"
#include "tools/commands/icons.h"
#include "tools/selection/material_rules.h"
#include "tools/selection/selecting.h"
#include "tools/target.h"

namespace slipface {

using namespace command_actions;

namespace {

void add_digit_commands(std::vector<Command>& rows) {
    std::vector<Command> fills;
    for (std::size_t i = 1; i <= 9; ++i) {
        const std::string digit = std::to_string(i);
        const auto has_type = [i](const Editor& e) { return surface_with_hotkey(e, i).has_value(); };
        rows.push_back({lasting("brush." + digit), "", lasting("Brush of key " + digit), "Tools",
                        lasting("Paint with the surface type that has the hotkey " + digit),
                        "surface type hotkey", key(digit.c_str()), has_type,
                        [i](const Editor& e) { return e.brush && e.brush == surface_with_hotkey(e, i); },
                        [i](Editor& e) { choose_brush(e, surface_with_hotkey(e, i)); },
                        [i](const Editor& e) { return "Brush: " + type_on_key(e, i); }});
        fills.push_back(
            {lasting("paint." + digit), "", lasting("Paint the selection with key " + digit), "Edit/Make it",
             lasting("Give the selected faces the surface type that has the hotkey " + digit),
             "paint selection turn into surface type", shift(digit.c_str()),
             [has_type](const Editor& e) { return has_selection(e) && has_type(e); }, nullptr,
             [i](Editor& e) { paint_faces(e, e.document->selection(), surface_with_hotkey(e, i)); },
             [i](const Editor& e) { return "Make it " + type_on_key(e, i); }});
    }
    rows.insert(rows.end(), fills.begin(), fills.end());
}

// The types of the seeds, everywhere or within the selection, become the brush's.
void replace_seed_types(Editor& editor) {
    const Document& document = *editor.document;
    std::vector<SurfaceId> types;
    if (const auto pointed = pointed_target(editor))
        types = {document.surface_of(pointed->face)};
    else
        for (const FaceId face : seed_faces(editor))
            if (const SurfaceId type = document.surface_of(face);
                std::find(types.begin(), types.end(), type) == types.end())
                types.push_back(type);
    editor.document->begin("Replace type");
    for (const SurfaceId type : types)
        if (!editor.brush || type != *editor.brush) replace_type(editor, type, editor.brush);
    editor.document->commit();
}

}  // namespace

std::vector<Command> paint_commands() {
    std::vector<Command> rows{
        {"edit.fill_selection", icons::fill, "Paint selection", "Edit",
         "Give the selected faces the brush's surface type", "fill apply assign", key("L"), has_selection,
         nullptr, fill_selection},
        {"edit.replace_type", icons::replace, "Replace type by the brush's", "Edit",
         "Change all faces of the type under the mouse, or of the selected faces' types, to the brush's "
         "type; only inside the selection if there is one",
         "swap convert everywhere all", shift("L"), has_document, nullptr, replace_seed_types},
        {"edit.unset_selection", icons::eraser, "Unset selection", "Edit",
         "Remove the paint of the selected faces; rules and suffixes decide their type again",
         "clear erase remove override", key("Backspace"), has_selection, nullptr, unset_selection},
        {"edit.add_rule", icons::list, "Add rule for the material", "Edit",
         "Give the brush's type to the materials of the selected faces, or of the face under the mouse, by a "
         "rule for their names: new faces of these materials get it, too",
         "material pattern wildcard", no_key(), [](const Editor& e) { return has_document(e) && e.brush; },
         nullptr, add_rules_for_faces},
        {"tools.pick_surface", icons::eyedropper, "Pick surface type", "Tools",
         "Use the surface type of the face under the mouse as the brush", "eyedropper pipette", key("I"),
         has_document, nullptr, pick_surface},
        {"tools.larger_brush", icons::plus, "Larger brush", "Tools",
         "Paint a wider patch of faces around the mouse", "size radius bigger grow", key("]"), always,
         nullptr, larger_brush},
        {"tools.smaller_brush", icons::minus, "Smaller brush", "Tools",
         "Paint a narrower patch of faces; the smallest brush paints single faces", "size radius shrink",
         key("["), brush_can_shrink, nullptr, smaller_brush},
        {"brush.unset", icons::eraser, "Brush: unset", "Tools",
         "Remove paint: rules and suffixes decide the face's type again", "eraser remove override", key("0"),
         has_document, brush_is_unset, brush_unset},
    };
    add_digit_commands(rows);
    return rows;
}

}  // namespace slipface
