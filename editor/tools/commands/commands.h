// The one table of commands. Menus, toolbar, shortcuts, tooltips, scripts and docs/commands.md are made from
// it.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "tools/commands/shortcut.h"
#include "tools/editor.h"

namespace slipface {

struct Command {
    const char* id;           // "file.save", as scripts name it
    const char* icon;         // UTF-8 of a Font Awesome 4.7 glyph, or ""
    const char* label;        // "Save", "Save as…" when it asks for more
    const char* menu;         // "File", "View/Panels" for a submenu, "" for no menu
    const char* description;  // the tooltip's sentence
    const char* search;       // more words to find it by
    Shortcut shortcut;
    std::function<bool(const Editor&)> enabled;
    std::function<bool(const Editor&)> checked;  // null: no check mark
    std::function<void(Editor&)> run;
    // For commands about something in the level with a name of its own: the label while the command is
    // enabled, "Brush: ice" instead of "Brush of key 1". Null: always `label`.
    std::function<std::string(const Editor&)> name = nullptr;
};

std::span<const Command> commands();
const Command* find_command(std::string_view id);
// The table's command for a key, or null. A test checks that the table has no conflicts. Keys that the user
// changed are in Editor::session.keymap.
const Command* command_for(const Shortcut& pressed);
// The present name in menus, tooltips and lists.
std::string command_name(const Editor& editor, const Command& command);
// Where it is in the menus: "View > Snapshots > Review snapshots".
std::string menu_location(const Command& command);
// Its present key as text for menus and tooltips; empty: none.
std::string shortcut_text(const Editor& editor, const Command& command);
// Runs it if it is enabled; false otherwise.
bool run_command(Editor& editor, std::string_view id);

}  // namespace slipface
