// Commands that select faces, hide them, and store named selections.
#include "slipface/base/counted.h"
#include "tools/commands/command_actions.h"
#include "tools/commands/command_rows.h"
#include "tools/commands/icons.h"
#include "tools/selection/selecting.h"
#include "tools/target.h"

namespace slipface {

using namespace command_actions;

namespace {

bool has_hidden(const Editor& editor) {
    return editor.document && !editor.document->hidden().empty();
}

// From the seeds to what `choose` makes of them.
template <auto Choose>
void from_seeds(Editor& editor, const char* step_name) {
    apply_selection(editor, Choose(*editor.document, seed_faces(editor)), SelectBy::replace, step_name);
}
template <Likeness What>
std::vector<FaceId> similar(const Document& document, std::span<const FaceId> seeds) {
    return similar_faces(document, seeds, What);
}

template <SelectShape Shape>
bool shape_is(const Editor& editor) {
    return editor.tool == Tool::select && editor.select_shape == Shape;
}
template <SelectShape Shape>
void use_shape(Editor& editor) {
    editor.tool = Tool::select;
    editor.select_shape = Shape;
}

// The faces of the brush's type, or all unpainted ones.
void select_brush_type(Editor& editor) {
    const Document& document = *editor.document;
    apply_selection(editor, editor.brush ? faces_of_type(document, *editor.brush) : unpainted_faces(document),
                    SelectBy::replace, "Select by type");
}

void hide_selected(Editor& editor) {
    Document& document = *editor.document;
    const std::size_t count = document.selection().size();
    document.hide(united(document.hidden(), document.selection()), "Hide");
    editor.status = "Hidden: " + counted(count, "face");
}
void isolate_selected(Editor& editor) {
    Document& document = *editor.document;
    document.hide(inverted(document, document.selection()), "Isolate");
    editor.status = "Only the selection is shown";
}
void show_all(Editor& editor) {
    editor.document->hide({}, "Show all");
    editor.status = "Every face is shown";
}

void select_middle(Editor& editor) {
    if (const auto middle = middle_of_view(editor))
        apply_selection(editor, {middle->face}, SelectBy::replace, "Select face");
    else
        editor.status = "There is no face in the middle of the view";
}
// Under the mouse, or else in the middle of the view.
void select_behind(Editor& editor) {
    const Camera camera = editor.view.camera();
    const Vec2 size{editor.view_aspect, 1.0};
    Vec2 pixel = 0.5 * size;
    if (const auto pointed = pointed_target(editor)) pixel = project(camera, pointed->point, size).head<2>();
    drill_select(editor, pixel_ray(camera, pixel, size), 1);
}

std::vector<Command> whole_rows() {
    return {
        {"select.all", icons::all, "Select all", "Select", "Select every face that is not hidden",
         "everything", ctrl("A"), has_document, nullptr,
         [](Editor& e) { apply_selection(e, every_face(*e.document), SelectBy::replace, "Select all"); }},
        {"select.none", icons::none, "Select none", "Select", "Select no face", "deselect clear nothing",
         ctrl_shift("A"), has_selection, nullptr, [](Editor& e) { e.document->select({}); }},
        {"select.invert", icons::exchange, "Invert selection", "Select", "Swap selected and unselected",
         "inverse swap", ctrl("I"), has_document, nullptr,
         [](Editor& e) {
             apply_selection(e, inverted(*e.document, e.document->selection()), SelectBy::replace,
                             "Invert selection");
         }},
        {"select.grow", icons::plus, "Grow selection", "Select", "Add all neighbours of selected faces",
         "more larger expand", ctrl("]"), has_selection, nullptr,
         [](Editor& e) { from_seeds<grown>(e, "Grow selection"); }},
        {"select.shrink", icons::minus, "Shrink selection", "Select",
         "Deselect faces next to an unselected face", "less smaller contract", ctrl("["), has_selection,
         nullptr, [](Editor& e) { from_seeds<shrunk>(e, "Shrink selection"); }},
        {"select.middle", icons::crosshairs, "Select in the middle", "Select",
         "Select the face in the middle of the view", "centre keyboard aim", key("Space"), has_document,
         nullptr, select_middle},
        {"select.behind", icons::sort_down, "Select behind", "Select",
         "Select the next face behind the selected one; the same as clicking again, or Ctrl+wheel",
         "drill through tunnel under", key("N"), has_document, nullptr, select_behind},
    };
}

std::vector<Command> connected_rows() {
    return {
        {"select.flat", icons::connected, "Connected flat", "Select/Connected",
         "Select the faces connected in the same plane as the selected ones, or the one under the mouse",
         "flood coplanar plane region", shift("F"), has_document, nullptr,
         [](Editor& e) { from_seeds<connected_flat>(e, "Select flat"); }},
        {"select.smooth", icons::connected, "Connected by angle", "Select/Connected",
         "Select faces connected across edges that bend less than the fill angle", "flood smooth bend region",
         shift("G"), has_document, nullptr,
         [](Editor& e) {
             apply_selection(e, connected_by_angle(*e.document, seed_faces(e), e.fill_angle),
                             SelectBy::replace, "Select by angle");
         }},
        {"select.within_material", icons::connected, "Connected within material", "Select/Connected",
         "Select connected faces of the same material", "flood texture region", shift("M"), has_document,
         nullptr, [](Editor& e) { from_seeds<connected_within_material>(e, "Select within material"); }},
        {"select.within_type", icons::connected, "Connected within type", "Select/Connected",
         "Select connected faces of the same surface type", "flood surface region", shift("T"), has_document,
         nullptr, [](Editor& e) { from_seeds<connected_within_type>(e, "Select within type"); }},
    };
}

std::vector<Command> similar_rows() {
    return {
        {"select.same_material", icons::copy, "Same material", "Select/Similar",
         "Select every face with a material of the selected ones", "similar texture", ctrl("M"), has_document,
         nullptr, [](Editor& e) { from_seeds<similar<Likeness::material>>(e, "Select same material"); }},
        {"select.same_type", icons::copy, "Same type", "Select/Similar",
         "Select every face with a surface type of the selected ones", "similar surface", ctrl_shift("T"),
         has_document, nullptr,
         [](Editor& e) { from_seeds<similar<Likeness::type>>(e, "Select same type"); }},
        {"select.same_group", icons::copy, "Same group", "Select/Similar",
         "Select every face of the groups and objects of the selected ones", "similar object part", ctrl("G"),
         has_document, nullptr,
         [](Editor& e) { from_seeds<similar<Likeness::group>>(e, "Select same group"); }},
        {"select.same_direction", icons::copy, "Same direction", "Select/Similar",
         "Select every face whose normal differs by less than 2 degrees", "similar normal parallel",
         ctrl_shift("N"), has_document, nullptr,
         [](Editor& e) { from_seeds<similar<Likeness::normal>>(e, "Select same direction"); }},
        {"select.same_area", icons::copy, "Same area", "Select/Similar",
         "Select every face whose area differs by less than 5 %", "similar size", ctrl_shift("D"),
         has_document, nullptr,
         [](Editor& e) { from_seeds<similar<Likeness::area>>(e, "Select same area"); }},
        {"select.same_slope", icons::copy, "Same slope class", "Select/Similar",
         "Select every face that is walkable, too steep, or overhanging like the selected ones",
         "similar incline", ctrl_shift("L"), has_document, nullptr,
         [](Editor& e) { from_seeds<similar<Likeness::slope>>(e, "Select same slope class"); }},
        {"select.steep", icons::signal, "Steeper than the limit", "Select/Similar",
         "Select every face that is too steep to walk on: walls and ceilings too",
         "slope incline walkable limit", ctrl("L"), has_document, nullptr,
         [](Editor& e) {
             apply_selection(e, faces_steeper_than_limit(*e.document), SelectBy::replace, "Select steep");
         }},
    };
}

std::vector<Command> type_rows() {
    return {
        {"select.brush_type", icons::all, "The brush's type", "Select/By type",
         "Select every face of the brush's surface type, or all unpainted faces if the brush is `unset`",
         "similar same all with type", ctrl("T"), has_document, nullptr, select_brush_type},
        {"select.painted", icons::brush, "Painted faces", "Select/By type", "Select every painted face",
         "override overridden", no_key(), has_document, nullptr,
         [](Editor& e) {
             apply_selection(e, painted_faces(*e.document), SelectBy::replace, "Select painted");
         }},
    };
}

bool has_guessed(const Editor& editor) {
    return editor.document && !editor.document->guessed().empty();
}

bool has_selected_guess(const Editor& editor) {
    return editor.document && !selected_guesses(*editor.document).empty();
}

bool has_two_readings(const Editor& editor) {
    return editor.document && !editor.document->second_reading().empty();
}

std::vector<Command> guessed_rows() {
    return {
        {"select.two_readings", icons::all, "Select what differs", "Select/Guessed paint",
         "Select the faces whose paint can be read in two ways, because the changed geometry fits both",
         "reload match turned moved symmetric question", no_key(), has_two_readings, nullptr,
         [](Editor& e) {
             apply_selection(e, e.document->second_reading().faces, SelectBy::replace, "Select what differs");
         }},
        {"select.take_reading", icons::refresh, "Take the other", "Select/Guessed paint",
         "Paint the faces as the other reading says; undo shows the first one again",
         "reload match turned moved symmetric question", no_key(), has_two_readings, nullptr,
         [](Editor& e) {
             e.document->take_second_reading();
             e.status = "The other reading of the paint was taken; undo shows the first one again";
         }},
        {"select.keep_reading", icons::check, "Keep this one", "Select/Guessed paint",
         "Accept the paint of these faces as it is shown", "reload match turned moved symmetric question",
         no_key(), has_two_readings, nullptr,
         [](Editor& e) {
             e.document->accept_guessed(std::vector<FaceId>(e.document->second_reading().faces));
             e.status = "The paint was kept as it is";
         }},
        {"select.guessed", icons::all, "All of them", "Select/Guessed paint",
         "Select the faces whose paint was guessed when the geometry was read: matched by plane or distance, "
         "not exactly",
         "reload match plane nearest hot", no_key(), has_guessed, nullptr,
         [](Editor& e) {
             const std::span<const FaceId> faces = e.document->guessed();
             apply_selection(e, {faces.begin(), faces.end()}, SelectBy::replace, "Select guessed paint");
         }},
        {"select.next_guessed", icons::step_forward, "Next", "Select/Guessed paint",
         "Select and frame the next face whose paint was guessed", "reload match step", key("J"), has_guessed,
         nullptr, [](Editor& e) { step_guessed(e, true); }},
        {"select.previous_guessed", icons::step_back, "Previous", "Select/Guessed paint",
         "Select and frame the previous face whose paint was guessed", "reload match step", shift("J"),
         has_guessed, nullptr, [](Editor& e) { step_guessed(e, false); }},
        {"select.accept_guess", icons::check, "Accept", "Select/Guessed paint",
         "Accept the guessed paint of the selected faces and go on to the next guess", "reload match confirm",
         ctrl("J"), has_selected_guess, nullptr,
         [](Editor& e) { settle_guesses(e, selected_guesses(*e.document), true); }},
        {"select.drop_guess", icons::eraser, "Drop", "Select/Guessed paint",
         "Remove the guessed paint of the selected faces and go on to the next guess", "reload match reject",
         alt("J"), has_selected_guess, nullptr,
         [](Editor& e) { settle_guesses(e, selected_guesses(*e.document), false); }},
        {"select.accept_part", icons::check, "Accept the part", "Select/Guessed paint",
         "Accept all guessed paint of the connected parts of the selected faces and go on to the next guess",
         "reload match confirm object island", ctrl_shift("J"), has_selected_guess, nullptr,
         [](Editor& e) { settle_guesses(e, guesses_of_part(*e.document), true); }},
        {"select.drop_guessed", icons::eraser, "Drop all", "Select/Guessed paint", "Remove all guessed paint",
         "reload match reject", no_key(), has_guessed, nullptr,
         [](Editor& e) {
             const std::span<const FaceId> faces = e.document->guessed();
             settle_guesses(e, {faces.begin(), faces.end()}, false);
         }},
        {"select.accept_guessed", icons::check, "Accept all", "Select/Guessed paint",
         "Accept all guessed paint", "reload match confirm", no_key(), has_guessed, nullptr,
         [](Editor& e) {
             const std::span<const FaceId> faces = e.document->guessed();
             e.status = std::to_string(faces.size()) + " guesses accepted";
             e.document->accept_guessed(faces);
         }},
    };
}

std::vector<Command> hide_rows() {
    return {
        {"select.hide", icons::eye_off, "Hide", "Select",
         "Hide the selected faces; what is hidden is neither drawn nor picked", "invisible", key("H"),
         has_selection, nullptr, hide_selected},
        {"select.isolate", icons::eye, "Isolate", "Select", "Hide everything but the selected faces",
         "only solo local view", shift("H"), has_selection, nullptr, isolate_selected},
        {"select.show_all", icons::eye, "Show all", "Select", "Show every hidden face again", "unhide reveal",
         alt("H"), has_hidden, nullptr, show_all},
    };
}

std::vector<Command> shape_rows() {
    return {
        {"select.box", icons::object_group, "Drag a box", "Select/Mouse",
         "Dragging with the select tool draws a box", "rectangle marquee", shift("B"), always,
         shape_is<SelectShape::box>, use_shape<SelectShape::box>},
        {"select.lasso", icons::lasso, "Drag a lasso", "Select/Mouse",
         "Dragging with the select tool draws an outline around faces", "freehand outline polygon",
         shift("Q"), always, shape_is<SelectShape::lasso>, use_shape<SelectShape::lasso>},
        {"select.brush", icons::disc, "Drag a brush", "Select/Mouse",
         "Dragging with the select tool selects the faces under the mouse", "paint stroke circle", shift("P"),
         always, shape_is<SelectShape::brush>, use_shape<SelectShape::brush>},
        {"select.through", icons::cubes, "Select through", "Select/Mouse",
         "Box and lasso also take faces that cannot be seen, by their centres", "x-ray behind occluded",
         shift("X"), always, shown<&Editor::select_through>, toggle_shown<&Editor::select_through>},
        {"select.whole", icons::whole, "Only whole faces", "Select/Mouse",
         "Box and lasso select only faces completely inside the outline", "fully inside contained crossing",
         shift_alt("X"), always, shown<&Editor::select_whole>, toggle_shown<&Editor::select_whole>},
    };
}

// For each digit: every face of the type with that hotkey, and the saved selection with that number.
std::vector<Command> digit_rows() {
    std::vector<Command> types, saved;
    for (std::size_t i = 1; i <= 9; ++i) {
        const std::string digit = std::to_string(i);
        types.push_back({lasting("select.type_" + digit), "", lasting("Type of key " + digit),
                         "Select/By type",
                         lasting("Select every face of the surface type that has the hotkey " + digit),
                         "surface type hotkey", ctrl(digit.c_str()),
                         [i](const Editor& e) { return surface_with_hotkey(e, i).has_value(); }, nullptr,
                         [i](Editor& e) {
                             apply_selection(e, faces_of_type(*e.document, *surface_with_hotkey(e, i)),
                                             SelectBy::replace, "Select " + type_on_key(e, i));
                         },
                         [i](const Editor& e) { return "Type: " + type_on_key(e, i); }});
        saved.push_back(
            {lasting("select.recall_" + digit), "", lasting("Recall selection " + digit), "Select/Saved",
             lasting("Select the faces of saved selection number " + digit), "saved named set restore",
             alt(digit.c_str()),
             [i](const Editor& e) { return e.document && i <= e.document->saved_selections().size(); },
             nullptr, [i](Editor& e) { recall_selection(e, i - 1, SelectBy::replace); },
             [i](const Editor& e) { return "Recall " + e.document->saved_selections()[i - 1].name; }});
    }
    types.push_back({"select.save", icons::save, "Save selection", "Select/Saved",
                     "Save the selected faces under a name", "named set remember store", ctrl_alt("S"),
                     has_selection, nullptr, [](Editor& e) { save_selection(e, {}); }});
    types.insert(types.end(), saved.begin(), saved.end());
    return types;
}

}  // namespace

std::vector<Command> select_commands() {
    std::vector<Command> all;
    for (const std::vector<Command>& part : {whole_rows(), hide_rows(), connected_rows(), similar_rows(),
                                             type_rows(), guessed_rows(), digit_rows(), shape_rows()})
        all.insert(all.end(), part.begin(), part.end());
    return all;
}

}  // namespace slipface
