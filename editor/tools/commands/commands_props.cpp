// Commands of the props.
#include "tools/commands/command_actions.h"
#include "tools/commands/command_rows.h"
#include "tools/commands/icons.h"
#include "tools/props/props.h"

namespace slipface {

using namespace command_actions;

namespace {

bool has_prop(const Editor& editor) {
    return chosen_prop(editor).has_value();
}
bool has_file(const Editor& editor) {
    return editor.document && !editor.props.file.empty();
}
template <PropHandles Which>
bool handles_are(const Editor& editor) {
    return editor.props.handles == Which;
}
template <PropHandles Which>
void use_handles(Editor& editor) {
    editor.props.handles = Which;
    editor.tool = Tool::props;
}

}  // namespace

std::vector<Command> prop_commands() {
    return {
        {"tools.props", icons::cube, "Props", "Tools",
         "Click a prop to choose it and drag its handles, or place the mesh that is chosen in the panel "
         "Props",
         "instances objects meshes place gizmo", key("U"), always, tool_is<Tool::props>,
         use_tool<Tool::props>},
        {"props.move", "", "Move props", "Edit/Prop", "Handles that move the chosen prop",
         "gizmo translate position", no_key(), has_document, handles_are<PropHandles::move>,
         use_handles<PropHandles::move>},
        {"props.rotate", "", "Rotate props", "Edit/Prop", "Handles that rotate the chosen prop",
         "gizmo turn rotation", no_key(), has_document, handles_are<PropHandles::rotate>,
         use_handles<PropHandles::rotate>},
        {"props.scale", "", "Scale props", "Edit/Prop", "Handles that scale the chosen prop", "gizmo size",
         no_key(), has_document, handles_are<PropHandles::scale>, use_handles<PropHandles::scale>},
        {"props.snap", "", "Snap", "Edit/Prop",
         "Move by quarter metres, rotate by 15 degrees, scale by tenths; Shift does the opposite",
         "grid steps", no_key(), always, [](const Editor& e) { return e.props.snap; },
         [](Editor& e) { e.props.snap = !e.props.snap; }},
        {"props.place", icons::plus, "Place here", "Edit/Prop",
         "Place the mesh chosen in the panel Props on the face under the mouse, or in the middle of the view",
         "add instance", no_key(), has_file, nullptr, place_prop},
        {"props.duplicate", icons::copy, "Duplicate", "Edit/Prop", "Place another one beside the chosen prop",
         "copy clone instance", ctrl("D"), has_prop, nullptr,
         [](Editor& e) { duplicate_prop(e, *chosen_prop(e)); }},
        {"props.delete", icons::trash, "Delete", "Edit/Prop", "Remove the chosen prop", "remove instance",
         shift("Delete"), has_prop, nullptr, [](Editor& e) { remove_prop(e, *chosen_prop(e)); }},
        {"props.paint", icons::brush, "Paint whole prop", "Edit/Prop",
         "Give all faces of the chosen prop the brush's surface type", "type surface", no_key(), has_prop,
         nullptr, [](Editor& e) { paint_prop(e, *chosen_prop(e), e.brush); }},
        {"props.choose", icons::pointer, "Choose prop", "Edit/Prop",
         "Choose the prop under the mouse and select its faces", "select instance", key("Y"),
         [](const Editor& e) { return prop_of_target(e, target_of(e)).has_value(); }, nullptr,
         [](Editor& e) { choose_prop(e, prop_of_target(e, target_of(e))); }},
    };
}

}  // namespace slipface
