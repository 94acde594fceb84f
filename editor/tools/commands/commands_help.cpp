// Commands that help to find the others.
#include "tools/commands/command_actions.h"
#include "tools/commands/command_rows.h"
#include "tools/commands/icons.h"
#include "tools/target.h"

namespace slipface {
namespace {

using namespace command_actions;

void zoom_in(Editor& editor) {
    set_zoom(editor, editor.session.zoom + 0.1);
}
void zoom_out(Editor& editor) {
    set_zoom(editor, editor.session.zoom - 0.1);
}
void zoom_reset(Editor& editor) {
    set_zoom(editor, 1.0);
}
bool zoom_can_grow(const Editor& editor) {
    return editor.session.zoom < largest_zoom;
}
bool zoom_can_shrink(const Editor& editor) {
    return editor.session.zoom > smallest_zoom;
}
bool zoom_differs(const Editor& editor) {
    return editor.session.zoom != 1.0;
}
template <Theme Which>
bool theme_is(const Editor& editor) {
    return editor.session.theme == Which;
}
template <Theme Which>
void use_theme(Editor& editor) {
    set_theme(editor, Which);
}
void toggle_palette(Editor& editor) {
    remember_pointed(editor);
    editor.show_command_palette = !editor.show_command_palette;
}
bool help_is_shown(const Editor& editor) {
    return editor.session.help;
}
void toggle_help(Editor& editor) {
    editor.session.help = !editor.session.help;
}
void start_tour(Editor& editor) {
    editor.session.tour = 0;
}

}  // namespace

std::vector<Command> help_commands() {
    return {
        {"help.command_palette", icons::search, "Find a command\u2026", "Help",
         "Find any command by a few letters and run it", "palette search actions", ctrl("P"), always,
         shown<&Editor::show_command_palette>, toggle_palette},
        {"interface.zoom_in", icons::search_plus, "Larger interface", "View/Interface",
         "Draw text and panels larger", "scale zoom dpi bigger", ctrl("="), zoom_can_grow, nullptr, zoom_in},
        {"interface.zoom_out", icons::search_minus, "Smaller interface", "View/Interface",
         "Draw text and panels smaller", "scale zoom dpi", ctrl("-"), zoom_can_shrink, nullptr, zoom_out},
        {"interface.zoom_reset", icons::search, "Usual size", "View/Interface",
         "Draw text and panels at the screen's own scale", "scale zoom dpi reset 100", ctrl("0"),
         zoom_differs, nullptr, zoom_reset},
        {"interface.dark", icons::moon, "Dark theme", "View/Interface", "Light text on a dark background",
         "night colours", no_key(), always, theme_is<Theme::dark>, use_theme<Theme::dark>},
        {"interface.light", icons::sun, "Light theme", "View/Interface", "Dark text on a light background",
         "day colours bright", no_key(), always, theme_is<Theme::light>, use_theme<Theme::light>},
        {"help.overlay", icons::question, "What can I do here?", "Help",
         "Show the keys and mouse buttons that work now", "keys cheat sheet overlay", key("F12"), always,
         help_is_shown, toggle_help},
        {"help.tour", icons::compass, "Tour", "Help", "Take a guided tour, step by step",
         "first steps tutorial", no_key(), always, nullptr, start_tour},
        {"help.shortcuts", icons::keyboard, "Shortcuts", "Help", "Show every command and its keys",
         "keys keyboard bindings help", key("F1"), always, shown<&Editor::show_shortcuts>,
         toggle_shown<&Editor::show_shortcuts>},
    };
}

}  // namespace slipface
