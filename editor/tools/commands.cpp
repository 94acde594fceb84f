#include "tools/commands.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

#include "tools/command_actions.h"
#include "tools/icons.h"

namespace slipface {
namespace {

using namespace command_actions;

Shortcut key(const char* name) {
    return {name, false, false, false};
}
Shortcut ctrl(const char* name) {
    return {name, true, false, false};
}
Shortcut ctrl_shift(const char* name) {
    return {name, true, true, false};
}

std::vector<Command> file_and_edit_commands() {
    return {
        {"file.open", icons::folder_open, "Open…", "File", "Open an OBJ or a level file",
         "load import level obj", ctrl("O"), always, nullptr, open_file},
        {"file.save", icons::save, "Save", "File",
         "Write the level file beside the OBJ, which stays as it is", "write store", ctrl("S"), has_document,
         nullptr, save},
        {"file.save_as", icons::save, "Save as…", "File", "Write the level file under another name",
         "write store copy", ctrl_shift("S"), has_document, nullptr, save_as},
        {"file.quit", icons::sign_out, "Quit", "File",
         "Leave Slipface; asks first when there are unsaved changes", "exit close leave", ctrl("Q"), always,
         nullptr, request_quit},

        {"edit.undo", icons::undo, "Undo", "Edit", "Take back the last step", "back revert", ctrl("Z"),
         can_undo, nullptr, undo},
        {"edit.redo", icons::redo, "Redo", "Edit", "Do again what was undone", "again repeat",
         ctrl_shift("Z"), can_redo, nullptr, redo},
        {"edit.redo_alternative", icons::redo, "Redo", "", "Do again what was undone", "again repeat",
         ctrl("Y"), can_redo, nullptr, redo},
        {"edit.select_all", icons::all, "Select all", "Edit", "Select every face", "everything", ctrl("A"),
         has_document, nullptr, select_all},
        {"edit.select_none", icons::none, "Select none", "Edit", "Select no face", "deselect clear nothing",
         ctrl_shift("A"), has_selection, nullptr, select_none},
        {"edit.invert_selection", icons::exchange, "Invert selection", "Edit",
         "Select exactly the faces that are not selected", "inverse swap", ctrl("I"), has_document, nullptr,
         invert_selection},
        {"edit.select_brush_type", icons::all, "Select faces of the brush's type", "Edit",
         "Select every face whose surface type is the brush's", "similar same all with type", ctrl("T"),
         has_document, nullptr, select_brush_type},
        {"edit.fill_selection", icons::fill, "Paint selection", "Edit",
         "Give the selected faces the brush's surface type", "fill apply assign", key("L"), has_selection,
         nullptr, fill_selection},
        {"edit.unset_selection", icons::eraser, "Unset selection", "Edit",
         "Take the painted types off the selected faces; rules and suffixes count again",
         "clear erase remove override", key("Backspace"), has_selection, nullptr, unset_selection},
        {"edit.set_spawn", icons::flag, "Set spawn point", "Edit",
         "Put the player's start on the face under the mouse, looking where the camera looks",
         "start player begin", key("P"), has_hovered, nullptr, set_spawn_hovered},
    };
}

std::vector<Command> tool_commands() {
    return {
        {"tools.select", icons::pointer, "Select", "Tools",
         "Click faces to select them; with Ctrl to add and remove", "pointer pick arrow", key("Q"), always,
         tool_is<Tool::select>, use_tool<Tool::select>},
        {"tools.paint", icons::brush, "Paint", "Tools",
         "Drag over faces to give them the brush's surface type", "brush draw", key("B"), always,
         tool_is<Tool::paint>, use_tool<Tool::paint>},
        {"tools.fill", icons::fill, "Fill", "Tools",
         "Click to paint all connected faces that turn by less than the fill angle",
         "flood bucket coplanar region", key("G"), always, tool_is<Tool::fill>, use_tool<Tool::fill>},
        {"tools.probe", icons::crosshairs, "Probe", "Tools",
         "Click to place the player's ellipsoid, drag to sweep it through the level",
         "sweep contact ellipsoid", key("T"), always, tool_is<Tool::probe>, use_tool<Tool::probe>},
        {"tools.pick_surface", icons::eyedropper, "Pick surface type", "Tools",
         "Take the surface type of the face under the mouse as the brush", "eyedropper pipette", key("I"),
         has_hovered, nullptr, pick_surface},
        {"tools.larger_brush", icons::plus, "Larger brush", "Tools",
         "Paint a wider patch of faces around the mouse", "size radius bigger grow", key("]"), always,
         nullptr, larger_brush},
        {"tools.smaller_brush", icons::minus, "Smaller brush", "Tools",
         "Paint a narrower patch of faces; the smallest brush paints single faces", "size radius shrink",
         key("["), brush_can_shrink, nullptr, smaller_brush},
        {"tools.clear_probe", icons::trash, "Clear probe", "Tools", "Take the sweep probe out of the level",
         "remove delete", key("Delete"), probe_is_placed, nullptr, clear_probe},
        {"brush.unset", icons::eraser, "Brush: unset", "Tools",
         "Paint with nothing: rules and suffixes decide the face's type again", "eraser remove override",
         key("0"), has_document, brush_is_unset, brush_unset},
    };
}

std::vector<Command> view_commands() {
    return {
        {"view.frame_selected", icons::frame, "Frame selected", "View",
         "Move the camera to see the selected faces, or all", "focus zoom fit", key("F"), has_document,
         nullptr, frame_selection},
        {"view.frame_all", icons::frame_all, "Frame all", "View", "Move the camera to see the whole level",
         "focus zoom fit home", key("Home"), has_document, nullptr, frame_all},
        {"view.textured", icons::picture, "Textures", "View", "Draw textures instead of plain shaded faces",
         "shaded material plain", key("X"), always, flag_is<&LevelStyle::textured>,
         toggle_flag<&LevelStyle::textured>},
        {"view.overlay", icons::layers, "Surface type overlay", "View",
         "Lay colours and hatches of the surface types over faces", "colour hatch legend types", key("O"),
         always, overlay_is_on, toggle_overlay},
        {"view.wireframe", icons::grid, "Wireframe", "View", "Draw the borders of faces",
         "edges lines polygons", key("Z"), always, flag_is<&LevelStyle::wireframe>,
         toggle_flag<&LevelStyle::wireframe>},
        {"view.back_faces", icons::cube, "Back faces", "View",
         "Draw faces seen from behind, darker and reddish; else look through them", "cull two sided",
         key("C"), always, flag_is<&LevelStyle::back_faces>, toggle_flag<&LevelStyle::back_faces>},
        {"view.trace", icons::eye, "Contacts in playtest", "View",
         "Draw the contacts of the last tick while walking", "trace debug", key("K"), always,
         shown<&Editor::show_trace>, toggle_shown<&Editor::show_trace>},
        {"view.palette",
         icons::palette,
         "Surface types panel",
         "View",
         "Show the panel of surface types",
         "palette window",
         {},
         always,
         shown<&Editor::show_palette>,
         toggle_shown<&Editor::show_palette>},
        {"view.settings",
         icons::sliders,
         "Movement panel",
         "View",
         "Show the panel of movement hacks and parameters",
         "settings hacks window",
         {},
         always,
         shown<&Editor::show_settings>,
         toggle_shown<&Editor::show_settings>},
        {"view.probe_table",
         icons::table,
         "Probe panel",
         "View",
         "Show the numbers of the sweep probe",
         "sweep table window",
         {},
         always,
         shown<&Editor::show_probe_table>,
         toggle_shown<&Editor::show_probe_table>},
        {"view.history", icons::history, "History panel", "View",
         "Show the list of steps that undo goes back through", "undo log window", ctrl("H"), always,
         shown<&Editor::show_history>, toggle_shown<&Editor::show_history>},
        {"view.warnings",
         icons::warning,
         "Warnings panel",
         "View",
         "Show what was repaired or dropped while opening",
         "problems errors window",
         {},
         always,
         shown<&Editor::show_warnings>,
         toggle_shown<&Editor::show_warnings>},
    };
}

std::vector<Command> playtest_commands() {
    return {
        {"playtest.start", icons::play, "Play", "Playtest", "Walk the level from the spawn point",
         "run walk test game", key("F5"), has_document, nullptr, start_playtest},
        {"playtest.stop", icons::stop, "Stop", "Playtest", "Go back to editing", "end leave exit",
         key("Escape"), is_playing, nullptr, stop_playtest},
        {"playtest.restart", icons::restart, "Restart", "Playtest", "Go back to the spawn point",
         "again respawn reset", key("R"), is_playing, nullptr, start_playtest},
        {"playtest.toggle_person", icons::person, "First person", "Playtest", "See through the player's eyes",
         "third camera view", key("V"), is_playing, is_first_person, toggle_person},
    };
}

// Commands made from the settings table and the digits. What they point at lives as long as the program.
template <std::size_t... I>
std::vector<Command> hack_commands(std::index_sequence<I...>) {
    static std::array<std::string, sizeof...(I)> ids;
    std::vector<Command> rows;
    const auto add = [&](std::size_t i, auto checked, auto run) {
        if (i >= settings_table().size()) return;
        const SettingInfo& info = settings_table()[i];
        if (!std::holds_alternative<bool MovementSettings::*>(info.member)) return;
        ids[i] = std::string("movement.") + info.name;
        rows.push_back({ids[i].c_str(),
                        "",
                        info.label,
                        "Playtest",
                        info.meaning,
                        "hack switch toggle movement",
                        {},
                        has_document,
                        checked,
                        run});
    };
    (add(I, setting_is_on<I>, toggle_setting<I>), ...);
    return rows;
}

template <std::size_t... I>
std::vector<Command> brush_commands(std::index_sequence<I...>) {
    static std::array<std::array<std::string, 3>, sizeof...(I)> texts;
    std::vector<Command> rows;
    const auto add = [&](std::size_t i, auto enabled, auto checked, auto run) {
        const std::string digit = std::to_string(i + 1);
        texts[i] = {"brush." + digit, "Brush " + digit,
                    "Paint with the surface type that has the hotkey " + digit};
        rows.push_back({texts[i][0].c_str(), "", texts[i][1].c_str(), "Tools", texts[i][2].c_str(),
                        "surface type hotkey", key(digit.c_str()), enabled, checked, run});
    };
    (add(I, has_hotkey<I + 1>, brush_has_hotkey<I + 1>, brush_by_hotkey<I + 1>), ...);
    return rows;
}

std::vector<Command> make_commands() {
    constexpr std::size_t max_settings = 96;
    if (settings_table().size() > max_settings) std::abort();
    const Command reset{"movement.reset",
                        icons::reset,
                        "Reset movement",
                        "Playtest",
                        "Set every hack and parameter to its default",
                        "default settings hacks",
                        {},
                        movement_differs,
                        nullptr,
                        reset_movement};
    const Command shortcuts{"help.shortcuts",
                            icons::keyboard,
                            "Shortcuts",
                            "Help",
                            "Show every command and its keys",
                            "keys keyboard bindings help",
                            key("F1"),
                            always,
                            shown<&Editor::show_shortcuts>,
                            toggle_shown<&Editor::show_shortcuts>};
    std::vector<Command> all;
    for (const std::vector<Command>& part : {file_and_edit_commands(),
                                             view_commands(),
                                             tool_commands(),
                                             brush_commands(std::make_index_sequence<9>()),
                                             playtest_commands(),
                                             hack_commands(std::make_index_sequence<max_settings>()),
                                             {reset},
                                             {shortcuts}})
        all.insert(all.end(), part.begin(), part.end());
    return all;
}

}  // namespace

std::string Shortcut::text() const {
    if (key.empty()) return {};
    return std::string(ctrl ? "Ctrl+" : "") + (shift ? "Shift+" : "") + (alt ? "Alt+" : "") + key;
}

std::span<const Command> commands() {
    static const std::vector<Command> all = make_commands();
    return all;
}

const Command* find_command(std::string_view id) {
    const auto all = commands();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Command& command) { return id == command.id; });
    return found == all.end() ? nullptr : &*found;
}

const Command* command_for(const Shortcut& pressed) {
    if (pressed.key.empty()) return nullptr;
    const auto all = commands();
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const Command& command) { return command.shortcut == pressed; });
    return found == all.end() ? nullptr : &*found;
}

bool run_command(Editor& editor, std::string_view id) {
    const Command* command = find_command(id);
    if (!command || !command->enabled(editor)) return false;
    command->run(editor);
    keep_brush_valid(editor);
    return true;
}

}  // namespace slipface
