// Commands that give faces their types.
#include <algorithm>
#include <array>
#include <utility>

#include "tools/commands/command_actions.h"
#include "tools/commands/command_rows.h"
#include "tools/commands/icons.h"
#include "tools/selection/selecting.h"

namespace slipface {

using namespace command_actions;

namespace {

// One for each digit. The texts live as long as the program.
template <std::size_t... I>
std::vector<Command> digit_commands(std::index_sequence<I...>) {
    static std::array<std::array<std::string, 6>, sizeof...(I)> texts;
    std::vector<Command> rows, fills;
    const auto add = [&](std::size_t i, auto enabled, auto checked, auto run, auto brush_name, auto can_fill,
                         auto fill, auto fill_name) {
        const std::string digit = std::to_string(i + 1);
        texts[i] = {"brush." + digit,
                    "Brush of key " + digit,
                    "Paint with the surface type that has the hotkey " + digit,
                    "paint." + digit,
                    "Paint the selection with key " + digit,
                    "Give the selected faces the surface type that has the hotkey " + digit};
        rows.push_back({texts[i][0].c_str(), "", texts[i][1].c_str(), "Tools", texts[i][2].c_str(),
                        "surface type hotkey", key(digit.c_str()), enabled, checked, run, brush_name});
        fills.push_back({texts[i][3].c_str(), "", texts[i][4].c_str(), "Edit/Make it", texts[i][5].c_str(),
                         "paint selection turn into surface type", shift(digit.c_str()), can_fill, nullptr,
                         fill, fill_name});
    };
    (add(
         I, has_hotkey<I + 1>, brush_has_hotkey<I + 1>, brush_by_hotkey<I + 1>,
         [](const Editor& e) { return "Brush: " + type_on_key(e, I + 1); },
         [](const Editor& e) { return has_selection(e) && has_hotkey<I + 1>(e); },
         [](Editor& e) { paint_faces(e, e.document->selection(), surface_with_hotkey(e, I + 1)); },
         [](const Editor& e) { return "Make it " + type_on_key(e, I + 1); }),
     ...);
    rows.insert(rows.end(), fills.begin(), fills.end());
    return rows;
}

// The types of the seeds, everywhere or within the selection, become the brush's.
void replace_seed_types(Editor& editor) {
    const Document& document = *editor.document;
    std::vector<SurfaceId> types;
    if (editor.hovered != no_id)
        types = {document.resolved().surface[editor.hovered]};
    else
        for (const FaceId face : document.selection())
            if (const SurfaceId type = document.resolved().surface[face];
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
         "swap convert everywhere all", shift("L"),
         [](const Editor& e) { return has_selection(e) || has_hovered(e); }, nullptr, replace_seed_types},
        {"edit.unset_selection", icons::eraser, "Unset selection", "Edit",
         "Remove the paint of the selected faces; rules and suffixes decide their type again",
         "clear erase remove override", key("Backspace"), has_selection, nullptr, unset_selection},
        {"tools.pick_surface", icons::eyedropper, "Pick surface type", "Tools",
         "Use the surface type of the face under the mouse as the brush", "eyedropper pipette", key("I"),
         has_hovered, nullptr, pick_surface},
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
    for (Command& row : digit_commands(std::make_index_sequence<9>()))
        rows.push_back(std::move(row));
    return rows;
}

}  // namespace slipface
