// The one table of commands. Menus, toolbar, shortcuts, tooltips, scripts and docs/commands.md are made from
// it.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "tools/editor.h"

namespace slipface {

// A shortcut by label, the key that carries the letter on the user's keyboard.
struct Shortcut {
    std::string key;  // "S", "1", "F5", "Delete", "Escape"; empty: none
    bool ctrl = false, shift = false, alt = false;
    std::string text() const;  // "Ctrl+Shift+S"
    friend bool operator==(const Shortcut&, const Shortcut&) = default;
};

struct Command {
    const char* id;           // "file.save", as scripts name it
    const char* icon;         // UTF-8 of a Font Awesome 4.7 glyph, or ""
    const char* label;        // "Save", "Save as…" when it asks for more
    const char* menu;         // "File", "Edit", "View", "Tools", "Playtest", "Help"
    const char* description;  // the tooltip's sentence
    const char* search;       // more words to find it by
    Shortcut shortcut;
    bool (*enabled)(const Editor&);
    bool (*checked)(const Editor&);  // null: no check mark
    void (*run)(Editor&);
};

std::span<const Command> commands();
const Command* find_command(std::string_view id);
// The command for a pressed key, or null; first in the table wins, and a test keeps the table free of
// conflicts.
const Command* command_for(const Shortcut& pressed);
// Runs it if it is enabled. False if not.
bool run_command(Editor& editor, std::string_view id);

}  // namespace slipface
