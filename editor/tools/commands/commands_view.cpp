// Commands on what the view shows.
#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "tools/commands/command_actions.h"
#include "tools/commands/command_rows.h"
#include "tools/commands/icons.h"
#include "tools/target.h"
#include "tools/view/cameras.h"

namespace slipface {

using namespace command_actions;

namespace {

std::vector<Command> panel_commands() {
    std::vector<Command> rows;
    for (const PanelInfo& info : panel_table())
        rows.push_back({lasting(std::string("panel.") + info.name), info.icon,
                        lasting(std::string(info.label) + " panel"), "View/Panels", info.description,
                        lasting(std::string("panel window tab ") + info.search),
                        parse_shortcut(info.shortcut), always,
                        [id = info.id](const Editor& e) { return e.layout.shown(id); },
                        [id = info.id](Editor& e) { e.layout.toggle(id); }});
    return rows;
}

template <FaceColors Colors>
bool colors_are(const Editor& editor) {
    return editor.style.colors == Colors;
}
template <FaceColors Colors>
void toggle_colors(Editor& editor) {
    editor.style.colors = colors_are<Colors>(editor) ? FaceColors::types : Colors;
}
template <std::size_t Count>
bool pane_count_is(const Editor& editor) {
    return editor.panes.count == Count;
}
template <std::size_t Count>
void show_panes(Editor& editor) {
    set_pane_count(editor, Count);
}
bool has_panes(const Editor& editor) {
    return editor.panes.count > 1;
}
// Views along an axis; X, Y, Z is the direction to the eye. A perspective view becomes orthographic.
template <int X, int Y, int Z>
void look_along(Editor& editor) {
    editor.view.orthographic = true;
    editor.view.look_from({X, Y, Z});
}
template <int Yaw, int Pitch>
void turn_view(Editor& editor) {
    constexpr double pixels = 45.0;  // of mouse movement: about 15 degrees
    editor.view.orbit({Yaw * pixels, Pitch * pixels});
}
template <int Wheel>
void zoom_view(Editor& editor) {
    zoom_to(editor, Wheel * 2.0, std::nullopt);
}

std::vector<Command> direction_rows() {
    return {
        {"view.orthographic", icons::square, "Orthographic", "View/Direction",
         "View without perspective: parallel edges stay parallel", "ortho perspective projection flat",
         shift("O"), always, [](const Editor& e) { return e.view.orthographic; },
         [](Editor& e) { e.view.orthographic = !e.view.orthographic; }},
        {"view.top", icons::map, "Top", "View/Direction", "Look straight down, as on a map", "above plan y",
         alt("Up"), always, nullptr, look_along<0, 1, 0>},
        {"view.bottom", icons::map, "Bottom", "View/Direction", "Look straight up", "below y", alt("Down"),
         always, nullptr, look_along<0, -1, 0>},
        {"view.front", icons::square, "Front", "View/Direction", "Look along -Z", "axis z", alt("Home"),
         always, nullptr, look_along<0, 0, 1>},
        {"view.back", icons::square, "Back", "View/Direction", "Look along +Z", "axis z", alt("End"), always,
         nullptr, look_along<0, 0, -1>},
        {"view.right", icons::square, "Right", "View/Direction", "Look along -X", "axis x side", alt("Right"),
         always, nullptr, look_along<1, 0, 0>},
        {"view.left", icons::square, "Left", "View/Direction", "Look along +X", "axis x side", alt("Left"),
         always, nullptr, look_along<-1, 0, 0>},
        {"view.turn_left", "", "Turn left", "View/Direction", "Rotate the view around its pivot",
         "orbit rotate keyboard", shift("Left"), always, nullptr, turn_view<1, 0>},
        {"view.turn_right", "", "Turn right", "View/Direction", "Rotate the view around its pivot",
         "orbit rotate keyboard", shift("Right"), always, nullptr, turn_view<-1, 0>},
        {"view.turn_up", "", "Turn up", "View/Direction", "Rotate the view upwards", "orbit rotate keyboard",
         shift("Up"), always, nullptr, turn_view<0, 1>},
        {"view.turn_down", "", "Turn down", "View/Direction", "Rotate the view downwards",
         "orbit rotate keyboard", shift("Down"), always, nullptr, turn_view<0, -1>},
        {"view.zoom_in", icons::search, "Zoom in", "View/Direction", "Zoom in", "closer keyboard",
         shift("PageUp"), always, nullptr, zoom_view<1>},
        {"view.zoom_out", icons::search, "Zoom out", "View/Direction", "Zoom out", "away keyboard",
         shift("PageDown"), always, nullptr, zoom_view<-1>},
    };
}

template <BackFaces Which>
bool back_faces_are(const Editor& editor) {
    return editor.back_faces == Which;
}
template <BackFaces Which>
void use_back_faces(Editor& editor) {
    set_back_faces(editor, Which);
}
// From automatic to the opposite of the present state, and from there back to automatic.
void switch_back_faces(Editor& editor) {
    if (editor.back_faces != BackFaces::automatic)
        set_back_faces(editor, BackFaces::automatic);
    else
        set_back_faces(editor, sees_back_faces(editor) ? BackFaces::never : BackFaces::always);
}

std::vector<Command> back_face_rows() {
    return {
        {"view.back_faces", icons::cube, "Back faces", "View/Back faces",
         "Show or hide faces seen from behind (darker and reddish); again: automatic",
         "cull two sided inside outside", key("C"), always, sees_back_faces, switch_back_faces},
        {"view.back_faces_automatic", "", "Automatic", "View/Back faces",
         "Hide back faces where they would cover rooms (seen from outside, and in orthographic views); draw "
         "them everywhere else",
         "cull two sided inside outside closed", no_key(), always, back_faces_are<BackFaces::automatic>,
         use_back_faces<BackFaces::automatic>},
        {"view.back_faces_always", "", "Always drawn", "View/Back faces",
         "Draw faces seen from behind, darker and reddish, in every view", "cull two sided", no_key(), always,
         back_faces_are<BackFaces::always>, use_back_faces<BackFaces::always>},
        {"view.back_faces_never", "", "Never drawn", "View/Back faces",
         "Hide faces seen from behind in every view", "cull two sided", no_key(), always,
         back_faces_are<BackFaces::never>, use_back_faces<BackFaces::never>},
    };
}

std::vector<Command> pane_rows() {
    return {
        {"view.one_pane", icons::square, "One view", "View/Panes", "Show one view of the level",
         "single layout split", ctrl_alt("1"), always, pane_count_is<1>, show_panes<1>},
        {"view.two_panes", icons::columns, "Two views", "View/Panes", "Show two views side by side",
         "split layout top", ctrl_alt("2"), always, pane_count_is<2>, show_panes<2>},
        {"view.three_panes", icons::columns, "Three views", "View/Panes",
         "Show one large view and two small ones", "split layout", ctrl_alt("3"), always, pane_count_is<3>,
         show_panes<3>},
        {"view.four_panes", icons::grid, "Four views", "View/Panes",
         "Show four views: perspective, top, front, right", "split layout quad", ctrl_alt("4"), always,
         pane_count_is<4>, show_panes<4>},
        {"view.next_pane", icons::exchange, "Next view", "View/Panes", "Activate the next view",
         "cycle focus pane", ctrl_alt("N"), has_panes, nullptr,
         [](Editor& e) { activate_pane(e, (e.panes.active + 1) % e.panes.count); }},
        {"view.maximise", icons::expand, "Maximise view", "View/Panes",
         "Show only the active view, or all again", "full pane zoom", key("M"), has_panes,
         [](const Editor& e) { return e.panes.maximised; },
         [](Editor& e) { e.panes.maximised = !e.panes.maximised; }},
    };
}

bool has_camera(const Editor& editor) {
    return editor.document && !editor.document->level().cameras.empty();
}

std::vector<Command> camera_rows() {
    std::vector<Command> rows{
        {"camera.add", icons::camera, "Add camera", "View/Cameras", "Save this view as a camera",
         "bookmark save snapshot", ctrl_shift("B"), has_document, nullptr,
         [](Editor& e) { save_camera(e, {}); }},
        {"camera.replace", icons::camera, "Move camera here", "View/Cameras",
         "Replace the last used camera by the current view", "bookmark update change", no_key(),
         [](const Editor& e) { return has_camera(e) && e.camera_shown.has_value(); }, nullptr,
         [](Editor& e) { replace_camera(e, *e.camera_shown); }},
        {"camera.delete", icons::trash, "Delete camera", "View/Cameras",
         "Delete the last used camera from the level", "bookmark remove", no_key(),
         [](const Editor& e) { return has_camera(e) && e.camera_shown.has_value(); }, nullptr,
         [](Editor& e) { remove_camera(e, *e.camera_shown); }},
        {"camera.next", icons::camera, "Next camera", "View/Cameras", "Go to the next of the level's cameras",
         "bookmark cycle", key("PageDown"), has_camera, nullptr, [](Editor& e) { go_to_next_camera(e, 1); }},
        {"camera.previous", icons::camera, "Previous camera", "View/Cameras",
         "Go to the previous of the level's cameras", "bookmark cycle", key("PageUp"), has_camera, nullptr,
         [](Editor& e) { go_to_next_camera(e, -1); }},
    };
    for (std::size_t i = 0; i < 9; ++i) {
        const std::string digit = std::to_string(i + 1);
        rows.push_back({lasting("camera.go_" + digit), "", lasting("Camera " + digit), "View/Cameras",
                        lasting("Go to camera number " + digit), "bookmark jump", shift(lasting("F" + digit)),
                        [i](const Editor& e) { return e.document && i < e.document->level().cameras.size(); },
                        nullptr, [i](Editor& e) { go_to_camera(e, i); },
                        [i](const Editor& e) { return "Camera: " + e.document->level().cameras[i].name; }});
    }
    return rows;
}

}  // namespace

std::vector<Command> view_commands() {
    std::vector<Command> rows{
        {"view.frame_selected", icons::frame, "Frame selected", "View",
         "Move the camera to see the selected faces, or all", "focus zoom fit", key("F"), has_document,
         nullptr, frame_selection},
        {"view.frame_all", icons::frame_all, "Frame all", "View",
         "Move the camera to see the whole level, hidden faces apart", "focus zoom fit home", key("Home"),
         has_document, nullptr, frame_all},
        {"view.textured", icons::image, "Textures", "View", "Draw textures instead of plain shaded faces",
         "shaded material plain", key("X"), always, flag_is<&LevelStyle::textured>,
         toggle_flag<&LevelStyle::textured>},
        {"view.baked_light", icons::eye, "Baked light", "View",
         "Draw textures in the level's baked light and sky, if it has them", "light map shadow sun lit",
         no_key(), always, flag_is<&LevelStyle::baked_light>, toggle_flag<&LevelStyle::baked_light>},
        {"view.overlay", icons::layers, "Surface type overlay", "View",
         "Show the surface types' colours and hatches on faces", "colour hatch legend types", key("O"),
         always, overlay_is_on, toggle_overlay},
        {"view.wireframe", icons::grid, "Wireframe", "View", "Draw the borders of faces",
         "edges lines polygons", key("Z"), always, flag_is<&LevelStyle::wireframe>,
         toggle_flag<&LevelStyle::wireframe>},
        {"view.slope", icons::signal, "Slope colours", "View",
         "Colour faces by how steep they are: blue flat, pale at the slope limit, light to dark red beyond",
         "heat incline angle steep", shift("S"), always, colors_are<FaceColors::slope>,
         toggle_colors<FaceColors::slope>},
        {"view.walkable", icons::walk, "Walkable faces", "View",
         "Colour faces by what the player can do there: walk, slide off, or not stand at all",
         "slope limit steep overhang", shift("W"), always, colors_are<FaceColors::walkable>,
         toggle_colors<FaceColors::walkable>},
        {"view.triangle_ids", icons::hash, "Triangle numbers", "View",
         "Write the numbers of the triangles around the mouse on them", "ids index debug", shift("I"), always,
         shown<&Editor::show_triangle_ids>, toggle_shown<&Editor::show_triangle_ids>},
        {"view.trace", icons::eye, "Contacts in playtest", "View",
         "Draw the contacts of the last tick while walking", "trace debug", key("K"), always,
         shown<&Editor::show_trace>, toggle_shown<&Editor::show_trace>},
        {"view.focus", icons::expand, "Focus", "View/Panels",
         "Hide menus, toolbar and every panel but the view; Escape brings them back",
         "zen distraction full only", key("F11"), always, [](const Editor& e) { return e.layout.focus; },
         [](Editor& e) {
             if (e.layout.focus)
                 e.layout.focus = false;
             else
                 e.layout.focus_on(std::nullopt);
         }},
        {"view.reset_layout", icons::reset, "Reset layout", "View/Panels",
         "Reset the panels to the default layout", "default panels docks window arrange", no_key(), always,
         nullptr, reset_layout},
    };
    for (std::vector<Command>& part :
         std::array{back_face_rows(), direction_rows(), pane_rows(), camera_rows(), panel_commands()})
        std::move(part.begin(), part.end(), std::back_inserter(rows));
    return rows;
}

}  // namespace slipface
